"""Deflection and stiffness of the mesh, and the spectrum as a whole from an input."""

import math

import numpy as np
import pytest

from wearsim.errors import GeometryError
from wearsim.handbook.stiffness_spectrum.contact_number import contact_ratio
from wearsim.handbook.stiffness_spectrum.keys import StiffnessSpectrumTables
from wearsim.handbook.stiffness_spectrum.mesh_statics import deflection, hertz_constant, mesh_stiffness
from wearsim.input.document import load_calculation

CASE = {
    "format_version": 1,
    "gear_pair": {"module_mm": 3, "pressure_angle_deg": 20, "pinion_speed_rpm": 1500},
    "pinion": {"teeth": 20, "pitch_error_mm": 0},
    "wheel": {"teeth": 30, "pitch_error_mm": 0},
    "statics": {"force_N": 2000, "pinion_curvature_radius_mm": 10, "wheel_curvature_radius_mm": 10},
}
ERRORS = ("pinion.pitch_error_mm=0.3", "wheel.pitch_error_mm=0.4")
DOUBLE = "spectrum.model=double_sum"


def solved(*overrides, **tables):
    case = {**CASE, **tables}
    return load_calculation(case, StiffnessSpectrumTables, overrides).answer()


def test_reference_deflections_and_stiffnesses(validated):
    constant = hertz_constant(10.0, 10.0, 2.1e5, 0.3)
    law = (np.array([1.0, 2.0, 4.0]), 2000.0, constant, 2.5)
    source, how = "independent program", {"absolute": True}
    validated("constant of contact", constant, 344010.458, 6e-4, source, "N/mm^1.5", **how)
    np.testing.assert_allclose(deflection(*law), (0.0323324713, 0.0203681806, 0.0128311497), atol=6e-11)
    np.testing.assert_allclose(mesh_stiffness(*law), (92785.9790, 147288.5607, 233806.0163), atol=6e-5)


@pytest.mark.parametrize(
    ("model", "mean", "amplitude"),
    [("double_sum", 178127.9341, 84919.7950), ("pairs", 125769.6384, 32820.4995)],
)
def test_reference_mean_stiffness_and_its_first_amplitude(validated, model, mean, amplitude):
    """By hand too: the longer part of a tooth period has one contact, the rest two (counted four)."""
    found = solved(f"spectrum.model={model}")
    (line,) = [line for line in found.lines if line.name == "fz"]
    source, how = "independent program", {"absolute": True}
    quantity, stiffness = f"mean stiffness, {model}", found.statics.stiffness.mean
    validated(quantity, stiffness, mean, 6e-5, source, "N/mm", **how)
    quantity = f"its amplitude at the tooth frequency, {model}"
    validated(quantity, line.stiffness, amplitude, 6e-5, source, "N/mm", **how)
    two = found.pair.contact_ratio - 1.0
    one, more = found.statics.stiffnesses[[0, 1 if model == "pairs" else 2]]
    assert found.statics.stiffness.mean == pytest.approx(one + two * (more - one), rel=1e-12)
    wanted = 2.0 * (more - one) * math.sin(math.pi * two) / math.pi
    assert line.stiffness == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("exponent", [2.0, 2.5, 3.0])
def test_stiffness_is_the_slope_of_the_force(exponent):
    force, constant, step = 2000.0, 3.0e5, 1e-5
    contacts = np.array([1.0, 2.0, 3.0])
    delta = deflection(contacts, force, constant, exponent)
    np.testing.assert_allclose(contacts * constant * delta ** (exponent - 1.0), force, rtol=1e-12)
    up, down = (contacts * constant * (delta * (1 + s)) ** (exponent - 1.0) for s in (step, -step))
    slope = (up - down) / (2.0 * step * delta)
    np.testing.assert_allclose(mesh_stiffness(contacts, force, constant, exponent), slope, rtol=1e-8)
    closed = (exponent - 1.0) * constant ** (1.0 / (exponent - 1.0))
    closed *= force ** ((exponent - 2.0) / (exponent - 1.0)) * contacts ** (1.0 / (exponent - 1.0))
    np.testing.assert_allclose(mesh_stiffness(contacts, force, constant, exponent), closed, rtol=1e-12)


def test_torque_acts_along_the_common_normal_and_printed_along_the_pitch_circle():
    """60 N m on 30 mm: 2000 N, over cos 20 for the normal."""
    statics = {key: value for key, value in CASE["statics"].items() if key != "force_N"}
    statics["pinion_torque_N_m"] = 60
    right = solved(statics=statics)
    printed = solved("statics.formula=printed", statics=statics)
    assert right.statics.force == pytest.approx(2000.0 / math.cos(math.radians(20.0)))
    assert printed.statics.force == pytest.approx(2000.0)


def test_lines_have_frequencies_names_and_families():
    """1500 rpm and 20 teeth: 500 Hz, turns 25 and 16.667 Hz."""
    found = solved(*ERRORS)
    lines = {line.name: line for line in found.lines}
    assert found.mesh_frequency == pytest.approx(500.0)
    assert [lines[name].harmonic for name in ("fz", "fz - f1", "2fz + f2")] == [60, 57, 122]
    assert [lines[name].family for name in ("fz", "2f1", "fz - f2", "fz + f1 - f2")] == [
        *("mesh", "pinion", "wheel", "both")
    ]
    assert lines["fz - f1"].two_sided == pytest.approx(0.0156401751, abs=6e-11)
    assert lines["fz - f1"].one_sided == pytest.approx(2 * 0.0156401751, abs=2e-10)
    assert math.isnan(lines["fz"].series)
    assert 0.8 < found.variance_share < 1.0


def test_lines_that_two_wheels_share_say_so():
    found = solved(*ERRORS, "wheel.teeth=20")
    names = {line.name: line.family for line in found.lines}
    assert names["fz + f1 = fz + f2"] == "both"
    assert names["2f1 = f1 + f2 = 2f2"] == "both"
    (line,) = [line for line in found.lines if line.name == "2f1 = f1 + f2 = 2f2"]
    assert line.short_name == "2f1 = f1 + f2 = 2f2"
    (line,) = [line for line in found.lines if line.harmonic == 22]
    assert line.short_name == "fz + 2f1 = ..."


def test_sidebands_of_a_higher_order_error():
    found = solved(*ERRORS, "pinion.error_order=4", "wheel.pitch_error_mm=0")
    assert {line.name for line in found.lines} >= {"fz - 4f1", "fz + 8f1", "4f1", "8f1"}
    assert not [line for line in found.lines if "f2" in line.name]


def test_closed_form_stands_beside_the_exact_lines():
    found = solved(*ERRORS, DOUBLE)
    assert found.series_mean == pytest.approx(2.7853335361, abs=1e-3)
    assert max(abs(line.series - line.one_sided) for line in found.lines) < 1e-4
    printed = {line.name: line.series for line in solved(*ERRORS, DOUBLE, "spectrum.formula=printed").lines}
    assert printed["fz - f1"] == pytest.approx(2.681e-3, rel=2e-3)


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        (("pinion.pitch_error_mm=31",), ("pinion: pitch_error_mm must be below 30.5 mm", "lower it")),
        (
            ("wheel.pitch_error_mm=9", "wheel.error_order=7"),
            ("wheel: pitch_error_mm must be below", "is 9 mm"),
        ),
        (
            ("wheel.pitch_error_mm=3", "wheel.error_order=12"),
            ("statics: some teeth must touch at every moment", "remove [statics]"),
        ),
    ],
)
def test_what_cannot_run_says_what_to_do(overrides, words):
    with pytest.raises(GeometryError) as caught:
        solved(*overrides)
    for word in words:
        assert word in str(caught.value)


def test_greatest_error_is_where_two_teeth_coincide():
    """2 pi/z = 2 beta sin(pi/z) cos(pi/z), between teeth 10 and 11 of 20, or 11 and 12."""
    limit = 30.0 * (math.tau / 20.0) / math.sin(math.tau / 20.0)
    with pytest.raises(GeometryError):
        solved(f"pinion.pitch_error_mm={1.0001 * limit}", statics=None)
    solved(f"pinion.pitch_error_mm={0.9999 * limit}", statics=None)


def test_contact_ratio_is_above_one_for_all_that_an_input_may_have():
    corners = [(z, mate) for z in (5, 6, 10, 50, 300) for mate in (5, 17, 300)]
    ratios = [contact_ratio(z, mate, math.radians(angle)) for z, mate in corners for angle in (10, 20, 35)]
    assert min(ratios) > 1.05
