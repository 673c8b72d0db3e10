"""Inputs that used to end as a bug in wearsim: each is told by its place, or runs."""

import shutil
from pathlib import Path

import ezdxf
import numpy as np
import pytest

import wearsim
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError, GeometryError
from wearsim.geometry.measured.dxf_outline import outline_from_dxf
from wearsim.geometry.measured.points import flank_from_points
from wearsim.input.document import CaseText
from wearsim.report.answer import findings

CASES = Path(__file__).parents[2] / "cases"
STRAND, WRAP, TABLE, POINTS = (
    CASES / f"{name}.toml"
    for name in (*("16b-20t-oiled", "a40-19t-rating", "hertz-arc-prescribed"), "beet-harvester-18t-soil")
)


@pytest.mark.parametrize(
    "deep",
    [
        ".".join(["a"] * 150) + " = 1",
        f"[{'.'.join(['a'] * 150)}]\nb = 1",
        f"a = {'[' * 150}{']' * 150}",
        f"chain = {'{a = ' * 90}1{'}' * 90}",
    ],
)
def test_tables_within_one_another(deep):
    with pytest.raises(CaseError, match=r"deep\.toml:2: tables and lists may be nested at most 20 deep"):
        load_case(CaseText(Path("deep.toml"), f"format_version = 1\n{deep}\n"))


@pytest.mark.parametrize(
    "setting", [".".join(["chain"] * 1500) + "=1", f"chain.pitch_mm={'[' * 50}{']' * 50}"]
)
def test_tables_within_one_another_on_the_command_line(setting):
    with pytest.raises(CaseError, match="--set chain: tables and lists may be nested at most 20 deep"):
        load_case(STRAND, [setting])


@pytest.mark.parametrize("case", [STRAND, WRAP, TABLE])
@pytest.mark.parametrize(
    ("key", "value", "rule"),
    [
        ("load.speed_rpm", "1e-30", "greater than or equal to 0.000001"),
        ("run.horizon_hours", "1e-30", "greater than or equal to 0.000001"),
        ("mechanism.roller_slip_fraction", "1e-30", "greater than or equal to 0.000001"),
        ("chain.pitch_mm", "1e9", "less than or equal to 100000"),
        ("chain.pitch_mm", "1e300", "must be 0 or from 1e-30 to 1e\\+15"),
    ],
)
def test_numbers_that_no_drive_has(case, key, value, rule):
    with pytest.raises(CaseError, match=f"--set {key}: .*{rule}"):
        load_case(case, [f"{key}={value}"])


@pytest.mark.parametrize("case", [STRAND, TABLE])
def test_life_in_which_nothing_wears_is_told(case):
    result = wearsim.simulate(
        load_case(case, ["wear.specific_wear_rate_mm2_per_N=1e-30"])
        if case == TABLE
        else load_case(case, ["load.tension_N=1e-15"])
    )
    assert abs(result.removed_area) < 1e-11
    removed = dict(findings(result))["Removed"]
    assert removed == "below the resolution of the flank coordinates"


def edited(folder, *rows):
    """The case of a flank by points with the last rows up to line 100 of its file replaced."""
    shutil.copy(POINTS, folder / "case.toml")
    csv = POINTS.with_suffix(".csv")
    lines = csv.read_text().splitlines()
    lines[100 - len(rows) : 100] = rows
    (folder / csv.name).write_text("\n".join(lines))
    return folder / "case.toml"


@pytest.mark.parametrize(
    ("rows", "fault"),
    [
        (["nan,80.0"], "x_mm must be a finite number"),
        (["1e300,80.0"], "x_mm must be at most 1e\\+15 in size"),
        (["-8.0,80.0", "-8.0,80.0"], "the point repeats the one before"),
        (["1e-20,80.0", "2e-20,80.0"], "the point repeats the one before"),
    ],
)
def test_points_of_a_flank(tmp_path, rows, fault):
    """Also a step so small that the length of the flank does not grow by it."""
    with pytest.raises(CaseError, match=rf"sprocket\.points_file: .*csv:100: {fault}"):
        load_case(edited(tmp_path, *rows))


def test_points_that_no_spline_passes():
    """FITPACK ends on one far point with a ValueError of its own."""
    x, y = np.linspace(0.0, 1.0, 50), np.linspace(50.0, 60.0, 50)
    x[20] = 1e160
    with pytest.raises(GeometryError, match=r"a smooth curve must pass within 0\.0001 mm"):
        flank_from_points(x, y, 1e-4, 51)


FAR = {
    "circle": lambda space: space.add_circle((0.0, 0.0), 1e12),
    "arc": lambda space: space.add_arc((0.0, 0.0), 1e15, 0.0, 90.0),
    "line": lambda space: space.add_line((0.0, 0.0), (1e300, 0.0)),
    "ellipse": lambda space: space.add_ellipse((0.0, 0.0), (1e9, 0.0), 0.5),
    "spline": lambda space: space.add_spline([(0, 0), (1e10, 0), (1e10, 1e10), (0, 1e10)]),
    "polyline": lambda space: space.add_lwpolyline([(0, 0), (1e10, 0), (1e10, 1e10)]),
    "bulge": lambda space: space.add_lwpolyline([(0, 0, 1e300), (1, 0, 1), (1, 1, 0)], "xyb"),
}


@pytest.mark.parametrize("kind", FAR)
def test_drawing_that_is_far_too_large(tmp_path, kind):
    """A circle of 1e12 mm takes 2e9 chords of 0.01 um rise: it is refused before they are made."""
    drawing = ezdxf.new(units=4)
    entity = FAR[kind](drawing.modelspace())
    drawing.saveas(tmp_path / "wheel.dxf")
    told = f"wheel.dxf: every {entity.dxftype()} must be a curve of a wheel, but #"
    with pytest.raises(GeometryError, match=told):
        outline_from_dxf(tmp_path / "wheel.dxf", 12)


UNITS = "$INSUNITS\n 70\n"


@pytest.mark.parametrize(
    ("good", "bad"),
    [
        *((f"{UNITS}4", f"{UNITS}{number}") for number in ("inf", "nan", "\0", "1\x002")),
        ("\nModel\n", "\nMod\0el\n"),
    ],
)
def test_damaged_drawing(tmp_path, good, bad):
    """Numbers that are none, and a NUL in the name of the model space."""
    drawing = ezdxf.new(units=4)
    drawing.modelspace().add_lwpolyline([(0, 0), (1, 0), (1, 1)], close=True)
    drawing.saveas(tmp_path / "wheel.dxf")
    text = (tmp_path / "wheel.dxf").read_text()
    assert good in text
    (tmp_path / "wheel.dxf").write_text(text.replace(good, bad))
    with pytest.raises(GeometryError, match=r"wheel\.dxf: "):
        outline_from_dxf(tmp_path / "wheel.dxf", 12)


def test_case_keeps_the_text_of_its_files(tmp_path):
    """Studies load their cases in a folder that is gone when they run."""
    case = load_case(edited(tmp_path))
    (csv,) = case.files
    text = csv.read_text()
    shutil.rmtree(tmp_path)
    assert wearsim.simulate(case).input_files == {csv.name: text}


@pytest.mark.wide
def test_drawing_in_another_encoding_is_kept(tmp_path):
    """Bytes that are no UTF-8 come back from a saved run as they were."""
    from wearsim.cad.wheel_formats import export

    drawing = export(load_case(WRAP), None, ("new",), "dxf").replace(b"ANSI", "Зуб ".encode("cp1251"))
    (tmp_path / "wheel.dxf").write_bytes(drawing)
    text = WRAP.read_text().replace('"ansi_b29"', '"dxf"\ndxf_file = "wheel.dxf"')
    (tmp_path / "case.toml").write_text(text)
    kept = load_case(tmp_path / "case.toml").input_files["wheel.dxf"]
    assert kept.encode("utf-8", "surrogateescape") == drawing.replace(b"\r\n", b"\n")


@pytest.mark.parametrize("value", ["[1]", "{a = 1}", "true"])
def test_kind_that_is_no_word(value):
    with pytest.raises(CaseError, match=r"--set mechanism\.kind: must be 'strand', 'prescribed' or 'wrap'"):
        load_case(STRAND, [f"mechanism.kind={value}"])


@pytest.mark.parametrize(
    ("setting", "told"),
    [
        ("a.b.c=3", "--set a: unknown table"),
        ("load.x.y=2", "--set load.x: unknown table"),
        ("uncertainty=3", "--set uncertainty: must be a table (got 3)"),
        ("optimise.objectives=3", "--set optimise.objectives: must be a list of values (got 3)"),
        ("chain.joint_application_factor=[1]", "--set chain.joint_application_factor: unknown key"),
    ],
)
def test_fault_of_a_setting_names_what_was_typed(setting, told):
    with pytest.raises(CaseError) as caught:
        load_case(STRAND, [setting])
    assert any(line.startswith(told) for line in str(caught.value).splitlines()), str(caught.value)


@pytest.mark.parametrize(
    ("called", "told"),
    [
        (wearsim.simulate, "case: must be a case, the path of its file, or its tables"),
        (wearsim.check, "case: must be a case, the path of its file, or its tables"),
        (lambda array: list(wearsim.simulate_many([array])), "case: must be a case"),
        (lambda array: wearsim.sweep(STRAND, array), "grid: must map keys of the case to values"),
        (lambda array: wearsim.optimise(STRAND, array), "parameters: must map keys of the case to values"),
        (
            lambda array: wearsim.uncertainty(STRAND, array),
            "uncertainty: must map keys of the case to values",
        ),
        (lambda array: wearsim.maintain(STRAND, array), "maintenance: must map keys of the case to values"),
    ],
    ids=["simulate", "check", "simulate_many", "sweep", "optimise", "uncertainty", "maintain"],
)
def test_array_in_the_wrong_place_is_named(called, told):
    with pytest.raises(CaseError) as caught:
        called(np.array([1.0, 2.0]))
    assert str(caught.value).startswith(told)
    assert str(caught.value).endswith("(got a ndarray)")
