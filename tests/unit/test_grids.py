"""On which points a life is found: the search that single cases and batches share."""

from dataclasses import dataclass
from typing import Any

import pytest

from wearsim.drive.flank_grids import GridSearch, SettledLife, settle_grid
from wearsim.wear.accuracy import SAFETY


@dataclass(frozen=True)
class Points:
    """Stands for a flank: its name and the spacing at its ends."""

    name: str
    spacing: float

    @property
    def profile(self) -> Any:
        return self

    @property
    def x(self) -> Any:
        class Counted:
            size = round(10.0 / self.spacing)

        return Counted


@dataclass(frozen=True)
class Flank:
    """Stands for a mechanism with two other grids and two refinements."""

    contact: Points = Points("own", 1.0)
    levels: int = 2

    def other_grids(self) -> tuple[Points, ...]:
        return Points("half", 2.0), Points("fine ends", 0.2)

    def refined(self, level: int) -> "Flank | None":
        return Flank(Points(f"level {level}", 0.2 / 2**level)) if level <= self.levels else None


@dataclass(frozen=True)
class Run:
    spacing: float
    life: float
    own_error: float = 0.0

    def change(self, other: "Run") -> float:
        return abs(other.life / self.life - 1.0)


def settled(
    lives: dict[str, float], tolerance: float, levels: int = 2, flank: Flank | None = None
) -> tuple[SettledLife, list[str]]:
    """Serve a search with lives by the name of the flank; one that is left out has none."""
    search: GridSearch = settle_grid(flank or Flank(), tolerance, levels)  # type: ignore[arg-type]
    requested: list[str] = []
    contacts: Any = next(search)
    while True:
        requested += [contact.name for contact in contacts]
        runs = [
            Run(contact.spacing, lives[contact.name]) if contact.name in lives else None
            for contact in contacts
        ]
        try:
            contacts = search.send(runs)
        except StopIteration as end:
            return end.value, requested


LIVES = {"own": 1.02, "half": 1.04, "fine ends": 1.004, "level 1": 1.002, "level 2": 1.001}
"""Lives of 1 + 0.02 h."""

SPACINGS = (("own", 1.0), ("half", 2.0), ("fine ends", 0.2))


def test_points_that_are_good_enough_stay() -> None:
    found, requested = settled(LIVES, 0.06)
    assert requested == ["own", "half", "fine ends"]
    assert found.error == pytest.approx(SAFETY * 2 * 0.02 / 1.02, rel=1e-9)
    assert found.assumptions() == () and found.warnings(0.06) == []


def test_flank_is_refined_until_the_tolerance_holds() -> None:
    found, requested = settled(LIVES, 0.02)
    assert requested == ["own", "half", "fine ends", "level 1"]
    assert found.run.life == 1.002 and 0.002 < found.error <= 0.02
    assert "100, chosen for the tolerance; with the 10 of the case" in found.assumptions()[0]
    assert found.warnings(0.02) == []


def test_what_refining_does_not_reach_is_a_warning() -> None:
    found, requested = settled(LIVES, 1e-4)
    assert requested[-1] == "level 2" and found.run.life == 1.001
    assert found.warnings(1e-4)[0].endswith(
        "exceeds the tolerance 0.0001, even with the flank refined to 200 points: use more nodes, or a "
        "larger run.life_tolerance"
    )


def test_a_refined_flank_without_a_life_leaves_the_one_before() -> None:
    lives = {name: life for name, life in LIVES.items() if name != "level 2"}
    found, _ = settled(lives, 1e-4)
    assert found.run.life == 1.002


def test_a_refined_flank_without_a_life_is_passed_over() -> None:
    lives = {name: life for name, life in LIVES.items() if name != "level 1"}
    found, requested = settled(lives, 1e-4)
    assert requested[-2:] == ["level 1", "level 2"] and found.run.life == 1.001
    assert found.level == 2 and found.error == pytest.approx(
        1.75 * SAFETY * sum(abs(LIVES[name] / 1.001 - 1.0) * 0.05 / (h - 0.05) for name, h in SPACINGS),
        rel=1e-9,
    )


def test_the_other_grids_that_have_a_life_count_twice() -> None:
    found, _ = settled({"own": 1.02, "half": 1.04}, 0.06)
    assert found.error == pytest.approx(2.0 * SAFETY * 0.02 / 1.02, rel=1e-9)


def test_without_another_life_the_error_is_unknown() -> None:
    found, requested = settled({"own": 1.02}, 0.06)
    assert found.error == 1.0 and requested == ["own", "half", "fine ends"]
    assert "100 % is stated" in found.warnings(0.06)[0]


@pytest.mark.parametrize(("levels", "flank"), [(0, Flank()), (2, Flank(levels=0))])
def test_what_may_not_be_refined_is_not(levels: int, flank: Flank) -> None:
    found, requested = settled(LIVES, 1e-4, levels, flank)
    assert len(requested) == 3 and found.run.life == 1.02
    assert "use more points (nodes, or rows of the table of loads)" in found.warnings(1e-4)[0]
