"""Lives of many cases at once.

Expected: what `simulate` finds for each case alone, to the bit.
"""

import re
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim
from wearsim.drive import batch_lives as many
from wearsim.drive.batch_lives import CaseLife
from wearsim.drive.simulate import simulate_many
from wearsim.errors import WearsimError

CaseMaker = Callable[..., wearsim.Case]

STRAND: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.5, "nodes": 61},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"law": "archard", "specific_wear_rate_mm2_per_N": 5e-11},
    "stop": {"critical_depth_mm": 0.1},
}


def strand(*settings: str) -> wearsim.Case:
    return wearsim.load_case(STRAND, settings)


def power(exponent: float) -> wearsim.Case:
    law = {"law": "power", "coefficient": 5e-11 / 800.0 ** (exponent - 1.0)}
    tables = {**STRAND, "wear": law}
    return wearsim.load_case(tables, [f"wear.pressure_exponent={exponent}"])


@pytest.fixture
def table(tmp_path: Path) -> CaseMaker:
    """Return a table of loads on 41 rows as a case, with slip as a path or as a ratio."""

    def case(slip: str, curvature: float, ripple: float) -> wearsim.Case:
        file = tmp_path / f"{slip}.csv"
        arc = np.linspace(0.0, 4.0, 41)
        columns = (
            arc,
            50.0 + 0.0 * arc,
            curvature + 0.0 * arc,
            0.5 * (1.0 + ripple * np.cos(0.5 * np.pi * arc)),
        )
        rows = [",".join(repr(float(value)) for value in row) for row in zip(*columns, strict=True)]
        head = f"arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,{slip}"
        file.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
        return wearsim.load_case(
            {
                "format_version": 1,
                "chain": {"pitch_mm": 25.4, "roller_diameter_mm": 10.0, "inner_width_mm": 17.0},
                "mechanism": {"kind": "prescribed", "table_file": str(file)},
                "load": {"speed_rpm": 100},
                "wear": {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-9},
                "stop": {"critical_depth_mm": 0.05},
                "run": {"horizon_hours": 1e9},
            }
        )

    return case


def same(found: CaseLife | WearsimError, case: wearsim.Case) -> bool:
    alone = wearsim.simulate(case)
    assert isinstance(found, CaseLife)
    assert (found.case, found.life, found.stop) == (alone.case, alone.life, alone.stop)
    if isinstance(alone.life, wearsim.Life):
        assert found.numerical_error == pytest.approx(alone.numerical_error, rel=1e-6)
    return True


@pytest.mark.wide
@pytest.mark.parametrize("threads", [1, 2])
def test_lives_are_those_of_the_cases_alone(table: CaseMaker, threads: int) -> None:
    cases = [
        strand(),
        table("sliding_distance_mm", 0.025, -0.5),
        strand("load.tension_N=7000"),
        power(2.0),
        strand("wear.running_in_factor=3", "wear.running_in_distance_mm=5000"),
        strand("wear.case_depth_mm=0.03", "wear.core_factor=5"),
        strand("sprocket.nodes=81", "run.life_tolerance=1e-4"),
        strand("stop.critical_depth_mm=0.02"),
    ]
    found = list(simulate_many(cases, threads))
    assert all(same(one, case) for one, case in zip(found, cases, strict=True))


def test_what_cannot_be_batched_runs_alone() -> None:
    cases = [
        strand("stop.min_tip_land_mm=1.0"),
        strand("run.method=per_cycle", "run.cycles_per_update=500", "stop.critical_depth_mm=0.01"),
        strand(),
    ]
    found = list(simulate_many(cases))
    assert all(same(one, case) for one, case in zip(found, cases, strict=True))


def test_horizon_gives_a_lower_bound() -> None:
    """The same wear runs once, to the longest of the horizons; each case ends at its own."""
    cases = [strand(f"run.horizon_hours={hours}") for hours in (1.0, 1e5, 300.0)]
    found = list(simulate_many(cases))
    assert all(same(one, case) for one, case in zip(found, cases, strict=True))
    kinds = [type(one.life) for one in found if isinstance(one, CaseLife)]
    assert kinds == [wearsim.LowerBound, wearsim.Life, wearsim.LowerBound]


def test_coefficients_scale_the_life_without_another_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only the coefficient may scale; another tension is another run."""
    runs: list[int] = []
    advance_batch = many.advance_batch

    def counted(problems: Any, tolerances: Any) -> Any:
        runs.append(len(problems))
        return advance_batch(problems, tolerances)

    monkeypatch.setattr(many, "advance_batch", counted)
    rates = [f"wear.specific_wear_rate_mm2_per_N={5e-11 * factor!r}" for factor in (1.0, 2.0, 7.0)]
    cases = [strand(rate, "run.horizon_hours=1e6") for rate in rates]
    found = list(simulate_many([*cases, strand(rates[1], "load.tension_N=5001")], 1))
    made = sum(runs)
    runs.clear()
    list(simulate_many([cases[0], strand("load.tension_N=5001")], 1))
    assert made == sum(runs) > 0
    lives = [one.life.cycles for one in found if isinstance(one, CaseLife)]
    assert lives[1] == pytest.approx(lives[0] / 2.0, rel=1e-15)
    assert lives[2] == pytest.approx(lives[0] / 7.0, rel=1e-15)
    assert all(same(one, case) for one, case in zip(found, cases, strict=False))


def test_wide_contact_on_the_way_is_warned_of() -> None:
    """A flank of 12B conforms most in mid-life: 0.637 mm, 0.451 at the start and 0.543 in the end."""
    chain, contact = "chain.designation=12B-1", ["contact_start_mm=23.5", "contact_end_mm=3.5"]
    sprocket = ["teeth=24", "evolute_offset_mm=4", "face_width_mm=11", "nodes=201", *contact]
    load = ["load.tension_N=2500", "load.speed_rpm=90", "stop.critical_depth_mm=0.15"]
    case = strand(chain, *(f"sprocket.{text}" for text in sprocket), *load)
    [found] = simulate_many([case])
    assert isinstance(found, CaseLife)
    widths = [
        re.findall(r"half-width up to ([\d.]+) mm", str(one))
        for one in (found.warnings, wearsim.simulate(case).warnings)
    ]
    assert [len(one) for one in widths] == [1, 1]
    assert float(widths[0][0]) == pytest.approx(float(widths[1][0]), rel=0.005)


def test_error_of_a_case_takes_its_place(table: CaseMaker) -> None:
    """A given slip ratio digs at m = 1 whatever the curvature, until the flank conforms."""
    conforming = table("slip_ratio", -0.19, 0.5)
    with pytest.raises(WearsimError, match="conforms") as alone:
        wearsim.simulate(conforming)
    found = list(simulate_many([strand(), conforming, strand("load.tension_N=6000")]))
    assert isinstance(found[1], WearsimError)
    assert str(found[1]) == str(alone.value)
    assert isinstance(found[0], CaseLife) and isinstance(found[2], CaseLife)


def test_warnings_of_the_worn_flank_are_kept() -> None:
    wide = strand("load.tension_N=50000", "sprocket.face_width_mm=7")
    worn = strand("stop.critical_depth_mm=0.5")
    quick = strand("wear.specific_wear_rate_mm2_per_N=1e-4")
    found = list(simulate_many([wide, worn, quick]))
    for one, text in zip(found, ("0.1 of the radius", "in the end, below 1", "only"), strict=True):
        assert isinstance(one, CaseLife)
        assert any(text in warning for warning in one.warnings)


def test_cases_are_taken_as_they_are_needed() -> None:
    taken = 0

    def cases() -> Iterator[wearsim.Case]:
        nonlocal taken
        case = strand("sprocket.nodes=21")
        while True:
            taken += 1
            yield case

    lives = simulate_many(cases(), 1)
    for _ in range(10):
        assert isinstance(next(lives), CaseLife)
    assert taken < 300
    lives.close()  # type: ignore[attr-defined]


def test_lives_that_nobody_takes_to_their_end_wait_for_no_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    """The garbage collector may finalise them where a join never ends."""
    case = wearsim.load_case("16b-20t-oiled")
    lives = wearsim.simulate_many([case] * 3, threads=2)
    next(lives)
    joined: list[threading.Thread] = []
    monkeypatch.setattr(threading.Thread, "join", lambda self, timeout=None: joined.append(self))
    lives.close()  # type: ignore[attr-defined]
    assert joined == []
