"""A full life on a wrap, sprocket and chain coupled, on one core, and where its time goes.

Driver of chain no. 40, 19 teeth, 12 rollers in the wrap, 6 phases, 15 000 h, the coarser run
included. Goal: 1 s.
"""

import os
import time
from contextlib import contextmanager
from pathlib import Path

import pytest

import wearsim
from wearsim.geometry import roller_path
from wearsim.mechanisms.wrap import seating
from wearsim.wear import resting_bodies

CASE = Path(__file__).parents[2] / "cases" / "a40-19t-rating.toml"
PARTS = {
    "rollers in equilibrium, and their wear": (seating, "implicit_stage"),
    "line of roller centres on the worn gap": (roller_path, "roller_locus"),
    "pressure on the half-space": (resting_bodies, "wear_events"),
}


@contextmanager
def one_core():
    """Keep this process on one core."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)


@pytest.fixture
def spent(monkeypatch):
    """Seconds of a thread's own time spent in each of the compiled parts."""
    seconds = dict.fromkeys(PARTS, 0.0)

    def timed(name, function):
        def run(*given):
            begin = time.thread_time()
            found = function(*given)
            seconds[name] += time.thread_time() - begin
            return found

        return run

    for name, (module, attribute) in PARTS.items():
        monkeypatch.setattr(module, attribute, timed(name, getattr(module, attribute)))
    return seconds


def test_wrap_life(benchmark, spent):
    case = wearsim.load_case(CASE, ["run.horizon_hours=15000"])
    assert case.drive.phases == 6
    wearsim.simulate(wearsim.load_case(CASE, ["run.horizon_hours=10"]))
    spent.update(dict.fromkeys(spent, 0.0))

    def life():
        begin = time.process_time()
        return wearsim.simulate(case), time.process_time() - begin

    with one_core():
        result, seconds = benchmark.pedantic(life, rounds=1)
    shares = {name: part / seconds for name, part in spent.items()}
    benchmark.extra_info.update(
        seconds=seconds, shares=shares, updates=result.updates, error=result.numerical_error
    )
    assert 0.5 < sum(shares.values()) < 1.0
