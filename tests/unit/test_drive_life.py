"""What is said of the sprockets of a drive, and how their runs end together."""

import threading
import time
from types import SimpleNamespace

import pytest

from wearsim.errors import ConvergenceError
from wearsim.result import LimitState
from wearsim.study.whole_drive import model
from wearsim.study.whole_drive.keys import load_drive
from wearsim.study.whole_drive.model import drive_life
from wearsim.study.whole_drive.said_of_sprockets import said_of_sprockets
from wearsim.study.whole_drive.sheet import jumping_text
from wearsim.study.whole_drive.wheels import DriveWheel

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
        ({"ring": 4.0, "roll": 1e-6}, "jumping: safe"),
        ({"ring": 1e-6, "roll": 8.0}, "jumping: 25 % above what is needed on the sprocket 'roll'"),
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


def test_one_that_fails_stops_the_others(monkeypatch, drive):
    """The others would run on for ever: each only looks at whether it is still wanted."""
    running, ran_on = threading.Semaphore(0), []

    def simulate(case, progress):
        if case.drive.gaps == 17:
            for _ in range(4):
                assert running.acquire(timeout=10.0)
            raise ConvergenceError("the cog of 17 teeth fails")
        running.release()
        for _ in range(2000):
            progress(0.5)
            time.sleep(1e-3)
        ran_on.append(case.drive.gaps)

    monkeypatch.setattr(model, "simulate", simulate)
    with pytest.raises(ConvergenceError, match="'cassette 17T': the cog of 17 teeth fails"):
        drive_life(drive, threads=5)
    assert not ran_on
