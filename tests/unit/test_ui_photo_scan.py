"""What the page makes of a photograph: views of it, marked points, and the overlay."""

import base64
import io
import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

import wearsim
from tests.photographs import Camera, new_gap, picture, wheel, with_pocket
from wearsim.page.photo_scan import (
    ScanWish,
    close_view,
    crosses,
    depth_colours,
    overlay,
    scanned,
    sprocket_names,
    whole_view,
)
from wearsim.scanning.photograph import Photograph, photograph_of

CASE = "08b-19t-wrap"


def shown(view):
    """Return the picture of a view."""
    kind, _, content = view.source.partition(",")
    assert kind == "data:image/jpeg;base64"
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(content))))


def dotted(width, height, x, y):
    """Return a black photograph with a white square of 5 pixels around a place."""
    light = np.zeros((height, width), np.float32)
    light[y - 2 : y + 3, x - 2 : x + 3] = 1.0
    return Photograph("dot.png", light)


def middle(codes):
    """Return the centre of what is bright, in pixels from the corner."""
    down, across = np.nonzero(codes > 128)
    return across.mean() + 0.5, down.mean() + 0.5


@pytest.mark.parametrize("size", [(600, 400), (3000, 2000)])
def test_a_place_is_found_again(size):
    """A place that is clicked in the whole picture, then in its enlarged part."""
    photograph = dotted(*size, 437, 211)
    whole = whole_view(photograph)
    assert max(shown(whole).shape) <= 1400
    rough = whole.place(*middle(shown(whole)))
    assert rough == pytest.approx((437, 211), abs=whole.step)
    close = close_view(photograph, *rough)
    assert shown(close).shape == (200, 200)
    assert close.place(*middle(shown(close))) == pytest.approx((437, 211), abs=0.3)


@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (599.0, 399.0)])
def test_a_close_view_stays_in_the_photograph(x, y):
    view = close_view(dotted(600, 400, 300, 200), x, y)
    assert shown(view).shape == (200, 200)
    assert 0 <= view.left <= 400 and 0 <= view.top <= 200


def test_a_drawing_is_moved_into_its_view():
    """The middle of pixel 100, 200 is half a pixel off the corner of a view that begins there."""
    view = replace(whole_view(dotted(600, 400, 300, 200)), left=100, top=200, step=2)
    assert view.layer("x") == '<g transform="scale(0.5) translate(-99.5 -199.5)">x</g>'
    assert crosses([(10.0, 20.0)], 2.0).count('points="8.0,18.0 12.0,22.0"') == 1


@pytest.fixture(scope="module")
def photograph():
    """19 teeth, 0.3 mm deep."""
    content = io.BytesIO()
    picture(wheel([with_pocket(new_gap(12.7, 8.51, 19), 0.3)] * 19), Camera()).save(content, "PNG")
    return photograph_of(content.getvalue(), "wheel.png")


def scan(photograph, case, **wish):
    return scanned(photograph, case, ScanWish(**wish), lambda part: None)


def test_overlay_lies_on_the_wheel(photograph):
    """The wheel fills 0.8 of 600 pixels about their middle."""
    found = scan(photograph, wearsim.load_case(CASE)).found
    drawn = overlay(found)
    points = np.array(
        [
            [float(value) for value in pair.split(",")]
            for line in re.findall(r'points="([^"]*)"', drawn)
            for pair in line.split()
        ]
    )
    radius = np.hypot(*(points - 299.5).T)
    assert radius.max() == pytest.approx(240.0, abs=2.0)
    assert re.findall(r">(\d+)</text>", drawn) == [str(number) for number in range(1, 20)]
    assert set(re.findall(r'stroke="(#\w+)"', drawn)) >= {colour for colour, _ in depth_colours(found)}


def test_teeth_are_corrected(photograph):
    case = wearsim.load_case(CASE).with_({"sprocket.teeth": 20})
    with pytest.raises(wearsim.CaseError, match="20 teeth as given, but 19 are counted"):
        scan(photograph, case)
    assert scan(photograph, case, teeth=19).depth == pytest.approx(0.3, abs=0.03)


def test_sprockets_of_a_drive(photograph):
    case = wearsim.load_case("packaging-conveyor")
    names = sprocket_names(case)
    assert len(names) > 1 and sprocket_names(wearsim.load_case(CASE)) == []
    with pytest.raises(wearsim.CaseError, match="19 are counted"):
        scan(photograph, case, sprocket=names[-1], teeth=30)


def test_a_wrong_number_is_refused(photograph):
    with pytest.raises(wearsim.GeometryError, match="hours must be above 0"):
        scan(photograph, wearsim.load_case(CASE), hours=-1.0)


def test_what_is_no_picture():
    with pytest.raises(wearsim.CaseError, match=r"a\.jpg: must be a PNG, JPEG or TIFF"):
        photograph_of(b"no picture", "a.jpg")
