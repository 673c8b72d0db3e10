"""The gap of a sprocket that a chain wraps, by its tooth form."""

import math
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any, Literal

import numpy as np

from wearsim.case.chain_record import ChainRecord
from wearsim.case.keys import SprocketTable
from wearsim.case.sprocket_inputs import POINTS_NOISE, evolute_tooth
from wearsim.catalogue.catalogues import Chain, chains
from wearsim.errors import GeometryError
from wearsim.geometry.forms import BETWEEN_FORMS, TOOTH_FORMS
from wearsim.geometry.forms.iso606 import GapForm, gap_form
from wearsim.geometry.gap import Gap
from wearsim.geometry.gap_points import ON_CENTRE_LINE, evolute_gap, gap_from_points, lowest_centre
from wearsim.geometry.measured.drawing_doubts import EFFECT, rounding_step, rounding_text
from wearsim.geometry.measured.dxf_outline import outline_from_dxf
from wearsim.geometry.measured.edge_chains import NEAR
from wearsim.geometry.profile_points import Profile, Vector
from wearsim.input.csv_tables import read_points

OUTLINE_NODES = 601

_SAME_ROLLER = 0.1
"""Difference of roller diameters [mm] within which one sprocket takes both chains."""

_SAME_SEAT = 0.01
"""Distance [mm] beyond the standards' seats of a roller up to which nothing is said."""

_ENOUGH_POINTS = 70
"""Points of a gap from which on the joints of a standard's arcs are found within 0.001 mm."""

_FORMS: tuple[Literal["min", "max"], ...] = ("min", "max")
"""Of ISO 606: with the least and the most room for the roller."""

_ROUNDED = 1e-6
"""Part by which a given number may be beyond a limit, as both are printed with seven digits."""


@dataclass(frozen=True, eq=False)
class GapShape:
    """A gap as points, and as exact arcs where it is a standard's."""

    outline: Profile  # from the right tip through the seat to the left tip
    gap: Gap | None  # the exact arcs


def gap_shape(case: ChainRecord, table: SprocketTable, chain: Chain) -> GapShape | None:
    """Return the gap of a sprocket."""
    nodes = table.nodes or OUTLINE_NODES
    if table.nodes is None:
        case.take("sprocket.nodes", nodes, "default")
    if table.profile == "evolute":
        return _evolute(case, table, chain, nodes)
    if TOOTH_FORMS[table.profile].file:
        return _drawn(case, table, chain, nodes)
    _check_series(case, table, chain)
    try:
        gap = _standard_gap(case, table, chain)
        return GapShape(gap.outline(nodes), gap)
    except GeometryError as error:
        case.faults.add("sprocket.teeth", str(error))
        return None


def _standard_gap(case: ChainRecord, table: SprocketTable, chain: Chain) -> Gap:
    seat = table.seat_centre
    if seat is None:
        seat = "pitch_circle"
        case.take("sprocket.seat_centre", seat, "default")
    # Where only every second gap carries a roller the gaps lie nearer than a pitch.
    radius = _pitch_radius(table, chain)
    pitch = chain.pitch
    if table.engaged_every > 1:
        pitch = 2.0 * radius * math.sin(math.pi / table.teeth)
    gap = TOOTH_FORMS[table.profile].gap(
        pitch,
        chain.roller_diameter,
        table.teeth,
        seat_centre=seat,
        tip_diameter=table.tip_diameter_mm,
        **_options(case, table, chain),
    )
    if table.tip_diameter_mm is None:
        case.take("sprocket.tip_diameter_mm", 2.0 * gap.tip_radius, "by the standard")
    elif gap.truncated:
        case.warnings.append(
            f"the teeth come to a point at a diameter of {2.0 * gap.tip_radius:.5g} mm, below "
            f"sprocket.tip_diameter_mm = {table.tip_diameter_mm:g}: this is used instead"
        )
    return gap


def _options(case: ChainRecord, table: SprocketTable, chain: Chain) -> dict[str, Any]:
    """What the standard of a form leaves free beside seat and tip."""
    if any(getattr(table, key) is not None for key in BETWEEN_FORMS):
        return {"form": _between_forms(case, table, chain)}
    options = {}
    for key, default in TOOTH_FORMS[table.profile].options.items():
        options[key] = getattr(table, key)
        if options[key] is None:
            options[key] = default
            case.take(f"sprocket.{key}", default, "default")
    return options


def _between_forms(case: ChainRecord, table: SprocketTable, chain: Chain) -> GapForm:
    """Form of a gap between the two of ISO 606, by the keys that are given."""
    given = {key: getattr(table, key) for key in BETWEEN_FORMS}
    smallest, largest = (_lengths(gap_form(name, chain.roller_diameter, table.teeth)) for name in _FORMS)
    for key, value in given.items():
        low, high = sorted((smallest[key], largest[key]))
        if value is None:
            case.take(f"sprocket.{key}", smallest[key], "minimum form of ISO 606")
        elif not low * (1.0 - _ROUNDED) <= value <= high * (1.0 + _ROUNDED):
            case.faults.add(
                f"sprocket.{key}",
                f"must lie between the two forms of ISO 606, {low:.7g} and {high:.7g} for rollers of "
                f"{chain.roller_diameter:g} mm and {table.teeth} teeth (got {value:g})",
            )
    radius, flank, angle = (given[key] or smallest[key] for key in BETWEEN_FORMS)
    return GapForm(flank, radius, math.radians(angle))


def _lengths(form: GapForm) -> dict[str, float]:
    """The numbers of a form by their keys."""
    lengths = form.seat_radius, form.flank_radius, math.degrees(form.seating_angle)
    return dict(zip(BETWEEN_FORMS, lengths, strict=True))


def _pitch_radius(table: SprocketTable, chain: Chain) -> float:
    """Radius of the circle through the centres of the rollers [mm]."""
    return 0.5 * chain.pitch / math.sin(math.pi * table.engaged_every / table.teeth)


def _check_series(case: ChainRecord, table: SprocketTable, chain: Chain) -> None:
    """Add a fault where the standard's sprockets of this pitch take other rollers."""
    if not chain.designation:
        return
    series = TOOTH_FORMS[table.profile].series
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


def _evolute(case: ChainRecord, table: SprocketTable, chain: Chain, nodes: int) -> GapShape | None:
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


def _drawn(case: ChainRecord, table: SprocketTable, chain: Chain, nodes: int) -> GapShape | None:
    """Return a gap from a table of points or from a drawing."""
    key = "sprocket.points_file" if table.points_file else "sprocket.dxf_file"
    noise = table.points_noise_mm
    if noise is None:
        noise = POINTS_NOISE if table.points_file else 0.0
        case.take("sprocket.points_noise_mm", noise, "error of the points, sets the smoothing")
    name = table.points_file or table.dxf_file
    assert name is not None
    points = _points(case, key, name, table)
    if points is None or not _has_right_size(case, key, points, table, chain):
        return None
    x, y = points
    try:
        outline = gap_from_points(x, y, noise, nodes, 0.5 * chain.roller_diameter)
    except GeometryError as error:
        case.faults.add(key, f"{PurePath(name).name}: {error}")
        return None
    count = 2 * x.size if abs(x[0]) <= ON_CENTRE_LINE else x.size
    if count < _ENOUGH_POINTS:
        case.warnings.append(
            f"{PurePath(name).name} gives the gap by {count} points: the outline may be 0.01 mm off where "
            f"arcs meet, and forces wrong by several percent; give {_ENOUGH_POINTS} or more, in a drawing "
            "arcs or shorter lines"
        )
    return GapShape(outline, None) if _seats_roller(case, key, outline, table, chain) else None


def _points(case: ChainRecord, key: str, name: str, table: SprocketTable) -> tuple[Vector, Vector] | None:
    """Coordinates from the file, None where there was a fault."""
    path = case.path(name)
    if table.points_file:
        found = read_points(path, key, case.faults)
        step = 0.0 if found is None else rounding_step(np.column_stack(found), 1.0)
        if step > math.sqrt(12.0) * (table.points_noise_mm or POINTS_NOISE):
            case.warnings.append(f"{path.name}: {rounding_text(step)}: {EFFECT}")
        return found
    tolerance = table.dxf_join_tolerance_mm
    if tolerance is None:
        tolerance = NEAR
        case.take("sprocket.dxf_join_tolerance_mm", tolerance, "default")
    try:
        drawn = outline_from_dxf(path, table.teeth, layer=table.dxf_layer, tolerance=tolerance)
    except GeometryError as error:
        case.faults.add(key, str(error))
        return None
    case.assumptions += [f"drawing {name}: {note}" for note in drawn.notes]
    case.warnings += [f"drawing {name}: {text}" for text in drawn.warnings]
    return drawn.points[:, 0], drawn.points[:, 1]


def _has_right_size(
    case: ChainRecord, key: str, points: tuple[Vector, Vector], table: SprocketTable, chain: Chain
) -> bool:
    """Whether the bottom lies less than a pitch inside the pitch circle, else a fault."""
    radius, bottom = _pitch_radius(table, chain), float(np.hypot(*points).min())
    if radius - chain.pitch < bottom < radius:
        return True
    case.faults.add(
        key,
        f"the bottom of the gap must lie inside the pitch circle of radius {radius:.5g} mm, by less than "
        f"a pitch, but lies {bottom:.5g} mm from the sprocket's centre: check sprocket.teeth, the chain, "
        "the unit of the file ($INSUNITS in a drawing) and that the centre is at (0, 0)",
    )
    return False


def _seats_roller(case: ChainRecord, key: str, outline: Profile, table: SprocketTable, chain: Chain) -> bool:
    """Whether a roller seats about as on new sprockets of these teeth, else a fault.

    Standard forms seat it on the pitch circle or below, the lowest of them ISO 606's maximum
    form by 0.005 d1 + 0.069 cbrt(d1): by 0.65 mm on the largest chain of the catalogue and by
    0.022 p on the smallest, from 9 to 150 teeth. A tooth more or less moves all of them by
    p/(2 pi engaged_every); from halfway to there on it is a fault, between a warning.
    """
    radius, roller_radius = _pitch_radius(table, chain), 0.5 * chain.roller_diameter
    seat = math.hypot(*lowest_centre(outline.x, outline.y, roller_radius))
    deepest = gap_form("max", chain.roller_diameter, table.teeth).seat_radius - roller_radius
    beyond = max(seat - radius, radius - deepest - seat)
    step = chain.pitch / (2.0 * math.pi * table.engaged_every)
    new = f"{radius - deepest:.5g} to {radius:.5g} mm"
    if beyond > 0.5 * (step - deepest):
        case.faults.add(
            key,
            f"the gap must seat a roller of {chain.roller_diameter:g} mm near the pitch circle of radius "
            f"{radius:.5g} mm, as new sprockets do at {new}, but seats it {seat:.5g} mm from the "
            f"sprocket's centre: check sprocket.teeth = {table.teeth}, the chain and the unit of the file",
        )
        return False
    if beyond > _SAME_SEAT + (table.points_noise_mm or 0.0):
        way = "higher" if seat > radius else "lower"
        case.warnings.append(
            f"the gap of {key} seats a roller {seat:.5g} mm from the sprocket's centre, {beyond:.2g} mm "
            f"{way} than a new sprocket of {table.teeth} teeth would ({new}): correct if it is worn or was "
            "made that way, otherwise check teeth, chain and points"
        )
    return True
