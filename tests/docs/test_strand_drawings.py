"""The drawings of the strand and the logo: as scripts draw them, and true to the closed forms of the page."""

import math
import re
import runpy
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
SCRIPT = runpy.run_path(str(DOCS / "strand_drawings.py"))
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
R, H, ROLLER = 25.4 * 20 / math.tau, 5.5, 15.88 / 2
"""Centrode radius, offset and roller radius of the case that is drawn."""


def ends_of_the_normal(text):
    """First contact and last point of the red line, y upwards."""
    numbers = [float(value) for value in NUMBER.findall(re.search(r'class="normal" d="([^"]+)"', text)[1])]
    return (numbers[0], -numbers[1]), (numbers[2], -numbers[3])


LOGO = runpy.run_path(str(DOCS / "logo.py"))
DRAWN = {f"{stem}.svg": lambda draw=draw: SCRIPT["svg"](draw()) for stem, draw in SCRIPT["DRAWINGS"].items()}
DRAWN["_static/logo.svg"] = LOGO["logo"]


@pytest.mark.parametrize("file", DRAWN)
def test_files_are_what_the_scripts_draw(file):
    kept, fresh = (DOCS / file).read_text("utf-8"), DRAWN[file]()
    assert NUMBER.sub("n", kept) == NUMBER.sub("n", fresh)
    # The last digit that is written may differ between processors.
    numbers = [[float(value) for value in NUMBER.findall(text)] for text in (kept, fresh)]
    assert numbers[0] == pytest.approx(numbers[1], abs=0.011)


@pytest.mark.parametrize(("stem", "x"), [("strand_pitch_point", 18.0), ("strand_roller", 26.0)])
def test_normal_runs_from_the_contact_through_the_roller_to_the_pitch_point(stem, x):
    touched, pitch_point = ends_of_the_normal((DOCS / f"{stem}.svg").read_text("utf-8"))
    angle = math.atan2(H, x)
    assert pitch_point == pytest.approx((0.0, R), abs=0.006)
    expected = (-x - ROLLER * math.cos(angle), R - H - ROLLER * math.sin(angle))
    assert touched == pytest.approx(expected, abs=0.006)


def test_centre_of_curvature_lies_where_euler_savary_has_it():
    """At l/(1 + l^2/(R h)) from the pitch point, on the line to the roller's centre."""
    x = SCRIPT["FAR"]
    strand = SCRIPT["reference"]().tooth.strand
    away = math.hypot(x, H) / (1.0 + (x * x + H * H) / (R * H))
    angle = math.atan2(H, x)
    expected = (-away * math.cos(angle), R - away * math.sin(angle))
    assert SCRIPT["curvature_centre"](strand, x) == pytest.approx(expected, abs=1e-9)


def test_rollers_of_the_logo_lie_on_the_pitch_circle():
    """d = p/sin(180/z) of ISO 606, one roller a gap."""
    text = (DOCS / "_static" / "logo.svg").read_text("utf-8")
    centres = [(float(x), float(y)) for x, y in re.findall(r'cx="(\S+)" cy="(\S+)"', text)]
    radius = 0.5 * 12.7 / math.sin(math.pi / 11)
    assert [math.hypot(*centre) for centre in centres] == pytest.approx([radius] * 5, abs=0.01)
    assert math.dist(*centres[:2]) == pytest.approx(12.7, abs=0.02)
