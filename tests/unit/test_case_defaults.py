"""The shortest and the full form of an input file."""

from pathlib import Path

import pytest

import wearsim
from wearsim.case.load import load_case

MINIMAL = """\
format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
[load]
power_kW = 3
speed_rpm = 100
[wear]
condition = "hardened, oiled"
"""

FULL = Path(__file__).with_name("full_form.toml").read_text(encoding="utf-8")


@pytest.fixture
def load(tmp_path):
    def load(text):
        path = tmp_path / "drive.toml"
        path.write_text(text, encoding="utf-8")
        return load_case(path)

    return load


def test_full_form_works_as_it_stands_and_gives_the_reference_life(load):
    """8.1389e4 cycles: the reference run, by two independent programs (+-0.05 %)."""
    result = wearsim.simulate(load(FULL))
    assert result.life.cycles == pytest.approx(8.1389e4, rel=5e-4)
    assert result.life.hours == pytest.approx(8.1389e4 / 6000.0, rel=5e-4)
    assert result.title == "Evolute sprocket, 16B chain, 20 teeth"


def test_full_form_takes_no_default_that_it_gives(load):
    given = load(FULL).assumptions
    for key in ("face_width_mm", "evolute_offset_mm", "youngs_modulus_MPa", "horizon_hours"):
        assert not any(key in text for text in given)


# Values: ISO 606 rim width 0.95 b1 = 0.95 * 17.02 rounded; steel; the defaults of the input
# file's description; pull 3000 W / (2 pi 100/60 * 20 * 25.4/(2 pi) mm/s).
TAKEN = {
    "sprocket.face_width_mm": 16.17,
    "sprocket.contact_end_mm": 0.16 * 25.4,
    "sprocket.contact_start_mm": 0.16 * 25.4 + 1.05 * 25.4,
    "sprocket.nodes": 201,
    "sprocket.back_flank": "relieved",
    "mechanism.kind": "strand",
    "mechanism.roller_slip_fraction": 1.0,
    "material.sprocket.youngs_modulus_MPa": 2.1e5,
    "material.sprocket.poissons_ratio": 0.3,
    "material.roller.youngs_modulus_MPa": 2.1e5,
    "material.roller.poissons_ratio": 0.3,
    "wear.law": "archard",
    "run.method": "advance",
    "run.life_tolerance": 1e-3,
    "run.horizon_hours": 1e6,
}


def test_shortest_form_runs_and_every_default_is_among_the_assumptions(load):
    case = load(MINIMAL)
    result = wearsim.simulate(case)
    assert result.life.hours > 0.0
    for key, value in TAKEN.items():
        *tables, name = key.split(".")
        place = case.inputs
        for table in tables:
            place = place[table]
        expected = pytest.approx(value) if isinstance(value, float) else value
        assert place[name] == expected
        named = [text for text in result.assumptions if text.startswith(f"{key} = ")]
        assert len(named) == 1, key
    assert case.drive.pull == pytest.approx(3e6 / (100 / 60 * 20 * 25.4), rel=1e-12)
    assert any("3543.31 N" in text for text in result.assumptions)
    assert any("5e-11 mm2/N, 1.7e-11 to 1.5e-10" in text for text in result.assumptions)


def test_default_offset_is_the_smallest_feasible_one_with_a_reserve(load):
    """Smallest offset of the reference drive (x 4.0..30.67): 5.311, by an independent sweep."""
    text = MINIMAL.replace("teeth = 20", "teeth = 20\ncontact_end_mm = 4.0")
    case = load(text)
    assert case.inputs["sprocket"]["evolute_offset_mm"] == pytest.approx(1.05 * 5.311, rel=2e-3)
    assert any(text.startswith("sprocket.evolute_offset_mm = ") for text in case.assumptions)


def test_default_depth_is_a_tenth_of_the_tooth_at_the_pitch_line(load):
    case = load(MINIMAL)
    depth = case.inputs["stop"]["critical_depth_mm"]
    assert depth == pytest.approx(0.1 * case.drive.tooth.pitch_line_thickness, rel=1e-3)
    assert case.critical_depth == depth
    assert any(text.startswith("stop.critical_depth_mm = ") for text in case.assumptions)


@pytest.mark.parametrize(
    ("rate", "warns"), [("1e-16", True), ("1e-14", False), ("9e-7", False), ("1e-5", True)]
)
def test_wear_rate_that_looks_a_thousand_times_off(load, rate, warns):
    text = MINIMAL.replace(
        'condition = "hardened, oiled"', f"specific_wear_rate_mm2_per_N = {rate}"
    )
    assert any("factor of 1000" in text for text in load(text).warnings) is warns


def test_pull_from_power_torque_and_tension_agree(load):
    """R = p z / (2 pi), T = P/omega, F = T/R by hand."""
    radius = 25.4 * 20 / (2 * 3.141592653589793) / 1000
    torque = 3000 / (2 * 3.141592653589793 * 100 / 60)
    pulls = [
        load(MINIMAL.replace("power_kW = 3", text)).drive.pull
        for text in ("power_kW = 3", f"torque_N_m = {torque}", f"tension_N = {torque / radius}")
    ]
    assert pulls == pytest.approx([torque / radius] * 3, rel=1e-12)
