"""Tooth thickness and tip land that an outline leaves, against closed forms."""

import math

import numpy as np
import pytest

from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.worn_tooth import tip_land, tooth_thickness


def radial_gap(half_angle, bottom, top, points=11):
    """Two sides on rays through the centre, a chord between their lower ends."""
    radius = np.linspace(top, bottom, points)
    x, y = radius * np.sin(half_angle), radius * np.cos(half_angle)
    return np.concatenate([x, -x[::-1]]), np.concatenate([y, y[::-1]])


@pytest.mark.parametrize("teeth", [5, 12, 40])
@pytest.mark.parametrize("radius", [9.3, 10.0, 11.7])
def test_sides_on_rays(teeth, radius):
    """A gap of half the pitch angle leaves 2 R sin(90/z)."""
    x, y = radial_gap(0.5 * math.pi / teeth, 9.0, 12.0)
    expected = 2.0 * radius * math.sin(0.5 * math.pi / teeth)
    assert tooth_thickness(x, y, teeth, radius) == pytest.approx(expected, rel=1e-12)
    assert tip_land(x, y, teeth) == pytest.approx(12.0 * math.pi / teeth, rel=1e-12)


def test_radius_is_held_between_bottom_and_tips():
    x, y = radial_gap(0.1, 9.0, 12.0)
    below, above = (tooth_thickness(x, y, 10, radius) for radius in (1.0, 99.0))
    assert below == pytest.approx(18.0 * math.sin(math.pi / 10 - 0.1), rel=1e-12)
    assert above == pytest.approx(24.0 * math.sin(math.pi / 10 - 0.1), rel=1e-12)


def test_flanks_that_met_count_as_negative():
    x, y = radial_gap(1.1 * math.pi / 8, 9.0, 12.0)
    assert tooth_thickness(x, y, 8, 10.0) == pytest.approx(-20.0 * math.sin(0.1 * math.pi / 8))
    assert tip_land(x, y, 8) == pytest.approx(-12.0 * 0.2 * math.pi / 8)


def test_lower_tip_bounds_the_circle_and_the_higher_one_the_land():
    """One side worn down to 11 mm."""
    right = np.linspace(12.0, 9.0, 7)
    left = np.linspace(9.0, 11.0, 7)
    x = np.concatenate([right * math.sin(0.1), -left * math.sin(0.1)])
    y = np.concatenate([right * math.cos(0.1), left * math.cos(0.1)])
    thickness = tooth_thickness(x, y, 10, 12.0)
    assert thickness == pytest.approx(22.0 * math.sin(math.pi / 10 - 0.1), rel=1e-12)
    assert tip_land(x, y, 10) == pytest.approx(12.0 * (math.pi / 5 - 0.2), rel=1e-12)


@pytest.mark.parametrize(
    ("form", "tip", "land"), [("min", 72.1105, 2.526), ("max", 72.1105, 0.847), ("min", 76.4808, 0.488)]
)
def test_printed_tip_lands_of_08b(form, tip, land):
    """Table of 08B z = 17; the thickness on the tip circle is the chord of the land."""
    outline = iso606_gap(12.7, 8.51, 17, form=form, tip_diameter=tip).outline(401)
    assert tip_land(outline.x, outline.y, 17) == pytest.approx(land, abs=5.1e-4)
    chord = tip * math.sin(land / tip)
    thickness = tooth_thickness(outline.x, outline.y, 17, 0.5 * tip)
    assert thickness == pytest.approx(chord, abs=5.1e-4)
