"""The band of a lubricated life, held against lives of cases that stand at the ends of each cause."""

import math
from typing import Any

import pytest

import wearsim
from tests.drives import ROAD_BICYCLE, STRAND, changed
from wearsim.lubrication.clock import band_of_causes
from wearsim.runner.scatter import load_scattered

OILED_BY_HAND = changed(
    {key: table for key, table in STRAND.items() if key != "wear"},
    {
        "lubrication": {
            "lubricant": "manual",
            "environment": "dust",
            "lasts_hours": 200,
            "interval_hours": 75,
        },
        "run.life_tolerance": 0.1,
    },
)
"""In dust the oil lasts 200/2.4 = 83.3 h: 75 h are just in time."""


def life(values: dict[str, Any]) -> float:
    return wearsim.simulate(wearsim.load_case(changed(OILED_BY_HAND, values))).life.hours


def by_squares(middle: float, lives: list[float]) -> float:
    return math.sqrt(math.fsum(math.log(one / middle) ** 2 for one in lives))


def test_ends_of_a_life_are_those_of_its_causes() -> None:
    """Each cause alone at its end, as a case of its own: logarithms of the lives add as squares."""
    found = wearsim.simulate(wearsim.load_case(OILED_BY_HAND))
    rate = {"wear": {"condition": "hardened, greased"}}
    assert life(rate) == pytest.approx(found.life.hours)
    # Teeth of hardened, greased 2.5e-11 to 2.3e-10, typical 7.5e-11; 39 times as fast dry, 6.1 to 240.
    low = by_squares(
        found.life.hours,
        [
            life({"wear": {"specific_wear_rate_mm2_per_N": 2.3e-10}}),
            life({"lubrication.lasts_hours": 200 / 1.5}),
            life({"lubrication.dry_factor": 240}),
            life({"lubrication.contamination_factor": 6.3}),
        ],
    )
    assert math.log(found.life.hours / found.life_low.hours) == pytest.approx(low, rel=1e-3)
    high = by_squares(
        found.life.hours,
        [
            life({"wear": {"specific_wear_rate_mm2_per_N": 2.5e-11}}),
            life({"lubrication.lasts_hours": 200 * 1.5}),
            life({"lubrication.dry_factor": 6.1}),
            life({"lubrication.contamination_factor": 1.8}),
        ],
    )
    assert math.log(found.life_high.hours / found.life.hours) == pytest.approx(high, rel=1e-3)
    for cause in ("how long the lubricant lasts", "the wear without lubricant", "dirt"):
        assert cause in found.band


def test_the_cliff_lies_in_the_band_and_is_told() -> None:
    """With an interval of 92 h, 9 h beyond what the oil lasts, a life is shorter by far than with 75 h."""
    near = wearsim.simulate(wearsim.load_case(OILED_BY_HAND))
    beyond = life({"lubrication.interval_hours": 92})
    assert near.life_low.hours < beyond < 0.5 * near.life.hours
    [told] = [text for text in near.warnings if "hangs on how long the lubricant lasts" in text]
    assert "lasts, 83.33 h: with 55.56 h, " in told
    safe = wearsim.simulate(wearsim.load_case(changed(OILED_BY_HAND, {"lubrication.interval_hours": 50})))
    assert not any("hangs on" in text for text in safe.warnings)


@pytest.mark.parametrize("key", ["lasts_band_factor", "dry_band_factor", "contamination_band_factor"])
def test_a_known_lubricant_has_a_narrower_band(key: str) -> None:
    values = {"lubrication.interval_hours": 92, f"lubrication.{key}": 1.01}
    usual = changed(OILED_BY_HAND, {"lubrication.interval_hours": 92})
    wide, narrow = (wearsim.simulate(wearsim.load_case(one)) for one in (usual, changed(usual, values)))
    assert narrow.life.hours == wide.life.hours
    assert wide.life_low.hours < narrow.life_low.hours < narrow.life.hours
    assert narrow.life.hours < narrow.life_high.hours < wide.life_high.hours


@pytest.mark.parametrize(
    ("table", "key"),
    [
        ({"lubricant": "drip", "lasts_band_factor": 2}, "lasts_band_factor"),
        ({"lubricant": "drip", "dry_band_factor": 2}, "dry_band_factor"),
        ({"lubricant": "drip", "contamination_band_factor": 2}, "contamination_band_factor"),
        ({"lubricant": "manual", "lasts_hours": 0, "lasts_band_factor": 2}, "lasts_band_factor"),
    ],
)
def test_a_band_of_what_there_is_not_is_refused(table: dict[str, Any], key: str) -> None:
    with pytest.raises(wearsim.CaseError, match=rf"lubrication\.{key}: belongs to "):
        wearsim.load_case({**OILED_BY_HAND, "lubrication": table})


def test_the_band_of_a_rate_of_ones_own_holds_all_but_what_the_case_says() -> None:
    """A rate that was measured on the drive was measured with its lubricant and its dirt."""
    own = changed(OILED_BY_HAND, {"wear": {"specific_wear_rate_mm2_per_N": 1e-10, "band_factor": 1.2}})
    found = wearsim.simulate(wearsim.load_case(own))
    assert found.life.hours / found.life_low.hours == pytest.approx(1.2, rel=1e-2)
    told = wearsim.simulate(wearsim.load_case(changed(own, {"lubrication.contamination_band_factor": 2})))
    expected = math.exp(math.hypot(math.log(1.2), math.log(2.0)))
    assert told.life.hours / told.life_low.hours == pytest.approx(expected, rel=1e-2)


def test_one_cause_gives_its_own_ends() -> None:
    assert band_of_causes(100.0, [(50.0, 300.0)]) == pytest.approx((50.0, 300.0))


def test_samples_scatter_by_the_same_bands() -> None:
    """Their default scatter has the ends of the bands at 5 and 95 %: 1.6449 standard deviations."""
    scatters = {one.key: one.distribution for one in load_scattered(OILED_BY_HAND, ()).scatters}
    wear = "wear.specific_wear_rate_mm2_per_N"
    lasts, dry, dirt = (f"lubrication.{key}" for key in ("lasts_hours", "dry_factor", "contamination_factor"))
    assert set(scatters) == {wear, lasts, dry, dirt}
    assert scatters[lasts].sigma_ln == pytest.approx(math.log(1.5) / 1.6449, rel=1e-4)
    assert scatters[dirt].median == pytest.approx(math.sqrt(1.8 * 6.3))
    assert scatters[dry].sigma_ln == pytest.approx(0.5 * math.log(240 / 6.1) / 1.6449, rel=1e-4)


def test_wax_lasts_as_surely_as_its_row_says() -> None:
    """520 m, 310 to 590 m: half of the wax's band below, and its dry factor half and twice."""
    wax = changed(ROAD_BICYCLE, {"lubrication": {"lubricant": "immersion wax", "interval_sliding_m": 700}})
    del wax["wear"]
    lubrication = wearsim.load_case(wax).lubrication
    assert lubrication.lasts_ends == pytest.approx((310 / 520, 590 / 520))
    assert lubrication.dry_ends == pytest.approx((0.5, 2.0))


def test_hardness_and_lubricant_give_the_condition() -> None:
    """Hardened teeth last 6.7 times as long as normalised ones with either lubricant: the reconstruction."""
    base = {key: table for key, table in STRAND.items() if key != "wear"}

    def hours(lubricant: str, hardness: str) -> float:
        tables = {"wear": {"tooth_hardness": hardness}, "lubrication": {"lubricant": lubricant}}
        return wearsim.simulate(wearsim.load_case({**base, **tables})).life.hours

    assert hours("manual", "hardened") / hours("manual", "normalised") == pytest.approx(20 / 3, rel=2e-3)
    assert hours("drip", "hardened") / hours("drip", "normalised") == pytest.approx(6.6, rel=2e-3)
    assert hours("drip", "hardened") / hours("manual", "hardened") == pytest.approx(1.5, rel=2e-3)


@pytest.mark.parametrize(
    ("tables", "message"),
    [
        ({"wear": {"tooth_hardness": "hard"}, "lubrication": {"lubricant": "drip"}}, "tooth_hardness"),
        ({"wear": {"tooth_hardness": "hardened"}}, r"tooth_hardness: needs lubrication\.lubricant"),
        (
            {"wear": {"tooth_hardness": "hardened", "condition": "normalised, dry"}},
            r"tooth_hardness: must be that of condition = 'normalised, dry'",
        ),
        (
            {"wear": {"tooth_hardness": "normalised"}, "lubrication": {"lubricant": "wet drip"}},
            r"tooth_hardness: must be that of condition = 'bicycle, wet drip'",
        ),
        (
            {"wear": {"tooth_hardness": "hardened", "specific_wear_rate_mm2_per_N": 1e-9}},
            "tooth_hardness: specific_wear_rate_mm2_per_N already sets how fast",
        ),
    ],
)
def test_a_hardness_that_says_nothing_is_refused(tables: dict[str, Any], message: str) -> None:
    base = {key: table for key, table in STRAND.items() if key != "wear"}
    with pytest.raises(wearsim.CaseError, match=message):
        wearsim.load_case({**base, **tables})


def test_the_old_name_of_a_condition_is_taken() -> None:
    old = wearsim.load_case(changed(STRAND, {"wear.condition": "unhardened, dry"}))
    assert old.inputs["wear"]["condition"] == "normalised, dry"


def test_every_sprocket_has_its_hardness() -> None:
    """A drive of which one sprocket is not hardened: its teeth wear 6.7 times as fast."""
    sprocket = {"teeth": 17, "profile": "ansi_b29", "nodes": 51}
    drive = {
        "format_version": 1,
        "chain": {"designation": "12A-1"},
        "sprocket": [sprocket, {**sprocket, "teeth": 21, "wear": {"tooth_hardness": "normalised"}}],
        "drive": {"links": 100},
        "load": {"power_kW": 2, "speed_rpm": 120},
        "wear": {"tooth_hardness": "hardened"},
        "lubrication": {"lubricant": "manual"},
    }
    first, second = (one.case for one in wearsim.load_case(drive).sprockets)
    assert (first.wear.coefficient, second.wear.coefficient) == (7.5e-11, 5e-10)
    assert first.drive.joint.coefficient == second.drive.joint.coefficient == 1.8e-10


def test_no_warning_of_a_condition_that_nobody_gave() -> None:
    base = {key: table for key, table in STRAND.items() if key != "wear"}
    soft = {"wear": {"tooth_hardness": "normalised"}, "lubrication": {"lubricant": "manual"}}
    assert wearsim.load_case({**base, **soft}).warnings == ()
    law = {**soft, "wear": {**soft["wear"], "law": "archard"}}
    assert wearsim.load_case({**base, **law}).wear.coefficient == 5e-10


def test_dirt_that_may_be_worse_than_the_threshold_is_held_below_it() -> None:
    """Dust may wear 6.3 times as fast; relubricated at 5 times, it would be for ever."""
    by_rate = changed(OILED_BY_HAND, {"lubrication.when_rate_exceeds": 5})
    del by_rate["lubrication"]["interval_hours"]
    found = wearsim.simulate(wearsim.load_case(by_rate))
    assert found.life_low.hours < found.life.hours < found.life_high.hours


def test_a_band_of_a_cause_may_lie_on_one_side() -> None:
    """Both ends shorter than the middle: nothing is longer by it."""
    assert band_of_causes(100.0, [(80.0, 50.0)]) == pytest.approx((50.0, 100.0))


def test_the_locked_case_has_the_same_band(tmp_path: Any) -> None:
    found = wearsim.simulate(wearsim.load_case(OILED_BY_HAND))
    found.save(tmp_path / "out")
    again = wearsim.simulate(wearsim.load_case(tmp_path / "out" / "case.lock.toml"))
    assert (again.life_low, again.life_high) == (found.life_low, found.life_high)


def test_soil_beside_dry_contacts_is_warned_of() -> None:
    base = {key: table for key, table in STRAND.items() if key != "wear"}
    case = wearsim.load_case({**base, "lubrication": {"lubricant": "dry", "environment": "soil"}})
    assert any("counts the missing oil twice" in text for text in case.warnings)


def test_contacts_that_run_dry_are_told() -> None:
    """The oil lasts 83.3 h of 120: (83.3 + 36.7 x 39)/120 = 12.6 times the wear in the mean."""
    dry = wearsim.simulate(wearsim.load_case(changed(OILED_BY_HAND, {"lubrication.interval_hours": 120})))
    [told] = [text for text in dry.warnings if "is renewed every" in text]
    assert "lasts 83.33 h and is renewed every 120 h: contacts wear 12.6 times as fast" in told
    near = wearsim.simulate(wearsim.load_case(OILED_BY_HAND))
    assert not any("is renewed every" in text for text in near.warnings)
