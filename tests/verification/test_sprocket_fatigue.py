"""Contact fatigue of sprockets beside their wear, against formulas (21) to (26) of source 001.

Expected: N_HG K^-6 / (60 n / turns per cycle) with N_HG = 30 HB^2.4, K = sigma_H S_H / sigma_Hlim,
sigma_Hlim = 17 HRC + 200 (surface hardened) or 2 HB + 70 (quenched and tempered); sigma_H by Hertz from the
closed form of the evolute flank or from the numbers of a table of loads. Loads of a duty: Miner's
sum over runs under each of them alone.
"""

import copy
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.result import Life, LowerBound

MODULUS = 2.1e5 / (2.0 * (1.0 - 0.3**2))
HARD = {"treatment": "surface_hardened", "hardness_HRC": 45}
HARD_LIMIT = (17.0 * 45.0 + 200.0) / 1.2
SOFT = {"treatment": "quenched_and_tempered", "hardness_HB": 300}
SOFT_LIMIT = (2.0 * 300.0 + 70.0) / 1.1
WRAP: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 19, "profile": "ansi_b29", "nodes": 101},
    "mechanism": {"phases": 2},
    "drive": {"slack_tension_N": 40.0},
    "joint": {"specific_wear_rate_mm2_per_N": 1e-10},
    "load": {"tension_N": 3500, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.01},
    "run": {"life_tolerance": 0.1, "horizon_hours": 1e5},
}

CRAWLER: dict[str, Any] = {
    "format_version": 1,
    "chain": {"pitch_mm": 203.2, "roller_diameter_mm": 66.0, "inner_width_mm": 90.0},
    "sprocket": {
        "teeth": 27,
        "engaged_every": 2,
        "profile": "evolute",
        "evolute_offset_mm": 42.9,
        "contact_start_mm": 212.2,
        "contact_end_mm": 8.0,
    },
    "load": {"tension_N": 120000, "speed_rpm": 20},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
    "fatigue": {"sprocket": HARD},
}


def endured(stress: float, limit: float, brinell: float, cycles_per_hour: float) -> float:
    return 30.0 * brinell**2.4 * (stress / limit) ** -6 / cycles_per_hour


def fatigue_hours(tables: dict[str, Any]) -> float:
    life = wearsim.simulate(wearsim.load_case(tables)).parts["sprocket_fatigue"]
    assert isinstance(life, Life)
    return life.hours


@pytest.fixture
def strand(reference_tables: dict[str, Any]) -> Callable[..., dict[str, Any]]:
    def tables(material: dict[str, Any] = HARD, **others: Any) -> dict[str, Any]:
        base = {
            **reference_tables,
            "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
            "run": {"horizon_hours": 2e5},
            "fatigue": {"sprocket": material},
            **others,
        }
        return {name: table for name, table in copy.deepcopy(base).items() if table is not None}

    return tables


def evolute_peak(pull: float) -> float:
    """Highest Hertz pressure of the reference flank: ramps of 1.27 mm at both ends of contact."""
    R, r, h = 25.4 * 20 / (2.0 * np.pi), 7.94, 5.5
    x = np.linspace(4.0, 30.67, 100_001)
    share = np.clip(np.minimum(x - 4.0, 30.67 - x) / 1.27, 0.0, 1.0)
    l = np.hypot(x, h)
    rho = r + l**3 / (R * h + l**2)
    load = pull / 17.0 * share * l / x
    return float(np.sqrt(load * MODULUS * (1.0 / r - 1.0 / rho) / np.pi).max())


def test_strand_by_the_closed_form_of_its_flank(strand: Callable[..., dict[str, Any]]) -> None:
    tables = strand(fatigue={"load_factor": 1.2, "sprocket": HARD})
    result = wearsim.simulate(wearsim.load_case(tables))
    stress = math.sqrt(1.2) * evolute_peak(5000.0)
    assert stress == pytest.approx(1090.2, abs=0.1)
    hours = endured(stress, HARD_LIMIT, 450.0, 60.0 * 100.0)
    assert hours == pytest.approx(1878.0, abs=0.5)
    assert result.parts["sprocket_fatigue"].hours == pytest.approx(hours, rel=5e-3)
    assert result.parts["sprocket_fatigue"].cycles == pytest.approx(6000.0 * hours, rel=5e-3)
    assert result.summary()["sprocket_fatigue_life_hours"] == pytest.approx(hours, rel=5e-3)


def test_table_of_loads_by_hand(b9: Callable[..., wearsim.Case]) -> None:
    """q = 100 N/mm on 39.1 and 6.035 mm at the root, 100 rpm: 838.2 MPa against 609.1 MPa."""
    steel = "fatigue.sprocket={treatment='quenched_and_tempered', hardness_HB=300}"
    result = wearsim.simulate(b9(101, steel))
    stress = math.sqrt(100.0 * MODULUS * (1.0 / 39.1 + 1.0 / 6.035) / math.pi)
    hours = endured(stress, SOFT_LIMIT, 300.0, 60.0 * 100.0)
    assert result.parts["sprocket_fatigue"].hours == pytest.approx(hours, rel=1e-9)
    assert hours == pytest.approx(648.9, abs=0.1)


def test_wrap_by_its_highest_pressure_on_new_gaps() -> None:
    result = wearsim.simulate(wearsim.load_case({**WRAP, "fatigue": {"sprocket": HARD}}))
    stress = result.initial_peak_pressure
    assert 1.0 < stress / HARD_LIMIT < 1.8
    hours = endured(stress, HARD_LIMIT, 450.0, 60.0 * 100.0)
    assert result.parts["sprocket_fatigue"].hours == pytest.approx(hours, rel=1e-9)


@pytest.mark.wide
def test_load_factor_on_a_wrap_is_one_on_all_forces() -> None:
    """Tensions and stiffness of the links times 1.2: the same way of the rollers, 1.2 the forces."""
    tension, slack, stiffness = 3000.0, 40.0, 5e4
    drive = {"slack_tension_N": slack, "link_stiffness_N_per_mm": stiffness}
    base = {**WRAP, "load": {"tension_N": tension, "speed_rpm": 100}, "drive": drive}
    factor = fatigue_hours({**base, "fatigue": {"load_factor": 1.2, "sprocket": HARD}})
    more = {"slack_tension_N": 1.2 * slack, "link_stiffness_N_per_mm": 1.2 * stiffness}
    pulled = {**base, "load": {"tension_N": 1.2 * tension, "speed_rpm": 100}, "drive": more}
    assert fatigue_hours({**pulled, "fatigue": {"sprocket": HARD}}) == pytest.approx(factor, rel=1e-6)


@pytest.mark.parametrize(("teeth", "turns"), [(27, 2), (28, 1)])
def test_a_tooth_is_loaded_once_in_its_cycle(teeth: int, turns: int) -> None:
    """Of 27 gaps with every second roller each meets one every second turn, of 28 every turn."""
    case = wearsim.load_case(CRAWLER, [f"sprocket.teeth={teeth}"])
    result = wearsim.simulate(case)
    cycles_per_hour = 60.0 * 20.0 / turns
    hours = endured(result.initial_peak_pressure, HARD_LIMIT, 450.0, cycles_per_hour)
    assert result.parts["sprocket_fatigue"].hours == pytest.approx(hours, rel=1e-9)


DUTY = (
    {"share_of_time": 0.4, "tension_N": 6000, "speed_rpm": 50},
    {"share_of_time": 0.6, "tension_N": 4000, "speed_rpm": 150},
)


def test_duty_of_a_strand_by_hand(strand: Callable[..., dict[str, Any]]) -> None:
    """20 and 90 of 110 turns a minute: mu = 2/11 + 9/11 (2/3)^3 = 14/33."""
    hours = fatigue_hours(strand(load=None, duty=[*DUTY]))
    stress = evolute_peak(6000.0)
    expected = endured(stress, HARD_LIMIT, 450.0, 60.0 * 110.0 * 14.0 / 33.0)
    assert hours == pytest.approx(expected, rel=5e-3)


@pytest.mark.wide
@pytest.mark.parametrize("kind", ["strand", "wrap"])
def test_duty_is_the_sum_of_miner(strand: Callable[..., dict[str, Any]], kind: str) -> None:
    weak = {**SOFT, "contact_safety": 1.5}
    base = strand() if kind == "strand" else {**WRAP, "fatigue": {"sprocket": weak}}
    scale = 1.0 if kind == "strand" else 0.6
    blocks = [{**block, "tension_N": scale * block["tension_N"]} for block in DUTY]
    used = 0.0
    for block in blocks:
        alone = {"tension_N": block["tension_N"], "speed_rpm": block["speed_rpm"]}
        used += block["share_of_time"] / fatigue_hours({**base, "load": alone})
    together = {name: table for name, table in base.items() if name != "load"}
    assert fatigue_hours({**together, "duty": blocks}) == pytest.approx(1.0 / used, rel=1e-6)


def test_typical_regime_has_the_printed_equivalence(strand: Callable[..., dict[str, Any]]) -> None:
    """mu_H = 0.25 of regime II, table 2.2."""
    loads = [{"tension_N": 5000, "speed_rpm": 100, "regime": name} for name in ("0", "II")]
    constant, regime = (fatigue_hours(strand(load=load)) for load in loads)
    assert constant / regime == pytest.approx(0.25, rel=1e-3)


@pytest.mark.parametrize(("rate", "first"), [(1e-9, "wear"), (1e-11, "sprocket_fatigue")])
def test_which_governs(strand: Callable[..., dict[str, Any]], rate: float, first: str) -> None:
    tables = strand(wear={"specific_wear_rate_mm2_per_N": rate}, stop={"critical_depth_mm": 0.1})
    result = wearsim.simulate(wearsim.load_case(tables))
    fatigue = result.parts["sprocket_fatigue"].hours
    assert (result.life.hours < fatigue) == (first == "wear")
    assert result.governing == first
    assert result.summary()["governing_life"] == first
    assert result.summary()["governing_life_hours"] == min(result.life.hours, fatigue)
    told = [text for text in result.warnings if "contact fatigue of the sprocket ends the life" in text]
    assert len(told) == (first != "wear")
    assert all("before wear" in text and "it governs" in text for text in told)


def test_a_stress_below_the_limit_is_endured_for_ever(strand: Callable[..., dict[str, Any]]) -> None:
    """K = 0.99 of 804.2 MPa: N_HG cycles are a bound, or the horizon if that is more."""
    pull = 5000.0 * (0.99 * HARD_LIMIT / evolute_peak(5000.0)) ** 2
    result = wearsim.simulate(wearsim.load_case(strand(load={"tension_N": pull, "speed_rpm": 100})))
    life = result.parts["sprocket_fatigue"]
    assert isinstance(life, LowerBound)
    assert life.hours_run == 2e5 > 30.0 * 450.0**2.4 / 6000.0
    assert result.summary()["sprocket_fatigue_life_hours"] is None
    assert result.governing == "wear"
    assert result.summary()["governing_life_hours"] == result.life.hours


def test_a_stress_above_all_life_factors_is_allowed_at_no_time(strand: Callable[..., dict[str, Any]]) -> None:
    """K_HL is 1.8 at most: pulls of 1.01 and 0.99 of that stress squared."""
    greatest = 5000.0 * (1.8 * HARD_LIMIT / evolute_peak(5000.0)) ** 2
    above, below = (
        wearsim.simulate(wearsim.load_case(strand(load={"tension_N": factor * greatest, "speed_rpm": 100})))
        for factor in (1.01, 0.99)
    )
    assert above.parts["sprocket_fatigue"] == Life(0.0, 0.0)
    assert above.governing == "sprocket_fatigue"
    assert "too high for the sprocket from the start" in " ".join(above.warnings)
    assert below.parts["sprocket_fatigue"].hours > 0.0
    assert "from the start" not in " ".join(below.warnings)


def test_no_limit_within_the_run_leaves_open_which_governs(strand: Callable[..., dict[str, Any]]) -> None:
    result = wearsim.simulate(wearsim.load_case(strand(run={"horizon_hours": 100.0})))
    assert isinstance(result.life, LowerBound)
    assert result.parts["sprocket_fatigue"].hours > 100.0
    assert result.governing is None
    assert result.summary()["governing_life"] is None
    assert result.summary()["governing_life_hours"] is None


def test_a_chain_that_is_first_does_not_hide_the_fatigue_of_the_sprocket() -> None:
    tables = {
        **WRAP,
        "joint": {"specific_wear_rate_mm2_per_N": 1e-8},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-11},
        "fatigue": {"sprocket": {**HARD, "contact_safety": 1.8}},
        "run": {"life_tolerance": 0.1, "horizon_hours": 1000.0},
    }
    result = wearsim.simulate(wearsim.load_case(tables))
    fatigue = result.parts["sprocket_fatigue"].hours
    assert result.parts["chain"].hours < fatigue < result.parts["sprocket"].hours_run
    assert result.governing == "wear"
    assert "contact fatigue of the sprocket ends its life before wear" in " ".join(result.warnings)


def test_hardness_outside_its_formula_is_told(strand: Callable[..., dict[str, Any]]) -> None:
    soft = {"treatment": "surface_hardened", "hardness_HRC": 39}
    text = "fatigue.sprocket: table 2.3 holds for 40 to 56 HRC where it is surface_hardened, it is 39"
    assert text in wearsim.simulate(wearsim.load_case(strand(soft))).warnings
    given = {**soft, "contact_limit_MPa": 965}
    result = wearsim.simulate(wearsim.load_case(strand(given)))
    assert text not in result.warnings
    hours = endured(result.initial_peak_pressure, 965.0 / 1.2, 390.0, 6000.0)
    assert result.parts["sprocket_fatigue"].hours == pytest.approx(hours, rel=1e-9)


def test_wear_is_the_same_with_and_without(strand: Callable[..., dict[str, Any]]) -> None:
    requested = wearsim.simulate(wearsim.load_case(strand()))
    plain = wearsim.simulate(wearsim.load_case(strand(fatigue=None)))
    assert plain.life == requested.life
    assert plain.parts == {}
    assert not {"governing_life", "sprocket_fatigue_life_hours"} & set(plain.summary())


@pytest.mark.wide
@pytest.mark.parametrize("kind", ["strand", "wrap"])
def test_a_saved_result_reloads(strand: Callable[..., dict[str, Any]], kind: str, tmp_path: Path) -> None:
    tables = strand() if kind == "strand" else {**WRAP, "fatigue": {"sprocket": HARD}}
    result = wearsim.simulate(wearsim.load_case(tables))
    result.save(tmp_path / "run")
    again = wearsim.WearResult.load(tmp_path / "run")
    assert again.parts == result.parts
    assert again.summary() == result.summary()
    locked = wearsim.simulate(wearsim.load_case(tmp_path / "run" / "case.lock.toml"))
    assert locked.parts == result.parts
