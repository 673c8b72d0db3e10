"""The shortest and the full form of an input file."""

from pathlib import Path

import pytest

import wearsim
from wearsim.drive.load_case import load_case

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
    text = MINIMAL.replace('condition = "hardened, oiled"', f"specific_wear_rate_mm2_per_N = {rate}")
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


WRAPPED = MINIMAL.replace("evolute", "iso606")
JOINT = "joint.specific_wear_rate_mm2_per_N"


def joint_text(case):
    (text,) = [text for text in case.assumptions if text.startswith(JOINT)]
    return text


@pytest.mark.parametrize(
    ("condition", "rate", "words"),
    [
        ("hardened, oiled", 1.2e-10, "9e-11 to 1.5e-10; clean and well lubricated"),
        ("normalised, greased", 1.8e-10, "order of magnitude by a ratio: typical 1.5 times"),
        ("normalised, dry", 7e-9, "order of magnitude by ratios: low 8.8 times that of oil"),
        ("soil-contaminated", 1e-8, "order of magnitude, no joint measured"),
    ],
)
def test_joints_take_the_state_of_the_teeth_and_say_from_where(load, condition, rate, words):
    case = load(WRAPPED.replace("hardened, oiled", condition))
    assert case.drive.joint.coefficient == rate
    assert f"{JOINT} = {rate:.6g} (wear condition {condition!r}: " in joint_text(case)
    assert words in joint_text(case)
    assert case.warnings == ()


def test_joints_without_a_condition_are_well_lubricated_and_say_so(load):
    case = load(WRAPPED.replace('condition = "hardened, oiled"', "specific_wear_rate_mm2_per_N = 1e-8"))
    assert case.drive.joint.coefficient == 1.2e-10
    assert "as for 'hardened, oiled', no condition is given" in joint_text(case)


@pytest.mark.parametrize(
    ("condition", "rate", "words"),
    [
        ("hardened, dry", 1.2e-10, "is a rate of lubricated joints: delete this key to use 7e-09,"),
        ("soil-contaminated", 9.9e-10, "joints in that state have 1e-09 to 1e-07 mm2/N"),
        ("hardened, oiled", 7e-9, "is a rate of dry or contaminated joints: delete this key to use 1.2e-10"),
        ("normalised, greased", 1.01e-8, "the teeth are lubricated, and joints in that state have 9e-11"),
        ("hardened, dry", 1e-9, None),
        ("soil-contaminated", 1e-6, None),
        ("hardened, oiled", 1e-9, None),
        ("normalised, greased", 1e-12, None),
    ],
)
def test_two_states_of_lubrication_are_warned_of_by_name(load, condition, rate, words):
    """Lubricated joints have at most 1e-9 mm2/N at 1000 rpm, more where they turn slowly."""
    joint = f"[joint]\nspecific_wear_rate_mm2_per_N = {rate}\n"
    case = load(WRAPPED.replace("hardened, oiled", condition) + joint)
    assert case.drive.joint.coefficient == rate
    if words is None:
        assert case.warnings == ()
        return
    (warning,) = case.warnings
    assert warning.startswith(f"wear.condition = {condition!r} contradicts {JOINT} = {rate:g}: ")
    assert words in warning


def test_a_rate_that_was_measured_is_not_argued_with(load):
    joint = '[joint]\nspecific_wear_rate_mm2_per_N = 7e-9\nsource = "read on the drive, 2026"\n'
    case = load(WRAPPED + joint)
    assert case.warnings == ()
    assert f"{JOINT} = 7e-09 comes from: read on the drive, 2026" in case.assumptions
    typed = case.with_({JOINT: 8e-9})
    assert any("contradicts" in text for text in typed.warnings)


def test_a_source_needs_its_rate(load):
    with pytest.raises(wearsim.CaseError, match=r"joint\.source: names the source of specific_wear_rate"):
        load(WRAPPED + '[joint]\nsource = "read on the drive"\n')


def test_the_state_that_a_joint_has_of_its_own_is_named(load):
    joint = '[joint]\ncondition = "hardened, dry"\nspecific_wear_rate_mm2_per_N = 1e-10\n'
    (warning,) = load(WRAPPED + joint).warnings
    assert warning.startswith("joint.condition = 'hardened, dry' contradicts ")
    assert "the joints are dry or contaminated" in warning
