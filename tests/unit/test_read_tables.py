"""Tables of a loaded case as attributes: their values, and what a notebook completes."""

import pytest

import wearsim

CASE = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute"},
    "load": {"power_kW": "3000 W", "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
}
DRIVE = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": [
        {"name": "motor", "teeth": 19, "profile": "iso606", "nodes": 61},
        {"teeth": 38, "profile": "iso606", "nodes": 81},
    ],
    "drive": {"links": 110},
    "load": {"power_kW": 1.5, "speed_rpm": 300},
    "wear": {"condition": "hardened, oiled"},
}
GEARS = {
    "format_version": 1,
    "gear": {"pinion_teeth": 20, "wheel_teeth": 40, "module_mm": 3, "face_width_mm": 20},
    "load": {"torque_N_m": 50, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
    "stop": {"critical_depth_mm": 0.1},
}


@pytest.fixture
def case():
    return wearsim.load_case(CASE)


@pytest.fixture
def drive():
    return wearsim.load_case(DRIVE)


def plain(value):
    """What a table holds as an input file would."""
    if not hasattr(value, "__dict__"):
        return value
    found = {key: plain(one) for key, one in vars(value).items()}
    return {key: one for key, one in found.items() if one is not None}


def test_values_are_those_of_the_inputs_with_defaults(case):
    assert case.load.power_kW == 3.0
    assert case.sprocket.teeth == 20
    assert case.sprocket.face_width_mm == pytest.approx(0.95 * 17.02, rel=1e-3)  # the rim of ISO 606
    assert case.stop.critical_depth_mm == case.critical_depth
    assert case.joint is None
    assert plain(case.tables) == {key: value for key, value in case.inputs.items() if value != []}


def test_a_changed_case_has_its_own(case):
    assert case.load.power_kW == 3.0
    changed = case.with_({"load.tension_N": 5000})
    assert (changed.load.tension_N, changed.load.power_kW) == (5000.0, None)


def test_a_drive_has_a_table_for_every_sprocket(drive):
    assert [one.teeth for one in drive.sprocket] == [19, 38]
    assert [one.nodes for one in drive.sprocket] == [61, 81]
    assert [one.name for one in drive.sprocket] == ["motor", None]
    assert drive.sprocket[1].tip_diameter_mm == drive.sprockets[1].case.sprocket.tip_diameter_mm
    assert drive.load.power_kW == 1.5
    assert drive.tables.drive.links == 110
    assert drive.tables.drive.mate_teeth is None
    assert (
        drive.joint.specific_wear_rate_mm2_per_N
        == drive.driver.case.inputs["joint"]["specific_wear_rate_mm2_per_N"]
    )


def test_gears_have_tables_of_theirs():
    gears = wearsim.load_case(GEARS)
    assert gears.tables.gear.profile == "involute"
    assert gears.load.torque_N_m == 50.0
    assert gears.stop.wheel_critical_depth_mm == 0.1


def test_a_value_is_not_set_but_by_with(case):
    with pytest.raises(AttributeError, match=r"power_kW: must not be set: case\.with_"):
        case.load.power_kW = 5


def test_a_table_shows_the_keys_that_have_a_value(case):
    assert repr(case.load) == "ReadTable(power_kW=3.0, speed_rpm=100.0)"
    assert {"power_kW", "tension_N"} < set(dir(case.load))


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("case.tables.material.sprocket.", "youngs_modulus_MPa"),
        ("case.lo", "load"),
        ("case.load.", "power_kW"),
        ("case.tables.wear.spec", "specific_wear_rate_mm2_per_N"),
        ("drive.sprocket[0].te", "teeth"),
        ("drive.tables.run.", "horizon_hours"),
    ],
)
def test_a_notebook_completes_keys(text, wanted, case, drive):
    completer = pytest.importorskip("IPython.core.completer", reason="IPython is not installed")
    found = completer.IPCompleter(
        namespace={"case": case, "drive": drive}, use_jedi=False, evaluation="limited"
    )
    with completer.provisionalcompleter():
        names = [one.text.rpartition(".")[2] for one in found.completions(text, len(text))]
    assert wanted in names
