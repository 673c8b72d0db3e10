"""``wearsim synthesise``: answer, files, faults, and what every key does."""

import copy
import csv
import io
import json
import math
import typing
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from pydantic import BaseModel

import wearsim.handbook.synthesise.sheet
from wearsim.errors import CaseError
from wearsim.handbook.synthesise.keys import SynthesisTables
from wearsim.handbook.synthesise.sheet import synthesis_sheet
from wearsim.input.document import load_calculation
from wearsim.quantities import quantities

CASES = Path(__file__).parents[2] / "cases" / "sizing"
POLE = CASES / "synthesise-constant-stress.toml"
SEGMENTS = CASES / "synthesise-two-segments.toml"
FIGURES = ("line_figure", "indices_figure", "field_figure", "direction_figure")


@pytest.fixture
def undrawn(monkeypatch):
    """Leave the pictures out: they take most of the time."""
    for name in FIGURES:
        monkeypatch.setattr(wearsim.handbook.synthesise.sheet, name, lambda *arguments: Figure())


@pytest.mark.usefixtures("undrawn")
def test_text(cli):
    done = cli("handbook", "synthesise", POLE)
    assert (done.code, done.err) == (0, "")
    assert "minimum 364.119 MPa at the pitch point (at 45 deg)" in done.out
    assert "requires a pressure angle of 20 deg" in " ".join(done.out.split())
    (line,) = [line for line in done.out.splitlines() if line.startswith("  -10.000")]
    assert line.split()[:7] == ["-10.000", "22.145", "-11.361", "17.303", "32.099", "454.16", "574.90"]
    assert max(map(len, done.out.splitlines())) <= 100


@pytest.mark.usefixtures("undrawn")
def test_page_shows_what_is_printed(cli):
    page = (CASES.parents[1] / "docs" / "synthesise.md").read_text()
    whole, second = cli("handbook", "synthesise", POLE).out, cli("handbook", "synthesise", SEGMENTS).out
    assert whole in page
    phase = second[second.index("  Phase 2") : second.index("\n\n  Assumes")]
    assert phase in page
    keys = {key.rpartition(".")[2] for key in CHANGES}
    assert all(f"`{key}`" in page for key in keys - {"title"})


@pytest.mark.usefixtures("undrawn")
def test_json(cli):
    done = cli("handbook", "synthesise", SEGMENTS, "--json")
    assert done.code == 0
    assert "phase 2: the pressure angle reaches 40.4 deg" in done.err
    found = json.loads(done.out)
    assert (found["schema_version"], found["case"]) == (1, "synthesise-two-segments")
    assert found["least_pitch_point_stress_MPa"] == pytest.approx(364.1190949303)
    great, small = found["mesh_phases"]
    assert (great["family"], small["family"]) == (1, -1)
    assert small["end_pitch_point_distance_mm"] == pytest.approx(5.585639, abs=1e-6)
    assert small["end_pressure_angle_deg"] == pytest.approx(90, abs=0.01)
    last = [row for row in found["indices"] if row["mesh_phase"] == 2][-1]
    assert last["pinion_flank_radius_mm"] == pytest.approx(2.7763095, abs=1e-6)
    names = {*found, *great, *last} - {"schema_version", "case"}
    assert names <= set(quantities())


@pytest.mark.usefixtures("undrawn")
def test_files(cli, tmp_path):
    out = tmp_path / "made"
    settings = ("--set", "field.field_nodes=21", "--set", "field.directions_deg=15")
    assert cli("handbook", "synthesise", POLE, "--out", out, *settings).code == 0
    made = {path.name for path in out.iterdir()}
    figures = ("line_of_action", "indices", "field_great_radii", "field_small_radii")
    tables = ("indices", "line_of_action", "pinion_profile", "wheel_profile", "stress_fields")
    assert made == {
        ".wearsim",
        "result.json",
        *(f"{name}.csv" for name in (*tables, "direction_fields")),
        *(f"{name}.{kind}" for name in (*figures, "field_directions") for kind in ("png", "svg")),
    }
    for path in out.glob("*.csv"):
        with path.open() as file:
            assert set(next(csv.reader(file))) <= set(quantities()), path
    fields = pd.read_csv(out / "stress_fields.csv", keep_default_na=False)
    assert len(fields) == 2 * 21**2
    real = fields["infeasibility"] == ""
    assert set(fields["infeasibility"]) == {"", "complex", "no torque", "no rolling"}
    for column in ("contact_stress_MPa", "pitch_point_distance_mm", "pinion_flank_radius_mm"):
        assert (fields[column][~real] == "").all()
    assert (fields["contact_stress_MPa"][real].astype(float) - 454.1608627).abs().max() < 1e-6
    profile = pd.read_csv(out / "pinion_profile.csv")
    radius = np.hypot(profile["x_mm"], profile["y_mm"])
    assert np.interp(0, profile["pitch_point_distance_mm"], radius) == pytest.approx(54)
    assert cli("handbook", "synthesise", POLE, "--out", out, *settings).code == 2
    assert cli("handbook", "synthesise", POLE, "--out", out, *settings, "--force").code == 0


FAULTS = [
    (
        POLE,
        "stress.contact_stress_MPa=364",
        3,
        "phase 1: contact_stress_MPa: must be above 364.119 at the pitch point",
    ),
    (
        SEGMENTS,
        "phase=[{family = -1, start_x_mm = 10, start_y_mm = 3, last_pitch_point_distance_mm = 5}]",
        3,
        "phase 1: line of action: the family -1 from l = 10.44 mm must end before l = 5.58564 mm",
    ),
    (
        SEGMENTS,
        "phase=[{start_x_mm = 10, start_y_mm = 3, last_pitch_point_distance_mm = 0.01}]",
        3,
        "must end before l = 0.0364695 mm, where its pressure angle comes to 0 deg",
    ),
    (
        POLE,
        "phase=[{family = -1, first_pitch_point_distance_mm = -1, last_pitch_point_distance_mm = 1}]",
        2,
        "phase.1.family: must be 1 without start_x_mm",
    ),
    (
        POLE,
        "phase=[{last_pitch_point_distance_mm = 1}]",
        2,
        "phase.1.first_pitch_point_distance_mm: give this",
    ),
    (
        POLE,
        "phase=[{first_pitch_point_distance_mm = 2, last_pitch_point_distance_mm = 1}]",
        2,
        "phase.1.last_pitch_point_distance_mm: must be above the first, 2 (got 1)",
    ),
    (POLE, "phase=[{start_x_mm = 9, last_pitch_point_distance_mm = 1}]", 2, "phase.1.start_y_mm: a point"),
    (
        POLE,
        "phase=[{start_x_mm = 9, start_y_mm = -2, last_pitch_point_distance_mm = 1}]",
        2,
        "phase.1.start_y_mm: must have the sign of start_x_mm, 9 (got -2)",
    ),
    (
        POLE,
        "phase=[{start_x_mm = 9, start_y_mm = 2, last_pitch_point_distance_mm = -1}]",
        2,
        "phase.1.last_pitch_point_distance_mm: must be on the side of the start, 9.21954",
    ),
    (
        POLE,
        "phase=[{first_pitch_point_distance_mm = 1, start_x_mm = 9, start_y_mm = 2, "
        "last_pitch_point_distance_mm = 1}]",
        2,
        "phase.1.first_pitch_point_distance_mm: start_x_mm gives the start",
    ),
    (POLE, "phase=[]", 2, "phase: "),
    (POLE, "stress.contact_stress_MPa=[500, -1]", 2, "stress.contact_stress_MPa: must be above 0"),
    (POLE, "stress.contact_stress_MPa=[]", 2, "stress.contact_stress_MPa: must be above 0"),
    (POLE, "stress.contact_stress_MPa=[500, 400]", 2, "stress.pitch_point_distance_mm: several stresses"),
    (POLE, "stress.pitch_point_distance_mm=[0, 1]", 2, "must have one entry for each stress, 1 (got 2)"),
    (
        POLE,
        "stress={contact_stress_MPa = [5, 6], pitch_point_distance_mm = [1, 0]}",
        2,
        "must ascend (got 1, 0)",
    ),
    (
        POLE,
        "stress={contact_stress_MPa = [500, 600], pitch_point_distance_mm = [-10, 9]}",
        2,
        "stress.pitch_point_distance_mm: must reach from -10 to 10 as phase 1 does (got -10 to 9)",
    ),
    (
        POLE,
        "stress={contact_stress_MPa = [500, 600], pitch_point_distance_mm = [-10, -1]}",
        2,
        "stress.pitch_point_distance_mm: must reach from -10 to 10 as phase 1 does (got -10 to -1)",
    ),
    (POLE, "load.face_width_mm=-1", 2, "load.face_width_mm: "),
    (POLE, "load={pinion_speed_rpm = 1}", 2, "load.pinion_torque_N_m: give pinion_torque_N_m and"),
    (POLE, "load.load_per_width_N_per_mm=60", 2, "load.pinion_torque_N_m: load_per_width"),
    (POLE, "field.x_to_mm=-20", 2, "field.x_to_mm: must be above x_from_mm, -15 (got -20)"),
    (POLE, "field.directions_deg=[90]", 2, "field.directions_deg: must be between -90 and 90"),
    (POLE, "involute.pressure_angle_deg=90", 2, "involute.pressure_angle_deg: "),
    (POLE, "gears.teeth=20", 2, "gears.teeth: unknown key"),
]


@pytest.mark.parametrize(("case", "setting", "code", "message"), FAULTS)
@pytest.mark.usefixtures("undrawn")
def test_faults(cli, case, setting, code, message):
    done = cli("handbook", "synthesise", case, "--set", setting)
    assert (done.code, done.out) == (code, "")
    shown = done.err.replace("--set ", "")
    assert message in shown
    assert "Traceback" not in done.err and ": ." not in done.err


@pytest.mark.usefixtures("undrawn")
def test_failed_case_as_json(cli):
    done = cli("handbook", "synthesise", POLE, "--json", "--set", "stress.contact_stress_MPa=300")
    found = json.loads(done.out)
    assert (done.code, found["error"]["kind"]) == (3, "GeometryError")


@pytest.mark.usefixtures("undrawn")
def test_line_through_the_pitch_point_needs_the_stress_there(cli):
    phase = "phase=[{first_pitch_point_distance_mm = 3, last_pitch_point_distance_mm = 9}]"
    radius_rule = "stress={contact_stress_MPa = [500, 600], pitch_point_distance_mm = [LEAST, 10]}"
    done = cli("handbook", "synthesise", POLE, "--set", phase, "--set", radius_rule.replace("LEAST", "3"))
    assert done.code == 2 and "must reach from 0 to 9 as phase 1 does (got 3 to 10)" in done.err
    assert (
        cli("handbook", "synthesise", POLE, "--set", phase, "--set", radius_rule.replace("LEAST", "0")).code
        == 0
    )


def test_schema(cli):
    done = cli("schema", "--of", "synthesise")
    assert set(json.loads(done.out)["properties"]) == set(SynthesisTables.model_fields)


@pytest.mark.usefixtures("undrawn")
def test_involute_that_interferes_is_left_out(cli):
    setting = "phase=[{first_pitch_point_distance_mm = -19, last_pitch_point_distance_mm = 0}]"
    done = cli("handbook", "synthesise", POLE, "--json", "--set", setting)
    assert "phase 1: the involute interferes over part of this range" in done.err
    rows = json.loads(done.out)["indices"]
    assert rows[0]["involute_contact_stress_MPa"] is None
    assert rows[-1]["involute_contact_stress_MPa"] == pytest.approx(454.1608627, abs=1e-6)


BASE = {
    "format_version": 1,
    "title": "base",
    "gears": {"centre_distance_mm": 135, "gear_ratio": 1.5},
    "material": {
        "pinion": {"youngs_modulus_MPa": 2.1e5, "poissons_ratio": 0.3},
        "wheel": {"youngs_modulus_MPa": 2.1e5, "poissons_ratio": 0.3},
    },
    "load": {"pinion_torque_N_m": 240, "face_width_mm": 76, "pinion_speed_rpm": 1000},
    "stress": {"contact_stress_MPa": [480, 470, 500], "pitch_point_distance_mm": [-12, 0, 20]},
    "phase": [
        {"start_x_mm": 10, "start_y_mm": 3, "last_pitch_point_distance_mm": 12, "nodes": 11},
        {"first_pitch_point_distance_mm": -10, "last_pitch_point_distance_mm": 5, "nodes": 11},
    ],
    "involute": {"pressure_angle_deg": 20},
    "field": {
        "x_from_mm": 0,
        "x_to_mm": 10,
        "y_from_mm": 0,
        "y_to_mm": 5,
        "field_nodes": 11,
        "directions_deg": 15,
    },
}

CHANGES = {
    "title": "other",
    "gears.centre_distance_mm": 140,
    "gears.gear_ratio": 1.6,
    "material.pinion.name": {"name": "bronze"},
    "material.pinion.youngs_modulus_MPa": 2e5,
    "material.pinion.poissons_ratio": 0.28,
    "material.wheel.name": {"name": "bronze"},
    "material.wheel.youngs_modulus_MPa": 2e5,
    "material.wheel.poissons_ratio": 0.28,
    "load.pinion_torque_N_m": 230,
    "load.face_width_mm": 75,
    "load.load_per_width_N_per_mm": {"load_per_width_N_per_mm": 60, "pinion_speed_rpm": 1000},
    "load.pinion_speed_rpm": 900,
    "stress.contact_stress_MPa": [481, 470, 500],
    "stress.pitch_point_distance_mm": [-11, 0, 20],
    "phase.family": -1,
    "phase.start_x_mm": 9.5,
    "phase.start_y_mm": 3.1,
    "phase.first_pitch_point_distance_mm": {
        "first_pitch_point_distance_mm": -9,
        "last_pitch_point_distance_mm": 12,
    },
    "phase.last_pitch_point_distance_mm": 13,
    "phase.nodes": 12,
    "involute.pressure_angle_deg": 21,
    "field.x_from_mm": 1,
    "field.x_to_mm": 11,
    "field.y_from_mm": 1,
    "field.y_to_mm": 6,
    "field.field_nodes": 12,
    "field.directions_deg": [15, 20],
}
"""A new value of every key, or a new table where it excludes others there."""


def keys(model, lead=""):
    for name, field in model.model_fields.items():
        inner = [
            kind
            for kind in (field.annotation, *typing.get_args(field.annotation))
            if isinstance(kind, type) and issubclass(kind, BaseModel)
        ]
        yield from keys(inner[0], f"{lead}{name}.") if inner else [f"{lead}{name}"]


def test_every_key_is_tried():
    assert {*keys(SynthesisTables)} == {"format_version", *CHANGES}


def results(document):
    tables = load_calculation(document, SynthesisTables)
    pair = tables.pair()
    sheet = synthesis_sheet(tables, pair, tables.phases(pair))
    return {"text": sheet.text, **{name: table.to_csv() for name, table in sheet.tables().items()}}


@pytest.fixture(scope="module")
def base_results():
    return results_without_pictures(BASE)


def results_without_pictures(document):
    with pytest.MonkeyPatch.context() as patch:
        for name in FIGURES:
            patch.setattr(wearsim.handbook.synthesise.sheet, name, lambda *arguments: Figure())
        return results(document)


@pytest.mark.slow
@pytest.mark.parametrize(("key", "value"), CHANGES.items())
def test_every_key_changes_the_result(base_results, key, value):
    document = copy.deepcopy(BASE)
    *path, last = key.split(".")
    place = document
    for name in path:
        place = place[name]
        place = place[0] if isinstance(place, list) else place
    if isinstance(value, dict):
        place.clear()
        place.update(value)
    else:
        place[last] = value
    changed = results_without_pictures(document)
    differing = {name for name in base_results if base_results[name] != changed[name]}
    assert differing
    if key.startswith("field."):
        assert differing <= {"stress_fields", "direction_fields"}


def test_version_is_checked():
    with pytest.raises(CaseError, match="format_version"):
        results({**BASE, "format_version": 2})


def test_materials_are_steel_by_default():
    steel = {name: table for name, table in BASE.items() if name != "material"}
    assert results_without_pictures(steel) == results_without_pictures(BASE)


def test_strings_with_units():
    document = copy.deepcopy(BASE)
    document["stress"] = {
        "contact_stress_MPa": ["0.48 GPa", 470, 500],
        "pitch_point_distance_mm": ["-1.2 cm", 0, 20],
    }
    document["phase"][1]["first_pitch_point_distance_mm"] = "-1 cm"
    document["field"]["directions_deg"] = f"{math.radians(15)} rad"
    with_units = results_without_pictures(document)
    base = results_without_pictures(BASE)
    assert with_units["line_of_action"] == base["line_of_action"]


def test_pictures():
    settings = ["field.field_nodes=21", "field.x_from_mm=-6", "field.directions_deg=20"]
    tables = load_calculation(SEGMENTS, SynthesisTables, settings)
    pair = tables.pair()
    sheet = synthesis_sheet(tables, pair, tables.phases(pair))
    plane, profiles = sheet.figures()["line_of_action"].axes
    assert [line.get_label() for line in plane.lines[::3]][:2] == ["phase 1, family +1", "phase 2, family -1"]
    assert len(profiles.lines) == 4
    sheet.figures()["field_directions"].savefig(io.BytesIO(), format="svg")
    drawn = sheet.figures()["field_small_radii"].axes[0].lines[-1]
    assert drawn.get_xydata() == pytest.approx(
        sheet.tables()["line_of_action"].query("mesh_phase == 2")[["contact_x_mm", "contact_y_mm"]]
    )
