"""Shipped whole drives: each is complete, says what practice reports, and gives every part a life."""

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from wearsim.drive.drive_case import DriveCase
from wearsim.drive.drive_result import DriveLife
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.report.drive.drive_text import drive_text
from wearsim.result import Life
from wearsim.result.ends import before_wear

pytestmark = pytest.mark.wide

PATHS = {path.stem: path for path in sorted((Path(__file__).parents[2] / "cases" / "drives").glob("*.toml"))}


@cache
def loaded(name: str) -> DriveCase:
    return load_drive(PATHS[name])


def hours(name: str) -> tuple[float, float] | None:
    """What practice reports of the part that is replaced first, with the factor of the case."""
    text = PATHS[name].read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("# practice:")]
    assert len(lines) == 1
    found = re.match(r"# practice: (\d+)\.\.(\d+) h \(\S", lines[0])
    if found is None:
        assert lines[0].startswith("# practice: none found ("), lines[0]
        return None
    factor = re.search(r"^# factor: ([\d.]+) \(\S", text, re.MULTILINE)
    assert factor is not None
    return float(found[1]) / float(factor[1]), float(found[2]) * float(factor[1])


def test_they_are_those_of_the_list() -> None:
    assert list(PATHS) == [
        "bicycle-cassette",
        "camshaft-loop",
        "escalator-duplex",
        "motorcycle-520",
        "packaging-conveyor",
    ]


@pytest.mark.parametrize("name", PATHS)
def test_each_is_complete_without_warnings_of_its_own(name: str) -> None:
    drive = loaded(name)
    hours(name)
    for sprocket in drive.sprockets:
        assert not sprocket.case.warnings, (name, sprocket.name)


@pytest.mark.slow
@pytest.mark.parametrize("name", PATHS)
def test_parts_live_as_practice_has_it(name: str) -> None:
    _lives_as_practice_has_it(drive_life(loaded(name)), name)


def _lives_as_practice_has_it(found: DriveLife, name: str) -> None:
    reported = hours(name)
    assert isinstance(found.chain, Life)
    if reported is not None:
        assert reported[0] <= found.life.hours_run <= reported[1], found.life
    chains = [result.parts["chain"].hours_run for result in found.results.values()]
    assert chains == pytest.approx([chains[0]] * len(chains), rel=1e-9)
    assert len(found.sprockets) == len(found.drive.sprockets)
    assert_short(found)


def assert_short(found: DriveLife) -> list[str]:
    """The answer takes twelve lines at most, none of its findings more than 100 columns."""
    lines = drive_text(found, "drive.toml").splitlines()
    assert lines[0] == found.drive.title
    labels = [line.split()[0] for line in lines[1:] if line[2] != " "]
    assert labels[0] == "Chain"
    rest = ("First", "Then", "Band", "Ratings", "Worn", "Warnings", "Assumes", "Next")
    assert [label for label in labels if label in rest] == [
        one for one in rest if one != "Then" or "Then" in labels
    ]
    assert len(lines) <= 12, "\n".join(lines)
    assert max(map(len, lines[1:])) <= 100
    return lines


OVERLOADED = (
    ("bicycle-cassette", "load.power_kW=2"),
    ("camshaft-loop", "load.power_kW=15"),
    ("escalator-duplex", "chain.strands=1"),
    ("motorcycle-520", "load.power_kW=40"),
    ("packaging-conveyor", "chain.designation=08B-1"),
)
"""Ten times the power or half of the chain, or as much more as the chain can be run with."""


@pytest.mark.parametrize(("name", "setting"), [*((name, None) for name in PATHS), *OVERLOADED])
def test_the_answer_takes_twelve_lines(name: str, setting: str | None) -> None:
    """A short run, with lives of its parts that are all of different length and all shorter than the run."""
    quick = ["run.life_tolerance=0.1", "mechanism.phases=1", "run.horizon_hours=20", "sprocket.1.nodes=31"]
    nodes = [f"sprocket.{i}.nodes=31" for i in range(2, len(loaded(name).wheels) + 1)]
    found = drive_life(load_drive(PATHS[name], [*quick, *nodes, *([setting] if setting else [])]))
    assert_short(found)
    first = found.drive.driver.name
    chain = Life(1e6, 1803.456)
    lives = [Life(1e8, 33_333.33 + 1234.567 * place) for place in range(len(found.results))]
    aged = {
        part: replace(result, parts={"chain": chain, "sprocket": life}, warnings=("a doubt " * 40, "another"))
        for (part, result), life in zip(found.results.items(), lives, strict=True)
    }
    drive = DriveLife(found.drive, aged)
    lines = assert_short(drive)
    assert len(lines) == 12
    assert any(line.startswith("  Then  ") for line in lines)
    (warned,) = [line for line in lines if line.startswith("  Warnings")]
    outside = sum(not finding.ok and not finding.at_least for finding in found.results[first].ratings)
    doubted = outside + len(found.practice.warnings)
    sooner = before_wear(drive.ends, "chain") is not None
    assert warned.startswith(f"  Warnings   {2 + doubted + sooner} (--explain), the first: ")
    assert ("a doubt" in warned) == (doubted == 0)
    (ratings,) = [line for line in lines if line.startswith("  Ratings")]
    assert ("OVERLOADED: " in ratings) == bool(found.overloaded)
    if name == "bicycle-cassette":
        # 33 333.33 + 1234.567 h and so on: 34 567.9, 35 802.5, 37 037.0 up to 46 913.6 h.
        eleven = "11T fails first, at 34 570 h, then 12T at 35 800 h; 9 more, 37 040 h to 46 910 h"
        assert f"  cassette   {eleven}" in lines
    if setting is not None:
        assert re.search(r"OVERLOADED: [a-z ]+ \(indicative\) [\d ]+\.?\d* % and \d more; ", ratings)


def test_the_worst_rating_is_named_and_the_rest_are_counted() -> None:
    """Plate fatigue is the worst of two; GOST joint pressure, 216.9 %, is for other chains."""
    quick = ["run.life_tolerance=0.1", "mechanism.phases=1", "run.horizon_hours=5"]
    text = drive_text(drive_life(load_drive(PATHS["packaging-conveyor"], quick)), "drive.toml")
    worst = "plate fatigue (indicative) 165.1 % and 1 more; life counts wear only"
    assert f"  Ratings    OVERLOADED: {worst}\n" in text


def test_the_conveyor_says_that_it_is_overloaded() -> None:
    """Ratings need no run: those of the question of the drive engineer."""
    driver = loaded("packaging-conveyor").driver
    outside = {finding.name for finding in driver.drive.ratings(driver.case) if not finding.ok}
    assert {"plate fatigue", "corrected power", "joint pressure"} <= outside


def test_two_strands_share_the_pull() -> None:
    drive = loaded("escalator-duplex").driver.drive
    assert (drive.chain.designation, drive.chain.strands) == ("16B-2", 2)
    settings = ["drive.service_factor=1", "joint.law=constant"]
    single = load_drive(PATHS["escalator-duplex"], ["chain.strands=1", *settings]).driver
    twice = load_drive(PATHS["escalator-duplex"], settings).driver
    growth = [one.drive.contact(one.case).elongation_per_cycle for one in (single, twice)]
    # The pull is the same, the bearing area twice as large; a heavier chain hangs with twice the slack.
    assert growth[0] == pytest.approx(2.0 * growth[1], rel=0.06)
    plates = [
        next(finding for finding in one.drive.ratings(one.case) if finding.name == "plate fatigue").limit
        for one in (single, twice)
    ]
    assert plates[1] == pytest.approx(1.7 * plates[0], rel=1e-12)
