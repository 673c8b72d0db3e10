"""Changing any key of the input changes what is shown, or raises an error that names it."""

from functools import cache

import pytest

from wearsim.command.registry import tables_of
from wearsim.errors import CaseError
from wearsim.handbook.stiffness_spectrum.keys import StiffnessSpectrumTables
from wearsim.handbook.stiffness_spectrum.sheet import stiffness_spectrum_sheet
from wearsim.input.document import load_calculation
from wearsim.quantities import quantities

RADII = {"pinion_curvature_radius_mm": 10, "wheel_curvature_radius_mm": 12}
PAIRS = {
    "format_version": 1,
    "title": "pairs",
    "gear_pair": {"module_mm": 3},
    "pinion": {"teeth": 20, "pitch_error_mm": 0.3},
    "wheel": {"teeth": 30, "pitch_error_mm": 0.4},
    "spectrum": {"tooth_harmonics": 1},
    "statics": {"force_N": 2000, **RADII},
}
BASES = {
    "pairs": PAIRS,
    "torque": {**PAIRS, "statics": {"pinion_torque_N_m": 60, **RADII}},
    "double": {**PAIRS, "spectrum": {"model": "double_sum", "series_harmonics": 300, "tooth_harmonics": 1}},
}

# Key: (base, another value) for a change of what is shown, (base, value, fault) for an error.
WHEEL = {
    "teeth": [
        ("pairs", 21),
        ("pairs", 4, "greater than or equal to 5"),
        ("pairs", 301, "less than or equal to 300"),
    ],
    "pitch_error_mm": [("pairs", "200 um"), ("pairs", -0.1, "greater than or equal to 0")],
    "error_order": [
        ("pairs", 2),
        ("pairs", 16, "at most half the teeth"),
        ("pairs", 0, "greater than or equal to 1"),
    ],
    "error_phase_deg": [("pairs", 40), ("pairs", 361, "less than or equal to 360")],
}
CHANGES = {
    "format_version": [("pairs", 2, "must be 1")],
    "title": [("pairs", "other")],
    "gear_pair.module_mm": [("pairs", 4), ("pairs", 0, "greater than 0")],
    "gear_pair.pressure_angle_deg": [
        ("pairs", 25),
        ("pairs", 36, "less than or equal to 35"),
        ("pairs", 9, "or equal to 10"),
    ],
    "gear_pair.pinion_speed_rpm": [("pairs", 1500), ("pairs", 0, "greater than 0")],
    **{f"pinion.{key}": entries for key, entries in WHEEL.items()},
    **{f"wheel.{key}": entries for key, entries in WHEEL.items()},
    "spectrum.model": [("pairs", "double_sum"), ("double", "pairs", "belongs to the closed form")],
    "spectrum.tooth_harmonics": [("pairs", 2), ("pairs", 21, "less than or equal to 20")],
    "spectrum.sideband_order": [("pairs", 1), ("pairs", 6, "less than or equal to 5")],
    "spectrum.lines_shown": [("pairs", 3), ("pairs", 0, "greater than or equal to 1")],
    "spectrum.formula": [
        *(("double", f"printed{slip}") for slip in ("", "_argument", "_sums", "_amplitude")),
        ("pairs", "printed", "belongs to the closed form"),
    ],
    "spectrum.series_harmonics": [("double", 400), ("pairs", 400, "belongs to the closed form")],
    "statics.force_N": [("pairs", 2100), ("torque", 2000, "exactly one of")],
    "statics.pinion_torque_N_m": [("torque", 61), ("pairs", 60, "exactly one of")],
    "statics.pinion_curvature_radius_mm": [("pairs", 11), ("pairs", 0, "greater than 0")],
    "statics.wheel_curvature_radius_mm": [("pairs", 11), ("pairs", -1, "greater than 0")],
    "statics.youngs_modulus_MPa": [("pairs", 2e5)],
    "statics.poissons_ratio": [("pairs", 0.25), ("pairs", 0.5, "less than 0.5")],
    "statics.energy_exponent": [("pairs", 2.0), ("pairs", 1.0, "greater than or equal to 1.5")],
    "statics.formula": [("torque", "printed"), ("pairs", "printed", "belongs to pinion_torque_N_m")],
}


@cache
def shown(base, *overrides):
    tables = load_calculation(BASES[base], StiffnessSpectrumTables, overrides)
    sheet = stiffness_spectrum_sheet(tables, tables.answer())
    return sheet.text, sheet.content, sheet.warnings


def test_every_key_is_walked(leaves):
    assert tables_of("stiffness-spectrum") is StiffnessSpectrumTables
    assert set(leaves(StiffnessSpectrumTables)) == set(CHANGES)


@pytest.mark.parametrize(
    ("key", "entry"), [(key, entry) for key, entries in CHANGES.items() for entry in entries]
)
def test_a_change_shows_or_is_named(key, entry):
    base, value, *fault = entry
    if not fault:
        assert shown(base, f"{key}={value}") != shown(base)
        return
    with pytest.raises(CaseError) as caught:
        shown(base, f"{key}={value}")
    assert key.split(".")[-1] in str(caught.value) or "series_harmonics" in str(caught.value)
    assert fault[0] in str(caught.value)


def test_an_error_that_no_tooth_shows_is_refused():
    with pytest.raises(CaseError, match="error_phase_deg: must not be a multiple of 180"):
        shown("pairs", "pinion.error_order=10")
    shown("pairs", "pinion.error_order=10", "pinion.error_phase_deg=90")


def test_a_load_needs_a_force_or_a_torque():
    with pytest.raises(CaseError, match=r"exactly one of force_N, pinion_torque_N_m \(got none\)"):
        load_calculation({**PAIRS, "statics": RADII}, StiffnessSpectrumTables)


def test_every_name_that_goes_out_is_listed():
    def names(content):
        for name, value in content.items():
            yield name
            for entry in value if isinstance(value, list) else [value]:
                yield from names(entry) if isinstance(entry, dict) else ()

    assert set(names(shown("pairs")[1])) - set(quantities()) == set()
    assert {key.split(".")[-1] for key in CHANGES} - set(quantities()) == set()
