"""The same runs compiled and interpreted: this process in its own mode, a second one in the other.

Expected numbers are those of the other mode; as a script the file prints this mode's.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from types import FunctionType

import numpy as np
import pytest
from numba.core import config

import wearsim
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.geometry.forms.iso606 import iso606_gap
from wearsim.geometry.roller_path import roller_path
from wearsim.kernels.offset import OFFSET_ROWS, run_offset_cycles
from wearsim.kernels.per_cycle_loop import CYCLES_ROWS, run_cycles
from wearsim.kernels.prescribed import prescribed_contact
from wearsim.kernels.strand import strand_contact
from wearsim.mechanisms.wrap.wrap_mechanism import StrandTensions, WrapChain, WrapMechanism

STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {
        "teeth": 20,
        "profile": "evolute",
        "face_width_mm": 17.0,
        "evolute_offset_mm": 5.5,
        "contact_start_mm": 30.67,
        "contact_end_mm": 4.0,
        "nodes": 13,
    },
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "stop": {"critical_depth_mm": 0.02},
    "run": {"method": "per_cycle", "life_tolerance": 1e-2},
}
ARCHARD = {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-7}
POWER = {"law": "power", "coefficient": 1e-10, "pressure_exponent": 2.0}
DROZDOV = {
    "law": "drozdov",
    "coefficient": 2e-4,
    "pressure_exponent": 1.7,
    "hardness_MPa": 2000.0,
    "reference_speed_mm_per_s": 30.0,
    "speed_exponent": 0.3,
}
TABLE_HEAD = "arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,{slip}\n"


def lives(folder):
    """Life and worn flank of small cases, from the case to the result."""
    yield "archard", {**STRAND, "wear": ARCHARD}
    yield "power, advance", {**STRAND, "wear": POWER, "run": {"life_tolerance": 1e-2}}
    yield "drozdov", {**STRAND, "wear": DROZDOV}
    for slip, wear in (("slip_ratio", POWER), ("sliding_distance_mm", ARCHARD)):
        table = folder / f"{slip}.csv"
        u = np.linspace(0.0, 1.0, 11)
        columns = 6.0 * u, 100.0 - 60.0 * u, 0.025 + 0.0 * u, 0.2 + 0.4 * u
        rows = [",".join(repr(float(value)) for value in row) for row in zip(*columns, strict=True)]
        table.write_text(TABLE_HEAD.format(slip=slip) + "\n".join(rows), encoding="utf-8")
        yield (
            slip,
            {
                "format_version": 1,
                "chain": {"designation": "12B-1"},
                "mechanism": {"kind": "prescribed", "table_file": str(table)},
                "load": {"speed_rpm": 100},
                "wear": {**wear, **({"coefficient": 1e-9} if wear is POWER else {})},
                "stop": STRAND["stop"],
                "run": STRAND["run"],
            },
        )


def contacts():
    """Both contact functions handed to the same loop as an argument."""
    strand = Strand(centrode_radius=80.851, roller_radius=7.94, offset=5.5)
    flank = evolute_flank(strand, 4.0, 30.67, 11).profile
    arc, ones = flank.arc_length, np.ones(11)
    given = [arc, 90.0 + arc, 0.3 + 0.1 * arc, 50.0 + arc, 0.025 * ones]
    columns = np.array([*given, flank.normal_x, flank.normal_y])
    yield "prescribed argument", prescribed_contact, flank, np.array([1.0 / 7.94]), columns
    constants = np.array([strand.height, 7.94, 294.0, 4.0, 30.67, 1.0 / 1.27, 1.0, 10.5])
    yield "strand argument", strand_contact, flank, constants, np.empty((1, 1))


def wraps():
    """Roller paths and equilibria: links alike, one roller aloft, friction."""
    gap = iso606_gap(12.7, 8.51, 11, form="max")
    outline = gap.outline(41)
    for name, alternating, friction, phase in (
        ("wrap", False, 0.0, 1.0),
        ("wrap, roller aloft", True, 0.0, 0.01),
        ("wrap, friction", True, 0.1, 0.4),
    ):
        yield (
            name,
            WrapMechanism(
                outline=outline,
                path=roller_path(outline, 4.255, 21),
                pitch_angle=2.0 * np.pi / 11,
                wrap_angle=np.pi,
                chain=WrapChain(12.7, 4.255, 3.0, 5e4, alternating),
                pull=StrandTensions(1000.0, 60.0, True, friction, 1.0),
            ),
            phase,
        )


def numbers():
    """All numbers of this mode by name of the run."""
    found = {"interpreted": [float(isinstance(run_cycles.compiled, FunctionType))]}
    with tempfile.TemporaryDirectory() as folder:
        for name, tables in lives(Path(folder)):
            result = wearsim.simulate(wearsim.load_case(tables))
            last = result.flank.tail(11)
            columns = last[["x_mm", "y_mm", "pressure_MPa"]].to_numpy().ravel()
            found[name] = [result.cycles, result.updates, *columns.tolist()]
    for name, mechanism, phase in wraps():
        loads = mechanism.loads(phase, 0.02)
        rows = [loads.tension, loads.force, loads.pressure_angle, *loads.centre.T]
        locus = [*mechanism.unworn.locus, mechanism.unworn.touched]
        found[name] = np.concatenate([*rows, *locus]).tolist()
    law = np.array([1e-7, 0.5, 1.0, 0.0, np.inf, 1.0, 0.0, 0.0, 0.0])
    for name, contact, flank, constants, columns in contacts():
        x, y, depth = flank.x.copy(), flank.y.copy(), np.zeros(11)
        work, done = np.zeros((CYCLES_ROWS, 11)), np.zeros(1)
        status = run_cycles(
            contact, x, y, depth, constants, columns, work, 1e5, law, 0.75, 1.0, 1.0, 20, done
        )
        found[name] = [status, done[0], *x.tolist(), *y.tolist(), *work.ravel().tolist()]
        if contact is prescribed_contact:
            x, y, depth = flank.x.copy(), flank.y.copy(), np.zeros(11)
            work = np.zeros((OFFSET_ROWS, 11))
            status = run_offset_cycles(
                x, y, depth, constants, columns, work, 1e5, law, 0.75, 1.0, 1.0, 20, done
            )
            found["offset form"] = [status, done[0], *depth.tolist(), *work.ravel().tolist()]
    return found


@pytest.fixture(scope="module")
def both():
    """The numbers of this process and of one with the kernels in the other mode."""
    other = "0" if config.DISABLE_JIT else "1"
    script = [sys.executable, "-W", "error", __file__]
    with subprocess.Popen(
        script, env={**os.environ, "NUMBA_DISABLE_JIT": other}, stdout=subprocess.PIPE, text=True
    ) as process:
        here = numbers()
        there = json.loads(process.communicate()[0])
    assert process.returncode == 0
    return here, there


NAMES = (
    "archard",
    "power, advance",
    "drozdov",
    "slip_ratio",
    "sliding_distance_mm",
    "prescribed argument",
    "strand argument",
    "offset form",
    "wrap",
    "wrap, roller aloft",
    "wrap, friction",
)


def test_modes_differ(both):
    assert sorted(mode["interpreted"] for mode in both) == [[0.0], [1.0]]


@pytest.mark.parametrize("name", NAMES)
def test_compiled_and_interpreted_agree(both, name):
    here, there = both
    assert set(here) == set(there) == {"interpreted", *NAMES}
    assert here[name] == pytest.approx(there[name], rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("name", ["prescribed argument", "strand argument"])
def test_every_update_is_made_and_wears(both, name):
    status, done = both[0][name][:2]
    assert (status, done) == (0, 20)
    assert max(both[0][name][-11:]) > 0.0


if __name__ == "__main__":
    print(json.dumps(numbers()))
