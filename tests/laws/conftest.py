"""The measured sets in one form, and the assertion that makes a part of docs/laws.md."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from wearsim.study.judge.model import Judgement, judge_series
from wearsim.study.judge.wear_series import WearReading, WearSeries, wear_series

DATA = Path(__file__).parents[1] / "validation" / "data"


def table(name: str) -> pd.DataFrame:
    return pd.read_csv(DATA / f"{name}.csv", comment="#")


def metal() -> tuple[list[WearReading], str, str]:
    rows = table("metal_wear").itertuples()
    return [WearReading(str(r.specimen), r.cycles, r.wear_um, load=r.load_g) for r in rows], "cycles", "um"


def commuter() -> tuple[list[WearReading], str, str]:
    """Growth of the gap since the length that a straight line through two chains up to 3250 km begins at."""
    read = table("commuter_chains")
    early = read[(read.chain != "Miche") & (read.distance_km <= 3250)]
    new = float(np.polyfit(early.distance_km, early.reading_mm, 1)[1])
    wet = read.remark.str.contains("rain", na=False)
    rows = read.assign(environment=np.where(wet, "rain", "mixed")).itertuples()
    readings = [
        WearReading(r.chain, r.distance_km, r.reading_mm - new, error=0.1, environment=r.environment)
        for r in rows
    ]
    return readings, "km", "mm"


def single_chains() -> tuple[list[WearReading], str, str]:
    """End points, each at the middle of its range of distances."""
    rows = table("chain_lives").itertuples()
    found = [WearReading(r.chain, float(np.sqrt(r.low_km * r.high_km)), r.elongation_percent) for r in rows]
    return found, "km", "%"


def pins() -> tuple[list[WearReading], str, str]:
    rows = table("pin_on_disc")
    found = [
        WearReading(f"{r.material} {r.load_N:.0f} N {r.test}", r.distance_m, r.depth_um, load=r.load_N)
        for r in rows[rows.material != "PPS_45PTFE"].itertuples()
    ]
    return found, "m", "um"


def composite() -> tuple[list[WearReading], str, str]:
    found = [
        WearReading(f"{r.nanotubes_percent} % {r.load_N} N", r.distance_m, 1e3 * r.loss_g, load=r.load_N)
        for r in table("carbon_fibre_plastic").itertuples()
    ]
    return found, "m", "mg"


def twin_disc() -> tuple[list[WearReading], str, str]:
    """Wear in a metre rolled, a series for each slip."""
    rows = table("twin_disc").itertuples()
    found = [
        WearReading(
            f"{r.slip_percent} %",
            1.0,
            float(np.where(r.x_N_per_mm2 < 10.4, 5.3 * r.x_N_per_mm2, 55.0)),
            slip=0.01 * r.slip_percent,
            t_gamma=r.x_N_per_mm2,
        )
        for r in rows
    ]
    return found, "m", "ug/mm2"


SETS = {
    "metal": metal,
    "commuter": commuter,
    "single_chains": single_chains,
    "pins": pins,
    "composite": composite,
    "twin_disc": twin_disc,
}


@pytest.fixture(scope="session")
def series_of() -> Callable[..., WearSeries]:
    """Return a set with some of its readings, some held out."""

    def series(name: str, held_out, used=lambda one: True) -> WearSeries:
        from dataclasses import replace

        readings, exposure, wear = SETS[name]()
        kept = [replace(one, held_out=held_out(one)) for one in readings if used(one)]
        return wear_series(kept, exposure, wear)

    return series


@pytest.fixture
def judged(request: pytest.FixtureRequest) -> Callable[..., Judgement]:
    """Return the court on a set: the preferred law and the verdict are as stated, some laws are not tied.

    A table of the page is made of it.
    """

    def check(split: str, data: WearSeries, take: str, good: bool, behind: tuple[str, ...] = ()) -> Judgement:
        found = judge_series(data, 3000 if data.wear.size < 20 else 400)
        assert found.simplest.law == take, found.ties
        assert not set(behind) & set(found.ties), (found.ties, behind)
        assert (not found.objections) == good, found.objections
        if request.config.getoption("laws_page"):
            row = {
                "split": split,
                "take": take,
                "good": good,
                "ties": list(found.ties),
                "objections": list(found.objections),
                "laws": [
                    {
                        "law": one.law,
                        "scatter": one.scatter,
                        "behind": one.behind,
                        "behind_error": one.behind_error,
                        "coverage_50": one.coverage_50,
                        "coverage_90": one.coverage_90,
                        "median_error": one.median_error,
                        "tied": one.tied,
                        "constants": [
                            [c.name, c.low, c.middle, c.high] for c in (*one.constants, *one.deviations)
                        ],
                    }
                    for one in found.laws
                ],
            }
            request.node.user_properties.append(("judged", row))
        return found

    return check
