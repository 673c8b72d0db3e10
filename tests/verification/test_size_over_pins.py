"""Teeth of a whole drive as they are measured: a size over pins, and depths of one sprocket."""

import math

import pytest

import wearsim
from tests.drives import changed
from wearsim.study.calibrate.readings import read_readings
from wearsim.study.remaining.model import OVER_PINS, SingleReading, from_size

DRIVE = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": [
        {"name": "small", "role": "driver", "teeth": 16, "profile": "iso606", "nodes": 31},
        {"name": "large", "teeth": 38, "profile": "iso606", "nodes": 31},
    ],
    "drive": {"links": 100},
    "mechanism": {"phases": 2},
    "run": {"life_tolerance": 0.1, "horizon_hours": 5000},
    "load": {"power_kW": 1, "speed_rpm": 300},
    "wear": {"condition": "hardened, oiled"},
    "stop": {"critical_depth_mm": 0.03},
}
NEW = 12.7 / math.sin(math.pi / 16) + 8.51
"""Pins of 8.51 mm in opposite gaps of 16 teeth, on the pitch circle but for the play of the seat [mm]."""


@pytest.fixture(scope="module")
def small():
    return wearsim.load_case(DRIVE).single_cases["small"]


def test_a_size_counts_from_that_of_the_case(small):
    found = from_size(small, SingleReading(OVER_PINS, NEW - 0.5, 0.02, 100.0), None)
    assert found.value == pytest.approx(0.5, abs=0.15)
    larger = from_size(small, SingleReading(OVER_PINS, NEW - 0.7, 0.02, 100.0), None)
    assert larger.value - found.value == pytest.approx(0.2, abs=1e-9)


def test_a_size_counts_from_that_which_was_measured(small):
    found = from_size(small, SingleReading(OVER_PINS, 73.4, 0.02, 100.0), 73.55)
    assert found.value == pytest.approx(0.15)
    with pytest.raises(wearsim.CaseError, match=r"must be less .* new sprocket, 73\.0000 mm as given"):
        from_size(small, SingleReading(OVER_PINS, 73.4, 0.02, 100.0), 73.0)


def test_calibrate_takes_a_size_as_the_same_decrease(small, tmp_path):
    pytest.importorskip("pandera", reason="pandera is not installed")
    path = tmp_path / "log.csv"
    path.write_text(f"time_hours,quantity,value,error\n500,size_over_pins_mm,{NEW - 0.5},0.02\n")
    ((reading,), *_) = read_readings(path, small)
    expected = from_size(small, SingleReading(OVER_PINS, NEW - 0.5, 0.02, 100.0), None)
    assert (reading.quantity, reading.value) == (OVER_PINS, pytest.approx(expected.value, abs=1e-9))


def test_a_size_beside_a_decrease_is_one_reading_too_many():
    with pytest.raises(TypeError, match="must be given one of"):
        wearsim.remaining(DRIVE, 100, sprocket="small", over_pins=0.1, size_over_pins=73.0)
    with pytest.raises(wearsim.CaseError, match="must be less than that of the new sprocket"):
        wearsim.remaining(DRIVE, 100, sprocket="small", size_over_pins=75.0, new_over_pins=74.0)


def test_calibrate_takes_the_teeth_of_one_sprocket_of_a_drive():
    """What the case itself predicts gives its own coefficient, for the drive as a whole."""
    pytest.importorskip("pandera", reason="pandera is not installed")
    life = wearsim.simulate(wearsim.load_case(DRIVE)).parts["small"].hours
    rows = [{"time_hours": life, "quantity": "max_depth_mm", "value": 0.03, "error": 1e-4}]
    found = wearsim.calibrate(DRIVE, rows, sprocket="small")
    (value,) = found.found.values
    assert value.value == pytest.approx(value.in_case, rel=2e-2)
    assert isinstance(found.case, wearsim.DriveCase)
    again = wearsim.simulate(found.case).parts["small"].hours
    assert again == pytest.approx(life, rel=3e-2)


def test_calibrate_asks_for_the_name_of_a_sprocket():
    pytest.importorskip("pandera", reason="pandera is not installed")
    rows = [{"time_hours": 100, "quantity": "max_depth_mm", "value": 0.01, "error": 1e-3}]
    with pytest.raises(wearsim.CaseError, match="name it by --sprocket"):
        wearsim.calibrate(DRIVE, rows)
    with pytest.raises(wearsim.CaseError, match=r"must name a sprocket of the drive, small, large"):
        wearsim.calibrate(DRIVE, rows, sprocket="rol")
    own = changed(DRIVE, {})
    own["sprocket"][0]["wear"] = {"specific_wear_rate_mm2_per_N": 1e-10}
    with pytest.raises(wearsim.CaseError, match=r"sprocket\.1\.wear: must be left out here"):
        wearsim.calibrate(own, rows, sprocket="small")
