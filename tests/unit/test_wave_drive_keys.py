"""Every key of a wave drive's file changes its sheet, or is said to have no effect."""

import pytest

from wearsim.errors import CaseError
from wearsim.handbook.wave_drive.keys import WaveDriveTables
from wearsim.handbook.wave_drive.sheet import wave_drive_sheet
from wearsim.input.document import load_calculation

BASE = {
    "format_version": 1,
    "title": "drive",
    "wave_drive": {"gear_ratio": 120, "output_torque_N_m": 800, "generator_speed_rpm": 1500},
    "generator_bearing": {"bearing_constant": 10},
}

CHANGES = {
    "title": "another",
    "wave_drive.gear_ratio": 110,
    "wave_drive.output_torque_N_m": 900,
    "wave_drive.life_hours": 9000,
    "wave_drive.generator_speed_rpm": 1000,
    "wave_drive.tooth_length_ratio": 0.21,
    "pressure.allowable_pressure_MPa": 61,
    "pressure.load_nonuniformity": 1.4,
    "pressure.engaged_share": 0.23,
    "crushing.allowable_crushing_MPa": 21,
    "torsion.allowable_shear_MPa": 70,
    "torsion.diameter_to_thickness": 85,
    "torsion.torsion_coefficient": 13,
    "torsion.formula": "printed",
    "tooth_wear.allowable_crushing_MPa": 16,
    "tooth_wear.dynamic_factor": 1.1,
    "flank_pressure.allowable_pressure_MPa": 23,
    "rim_bending.endurance_limit_MPa": 440,
    "rim_bending.safety_factor": 1.6,
    "rim_bending.stress_concentration": 1.7,
    "rim_bending.tooth_form_factor": 1.4,
    "rim_bending.thickness_ratio": 0.012,
    "rim_bending.youngs_modulus_MPa": 2.06e5,
    "rim_bending.formula": "printed",
    "rim_endurance.endurance_limit_MPa": 360,
    "rim_endurance.safety_factor": 1.7,
    "rim_endurance.stress_concentration": 1.6,
    "generator_bearing.bearing_constant": 11,
    **{
        f"{method}.published_diameter_mm": 150
        for method in (
            "pressure",
            "crushing",
            "torsion",
            "tooth_wear",
            "flank_pressure",
            "rim_bending",
            "rim_endurance",
            "generator_bearing",
        )
    },
}


def sheet(tables):
    loaded = load_calculation(tables, WaveDriveTables)
    return wave_drive_sheet(loaded.title, loaded.diameters(), ()).content


def with_value(key, value):
    table, _, name = key.rpartition(".")
    return {**BASE, table: {**BASE.get(table, {}), name: value}} if table else {**BASE, key: value}


def test_every_key_is_here_and_no_other(leaves):
    assert {*CHANGES, "format_version"} == set(leaves(WaveDriveTables))


@pytest.mark.parametrize(("key", "value"), CHANGES.items())
def test_key_changes_the_sheet(key, value):
    assert sheet(with_value(key, value)) != sheet(BASE)


def test_other_versions_are_refused():
    with pytest.raises(CaseError, match="format_version"):
        sheet(with_value("format_version", 2))
