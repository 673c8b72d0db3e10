"""``wearsim stiffness-spectrum``: the shipped case as text, JSON and files, and bad input."""

import csv
import json
from pathlib import Path

import pytest

CASE = Path(__file__).parents[2] / "cases/sizing/stiffness-spectrum-20-30.toml"
COARSE = ("--set", "pinion.pitch_error_mm=0.3", "--set", "wheel.pitch_error_mm=0.4")
DOUBLE = ("--set", "spectrum.model=double_sum")


def test_shipped_case_as_text(cli):
    done = cli("handbook", "stiffness-spectrum", CASE)
    assert (done.code, done.err) == (0, "")
    assert max(map(len, done.out.splitlines())) <= 100
    assert "ratio 1.60518; mean 1.60325 contacts; model pairs" in done.out
    assert "3 revolutions of the pinion, 2 of the wheel, 60 meshes" in done.out
    assert "fz = 500 Hz; f1 = 25 Hz, f2 = 16.667 Hz" in done.out
    (line,) = [line for line in done.out.splitlines() if line.startswith("fz  ")]
    assert line.split() == ["fz", "1.00000", "500.00", "3.0170e-01", "6.0340e-01", "3.289e+04"]
    assert "0.0323325" in done.out


def test_page_shows_what_is_printed(cli):
    page = (CASE.parents[2] / "docs/stiffness-spectrum.md").read_text("utf-8")
    assert (
        page.partition("```text\n")[2].partition("```")[0] == cli("handbook", "stiffness-spectrum", CASE).out
    )


def test_source_model_as_json(cli):
    """The reference of the double sum, one-sided: twice 0.0031624935 at fz - f1."""
    found = json.loads(cli("handbook", "stiffness-spectrum", CASE, *DOUBLE, "--json").out)
    lines = {line["line"]: line for line in found["lines"]}
    assert (found["schema_version"], found["case"]) == (1, "stiffness-spectrum-20-30")
    assert found["mean_contacts"] == pytest.approx(2.8136029088, abs=6e-11)
    assert found["series_mean_contacts"] == pytest.approx(found["mean_contacts"], abs=1e-3)
    line = lines["fz - f1"]
    assert line["two_sided_coefficient"] == pytest.approx(0.0031624935, abs=6e-11)
    assert line["one_sided_amplitude"] == pytest.approx(2 * 0.0031624935, abs=2e-10)
    assert line["series_one_sided_amplitude"] == pytest.approx(2 * 0.0031624935, abs=2e-4)
    assert (line["tooth_harmonic"], line["pinion_sideband"], line["wheel_sideband"]) == (1, -1, 0)
    assert line["frequency_Hz"] == pytest.approx(475.0)
    assert line["line_family"] == "pinion"
    assert found["statics"]["deflections"][0]["stiffness_N_per_mm"] == pytest.approx(92785.979)


def test_without_speed_and_load_there_are_no_such_numbers(cli, tmp_path):
    text = CASE.read_text("utf-8").partition("[statics]")[0].replace("pinion_speed_rpm", "# ")
    path = tmp_path / "bare.toml"
    path.write_text(text)
    found = json.loads(cli("handbook", "stiffness-spectrum", path, "--json").out)
    assert "statics" not in found
    assert found["mesh_frequency_Hz"] is None
    line = found["lines"][0]
    assert line["frequency_Hz"] is line["series_one_sided_amplitude"] is None
    assert line["stiffness_one_sided_amplitude_N_per_mm"] is None
    text = cli("handbook", "stiffness-spectrum", path).out
    assert "Hz" not in text
    assert "N/mm" not in text


def test_files(cli, tmp_path):
    out = tmp_path / "out"
    assert cli("handbook", "stiffness-spectrum", CASE, *COARSE, *DOUBLE, "--out", out).code == 0
    assert {path.name for path in out.iterdir()} == {
        ".wearsim",
        *("result.json", "lines.csv", "statics.csv"),
        *("stiffness_spectrum.png", "stiffness_spectrum.svg"),
    }
    with (out / "lines.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["line"] for row in rows if row["line_family"] == "mesh"] == ["fz", "2fz", "3fz"]
    orders = [float(row["mesh_order"]) for row in rows]
    assert orders == sorted(orders)
    svg = (out / "stiffness_spectrum.svg").read_text("utf-8")
    for text in ("fz - f1", "fz + f1 + f2", "turns of the wheel", "closed form", "stiffness, kN/mm"):
        assert f">{text}<" in svg
    assert cli("handbook", "stiffness-spectrum", CASE, "--out", out).code == 2


def test_printed_formula_says_how_far_it_is_off(cli):
    done = cli("handbook", "stiffness-spectrum", CASE, *DOUBLE, "--set", "spectrum.formula=printed")
    assert "formula = printed: the closed form gives 0.9666 at fz, where 1.808 is exact" in done.err


def test_warnings_of_what_is_out_of_range(cli):
    done = cli(
        *("stiffness-spectrum", CASE, "--set", "pinion.teeth=8", "--set", "wheel.teeth=40"),
        *("--set", "statics.energy_exponent=2"),
    )
    assert done.code == 0
    assert "the tips of the wheel reach beyond the involute of the mate" in done.err
    assert "energy_exponent: radii and modulus give the constant of a point contact" in done.err


def test_teeth_that_lose_contact_are_a_warning_and_with_a_load_an_error(cli, tmp_path):
    large = ("--set", "wheel.pitch_error_mm=3", "--set", "wheel.error_order=12")
    done = cli("handbook", "stiffness-spectrum", CASE, *large, "--json")
    assert done.code == 3
    assert json.loads(done.out)["error"]["kind"] == "GeometryError"
    assert "some teeth must touch at every moment" in done.err
    path = tmp_path / "unloaded.toml"
    path.write_text(CASE.read_text("utf-8").partition("[statics]")[0])
    done = cli("handbook", "stiffness-spectrum", path, *large)
    assert done.code == 0
    assert "% of the time: lower pitch_error_mm" in done.err


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("pinion.teeth=4", "pinion.teeth: must be greater than or equal to 5"),
        ("spectrum.modell=pairs", "did you mean"),
        ("spectrum.formula=printed", "spectrum.formula: belongs to the closed form"),
        ("wheel.pitch_error_mm=3 deg", "wheel.pitch_error_mm: the unit must be convertible to mm"),
        ("statics.pinion_torque_N_m=60", "give exactly one of force_N, pinion_torque_N_m (got both)"),
    ],
)
def test_bad_input(cli, setting, words):
    done = cli("handbook", "stiffness-spectrum", CASE, "--set", setting)
    assert (done.code, done.out) == (2, "")
    assert words in done.err
    assert "Traceback" not in done.err


def test_schema_of_the_input(cli):
    found = json.loads(cli("schema", "--of", "stiffness-spectrum").out)
    assert set(found["required"]) == {"format_version", "gear_pair", "pinion", "wheel"}
    table = found["$defs"]["WheelTable"]["properties"]
    assert table["pitch_error_mm"]["description"].startswith("amplitude of the cumulative")
