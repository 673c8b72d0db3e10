"""A program as a user writes it, for mypy in its strict mode and for a test that runs it."""

from collections.abc import Mapping
from typing import Any, assert_type

import pandas as pd
from matplotlib.figure import Figure

import wearsim

TABLES: Mapping[str, Any] = {
    "format_version": 1,
    "title": "Hoist",
    "chain": {"designation": "10B-1"},
    "sprocket": {"teeth": 21, "profile": "iso606", "nodes": 61},
    "drive": {"mate_teeth": 42, "links": 110},
    "mechanism": {"phases": 2},
    "load": {"power_kW": 1.5, "speed_rpm": 150},
    "joint": {"specific_wear_rate_mm2_per_N": 1e-8},
    "wear": {"specific_wear_rate_mm2_per_N": 5e-9},
    "run": {"life_tolerance": 0.1},
}


def main() -> None:
    """Use every public function once."""
    case = assert_type(wearsim.load_case(TABLES), wearsim.Case | wearsim.DriveCase)
    case = assert_type(case.with_({"load.tension_N": "900 N"}), wearsim.Case | wearsim.DriveCase)
    drive = assert_type(wearsim.select(power=2, rpm=150, ratio=2, hours=5000).case(), wearsim.DriveCase)
    drive = assert_type(drive.with_({"mechanism.phases": 2, "run.life_tolerance": 0.1}), wearsim.DriveCase)

    assert case.load.speed_rpm == 150
    assert [one.teeth for one in drive.sprocket] == [
        one.case.tables.sprocket.teeth for one in drive.sprockets if one.case.tables.sprocket
    ]

    with wearsim.progress_bar("wearing") as progress:
        result = assert_type(wearsim.simulate(case, progress), wearsim.WearResult | wearsim.DriveLife)
    assert_type(result.history, pd.DataFrame)
    assert_type(result.plot(), Figure)
    life = result.life
    if isinstance(life, wearsim.Life):
        assert_type(life.hours, float)
    else:
        assert_type(life, wearsim.LowerBound)

    check = assert_type(wearsim.check(drive), wearsim.CheckResult)
    assert_type(check.ratings, pd.DataFrame)
    loads = assert_type(wearsim.loads(drive, worst=True), wearsim.LoadsResult)
    assert_type(loads.teeth, pd.DataFrame)
    assert_type(loads.plot(), Figure)
    strand = wearsim.load_case("16b-20t-oiled")
    sweep = assert_type(wearsim.sweep(strand, {"load.speed_rpm": (100, 200)}), wearsim.SweepResult)
    assert_type(sweep.cases, pd.DataFrame)
    assert_type(sweep.pictures(), dict[str, Figure])
    law = {"load.tension_N": {"distribution": "normal", "standard_deviation": 50.0}}
    sure = assert_type(wearsim.uncertainty(strand, law, samples=4), wearsim.UncertaintyResult)
    assert_type(sure.percentiles, pd.DataFrame)
    ageing = case.with_({"lubrication.lasts_hours": 100, "lubrication.dry_factor": 4})
    often = assert_type(wearsim.lubricate(ageing), wearsim.LubricationResult)
    assert_type(often.intervals, pd.DataFrame)
    wears = [{"series": "pin", "cycles": n, "wear_um": 2.0 * n} for n in range(1, 7)]
    judged = assert_type(wearsim.judge(wears, particles=100), wearsim.JudgementResult)
    assert_type(judged.laws, pd.DataFrame)
    plan = assert_type(wearsim.maintain(case, {"replace_at_percent": [3]}), wearsim.MaintenanceResult)
    assert_type(plan.policies, pd.DataFrame)
    left = assert_type(wearsim.remaining(case, 1000, elongation_percent=1), wearsim.RemainingResult)
    rows = [{"time_hours": 100, "quantity": "elongation_percent", "value": 0.5}]
    assert_type(wearsim.remaining(case, readings=rows), wearsim.ChainReadingsResult)
    assert_type(left.remaining, wearsim.Life | wearsim.LowerBound)
    wheel = assert_type(wearsim.export(result, state="new"), wearsim.ExportResult)
    assert_type(wheel.content("svg"), bytes)
    width = {"sprocket.face_width_mm": {"low": 6.0, "high": 8.0}}
    best = assert_type(wearsim.optimise(strand, width, evaluations=10, threads=1), wearsim.OptimiseResult)
    assert_type(best.cases, list[wearsim.Case | wearsim.DriveCase])


def calibrated(case: wearsim.Case | wearsim.DriveCase, readings: pd.DataFrame) -> pd.DataFrame:
    """Return the hours that are left, which needs an extra to be installed."""
    return assert_type(wearsim.calibrate(case, readings), wearsim.CalibrationResult).parts
