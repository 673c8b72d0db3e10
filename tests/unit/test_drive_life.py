"""What is said of the sprockets of a drive, and how their runs end together."""

import math
import threading
import time
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import brentq

from wearsim.catalogue.catalogues import wear_conditions
from wearsim.drive import life
from wearsim.drive.drive_case import said_of_sprockets
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.drive.wheels import DriveWheel
from wearsim.errors import ConvergenceError
from wearsim.report.drive.drive_words import jumping_text
from wearsim.result import LimitState

RING = {"name": "ring", "teeth": 38, "profile": "iso606", "nodes": 31}
COGS = [{"teeth": teeth, "share_of_time": 0.25} for teeth in (13, 15, 17, 19)]
DRIVE = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": [RING, {"name": "cassette", "profile": "iso606", "nodes": 31, "cog": COGS}],
    "drive": {"links": 110},
    "load": {"power_kW": 0.8, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
    "mechanism": {"phases": 2},
}


@pytest.fixture(scope="module")
def drive():
    return load_drive(DRIVE)


@pytest.fixture(scope="module")
def wheels(drive) -> tuple[DriveWheel, ...]:
    return drive.wheels


def test_cogs_are_named_once(wheels):
    texts = {
        "ring": ["error 0.3 exceeds 0.05", "dry"],
        "cassette 13T": ["error 0.12 exceeds 0.05", "dry", "1 tooth of 2"],
        "cassette 15T": ["error 0.083 exceeds 0.05", "dry"],
        "cassette 17T": ["dry", "error 0.1 exceeds 0.05"],
        "cassette 19T": ["dry"],
    }
    assert said_of_sprockets(texts, wheels) == (
        "ring: error 0.3 exceeds 0.05",
        "dry",
        "cassette 13T, 15T, 17T: error 0.083 to 0.12 exceeds 0.05",
        "cassette 13T: 1 tooth of 2",
    )


def test_all_sprockets_have_the_joints_of_the_lubricant():
    """They have one chain: what wears its joints is not another on a sprocket with a [wear] of its own."""
    own = {"teeth": 20, "profile": "iso606", "nodes": 31, "wear": {"condition": "hardened, dry"}}
    tables = {key: value for key, value in DRIVE.items() if key != "wear"}
    drive = load_drive({**tables, "sprocket": [RING, own], "lubrication": {"lubricant": "greased"}})
    laws = [one.drive.joint.law for one in drive.sprockets]
    assert laws[0] == laws[1]
    assert laws[0].coefficient == wear_conditions()["normalised, greased"].joint_typical


def test_all_cogs_are_their_cassette(wheels):
    cogs = wheels[1].parts
    texts = {"ring": ["wide"], **{name: ["wide", f"runs {i + 1} 000 h"] for i, name in enumerate(cogs)}}
    assert said_of_sprockets(texts, wheels) == ("wide", "cassette: runs 1 000 to 4 000 h")


def test_two_texts_of_one_cog_stay_two(wheels):
    texts = dict.fromkeys(("ring", *wheels[1].parts), ()) | {"cassette 15T": ("used 3 %", "used 5 %")}
    assert said_of_sprockets(texts, wheels) == ("cassette 15T: used 3 %", "cassette 15T: used 5 %")


@pytest.mark.parametrize(
    ("needed", "text"),
    [
        ({"ring": 4.0, "roll": 1e-6}, "jumping: no risk"),
        ({"ring": 1e-6, "roll": 8.0}, "jumping: 25 % more than needed on the sprocket 'roll'"),
        ({"ring": 10.0, "roll": 8.0}, "jumping: no margin on the sprocket 'ring'"),
    ],
)
def test_jumping_is_told_of_the_sprocket_that_is_nearest_to_it(needed, text):
    """With 10 N of slack tension; twice as much as is needed is safe."""
    results = {
        name: SimpleNamespace(limits=(LimitState("min_slack_tension_N", 10.0, value),))
        for name, value in needed.items()
    }
    assert jumping_text(SimpleNamespace(results=results)) == text


def failing(monkeypatch, *gaps):
    """Let the runs of the sprockets of so many teeth fail."""
    run = life.simulate

    def simulate(case, progress):
        if case.drive.gaps in gaps:
            raise ConvergenceError(f"{case.drive.gaps} teeth fail")
        return run(case, progress)

    monkeypatch.setattr(life, "simulate", simulate)


SHORT = {**DRIVE, "run": {"horizon_hours": 50.0, "life_tolerance": 0.1}}


@pytest.fixture(scope="module")
def whole():
    return drive_life(load_drive(SHORT))


@pytest.mark.wide
@pytest.mark.parametrize("gaps", [(17,), (38,), (13, 15, 17, 19)])
def test_others_live_on_where_one_fails(monkeypatch, whole, gaps):
    failing(monkeypatch, *gaps)
    found = drive_life(load_drive(SHORT))
    assert len(found.results) == 5 - len(gaps) and len(found.failed) == len(gaps)
    assert found.parts == {name: whole.parts[name] for name in found.parts}
    assert {name: str(error) for name, error in found.failed.items()} == {
        one.name: f"{one.drive.gaps} teeth fail" for one in found.drive.sprockets if one.drive.gaps in gaps
    }
    assert [one.ok for one in found.reference.ratings] == [one.ok for one in whole.reference.ratings]
    with pytest.raises(ConvergenceError, match=f"'.*': {gaps[0]} teeth fail"):
        found.complete()


def test_where_all_fail_the_first_is_told(monkeypatch):
    failing(monkeypatch, 38, 13, 15, 17, 19)
    with pytest.raises(ConvergenceError, match="'ring': 38 teeth fail"):
        drive_life(load_drive(SHORT))


def test_a_mistake_of_ours_stops_the_others(monkeypatch, drive):
    """The others would run on for ever: each only looks at whether it is still wanted."""
    running, ran_on = threading.Semaphore(0), []

    def simulate(case, progress):
        if case.drive.gaps == 17:
            for _ in range(4):
                assert running.acquire(timeout=10.0)
            raise ZeroDivisionError
        running.release()
        for _ in range(2000):
            progress(0.5)
            time.sleep(1e-3)
        ran_on.append(case.drive.gaps)

    monkeypatch.setattr(life, "simulate", simulate)
    with pytest.raises(ZeroDivisionError):
        drive_life(drive, threads=5)
    assert not ran_on


def chain_changes(result):
    """Hours at which new chains are put on."""
    hours, chains = result.history["time_hours"], result.history["chain"]
    return hours[chains.diff() > 0].index.map(lambda row: hours[row - 1]).to_numpy()


RUN_IN = {
    **DRIVE,
    "sprocket": [{**RING, "name": "a", "teeth": 15}, {**RING, "name": "b", "teeth": 38}],
    "drive": {"links": 90, "slack_tension_N": 60},
    "joint": {"specific_wear_rate_mm2_per_N": 2e-8},
    "stop": {"elongation_percent": 1.5},
    "mechanism": {"phases": 1},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-12, "running_in_factor": 4.0, "running_in_distance_mm": 3e5},
}


@pytest.mark.wide
@pytest.mark.parametrize("cassette", [False, True])
def test_joints_have_one_clock_of_running_in(cassette):
    """That of their way in a loop, 2 pi d2 sum(1/z): all chains last as long, seen from each sprocket."""
    cogs = [{"teeth": teeth, "share_of_time": share} for teeth, share in ((13, 0.5), (19, 0.3), (30, 0.2))]
    wheel = {"name": "b", "profile": "iso606", "nodes": 31, "cog": cogs}
    tables = {**RUN_IN, "sprocket": [RUN_IN["sprocket"][0], wheel]} if cassette else RUN_IN
    steady = {**tables, "wear": {"specific_wear_rate_mm2_per_N": 1e-12}}
    horizon = {"run": {"life_tolerance": 0.1, "horizon_hours": 150.0}}
    constant = drive_life(load_drive({**steady, **horizon})).chain.hours
    loops = 60.0 * 100.0 * 15 / 90  # in an hour
    turned = 1 / 15 + (sum(cog["share_of_time"] / cog["teeth"] for cog in cogs) if cassette else 1 / 38)
    run_in = 3e5 / (2.0 * math.pi * 4.45 * turned * loops)  # hours
    # tau = N + 3 N_r (1 - exp(-N/N_r)) is the life of constant coefficient.
    life = brentq(lambda n: n - 3.0 * run_in * math.expm1(-n / run_in) - constant, 0.0, constant)
    found = drive_life(load_drive({**tables, "run": {"life_tolerance": 0.1, "horizon_hours": 2.05 * life}}))
    for result in found.results.values():
        assert result.parts["chain"].hours == pytest.approx(life, rel=1e-6)
        assert chain_changes(result) == pytest.approx([life, 2.0 * life], rel=1e-6)


@pytest.mark.wide
@pytest.mark.parametrize("running_in", [1.0, 4.0])
def test_a_new_chain_comes_lubricated(running_in):
    """With a lubricant that is never renewed on the drive every chain lasts as long as the first."""
    wear = {**RUN_IN["wear"], "running_in_factor": running_in}
    lubrication = {"lasts_hours": 20.0, "dry_factor": 5.0}
    run = {"life_tolerance": 0.1, "horizon_hours": 140.0}
    found = drive_life(load_drive({**RUN_IN, "wear": wear, "lubrication": lubrication, "run": run}))
    life = found.chain.hours
    assert 20.0 < life < 70.0
    for result in found.results.values():
        changes = chain_changes(result)
        assert changes == pytest.approx(life * (1.0 + np.arange(changes.size)), rel=1e-6) and changes.size > 1
    assert any("new chain has lubricated" in text for text in found.drive.assumptions)


EQUAL = {
    "format_version": 1,
    "chain": {"designation": "08B-1"},
    "sprocket": [
        {"teeth": 19, "profile": "iso606", "nodes": 31},
        {"teeth": 19, "profile": "iso606", "nodes": 31},
    ],
    "drive": {"links": 100},
    "load": {"power_kW": 1, "speed_rpm": 300},
    "wear": {"condition": "hardened, oiled"},
    "mechanism": {"phases": 2},
    "run": {"horizon_hours": 20_000},
}


def _roles_run(monkeypatch) -> list[str]:
    """Roles of the sprockets that are run."""
    roles: list[str] = []
    run = life.simulate

    def counted(case, report):
        roles.append(case.inputs["sprocket"]["role"])
        return run(case, report)

    monkeypatch.setattr(life, "simulate", counted)
    return roles


def test_sprockets_that_wear_alike_are_run_once(monkeypatch):
    """Without friction the driven sprocket is the mirrored driver: alone, each comes to the same bits."""
    drive, progress = load_drive(EQUAL), []
    alone = {one.name: life.simulate(one.case) for one in drive.sprockets}
    roles = _roles_run(monkeypatch)
    together = drive_life(drive, progress.append)
    assert roles == ["driver"]
    assert progress[-1] == 1.0
    assert list(together.results) == ["driver", "driven"]
    for name, one in together.results.items():
        assert one.inputs["sprocket"]["role"] == name
        assert one.summary() == alone[name].summary()
        np.testing.assert_array_equal(
            one.history_columns["max_depth_mm"], alone[name].history_columns["max_depth_mm"]
        )


@pytest.mark.parametrize(
    "changes",
    [
        {"mechanism": {"phases": 2, "friction_roller_tooth": 0.05, "friction_roller_bush": 0.15}},
        {"sprocket": [{"teeth": 19, "profile": "iso606", "nodes": nodes} for nodes in (31, 33)]},
        {"sprocket": [{"teeth": teeth, "profile": "iso606", "nodes": 31} for teeth in (19, 20)]},
    ],
    ids=["friction", "nodes", "teeth"],
)
def test_others_are_run_each(monkeypatch, changes):
    roles = _roles_run(monkeypatch)
    drive_life(load_drive({**EQUAL, **changes}))
    assert sorted(roles) == ["driven", "driver"]
