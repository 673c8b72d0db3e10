"""What ends a drive before its wear does: headline, JSON, plan, sheet and ``--require-hours`` agree."""

import json

import pytest

import wearsim
from wearsim.command.options import answer_text as answer
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.maintenance import drive_plan, planned_events

pytestmark = pytest.mark.wide

IMPACT = 15_000 * 1.28 / (5.0 / (0.7457 * 17 * (100 * 17 / 3000) ** 1.5 * 0.5**0.8)) ** 2.5
"""Hours of rollers on 128 links: 5 kW over the rating H2 of 17 teeth, 12.7 mm, 3000 rpm, to the power 2.5."""


def tables(designation="08A-1", teeth=34, centre=640, power=5.0, speed=3000.0, condition="hardened, oiled"):
    wheels = {"a": 17, "b": teeth}
    return {
        "format_version": 1,
        "chain": {"designation": designation},
        "sprocket": [
            {"name": name, "teeth": z, "profile": "iso606", "nodes": 41} for name, z in wheels.items()
        ],
        "drive": {"centre_distance_mm": centre},
        "load": {"power_kW": power, "speed_rpm": speed},
        "mechanism": {"phases": 1},
        "run": {"life_tolerance": 0.1, "horizon_hours": 20_000},
        "wear": {"condition": condition},
    }


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    import tomlkit

    path = tmp_path_factory.mktemp("impact") / "impact.toml"
    path.write_text(tomlkit.dumps(tables()))
    return path


@pytest.fixture(scope="module")
def found():
    return drive_life(load_drive(tables()))


def test_hours_of_the_rollers_by_hand():
    assert pytest.approx(5839, abs=0.5) == IMPACT


def test_rollers_end_the_chain_before_wear(found):
    content = found.summary()
    assert content["first_end_hours"] == pytest.approx(IMPACT, rel=1e-3)
    assert (content["first_end_mode"], content["first_end_part"]) == ("roller and bush impact", "chain")
    # The life is that by wear, as before.
    assert content["life_hours"] == content["chain_life_hours"] == found.chain.hours > 2 * IMPACT
    assert found.first == "chain"
    (event,) = (one for one in content["events"] if "impact" in one["event"])
    assert event["hours"] == pytest.approx(IMPACT, rel=1e-3)
    assert event["event"] == "roller and bush impact: replace it"
    assert not any("3 %" in one["event"] or "1.5 %" in one["event"] for one in content["events"])


def test_the_answer_replaces_the_chain_then(found):
    lines = answer(found, "impact.toml").splitlines()
    assert lines[1].startswith("  Chain      5 839 h by roller and bush impact")
    assert "replace the chain at 5 839 h" in next(line for line in lines if line.startswith("  First"))
    told = answer(found, "impact.toml", explain=True)
    assert "counts wear only" not in told and "plate fatigue" in told
    assert "5 839 h by roller and bush impact; by wear " in told


def test_the_chains_of_the_sprockets_are_told(found):
    """Teeth wear under chains that grow by 3 %; these are gone before."""
    (told,) = (text for text in found.warnings if "sprocket lives" in text)
    assert "roller and bush impact ends its life at 5 839 h" in told
    light = {"load": {"power_kW": 1.0, "speed_rpm": 300}, "run": {"life_tolerance": 0.1}}
    later = load_drive({**tables(), **light})
    assert not any("sprocket lives" in text for text in drive_life(later).warnings)


def test_required_hours_name_the_mode(cli, file):
    done = cli("life", file, "--require-hours", 8000)
    assert done.code == 4
    assert "life of the chain by roller and bush impact 5838." in done.err
    assert "life of the chain 1" not in done.err
    assert cli("life", file, "--require-hours", 5000).code == 0


def test_a_power_is_solved_for_by_what_ends_first(cli, file):
    """Impact: hours as the power to the -2.5, as above, so 10 000 h at (5839/10 000)^0.4 of it."""
    done = cli("life", file, "--require-hours", 10_000, "--solve-for", "load.power_kW", "--json")
    assert done.code == 0, done.err
    found = json.loads(done.out)
    power = tables()["load"]["power_kW"] * (IMPACT / 10_000) ** 0.4
    assert found["solve_for"]["value"] == pytest.approx(power, rel=1e-3)
    assert found["first_end_hours"] == pytest.approx(10_000, rel=2e-3)


def test_the_plan_replaces_the_chain_then(cli, file):
    plan = json.loads(cli("maintain", file, "--json").out)
    assert plan["parts"][0]["life_hours"] == pytest.approx(IMPACT, rel=1e-3)
    for policy in plan["policies"]:
        assert policy["schedule"][0]["parts"][0] == "chain"
        assert policy["schedule"][0]["hours"] == pytest.approx(IMPACT, rel=1e-3)
    assert "chain 5 839 h by roller and bush impact, a " in cli("maintain", file).out


def test_the_sheet_is_headed_by_the_first_end(cli, file, tmp_path):
    out = tmp_path / "sheet.html"
    assert cli("report", file, "--out", out).code == 0
    assert ": 5 839 h, overloaded</title>" in out.read_text("utf-8")


def test_one_sprocket_agrees(cli, tmp_path):
    """21 teeth on the driven shaft of the same chain: its own H2, and events in its JSON too."""
    one = {key: value for key, value in tables().items() if key != "drive"}
    one |= {
        "sprocket": {"teeth": 17, "profile": "iso606", "nodes": 41},
        "drive": {"links": 128, "mate_teeth": 34},
    }
    result = wearsim.simulate(wearsim.load_case({**one, "mechanism": {"kind": "wrap", "phases": 1}}))
    content = result.summary()
    assert content["first_end_hours"] == pytest.approx(IMPACT, rel=1e-3)
    assert content["life_hours"] == result.life.hours > 2 * IMPACT
    assert [one["hours"] for one in content["events"] if "impact" in one["event"]] == [
        content["first_end_hours"]
    ]
    assert result.named_lives["life by roller and bush impact"].hours == content["first_end_hours"]
    assert "counts wear only" not in answer(result, "one.toml")


def test_outside_practice_stands_before_the_hours():
    """16A-1 at 10 rpm pulls 28 kN: far above twice the pressure allowed."""
    found = drive_life(load_drive(tables("16A-1", 51, 1000, 2.0, 10.0)))
    line = answer(found, "slow.toml").splitlines()[1]
    assert line.startswith("  Chain      outside any published practice: 2 773 h")


@pytest.fixture(scope="module")
def dry():
    return drive_life(load_drive(tables(power=0.5, speed=1500.0, condition="hardened, dry")))


def test_a_rating_that_decides_nothing_is_named_where_it_is_outside(dry):
    """1500 rpm of 1250 rpm recommended."""
    told = " ".join(answer(dry, "dry.toml", explain=True).split())
    assert (
        "within those that decide, outside recommended speed (for information) 120 %; most used is " in told
    )
    assert "within all of them" not in told and "most used is recommended speed" not in told


def test_events_follow_the_plan(dry):
    """The chain goes with sprocket 'a', before it has grown by 3 %."""
    chain, a = dry.chain.hours, dry.sprockets["a"].hours
    assert a < chain
    events = planned_events(drive_plan(dry))
    (event,) = (one for one in events if one.part == "chain" and "replace" in one.event)
    assert event.hours == a
    assert event.event.startswith("replace it; elongation 3 % at ")


def test_a_short_run_contradicts_no_rule():
    """The rules give 20 780 h in the mean; a run of 1000 h can say nothing against that."""
    drive = load_drive({**tables("10A-1", power=2.0, speed=300.0), "run": {"horizon_hours": 1000.0}})
    line = next(line for line in answer(drive_life(drive), "base.toml").splitlines() if "  Band" in line)
    assert "published rules" not in line
