"""``wearsim compare``: cases and runs side by side, tables and pictures."""

import csv

import pytest

pytestmark = pytest.mark.wide


@pytest.fixture(scope="module")
def expected_files():
    tables = {".wearsim", "summary.csv", "summary.md"}
    pictures = {"flanks", "along_flank", "depth_over_hours"}
    return tables | {f"{name}.{kind}" for name in pictures for kind in ("png", "svg")}


def test_case_and_run(cli, drive, tmp_path, expected_files):
    """Twice the pull of an Archard wear gives half the life, whatever the flank."""
    run, out = tmp_path / "light", tmp_path / "reports" / "first"
    assert cli("life", drive("light", power_kW=2), "--out", run).code == 0
    done = cli("compare", run, drive("heavy", power_kW=4), "--out", out)
    assert done.code == 0
    assert {path.name for path in out.iterdir()} == expected_files
    assert all(path.stat().st_size > 0 for path in out.iterdir())
    with (out / "summary.csv").open() as file:
        light, heavy = csv.DictReader(file)
    assert float(light["ratio_to_first"]) == 1.0
    assert float(heavy["ratio_to_first"]) == pytest.approx(0.5, rel=2e-3)
    assert float(light["life_hours_low"]) == pytest.approx(float(light["life_hours"]) / 3, rel=1e-9)
    assert (heavy["stop"], float(heavy["stop_value"])) == ("critical_depth_mm", 0.02)
    for key in ("initial_peak_pressure_MPa", "removed_area_mm2", "max_depth_arc_length_mm"):
        assert float(heavy[key]) > 0.0
    table = [line for line in done.out.splitlines() if line.startswith("| ")]
    assert len(table) == 3
    assert all("| critical depth 0.02 mm |" in line for line in table[1:])
    assert all(line.endswith(" from the root |") for line in table[1:])
    assert "limits differ" not in done.err
    page = (out / "summary.md").read_text()
    assert all(line in page for line in table)
    assert "](flanks.svg)" in page and "](depth_over_hours.svg)" in page
    assert cli("compare", run, "--out", out).code == 2


def test_different_limits_are_told(cli, drive, tmp_path):
    cases = [drive(f"d{depth}", critical_depth_mm=f"0.0{depth}") for depth in (2, 3, 2)]
    cases.append(drive("d2again"))
    out = tmp_path / "out"
    done = cli("compare", *cases, "--out", out)
    text = (
        "warning: limits differ between the cases: critical depth 0.02 mm (d2, d2again), "
        "critical depth 0.03 mm (d3)"
    )
    assert text in done.err.splitlines()
    assert f"- {text}\n" in (out / "summary.md").read_text()
    assert cli("-q", "compare", *cases, "--out", out, "--force").err == ""


def test_bound_is_shown_with_its_sign(cli, drive, tmp_path):
    path = drive()
    out = tmp_path / "out"
    done = cli("compare", path, "--out", out, "--set", "run.horizon_hours=50")
    assert done.code == 0
    assert "> 50 h | horizon 50 h |" in done.out
    with (out / "summary.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert (row["life_hours"], row["life_reached"]) == ("", "False")


def test_bad_case_or_run_writes_nothing(cli, drive, tmp_path):
    out = tmp_path / "out"
    (tmp_path / "empty").mkdir()
    for source in (drive("bad", teeth=3), tmp_path / "empty", tmp_path / "x.csv"):
        done = cli("compare", drive("good"), source, "--out", out)
        assert (done.code, done.out) == (2, "")
        assert not out.exists()


def test_table_is_printed_without_a_folder(cli, drive, tmp_path):
    cases = drive(), drive("heavy", power_kW=4)
    alone = cli("compare", *cases)
    assert alone.code == 0, alone.err
    assert alone.out == cli("compare", *cases, "--out", tmp_path / "out").out
    assert len(alone.out.splitlines()) == 4


def test_set_is_for_cases(cli, drive, tmp_path):
    cli("life", drive(), "--out", tmp_path / "run")
    done = cli("compare", tmp_path / "run", "--out", tmp_path / "out", "--set", "title=x")
    assert done.code == 2
    assert "--set" in done.err
