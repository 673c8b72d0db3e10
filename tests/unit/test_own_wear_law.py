"""What is wrong with a wear law that a program gives, and with a case that names one."""

import numpy as np
import pytest

import wearsim
from wearsim.catalogue.catalogues import wear_laws

CASE = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 51},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"law": "mine"},
    "run": {"life_tolerance": 0.1},
}


def archard(pressure, load, speed, slip, k):
    """Archard's law."""
    return k * pressure


@pytest.fixture(autouse=True)
def laws(catalogue_as_before):
    """A law of the test."""
    wearsim.wear_law("mine", archard, {"k": (1e-12, 1e-10, 1e-8)}, source="own rig")


def life_by(function):
    """Life of the case by a function without constants."""
    wearsim.wear_law("other", function, source="test")
    return wearsim.simulate({**CASE, "wear": {"law": "other"}}).life


def test_a_case_takes_its_constants_and_says_so():
    case = wearsim.load_case(CASE)
    assert case.inputs["wear"]["constants"] == {"k": 1e-10}
    assert "wear.constants.k = 1e-10 (wear law 'mine')" in case.assumptions
    assert "wear.coefficient = 1 (factor on wear law 'mine')" in case.assumptions
    assert "wear law 'mine' is a user-defined function: own rig" in case.assumptions
    assert case.tables.wear.constants == {"k": 1e-10}


def test_its_constants_go_with_the_law():
    case = wearsim.load_case(CASE).with_({"wear.constants.k": 2e-10})
    assert case.wear.constants == {"k": 2e-10}
    assert "constants" not in case.with_({"wear.condition": "hardened, oiled"}).inputs["wear"]
    assert case.with_({"wear.specific_wear_rate_mm2_per_N": 1e-10}).wear.law == "archard"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"wear.constants.q": 1.0}, "wear.constants.q: wear law 'mine' has no such constant (it has: k)"),
        ({"wear.constants.k": 1e-7},
            "wear.constants.k: must lie in 1e-12 to 1e-08, the range in which the law holds"),
        ({"wear.constants.k": "a"}, "wear.constants.k: must be a number"),
        ({"wear.law": "mina"}, "wear.law: must be 'archard', 'power', 'drozdov' or 't_gamma'"),
        ({"wear.law": "power", "wear.coefficient": 1, "wear.pressure_exponent": 1, "wear.constants.k": 1},
         "wear.constants: belongs to a user-defined wear law"),
        ({"sprocket.profile": "iso606"}, "wear.law: needs the pressure and the slip of a travelling"),
        ({"duty": [{"share_of_time": 0.5, "tension_N": 2000, "speed_rpm": 50},
                   {"share_of_time": 0.5, "tension_N": 1000, "speed_rpm": 50}]},
         "wear.law: holds for one constant load"),
    ],
)  # fmt: skip
def test_a_case_that_does_not_go_with_it_is_refused(changes, words):
    with pytest.raises(wearsim.CaseError) as caught:
        wearsim.load_case(CASE).with_(changes)
    assert words in str(caught.value)


def test_it_is_not_run_cycle_by_cycle():
    with pytest.raises(
        wearsim.CaseError, match=r"run\.method: must be 'advance' with a user-defined wear law"
    ):
        wearsim.simulate(wearsim.load_case(CASE).with_({"run.method": "per_cycle"}))


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda p, q, v, s: 1 / 0, "wear.law: 'other' raised ZeroDivisionError: division by zero"),
        (lambda p, q, v, s: -p, "must return a depth of at least 0 everywhere, but gives -"),
        (lambda p, q, v, s: p * np.nan, "must return a depth of at least 0 everywhere, but gives nan"),
        (lambda p, q, v, s: [1.0, 2.0, 3.0], "'other' raised ValueError"),
        (lambda p, q, v, s: 0.0 * p, "must wear something off the new flank"),
        (lambda p, q, v, s: 1e-13 * np.where(p > 300.0, p, 0.5 * p), "must be smooth in the pressure"),
        (lambda p, q, v, s: 1e-3 * p**-2.0, "must rise at least with the first power of the pressure"),
    ],
)
def test_a_function_that_is_no_law_is_refused(function, words):
    with pytest.raises(wearsim.CaseError) as caught:
        life_by(function)
    assert words in str(caught.value)


def test_an_error_on_a_worn_flank_is_told_as_it_is():
    def fails_later(pressure, load, speed, slip):
        if load.size and not fails_later.new:
            raise KeyError("later")
        fails_later.new -= 1
        return 1e-13 * pressure

    fails_later.new = 40
    with pytest.raises(wearsim.CaseError, match="raised KeyError: 'later'"):
        life_by(fails_later)


def test_on_gears_it_must_not_depend_on_the_slip():
    wearsim.wear_law("other", lambda p, q, v, s: 1e-13 * p * s, source="test")
    gears = {
        "format_version": 1,
        "gear": {"module_mm": 3.0, "pinion_teeth": 20, "wheel_teeth": 36, "face_width_mm": 20.0},
        "load": {"torque_N_m": 60.0, "speed_rpm": 500.0},
        "wear": {"law": "other"},
        "stop": {"critical_depth_mm": 0.05},
    }
    with pytest.raises(wearsim.CaseError, match="must not depend on the slip on gears"):
        wearsim.simulate(gears)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"name": "archard"}, "name: must be a name that no other wear law has (got 'archard')"),
        ({"source": ""}, "source: must say where the law comes from"),
        ({"function": 3}, "function: must be a function (got 3)"),
        (
            {"constants": {}},
            "function: must take pressure, load, speed, slip: missing a required argument: 'k'",
        ),
        (
            {"constants": {"k": (3, 1, 2)}},
            "constants.k: must be a number, or low, value and high in this order",
        ),
        ({"constants": {"k": "a"}}, "constants.k: must be a number, or low, value and high in this order"),
        ({"constants": {"k 1": 1.0}}, "constants.k 1: must be the name of an argument of the function"),
    ],
)
def test_a_wrong_law_is_refused(values, words):
    with pytest.raises(wearsim.CaseError) as caught:
        wearsim.wear_law(
            **{"name": "new", "function": archard, "constants": {"k": 1.0}, "source": "test", **values}
        )
    assert words in str(caught.value)
    assert "new" not in wear_laws()


def test_a_law_that_is_not_there_says_how_it_is_added():
    """As where the case of an earlier program is loaded."""
    with pytest.raises(
        wearsim.CaseError, match=r"or a law that this program has added with wearsim\.wear_law"
    ):
        wearsim.load_case({**CASE, "wear": {"law": "of another day"}})
