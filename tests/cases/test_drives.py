"""Shipped whole drives: each is complete, says what practice reports, and gives every part a life."""

import re
from functools import cache
from pathlib import Path

import pytest

from wearsim.result import Life
from wearsim.study.whole_drive.keys import DriveCase, load_drive
from wearsim.study.whole_drive.model import DriveLife, drive_life
from wearsim.study.whole_drive.sheet import drive_text

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
    text = drive_text(found, str(PATHS[name]))
    assert text.splitlines()[0] == found.drive.title
    assert "First" in text


def test_the_conveyor_says_that_it_is_overloaded() -> None:
    """Ratings need no run: those of the question of the drive engineer."""
    driver = loaded("packaging-conveyor").driver
    outside = {finding.name for finding in driver.drive.ratings(driver.case) if not finding.ok}
    assert {"plate fatigue", "corrected power", "joint pressure"} <= outside


def test_two_strands_share_the_pull() -> None:
    drive = loaded("escalator-duplex").driver.drive
    assert (drive.chain.designation, drive.chain.strands) == ("16B-2", 2)
    single = load_drive(PATHS["escalator-duplex"], ["chain.strands=1", "drive.service_factor=1"]).driver
    twice = load_drive(PATHS["escalator-duplex"], ["drive.service_factor=1"]).driver
    growth = [one.drive.contact(one.case).elongation_per_cycle for one in (single, twice)]
    # The pull is the same, the bearing area twice as large; a heavier chain hangs with twice the slack.
    assert growth[0] == pytest.approx(2.0 * growth[1], rel=0.06)
    plates = [
        next(finding for finding in one.drive.ratings(one.case) if finding.name == "plate fatigue").limit
        for one in (single, twice)
    ]
    assert plates[1] == pytest.approx(1.7 * plates[0], rel=1e-12)
