"""Measured data, the drives that stand in for theirs, and the assertion that makes a row of the page."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

import wearsim
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.result import WearResult

HERE = Path(__file__).parent
CASES = HERE.parents[1] / "cases"
COARSE = ("sprocket.nodes=51", "mechanism.phases=4", "run.life_tolerance=0.1")
CHAIN_ONLY = ("mechanism.phases=2", "wear.specific_wear_rate_mm2_per_N=1e-14", "stop.elongation_percent=10")
JOINT = "joint.specific_wear_rate_mm2_per_N"


@pytest.fixture(scope="session")
def data() -> Callable[[str], pd.DataFrame]:
    """Return the reader of the tables in tests/validation/data."""
    return lambda name: pd.read_csv(HERE / "data" / f"{name}.csv", comment="#")


@pytest.fixture(scope="session")
def wrap_run() -> Callable[..., WearResult]:
    """Return the run of a shipped wrap on a coarse grid, with overrides."""

    def run(case: str, *overrides: str) -> WearResult:
        return wearsim.simulate(wearsim.load_case(CASES / f"{case}.toml", [*COARSE, *overrides]))

    return run


@dataclass(frozen=True)
class Growth:
    """Elongation of a chain over the distance ridden."""

    distance: Any
    elongation: Any

    def at(self, distance: Any) -> Any:
        return np.interp(distance, self.distance, self.elongation)

    @property
    def rate(self) -> float:
        """Percent in 1000 km."""
        return float(1e5 * self.elongation[-1] / self.distance[-1])


@pytest.fixture(scope="session")
def grown(wrap_run: Callable[..., WearResult]) -> Callable[..., Growth]:
    """Return the growth of the bicycle's chain with a coefficient of its joints, up to a distance.

    The teeth hardly wear in it.
    """

    def run(coefficient: float, until_km: float, *overrides: str, speed: float = 33.0) -> Growth:
        result = wrap_run(
            "bicycle-17t-road",
            *CHAIN_ONLY,
            f"{JOINT}={float(coefficient)!r}",
            f"run.horizon_hours={until_km / speed!r}",
            *overrides,
        )
        history = result.history_columns
        return Growth(speed * history["time_hours"], 0.01 * history["elongation_percent"])

    return run


@pytest.fixture(scope="session")
def span() -> Callable[..., float]:
    """Return the length over pitches of the bicycle's chain, its first link given, from pin to pin."""

    def length(pitches: int, elongation: float, first: str = "inner", pattern: str = "alternating") -> float:
        case = wearsim.load_case(CASES / "bicycle-17t-road.toml", [f"joint.pitch={pattern}"])
        assert isinstance(case.drive, WrapDrive)
        inner, outer = case.drive.rollers.chain.pitches(elongation)
        more, less = (pitches + 1) // 2, pitches // 2
        inners = more if first == "inner" else less
        return inners * inner + (pitches - inners) * outer

    return length


@dataclass(frozen=True)
class Commuter:
    """What the first 3250 km of the commuter's chains give."""

    new_reading: float
    per_1000_km: float
    coefficient: float


@pytest.fixture(scope="session")
def commuter(
    data: Callable[[str], pd.DataFrame], grown: Callable[..., Growth], span: Callable[..., float]
) -> Commuter:
    """Return one first length and one coefficient for two chains, by a straight line through both.

    Life times coefficient is constant, so a run with any coefficient gives the one that fits.
    """
    read = data("commuter_chains")
    early = read[read.chain.isin(["Shimano", "KMC"]) & (read.distance_km <= 3250)]
    slope, new = np.polyfit(early.distance_km, early.reading_mm, 1)
    trial = 1e-8
    after = grown(trial, 3250.0).at(3250.0)
    coefficient = trial * slope * 3250.0 / (span(11, after) - span(11, 0.0))
    return Commuter(float(new), float(1e3 * slope), float(coefficient))


def limits(kind: str, size: Any, measured: Any) -> tuple[float, float]:
    """Return the least and the most that a prediction may be."""
    match kind:
        case "percent":
            return measured * (1.0 - 0.01 * size), measured * (1.0 + 0.01 * size)
        case "within":
            return measured - size, measured + size
        case "factor":
            return measured / size, measured * size
        case "range" | "found":
            return size
        case "below":
            return -math.inf, size
        case "above":
            return size, math.inf
        case _:
            raise ValueError(kind)


@pytest.fixture
def measured(request: pytest.FixtureRequest) -> Callable[..., None]:
    """Return the assertion that a prediction keeps or misses what was allowed, as is stated.

    A row of the page is made of it. Stated is ``"passed"`` or ``"failed"``: either way the test
    fails as soon as the verdict is another one. ``allowed`` is a kind of `limits` with its size;
    all are of the prediction but ``"found"``, of the reading.
    """

    def check(
        quantity: str,
        predicted: float,
        reading: float | str,
        allowed: tuple[str, Any],
        verdict: str,
        *,
        unit: str = "",
        scatter: str = "not stated",
        digits: int = 3,
    ) -> None:
        kind, size = allowed
        low, high = limits(kind, size, reading)
        judged = reading if kind == "found" else predicted
        found = "passed" if low <= judged <= high else "failed"
        if found != verdict:
            pytest.fail(
                f"{quantity}: {found}, the page states {verdict}: predicted {predicted:.6g} {unit}, "
                f"measured {reading}, allowed {low:.6g} to {high:.6g}"
            )
        # Plain numbers: workers hand rows over as text.
        shown = reading if isinstance(reading, str) else float(reading)
        row = {"quantity": quantity, "predicted": float(predicted), "reading": shown}
        row |= {"kind": kind, "size": np.asarray(size, float).tolist(), "verdict": verdict}
        row |= {"unit": unit, "scatter": scatter, "digits": digits}
        if request.config.getoption("measured_page"):
            request.node.user_properties.append(("measured", row))

    return check


@pytest.fixture(scope="session")
def even_contact(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., wearsim.Case]:
    """Return a case of a contact that is the same all over a flat, from columns of a table."""

    def case(
        columns: dict[str, float],
        wear: dict[str, Any],
        depth: float,
        horizon_cycles: float,
        roller_radius: float = 5.0,
    ) -> wearsim.Case:
        table = pd.DataFrame({"arc_length_mm": np.linspace(0.0, 1.0, 11)})
        table = table.assign(flank_curvature_per_mm=0.0).assign(**columns)
        file = tmp_path_factory.mktemp("contact") / "contact.csv"
        table.to_csv(file, index=False)
        return wearsim.load_case(
            {
                "format_version": 1,
                "chain": {
                    "pitch_mm": 100.0,
                    "roller_diameter_mm": 2.0 * roller_radius,
                    "inner_width_mm": 10.0,
                },
                "mechanism": {"kind": "prescribed", "table_file": str(file)},
                "load": {"speed_rpm": 100},
                "wear": wear,
                "stop": {"critical_depth_mm": depth},
                "run": {"horizon_hours": horizon_cycles / 6000.0},
            }
        )

    return case


@pytest.fixture(scope="session")
def wet_factor(data: Callable[[str], pd.DataFrame], commuter: Commuter) -> float:
    """Return by how much faster the third chain grew on its first rainy stretch."""
    read = data("commuter_chains")
    wet = read[(read.chain == "Miche") & read.distance_km.isin([2350, 2850])]
    growth = wet.reading_mm.max() - wet.reading_mm.min()
    return float(1e3 * growth / 500.0 / commuter.per_1000_km)
