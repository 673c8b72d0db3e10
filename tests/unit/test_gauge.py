"""The gauge held against drawn wheels: a way into the gap of one that is worn out, into no other."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely import affinity

from wearsim.cad.gauge import gauge
from wearsim.drive.load_case import load_case
from wearsim.geometry.wheel_outline import worn_gap, worn_space
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.report.worn_flank import wheel_shapes

CASES = Path(__file__).parents[2] / "cases"
WRAP = """\
format_version = 1
chain.designation = "{chain}"
sprocket = {{ teeth = {teeth}, nodes = 301, {form} }}
mechanism = {{ kind = "wrap" }}
load = {{ power_kW = 1, speed_rpm = 100 }}
wear.specific_wear_rate_mm2_per_N = 1e-9
stop.critical_depth_mm = 0.02
drive = {{ links = 60 }}
"""
WRAPS = {
    "iso606": ("08B-1", 12, 'profile = "iso606"'),
    "ansi_b29": ("08A-1", 13, 'profile = "ansi_b29"'),
    "gost591": ("ПР-12.7-18.2", 14, 'profile = "gost591", displaced = true'),
    "points": ("08B-1", 12, 'profile = "points", points_file = "gap.csv"'),
    "dxf": ("08B-1", 12, 'profile = "dxf", dxf_file = "wheel.dxf"'),
}
STRANDS = {"strand evolute": "16b-20t-oiled", "strand points": "beet-harvester-18t-soil"}
WHERE = np.array([0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0])
WORN = np.array([0.3, 0.3, 0.4, 1.0, 1.0, 0.4, 0.3, 0.3])
"""Part of the loaded side from the root, and of the greatest depth."""

FINE = 5e-4
"""What the chords of both drawings leave in doubt [mm]."""


def written(folder, form):
    chain, teeth, profile = WRAPS[form]
    path = folder / f"{form}.toml"
    path.write_text(WRAP.format(chain=chain, teeth=teeth, form=profile), encoding="utf-8")
    return path


def wheel(folder, form):
    """The case of a form; a gap by points and a drawing are those of ISO 606."""
    if form in STRANDS:
        return load_case(CASES / f"{STRANDS[form]}.toml")
    if form == "points":
        outline = load_case(written(folder, "iso606")).drive.outline
        points = np.column_stack([outline.x, outline.y])
        np.savetxt(folder / "gap.csv", points, "%.12f", ",", header="x_mm,y_mm", comments="")
    if form == "dxf":
        from wearsim.cad.wheel_formats import export

        drawing = export(load_case(written(folder, "iso606")), None, ("new",), "dxf")
        (folder / "wheel.dxf").write_bytes(drawing)
    return load_case(written(folder, form))


def worn(case, depth):
    """The wheel whose loaded side is worn by a depth over the part of its length from the root."""
    (shape,) = wheel_shapes(case, None)
    new, on_strand = shape.new[0], isinstance(case.drive, StrandDrive)
    profile = case.drive.tooth.flank if on_strand else case.drive.outline
    points = np.column_stack([profile.x, profile.y])
    loaded = np.arange(len(points)) if on_strand else np.flatnonzero(points[:, 0] < 0.0)
    at = np.linspace(0.0, 1.0, len(loaded))
    way = np.gradient(points, axis=0)[loaded]
    # The steel lies on the left of the way from the root to the tip.
    normal = way[:, ::-1] * (-1.0, 1.0) / np.hypot(*way.T)[:, None]
    points[loaded] += np.interp(at, *depth)[:, None] * normal
    space = (worn_space if on_strand else worn_gap)(new, points)
    return replace(shape, worn=(space,) * len(shape.new))


def drawn(chain):
    return shapely.Polygon(chain.outline.polygon(1e-5))


def steel(shape, state):
    (chain,) = shape.chains(state)
    return drawn(chain)


def fits(gauge_, steel_, turn=0.0):
    """Whether a gauge, its shoulders on both tips and turned about the axis, is free of steel."""
    placed = affinity.rotate(gauge_, turn, origin=(0.0, 0.0), use_radians=True)
    return not placed.buffer(-FINE).intersects(steel_)


@pytest.mark.wide
@pytest.mark.parametrize("form", [*STRANDS, *WRAPS])
def test_it_goes_in_where_the_gap_is_worn_out_and_nowhere_else(tmp_path, form):
    """Both shoulders on the tips: too wide for a new gap and for one that is worn by 95 % of the limit."""
    case = wheel(tmp_path, form)
    limit = 0.02 * case.drive.chain.pitch
    shape = worn(case, (WHERE, limit * WORN))
    body = drawn(gauge(shape).outline)
    assert body.is_valid
    assert fits(body, steel(shape, "worn"))
    axis = shapely.Point(0.0, 0.0)
    assert body.distance(axis) > steel(shape, "new").exterior.distance(axis)
    turns = np.linspace(-limit, limit, 41) / shape.pitch_radius
    for part, goes_in in ((0.0, False), (0.5, False), (0.95, False), (1.05, True)):
        there = steel(worn(case, (WHERE, part * limit * WORN)), "worn")
        assert any(fits(body, there, turn) for turn in turns) is goes_in, part
    # It is what lies on the tips that stops it there.
    stopped = affinity.translate(body, 0.0, -0.2 * limit) & steel(shape, "worn")
    sides = {piece.centroid.x > 0.0 for piece in shapely.get_parts(stopped) if piece.area > 1e-3}
    assert sides == {False, True}


@pytest.mark.wide
@pytest.mark.parametrize("form", [*STRANDS, *WRAPS])
def test_what_is_worn_less_elsewhere_does_not_keep_it_out(tmp_path, form):
    """A gap as deep where the model wears it most, and new towards seat and tip, is worn out too."""
    case = wheel(tmp_path, form)
    limit = 0.02 * case.drive.chain.pitch
    body = drawn(gauge(worn(case, (WHERE, limit * WORN))).outline)
    other = np.where(WORN < 0.4, 0.0, WORN)
    assert fits(body, steel(worn(case, (WHERE, limit * other)), "worn"))


@pytest.mark.wide
@pytest.mark.parametrize("form", [*STRANDS, *WRAPS])
def test_it_comes_in_from_above(tmp_path, form):
    """Into a gap that is worn out, also where only its deepest part is worn and the tip is new."""
    case = wheel(tmp_path, form)
    limit = 0.02 * case.drive.chain.pitch
    one = gauge(worn(case, (WHERE, limit * WORN)))
    body, way = drawn(one.outline), np.array([math.sin(one.slant), math.cos(one.slant)])
    for depths in (WORN, np.where(WORN < 0.4, 0.0, WORN)):
        there = steel(worn(case, (WHERE, limit * depths)), "worn")
        for lift in np.linspace(0.0, one.box[3], 120):
            assert fits(affinity.translate(body, *(lift * way)), there), lift


@pytest.mark.parametrize("form", STRANDS)
def test_below_the_tips_it_is_no_wider_than_the_gap_between_them(form, tmp_path):
    """Across the way in; the gap itself is wider below, so that a gauge of its form would catch."""
    case = wheel(tmp_path, form)
    shape = worn(case, ([0.0, 0.5, 1.0], 0.02 * case.drive.chain.pitch * np.array([0.0, 1.0, 0.2])))
    one = gauge(shape)
    tips = np.array([shape.worn[0].right[0].vertices[0], shape.worn[0].left[-1].vertices[-1]])
    across = np.array([math.cos(one.slant), -math.sin(one.slant)])
    below = one.outline.vertices[np.hypot(*one.outline.vertices.T) < shape.tip_radius - FINE]
    assert np.ptp(below @ across) < np.ptp(tips @ across) + FINE
    gap = np.concatenate([part.vertices for part in (*shape.worn[0].right, *shape.worn[0].left)])
    assert np.ptp(gap[:, 0]) > np.ptp(tips[:, 0]) + 0.5
