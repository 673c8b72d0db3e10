"""Published rules for duties of several blocks, and what they count beside the pull."""

import pytest

import wearsim
from wearsim.chain.practice import opinions
from wearsim.result.second_opinions import SecondOpinions
from wearsim.simulation.wrap_life import chain_practice, practice_warnings

DRIVE = {
    "format_version": 1,
    "chain": {"designation": "10A-1"},
    "sprocket": {"teeth": 17, "profile": "iso606", "role": "driver", "nodes": 41},
    "drive": {"mate_teeth": 34, "links": 106},
    "mechanism": {"kind": "wrap", "phases": 1},
    "wear": {"condition": "hardened, oiled"},
    "run": {"life_tolerance": 0.1},
}
FULL = {"power_kW": 2, "speed_rpm": 300}
LIGHT = {"power_kW": 0.02, "speed_rpm": 300}


def case(load=None, duty=None, **tables):
    merged = {**DRIVE, **{name: {**DRIVE.get(name, {}), **table} for name, table in tables.items()}}
    return wearsim.load_case({**merged, **({"duty": duty} if duty else {"load": load or FULL})})


def blocks(*parts):
    return [{"share_of_time": share, **load} for share, load in parts]


def hours(found: SecondOpinions) -> dict[str, float | None]:
    return {rule.rule: rule.hours for rule in found.rules}


def practice(*args, **tables) -> SecondOpinions:
    found = chain_practice(case(*args, **tables))
    assert found is not None
    return found


def test_every_rule_wears_by_its_blocks():
    """1/T = 0.1/T_1 + 0.9/T_2: next to nothing in the light block, about ten times the hours."""
    full, light = hours(practice(FULL)), hours(practice(LIGHT))
    duty = hours(practice(duty=blocks((0.1, FULL), (0.9, LIGHT))))
    assert duty == pytest.approx({name: 1 / (0.1 / full[name] + 0.9 / light[name]) for name in full})
    assert duty["rating rule"] == pytest.approx(10 * full["rating rule"], rel=1e-4)


def test_shares_of_a_duty_are_of_its_time():
    """Blocks at 300 and 600 rpm, each for half of the time: a third and two thirds of the turns."""
    slow, fast = FULL, {"power_kW": 2, "speed_rpm": 600}
    found = hours(practice(duty=blocks((0.5, slow), (0.5, fast))))
    one, other = hours(practice(slow)), hours(practice(fast))
    assert found == pytest.approx({name: 2 / (1 / one[name] + 1 / other[name]) for name in one})


def test_one_block_has_the_hours_of_the_constant_load_to_the_last_digit():
    assert practice(duty=blocks((0.5, FULL), (0.5, FULL))) == practice(FULL)


def test_the_worst_block_is_outside_of_practice():
    """4960 N on 70.3 mm2 for a tenth of the time; the mean pull of 1216 N is 17 MPa."""
    heavy, light = ({"tension_N": pull, "speed_rpm": 300} for pull in (5000, 800))
    found = practice(duty=blocks((0.1, heavy), (0.9, light)))
    assert found.outside.startswith("joint pressure 70.")
    assert "under 49" in found.outside and found.outside.endswith("in practice at most 45 MPa")
    assert set(hours(found).values()) == {None}


def test_a_rule_outside_its_range_in_a_block_has_no_hours_unless_nothing_wears_there(drive):
    """DIN is tabled from 0.1 m/s, which 21 teeth of 19.05 mm have at 15 rpm."""
    work, slow = drive(time_share=0.9), drive(speed=10.0, time_share=0.1)
    alone, found = ({one.rule.name: one for one in opinions(*duty)} for duty in ((drive(),), (work, slow)))
    # 0.1 10/(0.9 120 + 0.1 10) = 0.9 % of load times way
    din = alone["DIN 8195 pressure"].hours / 0.9
    assert found["DIN 8195 pressure"].hours == pytest.approx(din)
    longer = opinions(drive(time_share=0.8), drive(speed=10.0, time_share=0.2))
    with_hours = {one.rule.name: one for one in longer}
    assert with_hours["DIN 8195 pressure"].hours is None
    assert with_hours["DIN 8195 pressure"].note.endswith(" N at 10 rpm")
    assert with_hours["rating rule"].hours is not None


def test_a_rule_has_no_hours_where_every_block_is_small(drive):
    """None of 200 blocks has more than 1 % of the way, all of them together have all."""
    slow = [drive(speed=10.0, time_share=0.005)] * 200
    assert {one.rule.name: one.hours for one in opinions(*slow)}["DIN 8195 pressure"] is None


def test_lubrication_is_judged_by_the_fastest_block():
    """Drip ends at 1.27 m/s for this pitch, which 17 teeth have at 282 rpm."""
    slow = {"power_kW": 0.5, "speed_rpm": 200}
    drip = {"lubricant": "drip"}
    assert practice(slow, lubrication=drip).lubrication == ""
    found = practice(duty=blocks((0.5, FULL), (0.5, slow)), lubrication=drip)
    assert "give 0.4 times the life" in found.lubrication
    assert "'oil-bath' is recommended at 1.35 m/s" in found.lubrication


def test_impact_takes_the_hours_of_the_whole_duty():
    """1/h = 0.05/h_1 + 0.95/h_2, the worst block's rating being used as before."""
    fast, slow = {"power_kW": 5, "speed_rpm": 3000}, {"power_kW": 0.5, "speed_rpm": 500}
    small = {"designation": "08B-1"}

    def impact(loaded):
        return next(one for one in loaded.drive.ratings(loaded) if one.name == "roller impact")

    one, other = (impact(case(load, chain=small)) for load in (fast, slow))
    both = impact(case(duty=blocks((0.05, fast), (0.95, slow)), chain=small))
    assert both.hours == pytest.approx(1 / (0.05 / one.hours + 0.95 / other.hours), rel=1e-9)
    assert (both.used, one.hours) == (one.used, impact(case(duty=blocks((1.0, fast)), chain=small)).hours)


def test_the_joints_have_the_lubrication_of_their_own_condition():
    oiled, soil = "hardened, oiled", "soil-contaminated"
    clean = hours(practice())
    assert hours(practice(wear={"condition": soil}, joint={"condition": oiled})) == clean
    dirty = practice(joint={"condition": soil})
    assert hours(dirty) == pytest.approx({name: 0.008 * found for name, found in clean.items()})
    assert any(text.startswith("lubrication 'dry'") for text in practice_warnings(dirty))
