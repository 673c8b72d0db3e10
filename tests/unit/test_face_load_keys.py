"""Every key of the file of a wide pair changes its sheet."""

import pytest

from wearsim.errors import CaseError
from wearsim.handbook.face_load.keys import FaceLoadTables
from wearsim.handbook.face_load.sheet import face_load_sheet
from wearsim.input.document import load_calculation

BASE = {
    "format_version": 1,
    "title": "pair",
    "pair": {
        "face_width_mm": 500,
        "pinion_pitch_diameter_mm": 400,
        "gear_ratio": 6,
        "mesh_stiffness_N_per_mm_um": 20,
        "slices": 20,
    },
    "load": {"power_kW": 2000, "pinion_speed_rpm": 200},
    "misalignment": {"fixed_misalignment_um": 50, "varying_misalignment_um": 30, "crown_um": 10},
    "running_in": {"specific_wear_rate_mm2_per_N": 1e-11, "slip_ratio": 0.3, "time_hours": 1000},
}

CHANGES = {
    "title": "another",
    "pair.face_width_mm": 510,
    "pair.pinion_pitch_diameter_mm": 410,
    "pair.gear_ratio": 7,
    "pair.mesh_stiffness_N_per_mm_um": 19,
    "pair.slices": 22,
    "load.power_kW": 2100,
    "load.pinion_speed_rpm": 190,
    "load.application_factor": 1.1,
    "misalignment.fixed_misalignment_um": 55,
    "misalignment.varying_misalignment_um": 35,
    "misalignment.varies_with": "wheel",
    "misalignment.crown_um": 15,
    "running_in.specific_wear_rate_mm2_per_N": 2e-11,
    "running_in.wheel_wear_ratio": 2,
    "running_in.slip_ratio": 0.2,
    "running_in.time_hours": 900,
    "self_aligning.pivot_friction_lever_mm": 5,
}


def sheet(tables):
    loaded = load_calculation(tables, FaceLoadTables)
    return face_load_sheet(loaded.title, loaded.factors(), ()).content


def with_value(key, value):
    table, _, name = key.rpartition(".")
    return {**BASE, table: {**BASE.get(table, {}), name: value}} if table else {**BASE, key: value}


@pytest.fixture(scope="module")
def base():
    return sheet(BASE)


def test_every_key_is_here_and_no_other(leaves):
    assert {*CHANGES, "format_version"} == set(leaves(FaceLoadTables))


@pytest.mark.wide
@pytest.mark.parametrize(("key", "value"), CHANGES.items())
def test_key_changes_the_sheet(base, key, value):
    assert sheet(with_value(key, value)) != base


def test_pinion_and_wheel_differ(base):
    turning = [sheet(with_value("misalignment.varies_with", what)) for what in ("wheel", "pinion")]
    assert turning[0]["states"] != turning[1]["states"]


def test_other_versions_are_refused():
    with pytest.raises(CaseError, match="format_version"):
        sheet(with_value("format_version", 2))
