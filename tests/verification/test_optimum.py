"""Optima that are known: by the scaling laws of a strand, and by scans of plain runs.

On a strand under Archard's law life and mass go with the face width b, L = L0 b/b0 and
m = m0 b/b0, and the peak pressure with its root, p = p0 (b0/b)^(1/2) (physics.md). So the
lightest sprocket that lives for L* has b = b0 L*/L0, and one that keeps to p* has
b = b0 (p0/p*)^2. Where the flank changes too, L0 and m0 of a flank come from one plain run.
"""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
import tomlkit
from scipy.optimize import minimize_scalar

import wearsim
from wearsim.drive.part_life import new_peak_pressure
from wearsim.geometry.outline import rotated
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.result import Life
from wearsim.runner.run_study import run_study
from wearsim.runner.workers import Threads
from wearsim.study.optimise.model import OptimiseStudy, blank_mass, load_optimise
from wearsim.study.optimise.search import search
from wearsim.study.optimise.trials import Candidate, Trials, front

pytestmark = pytest.mark.wide

WIDTH = 17.0
CASE: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {
        "teeth": 20,
        "profile": "evolute",
        "evolute_offset_mm": 5.6,
        "contact_start_mm": 30.67,
        "contact_end_mm": 4.0,
        "face_width_mm": WIDTH,
        "nodes": 41,
    },
    "load": {"tension_N": 5000.0, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
    "stop": {"critical_depth_mm": 0.2},
    "run": {"life_tolerance": 0.1},
}
OFFSET, FACE, START = (f"sprocket.{name}_mm" for name in ("evolute_offset", "face_width", "contact_start"))
Searched = Callable[..., tuple[OptimiseStudy, list[Candidate]]]


@pytest.fixture
def searched(tmp_path: Path) -> Searched:
    """Return a function that searches CASE and gives the best designs."""

    def run(
        objectives: list[str],
        parameters: dict[str, Any],
        limits: dict[str, Any],
        evaluations: int,
        stop: dict[str, float] | None = None,
    ) -> tuple[OptimiseStudy, list[Candidate]]:
        table = {"objectives": objectives, "parameters": parameters, "limits": limits}
        path = tmp_path / "case.toml"
        path.write_text(tomlkit.dumps({**CASE, "stop": stop or CASE["stop"], "optimise": table}))
        study = load_optimise(path, [], evaluations, seed=1)
        trials = Trials(study, lambda cases: run_study(cases, Threads(1)))
        search(study, trials)
        assert len(trials.found) <= evaluations
        return study, front(list(trials.found.values()), study.objectives)

    return run


def case_of(stop: dict[str, float] | None = None, **sprocket: object) -> wearsim.Case:
    tables = {**CASE, "sprocket": {**CASE["sprocket"], **sprocket}, "stop": stop or CASE["stop"]}
    return wearsim.load_case(tables)


def life_of(case: wearsim.Case) -> float:
    life = wearsim.simulate(case).life
    assert isinstance(life, Life)
    return life.hours


def test_lightest_sprocket_of_a_life(searched: Searched) -> None:
    case = case_of()
    required, hours = 2000.0, life_of(case)
    limits = {"life_hours": {"low": required}}
    _, (best,) = searched(["mass_kg"], {FACE: {"low": 5.0, "high": 17.0}}, limits, 60)
    exact = WIDTH * required / hours
    assert best.values[0] == pytest.approx(exact, rel=2e-3)
    assert best.measures["mass_kg"] == pytest.approx(blank_mass(case) * exact / WIDTH, rel=2e-3)
    assert best.measures["life_hours"] >= required


def test_lightest_sprocket_of_a_peak_pressure(searched: Searched) -> None:
    case = case_of()
    pressure = wearsim.simulate(case).initial_peak_pressure
    allowed = 1.2 * pressure
    limits = {"peak_pressure_MPa": {"high": allowed}}
    _, (best,) = searched(["mass_kg"], {FACE: {"low": 5.0, "high": 17.0}}, limits, 60)
    assert best.values[0] == pytest.approx(WIDTH / 1.2**2, rel=2e-3)
    assert best.measures["peak_pressure_MPa"] == pytest.approx(allowed, rel=1e-3)


def test_least_pressure_of_a_mass(searched: Searched) -> None:
    """The other way round: the widest tooth that the mass allows, p = p0 (m0/m*)^(1/2)."""
    case = case_of()
    mass = blank_mass(case)
    limits = {"mass_kg": {"high": 0.6 * mass}}
    parameters = {FACE: {"low": 5.0, "high": 17.0}}
    _, (best,) = searched(["peak_pressure_MPa"], parameters, limits, 60)
    exact = wearsim.simulate(case).initial_peak_pressure / 0.6**0.5
    assert best.measures["peak_pressure_MPa"] == pytest.approx(exact, rel=1e-3)


def test_longest_life_between_two_limits_of_wear(searched: Searched) -> None:
    """A longer flank wears deeper but leaves more tip: the optimum is a kink between both limits.

    Against a bounded search by Brent's method over plain runs, which knows no study.
    """
    stop = {"critical_depth_mm": 0.2, "min_tip_land_mm": 8.5}
    low, high = 29.6, 30.9
    exact = minimize_scalar(
        lambda start: -life_of(case_of(stop, contact_start_mm=start)),
        bounds=(low, high),
        method="bounded",
        options={"xatol": 1e-4},
    )
    assert low + 0.1 < exact.x < high - 0.1
    _, (best,) = searched(["life_hours"], {START: {"low": low, "high": high}}, {}, 45, stop)
    assert best.measures["life_hours"] == pytest.approx(-exact.fun, rel=2e-3)
    assert best.measures["life_hours"] <= -exact.fun * 1.002
    assert best.values[0] == pytest.approx(exact.x, abs=0.01 * (high - low))


def test_two_parameters_against_a_scan(searched: Searched) -> None:
    """Width and offset of the lightest sprocket of a life: m* = L* min over h of m0(h)/L0(h)."""
    required = 2000.0
    offsets = np.linspace(5.4, 6.4, 11)
    found = []
    for offset in offsets:
        case = case_of(evolute_offset_mm=offset)
        found.append(required * blank_mass(case) / life_of(case))
    parameters = {OFFSET: {"low": 5.4, "high": 6.4}, FACE: {"low": 5.0, "high": 17.0}}
    _, (best,) = searched(["mass_kg"], parameters, {"life_hours": {"low": required}}, 120)
    assert best.measures["mass_kg"] == pytest.approx(min(found), rel=0.01)
    assert best.values[0] == pytest.approx(offsets[int(np.argmin(found))], abs=0.1)


def test_front_against_a_grid(searched: Searched) -> None:
    """No design of the front is worse than one of a grid by more than 1 % in both objectives.

    The front must also span the grid.
    """
    pytest.importorskip("optuna", reason="optuna is not installed")
    grid = []
    for offset in np.linspace(5.4, 6.4, 11):
        case = case_of(evolute_offset_mm=offset)
        hours, mass = life_of(case), blank_mass(case)
        grid += [(hours * b / WIDTH, mass * b / WIDTH) for b in np.linspace(8.0, 17.0, 19)]
    parameters = {OFFSET: {"low": 5.4, "high": 6.4}, FACE: {"low": 8.0, "high": 17.0}}
    _, best = searched(["life_hours", "mass_kg"], parameters, {}, 300)
    lives, masses = np.array(grid).T
    for one in best:
        life, mass = one.measures["life_hours"], one.measures["mass_kg"]
        assert not ((lives > 1.01 * life) & (masses < mass / 1.01)).any()
        assert not ((lives >= life) & (masses < mass / 1.01)).any()
    found = np.array([[one.measures[name] for name in ("life_hours", "mass_kg")] for one in best])
    assert found[:, 0].max() == pytest.approx(lives.max(), rel=0.01)
    assert found[:, 1].min() == pytest.approx(masses.min(), rel=0.01)
    assert len(best) > 20
    # Life and mass of the best offset both go with the width: the exact front is a ray.
    excess = found[:, 1] / (found[:, 0] * (masses / lives).min()) - 1.0
    assert excess.max() < 0.01
    assert np.quantile(excess, 0.9) < 1e-3


def test_pressure_and_mass_are_those_of_the_case() -> None:
    """Pressure to the bit that of a run; mass by the polygon of the wheel, and of other materials."""
    case = case_of()
    assert new_peak_pressure(case) == wearsim.simulate(case).initial_peak_pressure
    mirrored = case_of(back_flank="mirrored")
    assert isinstance(mirrored.drive, StrandDrive)
    tooth, radius = mirrored.drive.tooth, mirrored.drive.tooth.tip_radius
    gaps = [rotated(tooth.gap, -n * math.tau / tooth.teeth) for n in range(tooth.teeth)]
    tip = tooth.tip_land / radius
    over_chords = 0.5 * tooth.teeth * radius**2 * (tip - math.sin(tip))
    plate = 7850e-9 * WIDTH * (shapely.Polygon(np.concatenate(gaps)).area + over_chords)
    assert blank_mass(mirrored) == pytest.approx(plate, rel=1e-4)
    cast = wearsim.load_case({**CASE, "material": {"sprocket": {"name": "grey cast iron"}}})
    assert blank_mass(cast) == pytest.approx(blank_mass(case) * 7200.0 / 7850.0)
