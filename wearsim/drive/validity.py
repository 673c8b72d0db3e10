"""Where a run leaves the limits of its theory: warnings of its result, and the film of oil between flanks."""

import numpy as np

from wearsim.case.model import Case, FilmInput
from wearsim.contact.engagement import FlankContact
from wearsim.contact.hertz import half_width
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.lubrication.film import Lubricant, minimum_film

_FEW_CYCLES = 1000
"""Life below which a coefficient is doubtful."""

_WIDE = 0.1
"""Half-width over roller radius above which Hertz's half-spaces are doubtful."""

_RIDGE = 3.0
"""Relative curvature over the greatest of the new flank above which a place is a ridge."""

_BOUNDARY, _FULL = 1.0, 3.0
"""Film ratios between which flanks touch through the film, by convention."""


def few_cycles(cycles: float) -> list[str]:
    """Return a warning of a life that is hardly one."""
    if cycles >= _FEW_CYCLES:
        return []
    return [f"the life is only {cycles:.3g} cycles: check the wear coefficient and its unit"]


def wide_contact(contact: FlankContact, half_width: float) -> list[str]:
    """Return a warning of a contact too wide for half-spaces."""
    if half_width <= _WIDE * contact.mate_radius:
        return []
    return [
        f"contact half-width up to {half_width:.3g} mm is more than 0.1 of the radius of roller or mate: "
        "Hertz theory overestimates the pressure there"
    ]


_EDGE = "for that part of a pitch the roller touches the edge of the tip, which is not modelled"


def low_contact_ratio(hours: Vector, ratio: Vector) -> list[str]:
    """Return a warning of a worn tooth that lets its roller go too early."""
    if not (ratio < 1.0).any():
        return []
    return [
        f"the worn contact ratio is below 1 from about {hours[int((ratio < 1.0).argmax())]:.3g} h on, "
        f"lowest {ratio.min():.3f}: {_EDGE}"
    ]


def low_contact_ratio_in_the_end(ratio: float) -> list[str]:
    """Return the same warning where only the worn tooth in the end is known."""
    if not ratio < 1.0:
        return []
    return [f"the worn contact ratio is {ratio:.3f} in the end, below 1: {_EDGE}"]


def validity(contact: FlankContact, history: dict[str, Vector], flank: dict[str, Vector]) -> list[str]:
    """Return a warning for every limit of the theory that a run passes."""
    load, relative = flank["load_per_width_N_per_mm"], flank["relative_curvature_per_mm"]
    # Between two steps an interpolated flank may conform where those of both steps do not.
    touching = (load > 0.0) & (relative > 0.0)
    widths = half_width(load[touching], relative[touching], contact.modulus)
    found = wide_contact(contact, float(widths.max()))
    spacing = float(np.diff(contact.arc_length).max())
    if spacing > np.median(widths):
        found.append(
            f"points lie {spacing:.3g} mm apart, wider than the contact's half-width "
            f"{np.median(widths):.3g} mm: use more points (nodes, or rows of the table of loads)"
        )
    if contact.least_curvature > 0.0:
        found += _bridged(contact, history["time_hours"], relative, load)
    return found + low_contact_ratio(history["time_hours"], history["worn_contact_ratio"])


def _bridged(contact: FlankContact, hours: Vector, relative: Vector, load: Vector) -> list[str]:
    """Return warnings of hollows that the mate bridges, and of ridges between them."""
    shape = hours.size, contact.arc_length.size
    curvature, loaded = relative.reshape(shape), load.reshape(shape) > 0.0
    hollow = ((curvature <= contact.least_curvature) & loaded).mean(axis=1)
    ridge = ((curvature > _RIDGE * curvature[0].max()) & loaded).any(axis=1)
    found = []
    if hollow.any():
        found.append(
            f"from about {hours[int((hollow > 0.0).argmax())]:.3g} h on the mate bridges hollows, on "
            f"{100.0 * hollow.max():.2g} % of the flank at most: Hertz theory does not give the pressure "
            "there"
        )
    if ridge.any():
        found.append(
            f"from about {hours[int(ridge.argmax())]:.3g} h on ridges remain where sliding is small or the "
            "load steps: the Hertz pressure on them, which is the peak pressure, grows without limit on "
            "finer grids"
        )
    return found


def film_ratio(case: Case, film: FilmInput) -> Vector:
    """Return the least film over the roughness at the loaded points of the new flank.

    Equation physics.md (L11).

    Parameters
    ----------
    case : Case
        A drive whose contact travels.
    film : FilmInput
        The oil and the roughness.

    Returns
    -------
    numpy.ndarray
        Lambda.

    Raises
    ------
    CaseError
        The speeds of the surfaces are not known.
    """
    contact = case.drive.mechanism(case).contact
    touch = contact.new_engagement()
    speed = case.drive.entrainment_speed(case, touch)
    loaded = (touch.load_per_width > 0.0) & (speed > 0.0)
    if not loaded.any():
        message = "needs the speed of both surfaces: give the columns slip_ratio and sliding_speed_mm_per_s"
        raise CaseError([Fault(message, "film", case.name)])
    thickness = minimum_film(
        Lubricant(film.viscosity, film.pressure_viscosity),
        speed[loaded],
        touch.load_per_width[loaded],
        touch.relative_curvature[loaded],
        contact.modulus,
    )
    return np.asarray(thickness / film.roughness)


def film_assumptions(case: Case) -> tuple[str, ...]:
    """Return the film ratio of a case in words; nothing where its oil is not given."""
    if case.film is None:
        return ()
    ratio = film_ratio(case, case.film)
    least, greatest = float(ratio.min()), float(ratio.max())
    state = (
        "boundary lubrication somewhere"
        if least < _BOUNDARY
        else "mixed lubrication somewhere"
        if least < _FULL
        else "full film"
    )
    return (
        f"film ratio lambda {least:.3g} to {greatest:.3g} along the new flank, {state} (Dowson and "
        "Higginson; inlet flooded with oil, which a starved contact or an oil bath at high speed does not "
        "have: its film is thinner); it does not change the wear",
    )
