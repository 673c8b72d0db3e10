"""CSV files that a case names: read with the case, faults to the row."""

import re
import tomllib

import pytest

from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError

PRESCRIBED = """\
format_version = 1
[chain]
designation = "12B-1"
[mechanism]
kind = "prescribed"
table_file = "run.csv"
[load]
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 1e-10
[stop]
critical_depth_mm = 0.1
"""

POINTS = """\
format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "points"
points_file = "run.csv"
evolute_offset_mm = 5.5
[load]
power_kW = 3
speed_rpm = 100
[wear]
condition = "hardened, oiled"
"""

HEAD = "arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,slip_ratio"
ROWS = [f"{s},100,-0.01,0.5" for s in range(6)]


@pytest.fixture
def faults(tmp_path):
    """Messages about run.csv in a case."""

    def found(case, content):
        (tmp_path / "run.csv").write_bytes(content.encode("utf-8"))
        path = tmp_path / "drive.toml"
        path.write_text(case)
        with pytest.raises(CaseError) as caught:
            load_case(path)
        return [fault.message.replace(str(tmp_path), "") for fault in caught.value.faults]

    return found


def table(*rows, head=HEAD):
    return "\n".join([head, *rows]) + "\n"


def test_good_table(tmp_path):
    (tmp_path / "run.csv").write_text("\ufeff" + table(*ROWS), encoding="utf-8")
    path = tmp_path / "drive.toml"
    path.write_text(PRESCRIBED)
    case = load_case(path)
    assert case.files == (tmp_path / "run.csv",)
    assert case.drive.table.arc_length.tolist() == [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]


def test_every_bad_cell_with_its_row(faults):
    rows = [*ROWS]
    rows[1] = "1,100,x,0.5"
    rows[2] = "2,100,-0.01"
    rows[4] = "4,nan,-0.01,inf"
    assert faults(PRESCRIBED, table(*rows)) == [
        "run.csv:3: flank_curvature_per_mm must be a finite number (got 'x')",
        "run.csv:4: needs 4 values, has 3",
        "run.csv:6: load_per_width_N_per_mm must be a finite number (got 'nan')",
        "run.csv:6: slip_ratio must be a finite number (got 'inf')",
    ]


def test_arc_length_must_increase_and_load_not_be_negative(faults):
    rows = [*ROWS]
    rows[3] = "2,100,-0.01,0.5"
    rows[4] = "4,-1,-0.01,-0.5"
    assert faults(PRESCRIBED, table(*rows)) == [
        "run.csv:5: arc_length_mm must increase from row to row",
        "run.csv:6: load_per_width_N_per_mm must not be negative",
        "run.csv:6: slip_ratio must not be negative",
    ]


def test_columns(faults):
    head = "arc_length_mm,load_per_width_N_per_m,flank_curvature_per_mm,slip_ratio"
    messages = faults(PRESCRIBED, table(*ROWS, head=head))
    assert messages[0].startswith("run.csv:1: column 'load_per_width_N_per_mm' is missing")
    assert messages[1].endswith("did you mean 'load_per_width_N_per_mm'?")
    twice = "arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,arc_length_mm"
    assert "run.csv:1: each column may appear only once" in faults(PRESCRIBED, table(*ROWS, head=twice))
    semicolons = [row.replace(",", ";") for row in ROWS]
    messages = faults(PRESCRIBED, table(*semicolons, head=HEAD.replace(",", ";")))
    assert messages[0].startswith("run.csv:1: columns are separated by semicolons: separate them by commas")


@pytest.mark.parametrize(("columns", "found"), [("", 0), (",slip_ratio,sliding_distance_mm", 2)])
def test_exactly_one_kind_of_sliding(faults, columns, found):
    head = HEAD.removesuffix(",slip_ratio") + columns
    rows = [f"{s},100,-0.01" + ",0.5" * found for s in range(6)]
    (message,) = faults(PRESCRIBED, table(*rows, head=head))
    assert message.endswith(f"must be there, found {found}")


@pytest.mark.parametrize("content", ["", "\n", HEAD + "\n", table(*ROWS[:4])])
def test_too_little(faults, content):
    assert faults(PRESCRIBED, content)


def test_thousands_of_bad_rows_stay_quick_and_short(faults):
    rows = [f"{s},x,-0.01,0.5" for s in range(5000)]
    messages = faults(PRESCRIBED, table(*rows))
    assert len(messages) == 21
    assert messages[-1].startswith("and ")


def test_file_is_not_there(tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text(PRESCRIBED.replace("run.csv", "sub/no.csv"))
    with pytest.raises(CaseError, match=r"drive.toml:6: mechanism.table_file: .*No such file"):
        load_case(path)


@pytest.mark.parametrize("name", ["", ".", "\\u0000"])
def test_name_of_no_file(tmp_path, name):
    path = tmp_path / "drive.toml"
    path.write_text(PRESCRIBED.replace("run.csv", name))
    with pytest.raises(CaseError, match=r"table_file: the file must be readable CSV"):
        load_case(path)


@pytest.mark.parametrize(
    ("change", "key", "words"),
    [
        (("critical_depth_mm = 0.1", ""), "stop.critical_depth_mm", "required"),
        (("[stop]", "[stop]\nmin_tip_land_mm = 1"), "stop.min_tip_land_mm", "no tip"),
        (
            (
                "specific_wear_rate_mm2_per_N = 1e-10",
                'law = "power"\ncoefficient = 1e-10\npressure_exponent = 0.9',
            ),
            "wear.pressure_exponent",
            "ill-posed",
        ),
        (
            (
                "specific_wear_rate_mm2_per_N = 1e-10",
                'law = "drozdov"\ncoefficient = 1e-10\npressure_exponent = 2\nhardness_MPa = 1e3\n'
                "reference_speed_mm_per_s = 10\nspeed_exponent = 0.5",
            ),
            "mechanism.table_file",
            "sliding_speed_mm_per_s",
        ),
    ],
)
def test_checks_of_a_prescribed_case(tmp_path, change, key, words):
    (tmp_path / "run.csv").write_text(table(*ROWS))
    path = tmp_path / "drive.toml"
    path.write_text(PRESCRIBED.replace(*change))
    with pytest.raises(CaseError) as caught:
        load_case(path)
    (fault,) = caught.value.faults
    assert fault.key == key
    assert words in fault.message


def test_what_a_prescribed_case_does_not_use_is_said(tmp_path):
    (tmp_path / "run.csv").write_text(table(*ROWS))
    path = tmp_path / "drive.toml"
    path.write_text(PRESCRIBED.replace("[load]", "[load]\ntension_N = 5"))
    assert any("load.tension_N" in text for text in load_case(path).warnings)


def test_points_must_run_from_root_to_tip(faults):
    rows = [f"{x},{y}" for x, y in ((0.0, 90.0 - i) for i in range(20))]
    (message,) = faults(POINTS, table(*rows, head="x_mm,y_mm"))
    assert message == ("run.csv: points must run from root to tip, but the radius decreases: reverse them")


def test_points_may_not_repeat_and_must_be_enough(faults):
    rows = [f"{i},{60 + i}" for i in (*range(11), 10)]
    assert faults(POINTS, table(*rows, head="x_mm,y_mm")) == [
        "run.csv:13: the point repeats the one before: remove it"
    ]
    assert faults(POINTS, table(*rows[:5], head="x_mm,y_mm")) == [
        "run.csv: a flank needs at least 11 points, has 5"
    ]


def test_points_of_no_working_flank_are_a_fault_not_a_crash(faults):
    for y in (60.0, 1.0, 1e6):
        rows = [f"{5 + 0.1 * i},{y + i}" for i in range(20)]
        assert faults(POINTS, table(*rows, head="x_mm,y_mm"))


@pytest.mark.parametrize(
    ("change", "end", "reached"),
    [("contact_start_mm = 32", "tip", 30.67), ("contact_end_mm = 3", "root", 4.0)],
)
def test_contact_past_an_end_of_the_points(faults, change, end, reached):
    """The flank reaches from 4.0 to 30.67 mm, as the evolute flank that gave the points.

    The direction of the smoothed flank at its ends moves that by some 0.1 mm.
    """
    evolute = POINTS.replace('"points"', '"evolute"').replace('points_file = "run.csv"\n', "")
    tables = tomllib.loads(evolute)
    tables["sprocket"] |= {"contact_end_mm": 4.0, "contact_start_mm": 30.67}
    flank = load_case(tables).drive.profile
    rows = [f"{x!r},{y!r}" for x, y in zip(flank.x.tolist(), flank.y.tolist(), strict=True)]
    case = POINTS.replace("[load]", f"{change}\n[load]")
    (message,) = faults(case, table(*rows, head="x_mm,y_mm"))
    found = re.search(rf"{end} end of the flank at ([\d.]+) mm: give at (?:least|most) that", message)
    assert float(found.group(1)) == pytest.approx(reached, abs=0.2)
