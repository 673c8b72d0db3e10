"""Inputs that are small on the disk and would take minutes or gigabytes: refused by their size, at once."""

import math
import subprocess
import sys

import pytest

from wearsim.command.options import BAD_INPUT
from wearsim.errors import GeometryError
from wearsim.files import given_lines
from wearsim.geometry.measured.dxf_edges import edges_from_dxf

pytestmark = pytest.mark.usefixtures("not_for_ever")


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (".".join(["a"] * 20_000) + " = 1", "nested at most 20 deep"),
        ("\n".join(f"k{number} = 1" for number in range(150_000)), "at most 20000 keys, holds about 150"),
        ("[[duty]]\nhours = 1\nspeed_rpm = 50\ntension_N = 900\n" * 15_000, "at most 20000 keys"),
        ("list = [" + "1," * 900_000 + "]", "at most 100000 values in lists"),
    ],
    ids=["dotted key", "keys", "duty blocks", "list"],
)
def test_case(cli, drive, more, words):
    path = drive()
    path.write_text(path.read_text("utf-8") + more, "utf-8")
    done = cli("check", path)
    assert done.code == BAD_INPUT
    assert words in done.err


def test_table_of_millions_of_rows(tmp_path):
    (tmp_path / "long.csv").write_bytes(b"x_mm,y_mm\n" + b"1,2\n" * 3_000_000)
    with pytest.raises(OSError, match="it has 3000001 rows, 2000000 are the most"):
        next(given_lines(tmp_path / "long.csv"))


@pytest.mark.slow
def test_log_of_a_million_rows_in_400_megabytes(drive, tmp_path):
    rows = "".join(f"{second},{1000 + second % 7},60\n" for second in range(1_000_000))
    (tmp_path / "log.csv").write_text("time_s,tension_N,speed_rpm\n" + rows)
    case = drive(power_kW='3\nduty_file = "log.csv"')
    case.write_text(case.read_text().replace("power_kW = 3\n", "").replace("speed_rpm = 100\n", ""))
    # A child counts what its parent has until it runs its own program: a small parent has little.
    small = (
        "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, stdout=sys.stderr); "
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
    )
    command = [sys.executable, "-c", small, sys.executable, "-m", "wearsim", "check", str(case)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert 20_000 < int(done.stdout) < 400_000


def test_faults_of_a_table_end_after_a_thousand(cli, drive, tmp_path):
    (tmp_path / "long.csv").write_bytes(b"x_mm,y_mm\n" + b"1,\n" * 100_000)
    done = cli("check", drive(profile='"points"\npoints_file = "long.csv"'))
    assert done.code == 2
    assert "long.csv:2: y_mm must be a finite number (got '')" in done.err
    assert len(done.err.splitlines()) < 50


def entities(kind, rows):
    """Text of a DXF file with entities of a kind, each by its numbers after their codes."""
    body = "".join(
        f"0\n{kind}\n8\n0\n" + "".join(f"{code}\n{value}\n" for code, value in row.items()) for row in rows
    )
    return f"0\nSECTION\n2\nENTITIES\n{body}0\nENDSEC\n0\nEOF\n"


@pytest.mark.parametrize(
    ("kind", "rows", "words"),
    [
        ("CIRCLE", [{10: i, 20: 0, 40: 0.7} for i in range(1001)], "at most 1000 circles, but has 1001"),
        (
            "LINE",
            [{10: 0, 20: 0, 11: 50 * math.cos(i), 21: 50 * math.sin(i)} for i in range(3000)],
            "at most 200 edges that end at one point, but has 3000",
        ),
        ("LINE", [{10: i, 20: 0, 11: i, 21: 1} for i in range(20_001)], "at most 20000 edges, but has 20001"),
    ],
    ids=["circles", "junction", "lines"],
)
def test_drawing(tmp_path, kind, rows, words):
    path = tmp_path / "many.dxf"
    path.write_text(entities(kind, rows), "utf-8")
    with pytest.raises(GeometryError, match=words):
        edges_from_dxf(path, None, 0.01, [])
