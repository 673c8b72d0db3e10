"""How thick the film of oil on new flanks is against their roughness."""

import numpy as np

from wearsim.case.model import Case, FilmInput
from wearsim.errors import CaseError, Fault
from wearsim.geometry.profile_points import Vector
from wearsim.lubrication.film import Lubricant, minimum_film

_BOUNDARY, _FULL = 1.0, 3.0
"""Film ratios between which flanks touch through the film, by convention."""


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
