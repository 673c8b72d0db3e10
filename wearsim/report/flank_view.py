"""What pictures show of a worn flank: new and worn points, what touches it, the wheel around it."""

import math
import tempfile
from pathlib import Path

import numpy as np

from wearsim.case.load_case import load_case
from wearsim.case.model import Case
from wearsim.catalogue.catalogues import chains
from wearsim.geometry.profile import Vector
from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.report.lines import grouped
from wearsim.result import Life, WearResult
from wearsim.result.folder import with_files

_LARGEST_SHOWN = 0.12
"""Depth in the picture of a flank, as a fraction of the flank's extent."""

_FINE = 2e-4
"""Deviation of the wheel's outline in a picture, as a fraction of the pitch."""

_ROUND = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)


def case_of(result: WearResult) -> Case:
    """Return the case that a result was calculated for."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in result.input_files.items():
            (Path(folder) / name).write_text(text, encoding="utf-8", errors="surrogateescape")
        return load_case(with_files(result.inputs, folder))


def enlargement(depth: float, extent: float) -> int:
    """Return a round factor that makes a depth visible beside a flank.

    Examples
    --------
    >>> enlargement(0.1, 20.0)  # 20 * 0.1 = 2.0 <= 0.12 * 20 = 2.4
    20
    """
    return max(n for n in _ROUND if n == 1 or n * depth <= _LARGEST_SHOWN * extent)


def touching_circle(result: WearResult, arc_length: float) -> tuple[float, str]:
    """Return the radius of what touches the flank at a place, and what it is."""
    if "gear" in result.inputs:
        last = snapshot(result, -1)
        place = float(np.interp(arc_length, last["arc_length_mm"], last["path_mm"]))
        drive = case_of(result).drive
        assert isinstance(drive, GearDrive)
        mesh = drive.pair.mesh(drive.points)
        return 1.0 / float(np.interp(place, mesh.pole_distance, mesh.curvature[1])), "wheel"
    chain = result.inputs["chain"]
    if "designation" in chain:
        return 0.5 * chains()[chain["designation"]].roller_diameter, "roller"
    return 0.5 * float(chain["roller_diameter_mm"]), "roller"


def outline(result: WearResult) -> tuple[Vector, Vector]:
    """Return points of the new wheel, or of the teeth beside a gap."""
    if result.inputs["mechanism"]["kind"] == "wrap":
        return _beside_gap(result)
    sprocket = result.inputs.get("sprocket", {})
    strand = result.inputs["mechanism"]["kind"] == "strand"
    if not strand or sprocket["profile"] != "evolute":
        return np.empty(0), np.empty(0)
    drive = case_of(result).drive
    assert isinstance(drive, StrandDrive)
    wheel = drive.tooth.wheel().exterior.simplify(_FINE * drive.chain.pitch)
    points = np.array(wheel.coords)
    return points[:, 0], points[:, 1]


def _beside_gap(result: WearResult) -> tuple[Vector, Vector]:
    """Half of the teeth on both sides of a gap, down to the sprocket's axis."""
    first = snapshot(result, 0)
    x, y = first["x_mm"], first["y_mm"]
    half = np.pi / result.inputs["sprocket"]["teeth"]
    tip = np.hypot(x[0], y[0])
    across, up = tip * math.sin(half), tip * math.cos(half)
    return np.append(x, (-across, 0.0, across)), np.append(y, (up, 0.0, up))


def life_time(result: WearResult) -> str:
    """Return the time at which pictures show a flank as worn, and what it is."""
    what = "life" if isinstance(result.life, Life) else "limit not reached"
    if result.stop == "elongation_percent":
        what += ", ended by the chain"
    return f"{grouped(result.life.hours_run)} h ({what})"


def at_life(result: WearResult) -> dict[str, Vector]:
    """Return the columns of the flank at the end of the life; of the kind of gap that wears most."""
    times, end = np.unique(result.flank_columns["cycles"]), result.life.cycles_run
    last = int(np.clip(np.searchsorted(times, end), 1, times.size - 1))
    part = min(1.0, float((end - times[last - 1]) / (times[last] - times[last - 1])))
    before, after = snapshot(result, last - 1), snapshot(result, last)
    return {name: (1.0 - part) * before[name] + part * after[name] for name in after}


def snapshot(result: WearResult, index: int) -> dict[str, Vector]:
    """Return the columns of the flank at one snapshot; of the kind of gap that wears most."""
    columns = flanks(result, index)
    if "gap_kind" not in columns:
        return columns
    most = int(result.flank_columns["depth_mm"].argmax())
    at = columns["gap_kind"] == result.flank_columns["gap_kind"][most]
    return {name: values[at] for name, values in columns.items()}


def flanks(result: WearResult, index: int) -> dict[str, Vector]:
    """Return the columns of all flanks at one snapshot."""
    cycles = result.flank_columns["cycles"]
    at = cycles == np.unique(cycles)[index]
    return {name: values[at] for name, values in result.flank_columns.items()}
