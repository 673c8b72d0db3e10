"""``wearsim profile``: the flank as CSV."""

import csv
import io
import math

import pytest

COLUMNS = (
    "node,x_mm,y_mm,arc_length_mm,curvature_per_mm,flank_radius_mm,pressure_angle_deg,"
    "evolute_x_mm,evolute_y_mm"
)


def test_columns_and_numbers(cli, drive, tmp_path):
    """Ends of the default range of contact against the closed form of the flank.

    tan(alpha) = h/x, l^2 = x^2 + h^2, rho_t = r + l^3/(R h + l^2) with x = 4.064 and 30.734.
    """
    out = tmp_path / "new" / "flank.csv"
    done = cli("profile", drive(), "--out", out)
    assert (done.code, done.out) == (0, "")
    text = out.read_text()
    assert text.splitlines()[0] == COLUMNS
    rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(io.StringIO(text))]
    assert [row["node"] for row in rows] == list(range(1, 52))
    h, r, centrode = 5.6, 7.94, 20 * 25.4 / (2 * math.pi)
    for row, x in ((rows[0], 4.064), (rows[-1], 30.734)):
        length = math.hypot(x, h)
        radius = r + length**3 / (centrode * h + length**2)
        assert row["flank_radius_mm"] == pytest.approx(radius, rel=1e-9)
        assert row["curvature_per_mm"] == pytest.approx(-1 / radius, rel=1e-9)
        assert row["pressure_angle_deg"] == pytest.approx(math.degrees(math.atan2(h, x)), rel=1e-9)
        centre = math.hypot(row["evolute_x_mm"] - row["x_mm"], row["evolute_y_mm"] - row["y_mm"])
        assert centre == pytest.approx(radius, rel=1e-6)
    assert all(row["y_mm"] > 0 for row in rows)
    assert rows[0]["arc_length_mm"] == 0.0


def test_stdout_is_the_same_file(cli, drive, tmp_path):
    path = drive()
    cli("profile", path, "--out", tmp_path / "flank.csv")
    text = (tmp_path / "flank.csv").read_text()
    assert cli("profile", path).out == text
    assert cli("profile", path, "--out", "-").out == text


def test_file_in_the_way(cli, drive, tmp_path):
    out = tmp_path / "flank.csv"
    out.write_text("mine")
    assert cli("profile", drive(), "--out", out).code == 2
    assert out.read_text() == "mine"
    assert cli("profile", drive(), "--out", out, "--force").code == 0
    assert out.read_text().startswith(COLUMNS)
    assert cli("profile", drive(), "--out", tmp_path, "--force").code == 2


def test_override_and_fault(cli, drive):
    path = drive()
    assert len(cli("profile", path, "--set", "sprocket.nodes=31").out.splitlines()) == 32
    done = cli("profile", path, "--set", "sprocket.nodes=3")
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("--set sprocket.nodes: ")


def test_case_without_a_flank(cli, tmp_path):
    rows = "\n".join(f"{i},100,-0.01,0.5" for i in range(9))
    (tmp_path / "run.csv").write_text(
        f"arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,slip_ratio\n{rows}\n"
    )
    path = tmp_path / "loads.toml"
    path.write_text(
        'format_version = 1\nchain.designation = "12B-1"\nload.speed_rpm = 9\n'
        'mechanism = { kind = "prescribed", table_file = "run.csv" }\n'
        "wear.specific_wear_rate_mm2_per_N = 1e-10\nstop.critical_depth_mm = 0.1\n"
    )
    done = cli("profile", path)
    assert (done.code, done.out) == (2, "")
    assert "mechanism.kind" in done.err
