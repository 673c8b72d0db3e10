"""Columns in the place of a CSV file: what a program gives is what a file would give."""

import csv

import numpy as np
import pandas as pd
import pytest

import wearsim
from wearsim.input.document import read_document
from wearsim.runner.design import design

LOADS = {
    "arc_length_mm": np.linspace(0.0, 10.0, 21),
    "load_per_width_N_per_mm": np.full(21, 100.0),
    "flank_curvature_per_mm": np.full(21, -0.02),
    "sliding_distance_mm": np.linspace(0.3, 0.4, 21),
}


def prescribed(table):
    """A flank under loads that are given."""
    return {
        "format_version": 1,
        "chain": {"designation": "12B-1"},
        "mechanism": {"kind": "prescribed", "table_file": table},
        "load": {"speed_rpm": 100},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
        "stop": {"critical_depth_mm": 0.1},
    }


def drive(points):
    """Two sprockets, one of which is given by points."""
    return {
        "format_version": 1,
        "chain": {"designation": "08B-1"},
        "sprocket": [
            {"teeth": 17, "profile": "points", "points_file": points},
            {"teeth": 25, "profile": "iso606"},
        ],
        "drive": {"links": 90},
        "load": {"power_kW": 1, "speed_rpm": 100},
        "wear": {"condition": "hardened, oiled"},
    }


@pytest.fixture(scope="module")
def gap():
    """Points of a gap of 17 teeth."""
    one = {"teeth": 17, "profile": "iso606"}
    outline = wearsim.load_case(drive(None) | {"sprocket": one, "drive": {}}).drive.outline
    half = outline.x >= 0.0
    x, y = outline.x[half], outline.y[half]
    order = np.hypot(x, y).argsort()
    return {"x_mm": x[order], "y_mm": y[order]}


@pytest.mark.parametrize("kind", [dict, pd.DataFrame])
def test_columns_give_the_life_of_their_file(kind, tmp_path):
    path = tmp_path / "loads.csv"
    pd.DataFrame(LOADS).to_csv(path, index=False, float_format="%.17g")
    found = wearsim.simulate(prescribed(kind(LOADS)))
    assert found.life == wearsim.simulate(prescribed(str(path))).life


def test_a_folder_keeps_columns_to_the_last_digit(tmp_path):
    result = wearsim.simulate(prescribed(LOADS))
    result.save(tmp_path / "out")
    # Older versions of pandas round the last digit of what they read.
    with (tmp_path / "out" / "inputs" / "mechanism_table.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    kept = {name: [float(row[name]) for row in rows] for name in rows[0]}
    assert kept == {name: values.tolist() for name, values in LOADS.items()}
    assert wearsim.load_case(tmp_path / "out" / "case.lock.toml").drive.table.arc_length[1] == 0.5


def test_with_takes_columns_too():
    case = wearsim.load_case(prescribed(LOADS) | {"title": "Rig"})
    twice = {**LOADS, "load_per_width_N_per_mm": np.full(21, 200.0)}
    changed = case.with_({"mechanism.table_file": twice})
    assert changed.title == "Rig, with mechanism.table_file = mechanism_table.csv"
    assert changed.drive.table.load_per_width.tolist() == [200.0] * 21
    nested = case.with_({"mechanism": {"table_file": twice}})
    assert nested.drive.table.load_per_width.tolist() == [200.0] * 21


def test_every_sprocket_of_a_drive_has_points_of_its_own(gap):
    case = wearsim.load_case(drive(gap))
    [path] = case.files
    assert path.name == "sprocket_1_points.csv"
    study = design(read_document(drive(gap), ()), (), ((),), "study")
    assert study.files["sprocket_1_points.csv"].startswith("x_mm,y_mm\n")


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        (
            {"x_mm": [1, 2, 3], "y_mm": [1, 2]},
            "sprocket.1.points_file: all columns must hold the same number of values (got x_mm 3, y_mm 2)",
        ),
        ({}, "all columns must hold the same number of values (got none)"),
        ({"x_mm": ["a"], "y_mm": [1]}, "sprocket.1.points_file.x_mm: must be a row of numbers (got ['a'])"),
        ({"x_mm": 1.0, "y_mm": 2.0}, "sprocket.1.points_file.x_mm: must be a row of numbers (got 1.0)"),
        ({"x": [1, 2], "y_mm": [1, 2]}, "sprocket_1_points.csv:1: column 'x_mm' is missing"),
        ({"x_mm": [1, float("nan")], "y_mm": [1, 2]}, "points.csv:3: x_mm must be a finite number"),
    ],
)
def test_wrong_columns_are_refused_with_their_place(columns, words):
    with pytest.raises(wearsim.CaseError) as caught:
        wearsim.load_case(drive(columns))
    assert words in str(caught.value)
