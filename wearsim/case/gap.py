"""The gap of a sprocket that a chain wraps, by its tooth form."""

import math
from dataclasses import dataclass

from wearsim.case.flank import POINTS_NOISE, evolute_tooth
from wearsim.case.resolution import Resolution
from wearsim.case.schema import SprocketTable
from wearsim.case.tables import read_points
from wearsim.catalogue.tables import Chain, chains
from wearsim.errors import GeometryError
from wearsim.geometry.ansi_b29 import ansi_b29_gap
from wearsim.geometry.dxf import outline_from_dxf
from wearsim.geometry.gap import Gap, pitch_diameter
from wearsim.geometry.gap_points import evolute_gap, gap_from_points
from wearsim.geometry.gost591 import gost591_gap
from wearsim.geometry.iso606 import iso606_gap
from wearsim.geometry.profile import Profile

OUTLINE_NODES = 601

_SAME_ROLLER = 0.1
"""Difference of roller diameters [mm] within which one sprocket takes both chains."""

_SERIES = {
    "iso606": ("ISO606-A/ANSI B29.1", "ISO606-B", "ISO606-H"),
    "ansi_b29": ("ISO606-A/ANSI B29.1", "ISO606-H"),
    "gost591": ("GOST13568",),
}
"""Series of the catalogue that a standard form is made for."""


@dataclass(frozen=True, eq=False)
class GapShape:
    """A gap as points, and as exact arcs where it is a standard's.

    Attributes
    ----------
    outline : Profile
        From the right tip through the seat to the left tip.
    gap : Gap or None
        The exact arcs.
    """

    outline: Profile
    gap: Gap | None


def gap_shape(case: Resolution, table: SprocketTable, chain: Chain) -> GapShape | None:
    """Return the gap of a sprocket.

    Parameters
    ----------
    case : Resolution
        The case so far.
    table : SprocketTable
        Its sprocket.
    chain : Chain
        Its chain.

    Returns
    -------
    GapShape or None
        None where there was a fault.
    """
    nodes = table.nodes or OUTLINE_NODES
    if table.nodes is None:
        case.take("sprocket.nodes", nodes, "default")
    if table.profile == "evolute":
        return _evolute(case, table, chain, nodes)
    if table.profile in ("points", "dxf"):
        return _drawn(case, table, chain, nodes)
    _check_series(case, table, chain)
    try:
        gap = _standard(case, table, chain)
        return GapShape(gap.outline(nodes), gap)
    except GeometryError as error:
        case.faults.add("sprocket.teeth", str(error))
        return None


def _standard(case: Resolution, table: SprocketTable, chain: Chain) -> Gap:
    seat = table.seat_centre
    if seat is None:
        seat = "pitch_circle"
        case.take("sprocket.seat_centre", seat, "default")
    # Where only every second gap carries a roller the gaps lie nearer than a pitch.
    radius = 0.5 * chain.pitch / math.sin(math.pi * table.engaged_every / table.teeth)
    pitch = chain.pitch
    if table.engaged_every > 1:
        pitch = 2.0 * radius * math.sin(math.pi / table.teeth)
    common = (pitch, chain.roller_diameter, table.teeth)
    if table.profile == "ansi_b29":
        gap = ansi_b29_gap(*common, seat, table.tip_diameter_mm)
    elif table.profile == "gost591":
        if table.displaced is None:
            case.take("sprocket.displaced", False, "default")
        gap = gost591_gap(*common, table.displaced or False, seat, table.tip_diameter_mm)
    else:
        form = table.form
        if form is None:
            form = "min"
            case.take("sprocket.form", form, "default")
        gap = iso606_gap(*common, form, seat, table.tip_diameter_mm)
    if table.tip_diameter_mm is None:
        case.take("sprocket.tip_diameter_mm", 2.0 * gap.tip_radius, "the standard's")
    elif gap.truncated:
        case.warnings.append(
            f"the teeth are pointed at a diameter of {2.0 * gap.tip_radius:.5g} mm, below "
            f"sprocket.tip_diameter_mm = {table.tip_diameter_mm:g}: cut off there"
        )
    return gap


def _check_series(case: Resolution, table: SprocketTable, chain: Chain) -> None:
    """Add a fault where the standard's sprockets of this pitch take other rollers."""
    if not chain.designation:
        return
    series = _SERIES[table.profile]
    made_for = {
        known.designation: known.roller_diameter
        for known in chains().values()
        if known.series in series
        and known.strands == 1
        and abs(known.pitch - chain.pitch) < 0.01 * chain.pitch
    }
    if any(abs(diameter - chain.roller_diameter) <= _SAME_ROLLER for diameter in made_for.values()):
        return
    others = ", ".join(f"{name} ({size:g} mm)" for name, size in made_for.items()) or "none"
    case.faults.add(
        "sprocket.profile",
        f"a {table.profile} sprocket must be cut for the chain's roller, but chain {chain.designation} "
        f"has rollers of {chain.roller_diameter:g} mm and those of pitch {chain.pitch:g} mm in that "
        f"standard are {others}: choose the profile of the chain's own standard or another chain",
    )


def _evolute(case: Resolution, table: SprocketTable, chain: Chain, nodes: int) -> GapShape | None:
    centrode = chain.pitch * table.teeth / (2.0 * math.pi * table.engaged_every)
    found = evolute_tooth(case, table, chain, centrode, nodes)
    if found is None:
        return None
    case.assumptions.append(
        "the evolute flank of the straight strand is moved out until its gap seats the roller on the "
        "pitch circle; its contact ratio does not apply to a wrap"
    )
    try:
        return GapShape(evolute_gap(found[0], chain.pitch, nodes), None)
    except GeometryError as error:
        case.faults.add("sprocket.profile", str(error))
        return None


def _drawn(case: Resolution, table: SprocketTable, chain: Chain, nodes: int) -> GapShape | None:
    """Return a gap from a table of points or from a drawing."""
    key = "sprocket.points_file" if table.points_file else "sprocket.dxf_file"
    noise = table.points_noise_mm
    if noise is None:
        noise = POINTS_NOISE if table.points_file else 0.0
        case.take("sprocket.points_noise_mm", noise, "error of the points, sets the smoothing")
    name = table.points_file or table.dxf_file
    assert name is not None
    path = case.path(key, name)
    try:
        if table.points_file:
            points = read_points(path, key, case.faults)
            if points is None:
                return None
            x, y = points
        else:
            drawn, notes = outline_from_dxf(path, table.teeth, layer=table.dxf_layer)
            x, y = drawn.T
            case.assumptions += [f"drawing {name}: {note}" for note in notes]
        outline = gap_from_points(x, y, noise, nodes, 0.5 * chain.roller_diameter)
    except GeometryError as error:
        case.faults.add(key, str(error))
        return None
    radius = 0.5 * pitch_diameter(chain.pitch, table.teeth)
    if not outline.y.min() < radius:
        case.faults.add(
            key,
            f"the gap must reach inside the pitch circle of radius {radius:.5g} mm, its bottom lies at "
            f"{outline.y.min():.5g} mm: check teeth, pitch and the drawing's units",
        )
        return None
    return GapShape(outline, None)
