"""Bore, keyway and hub of a wheel: their outline by closed forms, and the root that they must stay below."""

import math

import numpy as np
import pytest

from wearsim.drive.load_case import load_case
from wearsim.geometry.blank import gap_space, tooth_space
from wearsim.geometry.hub import NO_HUB, Hub, circle

# Bore, width and depth of the keyway in the hub by DIN 6885-1, and two extremes.
KEYWAYS = [(8.0, 3.0, 1.4), (30.0, 8.0, 3.3), (50.0, 14.0, 3.8), (200.0, 1.0, 0.1), (20.0, 19.99, 5.0)]


@pytest.mark.parametrize(("bore", "width", "depth"), KEYWAYS)
def test_area_is_disc_and_rectangle_less_what_they_share(bore, width, depth):
    radius, half = 0.5 * bore, 0.5 * width
    shared = half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)
    outline = Hub(bore, width, depth).bore_outline
    expected = math.pi * radius**2 + width * (radius + depth) - shared
    assert outline.area == pytest.approx(expected, rel=1e-12)
    assert np.hypot(*outline.vertices[[0, 3]].T) == pytest.approx(radius, rel=1e-14)
    assert outline.vertices[1:3, 1].tolist() == [radius + depth] * 2


def test_circle():
    assert circle(3.0).area == pytest.approx(math.pi * 2.25, rel=1e-14)
    assert Hub(bore=3.0).bore_outline.area == pytest.approx(math.pi * 2.25, rel=1e-14)
    assert NO_HUB.bore_outline is None
    assert NO_HUB.notes == ()


CASE = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "mechanism": {"kind": "wrap"},
    "load": {"power_kW": 1, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
}
PITCH_DIAMETER = 12.7 / math.sin(math.pi / 17)


@pytest.mark.parametrize(
    ("chain", "more", "root"),
    [
        ("08B-1", {"profile": "iso606"}, PITCH_DIAMETER - 2 * 0.505 * 8.51),
        ("08B-1", {"profile": "iso606", "seat_centre": "root_diameter"}, PITCH_DIAMETER - 8.51),
        ("08A-1", {"profile": "ansi_b29"}, PITCH_DIAMETER - (1.005 * 7.92 + 0.003 * 25.4)),
    ],
)
def test_root_of_a_standard_form(chain, more, root):
    """Root diameter of the standards: that of the pitch circle less the seat, or less the roller."""
    sprocket = {"teeth": 17, "nodes": 101, **more}
    drive = load_case({**CASE, "chain": {"designation": chain}, "sprocket": sprocket}).drive
    assert 2.0 * gap_space(drive.outline, drive.gap).root_radius == pytest.approx(root, abs=5e-6)


def test_root_of_an_evolute_tooth():
    sprocket = {"teeth": 20, "profile": "evolute", "nodes": 51}
    drive = load_case({**CASE, "mechanism": {"kind": "strand"}, "sprocket": sprocket}).drive
    least = np.hypot(*drive.tooth.seat.T).min()
    assert tooth_space(drive.tooth).root_radius == pytest.approx(least, abs=1e-3)
