"""The form in which a reading is shared: what is wrong with one is named."""

import re
from pathlib import Path

import pytest

import wearsim
from wearsim.readings.shared_reading import case_conditions, check_sprocket, read_reading

READING = """\
format_version = 1
title = "Conveyor"
[reading]
origin = "photograph"
contributor = "A. Fitter"
date = 2026-03-31
licence = "CC0-1.0"
time_hours = 4200
depth_mm = 0.3
depth_se_mm = 0.01
teeth_depth_mm = [0.29, 0.31]
x_mm = [1.0, 2.0]
y_mm = [30.0, 31.0]
[conditions]
designation = "08B-1"
teeth = 19
power_kW = 3.0
speed_rpm = 1000.0
condition = "hardened, oiled"
"""


@pytest.fixture
def read(tmp_path):
    """Function that reads a reading with a line changed."""

    def run(before="", after=""):
        assert before in READING
        path = tmp_path / "reading.toml"
        path.write_text(READING.replace(before, after, 1))
        return read_reading(path)

    return run


def test_a_whole_one(read):
    found = read()
    assert (found.reading.time_hours, found.reading.depth_mm, found.conditions.teeth) == (4200.0, 0.3, 19)
    assert read('contributor = "A. Fitter"\n').reading.contributor == "anonymous"
    assert read("time_hours = 4200", 'time_hours = "252 ks"').reading.time_hours == 70.0


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("depth_mm = 0.3\n", "", "reading.depth_mm"),
        ("depth_se_mm = 0.01", "depth_se_mm = -0.01", "reading.depth_se_mm"),
        ("time_hours = 4200\n", "", "reading.time_hours"),
        ("2026-03-31", "2026-03-31T10:00:00", r"reading.date: must be a day such as 2026-03-31, without"),
        ("2026-03-31", '"2026-03-31"', r"reading.date: must be a day such as 2026-03-31, without quotes"),
        ("CC0-1.0", "MIT", r"reading.licence: must be 'CC0-1.0'"),
        ("photograph", "guess", "reading.origin"),
        ("y_mm = [30.0, 31.0]", "y_mm = [30.0]", "reading.y_mm: must have as many values as x_mm, 2"),
        ("teeth = 19", "teeth = 1", "conditions.teeth"),
        ("08B-1", "99X", "conditions.designation"),
        ('designation = "08B-1"\n', "", "conditions.designation: must be given, or the pitch_mm"),
        ("[0.29, 0.31]", str([0.3] * 20), r"at most conditions.teeth = 19 values, but has 20"),
        ("power_kW", "powr_kW", "conditions.powr_kW"),
    ],
)
def test_what_is_wrong_is_named(read, before, after, message):
    with pytest.raises(wearsim.CaseError, match=message) as caught:
        read(before, after)
    assert re.match(r".*reading\.toml(:\d+)?: ", str(caught.value))


def test_a_chain_by_another_of_its_names(read, tmp_path):
    case = wearsim.load_case("08b-19t-wrap")
    for name in ("08B-1", "08B", "08b"):
        check_sprocket(read("08B-1", name), case, tmp_path)
    with pytest.raises(wearsim.CaseError, match=r"must be that of the case, 08B-1, but is 10B"):
        check_sprocket(read("08B-1", "10B"), case, tmp_path)


def test_conditions_of_a_case():
    assert case_conditions(wearsim.load_case("08b-19t-wrap")) == {
        "designation": "08B-1",
        "teeth": 19,
        "profile": "iso606",
        "power_kW": 3.0,
        "speed_rpm": 1000,
        "condition": "hardened, oiled",
    }


SHARED = sorted((Path(__file__).parents[2] / "docs" / "shared_readings").glob("*.toml"))


@pytest.mark.parametrize("path", SHARED, ids=lambda path: path.stem)
def test_shared_readings_are_whole(path):
    read_reading(path)
