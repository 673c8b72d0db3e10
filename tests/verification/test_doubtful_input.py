"""Inputs that would give a life without meaning are refused or doubted.

Expected: neck 6.24 mm of the reference tooth (the neck of 6.49 mm of the mirrored tooth less
the relief of 0.01 pitch), and that turning a sprocket does not change it.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim

CASE: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {
        "teeth": 20,
        "profile": "evolute",
        "evolute_offset_mm": 5.5,
        "contact_start_mm": 30.67,
        "contact_end_mm": 4.0,
    },
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-8},
}


def test_depth_beyond_the_neck_is_refused() -> None:
    with pytest.raises(wearsim.CaseError, match=r"critical_depth_mm.*at its thinnest, 6\.2"):
        wearsim.load_case(CASE, ["stop.critical_depth_mm=6.3"])
    case = wearsim.load_case(CASE, ["stop.critical_depth_mm=4"])
    assert any("tooth may break first" in text for text in case.warnings)


@pytest.mark.parametrize("degrees", [1.0, -2.0, 90.0])
def test_turned_points_are_turned_back(tmp_path: Path, degrees: float) -> None:
    flank = wearsim.load_case(CASE).drive.profile
    rotated = flank.rotated(np.radians(degrees))
    lives = []
    for name, points in (("straight", flank), ("turned", rotated)):
        file = tmp_path / f"{name}.csv"
        np.savetxt(file, np.c_[points.x, points.y], delimiter=",", header="x_mm,y_mm", comments="")
        sprocket = {"teeth": 20, "profile": "points", "points_file": str(file), "evolute_offset_mm": 5.5}
        case = wearsim.load_case(CASE | {"sprocket": sprocket})
        lives.append(wearsim.simulate(case).life.cycles)
        assert any("rotated by" in text for text in case.warnings) == (name == "turned")
    assert lives[1] == pytest.approx(lives[0], rel=1e-6)


def test_bound_stays_where_the_higher_coefficient_fails() -> None:
    """At three times the wear rate the flank turns away before the horizon of 650 h."""
    case = wearsim.load_case(CASE, ["stop.critical_depth_mm=6.2", "run.horizon_hours=300"])
    result = wearsim.simulate(case)
    assert isinstance(result.life, wearsim.LowerBound)
    assert result.life_low.cycles_run if isinstance(result.life_low, wearsim.LowerBound) else True


def test_life_of_few_cycles_is_doubted() -> None:
    case = wearsim.load_case(CASE, ["wear.specific_wear_rate_mm2_per_N=1e-5"])
    assert any("only" in text and "cycles" in text for text in wearsim.simulate(case).warnings)
