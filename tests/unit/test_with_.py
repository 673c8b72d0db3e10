"""Other values for keys of a case: what they replace, what is wrong with them, what the case is then."""

import numpy as np
import pytest

import wearsim
from wearsim.input.keys import schema_of, tables_in

STRAND = {
    "format_version": 1,
    "title": "Hoist",
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.6},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
}
DRIVE = {
    "format_version": 1,
    "title": "Two",
    "chain": {"designation": "08B-1"},
    "sprocket": [{"teeth": 17, "profile": "iso606"}, {"name": "roll", "teeth": 20, "profile": "iso606"}],
    "drive": {"links": 110},
    "load": {"power_kW": 1.3, "speed_rpm": 300},
    "wear": {"specific_wear_rate_mm2_per_N": 5e-9},
}
GEARS = {
    "format_version": 1,
    "title": "Pair",
    "gear": {"pinion_teeth": 36, "wheel_teeth": 54, "module_mm": 4, "face_width_mm": 40},
    "load": {"torque_N_m": 240, "speed_rpm": 1000},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-12},
    "stop": {"critical_depth_mm": 0.05},
}


@pytest.fixture
def case():
    return wearsim.load_case(STRAND)


def test_a_value_takes_the_place_of_what_says_the_same(case):
    # 3 kW at 20 teeth of 25.4 mm and 100 rpm: 3000 W over 0.846667 m/s.
    assert case.drive.duty[0].tension == pytest.approx(3000.0 / (20 * 0.0254 * 100 / 60))
    changed = case.with_({"load.tension_N": 6000})
    assert changed.inputs["load"] == {"tension_N": 6000, "speed_rpm": 100}
    assert changed.drive.duty[0].tension == 6000.0
    assert changed.title == "Hoist, with load.tension_N = 6000, without load.power_kW"
    assert case.inputs["load"] == {"power_kW": 3, "speed_rpm": 100}


def test_units_numpy_and_nested_tables_are_read(case):
    changed = case.with_({"load": {"tension_N": "6 kN"}, "sprocket.teeth": np.int64(25)})
    assert changed.inputs["load"]["tension_N"] == 6000.0
    assert changed.inputs["sprocket"]["teeth"] == 25
    assert type(changed.inputs["sprocket"]["teeth"]) is int


def test_changes_follow_one_another_and_the_title_tells_what_is_left(case):
    back = case.with_({"load.tension_N": 6000}).with_({"load.power_kW": 3})
    assert back.title == "Hoist"
    assert back.inputs == case.inputs


def test_defaults_are_taken_anew(case):
    wide = case.with_({"chain.designation": "24B-1", "sprocket.evolute_offset_mm": 8.6})
    assert wide.inputs["sprocket"]["face_width_mm"] > 1.3 * case.inputs["sprocket"]["face_width_mm"]


def test_none_removes_a_key(case):
    with pytest.raises(wearsim.CaseError, match="give exactly one of tension_N, power_kW, torque_N_m"):
        case.with_({"load.power_kW": None})


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"load.tension": 6000}, "load.tension: unknown key; did you mean 'tension_N'"),
        ({"laod.tension_N": 6000}, "laod: unknown table; did you mean 'load'"),
        ({"load.tension_N": -1}, "load.tension_N: must be greater than 0 .got -1."),
        ({"load.tension_N": "6 kg"}, "load.tension_N: "),
        ({"load.tension_N.most": 1}, "load.tension_N: must be a number"),
        ({"sprocket.1.teeth": 21}, "sprocket.1: unknown table"),
    ],
)
def test_what_is_wrong_is_said_at_the_key(case, changes, words):
    with pytest.raises(wearsim.CaseError, match=words):
        case.with_(changes)


def test_a_horizon_that_was_raised_stays(case):
    assert case.with_horizon(2e6).with_({"sprocket.teeth": 25}).run.horizon_hours == 2e6


def test_whole_drives_and_gears_change_too():
    drive = wearsim.load_case(DRIVE)
    changed = drive.with_(
        {"sprocket.2.teeth": 40, "load.torque_N_m": "20 N m", "drive.centre_distance_mm": 400}
    )
    assert changed.sprockets[1].case.inputs["sprocket"]["teeth"] == 40
    assert changed.inputs["load"] == {"torque_N_m": "20 N m", "speed_rpm": 300}
    assert changed.inputs["drive"] == {"centre_distance_mm": 400}
    assert changed.title.startswith("Two, with ")
    with pytest.raises(wearsim.CaseError, match=r"must be changed as a whole.* with_ of the drive"):
        drive.sprockets[0].case.with_({"sprocket.teeth": 21})
    with pytest.raises(wearsim.CaseError, match=r"sprocket.3.*one of 2 tables"):
        drive.with_({"sprocket.3.teeth": 21})
    gears = wearsim.load_case(GEARS).with_({"load.torque_N_m": "300 N m"})
    assert gears.inputs["load"] == {"torque_N_m": 300.0, "speed_rpm": 1000}


FORMS = {
    "a duty": (
        {"duty": [{"share_of_time": 1.0, "tension_N": 900, "speed_rpm": 50}], "load": None},
        {"load.power_kW": 2, "load.speed_rpm": 80},
        {"load": {"power_kW": 2, "speed_rpm": 80}},
    ),
    "a wear law": (
        {"wear": {"law": "power", "coefficient": 1e-12, "pressure_exponent": 1.5}},
        {"wear.condition": "hardened, oiled"},
        {"wear": {"condition": "hardened, oiled", "law": "archard"}},
    ),
    "another law": (
        {},
        {"wear.law": "power", "wear.coefficient": 1e-12, "wear.pressure_exponent": 1.5},
        {"wear": {"law": "power", "coefficient": 1e-12, "pressure_exponent": 1.5, "band_factor": 3.0}},
    ),
    "a chain of one's own": (
        {"chain": {"pitch_mm": 25.4, "roller_diameter_mm": 15.88, "inner_width_mm": 17.02}},
        {"chain.designation": "16B-1"},
        {"chain": {"designation": "16B-1"}},
    ),
    "steel": (
        {"material": {"sprocket": {"youngs_modulus_MPa": 2e5, "poissons_ratio": 0.3}}},
        {"material.sprocket.name": "steel"},
        {},
    ),
    "a tooth form": (
        {
            "sprocket": {"teeth": 20, "profile": "iso606", "form": "max"},
            "drive": {"mate_teeth": 40, "links": 120},
        },
        {"sprocket.profile": "ansi_b29", "drive.centre_distance_mm": 900},
        {},
    ),
    "every cycle": ({"run": {"method": "per_cycle", "cycles_per_update": 10}}, {"run.method": "advance"}, {}),
}


@pytest.mark.parametrize("name", FORMS)
def test_what_excludes_the_new_value_gives_way(name):
    given, changes, expected = FORMS[name]
    tables = {key: value for key, value in {**STRAND, **given}.items() if value is not None}
    changed = wearsim.load_case(tables).with_(changes)
    for table, keys in expected.items():
        assert changed.inputs[table] == keys


def test_every_key_that_gives_way_is_one_of_its_table():
    for tables in (STRAND, DRIVE, GEARS):
        waiting = [schema_of(tables)]
        while waiting:
            model = waiting.pop()
            below = [table for field in model.model_fields.values() for table in tables_in(field.annotation)]
            waiting += below
            names = {*model.model_fields, *(name for table in below for name in table.model_fields)}
            for key in model.model_fields:
                others = model.gives_way(key, None)
                assert {other.rpartition(".")[2] for other in others} <= names, (model, key)
                assert key not in others
