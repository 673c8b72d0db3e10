"""Published rules for duties of several blocks, and what they count beside the pull."""

import pytest

import wearsim
from wearsim.chain.practice_rules import opinions, outside_practice, pressure_velocity
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.wrap_life import chain_practice
from wearsim.report.answer import overload_text
from wearsim.report.drive.drive_text import drive_text
from wearsim.result import Life
from wearsim.result.second_opinions import (
    SecondOpinions,
    opinions_json,
    practice_text,
    read_opinions,
    rule_rows,
    second_opinions,
    span_text,
)

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
    assert "under 4 9" in found.outside and found.outside.endswith("in practice at most 45 MPa")
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
    assert found.lubrication_factor == 0.4
    assert "'oil bath' is recommended at 1.35 m/s" in found.lubrication


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
    assert any(text.startswith("lubrication 'dry'") for text in dirty.warnings)


def test_a_better_lubrication_is_said_and_warned_of_by_nobody():
    """0.9 m/s ask for drip; a bath there gives 1.5 times the hours of the rules."""
    slow = {"power_kW": 1, "speed_rpm": 200}
    plain, bath = practice(slow), practice(slow, lubrication={"lubricant": "oil bath"})
    assert hours(bath) == pytest.approx({name: 1.5 * found for name, found in hours(plain).items()})
    assert ", times 1.5 for lubrication and surroundings" in practice_text(bath)
    assert "'drip' is recommended" in opinions_json(bath)["lubrication"]
    assert bath.warnings == ()
    assert "times" not in practice_text(plain)


def test_shocks_of_the_rules_are_said():
    shocks = practice(drive={"service_factor": 2})
    assert hours(shocks)["rating rule"] == pytest.approx(hours(practice())["rating rule"] / 8)
    assert "with shocks f1 = 2, which the computed life does not include" in practice_text(shocks)
    assert "shocks" not in practice_text(practice())


def test_hours_that_nobody_has_seen_are_a_bound(drive):
    light = second_opinions(drive(pull=300.0))
    assert {told for _, told, _, _ in rule_rows(light)[:-1]} == {"> 100 000 h"}
    assert practice_text(light).startswith("> 100 000 h by 7 published rules")
    assert "wear does not end the life of this chain" in practice_text(light)
    ends = [Life(1.0, hours) for hours in (5e4, 9e4, 1.1e5, 2e5)]
    assert light.within((ends[0], ends[2])) and light.within((ends[3], ends[3]))
    assert not light.within((ends[0], ends[1]))


def test_pressure_times_speed_stands_with_the_rules(drive):
    """3750 N on 89.3 mm2 at 21 19.05 mm 120 rpm; four times as fast, above both limits."""
    value = 3750 / 89.3 * 21 * 19.05e-3 * 120 / 60
    found = second_opinions(drive(pull=3750.0))
    assert found.pressure_velocity == pytest.approx(value)
    assert rule_rows(found)[-1][3].startswith("33.6 MPa m/s, within the 110 to 130")
    assert opinions_json(found)["pressure_velocity_MPa_m_per_s"] == pytest.approx(value)
    assert pressure_velocity(drive(), drive(pull=3750.0, speed=480.0)) == pytest.approx(4 * value)
    assert "BEYOND" in rule_rows(second_opinions(drive(speed=480.0)))[-1][3]


def test_second_opinions_come_back_from_their_file():
    found = practice(drive={"service_factor": 2}, lubrication={"lubricant": "forced"})
    assert read_opinions(opinions_json(found)) == found


def test_the_pressure_that_counts_is_named_where_k_e_alone_doubles_it():
    """2.25 times the pressure of the pull is above twice [p], the pressure itself is not."""
    pressing = {"tension_N": 2100, "speed_rpm": 300}
    gost = {"chain": {"designation": "ПР-15,875-23-1"}, "sprocket": {"profile": "gost591"}}
    loaded = case(pressing, drive={"joint_application_factor": 2.25}, **gost)
    result = wearsim.simulate(loaded)
    (rating,) = [one for one in result.ratings if one.name == "joint pressure"]
    assert rating.used > 2.0 and not outside_practice(*loaded.drive.practice(loaded))
    assert f"without K_e {100 * rating.used / 2.25:.1f} %, which counts" in overload_text(result)


@pytest.mark.wide
def test_a_whole_drive_names_shocks_where_the_rules_differ():
    """Five times the pull, 125 times the hours by the cube: far below the band of the life."""
    document = {
        **{key: DRIVE[key] for key in ("format_version", "chain", "wear", "run")},
        "sprocket": [
            {"name": name, "teeth": teeth, "profile": "iso606", "nodes": 41}
            for name, teeth in (("a", 17), ("b", 34))
        ],
        "mechanism": {"phases": 1},
        "drive": {"centre_distance_mm": 640, "service_factor": 5},
        "load": FULL,
    }
    found = drive_life(load_drive(document))
    assert found.practice is not None and found.practice.span is not None
    (line,) = [line for line in drive_text(found, "two.toml").splitlines() if "Band" in line]
    assert f"; by published rules with f1 = 5 {span_text(found.practice.span)}" in line
