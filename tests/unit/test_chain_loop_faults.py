"""Loops that cannot run are refused with the names of the parts and their figures."""

import math

import pytest

from wearsim.chain.chain_loop import ChainLoop, Wheel
from wearsim.chain.take_up import TakeUp, fitting_travel
from wearsim.errors import CaseError, GeometryError

PITCH = 10.0


def wheels(*rows: tuple[str, float, float, int] | tuple[str, float, float, int, bool]) -> tuple[Wheel, ...]:
    return tuple(Wheel(name, (x, y), teeth, *outside) for name, x, y, teeth, *outside in rows)


LEFT, RIGHT = ("left", 0.0, 0.0, 20), ("right", 400.0, 0.0, 20)
"""Pitch radius 31.96 mm each."""


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (
            (LEFT, ("right", 60.0, 0.0, 20)),
            r"'left' and 'right' must not overlap, are 60 mm apart.*69\.138 mm",
        ),
        ((LEFT, RIGHT, ("top", 200.0, 300.0, 20), ("idler", 200.0, 260.0, 11, True)), "'top' and 'idler'"),
        (
            (LEFT, RIGHT, ("idler", 200.0, 90.0, 11, True)),
            r"does not touch wheel 'idler'.*'right' and 'left'",
        ),
        ((LEFT, RIGHT, ("third", 200.0, -5.0, 20)), r"clockwise: give the wheels in the order third, right"),
        ((LEFT, RIGHT, ("top", 250.0, 300.0, 20), ("in", 200.0, 160.0, 11)), "does not touch wheel 'in'"),
        ((LEFT, RIGHT, ("high", 200.0, 0.0, 20)), r"does not touch wheel 'high'.*above 0, would be 0 deg"),
        ((LEFT, ("top", 200.0, 300.0, 20), RIGHT), r"in the order right, top, left"),
        ((LEFT, ("right", 400.0, 0.0, 20, True)), "at least two wheels must lie inside the loop, 1 do"),
        ((LEFT, ("left", 400.0, 0.0, 20)), "2 are called 'left'"),
        ((LEFT, ("right", 400.0, 0.0, 4)), "'right' needs at least 5 teeth, has 4"),
        ((LEFT, ("right", math.nan, 0.0, 20)), "'right' needs a centre of two finite numbers"),
    ],
)
def test_loops_that_cannot_be(rows, message):
    with pytest.raises(CaseError, match=message):
        ChainLoop(PITCH, wheels(*rows))


def test_all_overlaps_come_at_once():
    rows = LEFT, ("right", 60.0, 0.0, 20), ("top", 30.0, 50.0, 20)
    with pytest.raises(CaseError) as error:
        ChainLoop(PITCH, wheels(*rows))
    assert len(error.value.faults) == 3


def test_spans_that_cross():
    """Corners of a square in the order of a bow tie."""
    corners = ("a", 0.0, 0.0, 11), ("b", 400.0, 400.0, 11), ("c", 400.0, 0.0, 11), ("d", 0.0, 400.0, 11)
    with pytest.raises(CaseError, match="'a'"):
        ChainLoop(PITCH, wheels(*corners))
    turned = [(*row, i > 1) for i, row in enumerate(corners)]
    with pytest.raises(CaseError):
        ChainLoop(PITCH, wheels(*turned))


def test_span_runs_through_a_wheel():
    """An outside wheel draws the upper strand down upon a wheel below it, on the lower strand."""
    rows = (LEFT, ("low", 120.0, -20.0, 11, True), RIGHT, ("idler", 280.0, 40.0, 11, True))
    loop = ChainLoop(PITCH, wheels(*rows))
    with pytest.raises(
        CaseError, match=r"span 'idler' to 'left' must clear wheel 'low', runs [\d.]+ mm from"
    ):
        ChainLoop(PITCH, loop.wheels, plate_height=140.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"pitch": 0.0}, "pitch"),
        ({"plate_height": -1.0}, "plate height"),
        ({"elongation": 2.0}, "0.03 is 3 %"),
    ],
)
def test_numbers_out_of_range(change, message):
    with pytest.raises(CaseError, match=message):
        ChainLoop(**{"pitch": PITCH, "wheels": wheels(LEFT, RIGHT), **change})


def test_unknown_wheel():
    with pytest.raises(CaseError, match="no wheel is called 'idler': use one of left, right"):
        ChainLoop(PITCH, wheels(LEFT, RIGHT)).index("idler")


@pytest.mark.parametrize(("direction", "travel"), [((0.0, 0.0), (0.0, 1.0)), ((1.0, 0.0), (1.0, 1.0))])
def test_take_up_that_cannot_be(direction, travel):
    with pytest.raises(CaseError, match="take-up of 'right'"):
        TakeUp("right", direction, *travel)


def test_travel_is_too_short():
    """400 mm take 100 links, 410 mm take 102."""
    loop = ChainLoop(PITCH, wheels(LEFT, RIGHT))
    with pytest.raises(GeometryError, match=r"110 links must fit.*which allows 100 to 102 links"):
        fitting_travel(loop, TakeUp("right", (1.0, 0.0), 0.0, 10.0), 110)


def test_travel_without_a_loop():
    loop = ChainLoop(PITCH, wheels(LEFT, RIGHT))
    with pytest.raises(CaseError, match="must not overlap"):
        fitting_travel(loop, TakeUp("right", (-1.0, 0.0), 350.0, 390.0), 100)
