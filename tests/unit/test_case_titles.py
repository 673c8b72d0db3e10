"""The title above an answer is true of the input that was used."""

import re
import tomllib
from pathlib import Path

import pytest

from wearsim.cli.init import new_case
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError
from wearsim.input.document import CaseText
from wearsim.page.answers import edited_case
from wearsim.page.case_file import CaseFile, new_file
from wearsim.page.toml_source import with_value
from wearsim.runner.design import Design
from wearsim.study.optimise.design_files import save_designs
from wearsim.study.sweep.model import load_sweep

CASES = Path(__file__).parents[2] / "cases"
OILED = CASES / "16b-20t-oiled.toml"
GEARS = {
    "format_version": 1,
    "gear": {
        "pinion_teeth": 16,
        "wheel_teeth": 24,
        "module_mm": 4.5,
        "face_width_mm": 14,
        "pressure_angle_deg": 20,
    },
    "load": {"torque_N_m": 200, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
    "stop": {"critical_depth_mm": 0.05},
}


@pytest.mark.parametrize(
    ("kind", "title"),
    [
        ("strand", "Evolute sprocket, 12B-1 chain, 25 teeth"),
        ("wrap", "12B-1 chain around a sprocket of 25 teeth"),
    ],
)
def test_starter_case_follows_what_is_set(kind, title):
    path = Path("drive.toml")
    source = CaseText(path, new_case("12B-1", 25, kind))
    assert load_case(source).title == title
    settings = ["sprocket.teeth=31", "chain.designation=08B"]
    followed = title.replace("12B-1", "08B").replace("25", "31")
    assert load_case(source, settings).title == followed
    edited = with_value(source.text, "sprocket.teeth", "31")
    assert edited_case(CaseText(path, edited), new_file(path)).title == title.replace("25", "31")


def test_titles_of_chains_and_gears_of_ones_own():
    tables = {
        "format_version": 1,
        "chain": {"pitch_mm": 38.4, "roller_diameter_mm": 22, "inner_width_mm": 25},
        "sprocket": {"teeth": 18, "profile": "evolute"},
        "load": {"tension_N": 6000, "speed_rpm": 40},
        "wear": {"condition": "normalised, greased"},
    }
    assert load_case(tables).title == "Evolute sprocket, chain of 38.4 mm pitch, 18 teeth"
    assert load_case(GEARS).title == "Involute gears 16/24, module 4.5 mm"


@pytest.mark.parametrize(
    ("settings", "title"),
    [
        ([], "Evolute sprocket, 16B chain, 20 teeth"),
        (["sprocket.teeth=25"], "Evolute sprocket, 16B chain, 20 teeth, with sprocket.teeth = 25"),
        (
            ["load.speed_rpm=90", "wear.condition=hardened, dry", "sprocket.teeth=20"],
            "Evolute sprocket, 16B chain, 20 teeth, with load.speed_rpm = 90, wear.condition = hardened, dry",
        ),
        (["title=Mine", "sprocket.teeth=25"], "Mine"),
    ],
)
def test_written_title_tells_what_is_set(settings, title):
    """A value that the file has already is no change; a title that is set is as it is."""
    assert load_case(OILED, settings).title == title


def test_page_tells_what_is_not_in_the_file():
    text = OILED.read_text(encoding="utf-8")
    file = CaseFile(OILED, text.encode())
    assert edited_case(CaseText(OILED, text), file).title == load_case(OILED).title
    edited = with_value(with_value(text, "sprocket.teeth", "25"), "wear.condition", "")
    edited = with_value(edited, "wear.specific_wear_rate_mm2_per_N", "1e-10")
    assert edited_case(CaseText(OILED, edited), file).title == (
        "Evolute sprocket, 16B chain, 20 teeth, with sprocket.teeth = 25, "
        "wear.specific_wear_rate_mm2_per_N = 1e-10, without wear.condition"
    )


def test_designs_of_a_study_tell_their_values(tmp_path):
    tables = tomllib.loads(OILED.read_text(encoding="utf-8"))
    save_designs(tmp_path, {"01.toml": "design 1"}, Design("a", tables, {}, ("sprocket.teeth",), ((25,),)))
    found = load_case(tmp_path / "01.toml")
    assert found.title == "Evolute sprocket, 16B chain, 20 teeth, with sprocket.teeth = 25"


def test_sweep_tells_what_is_set_in_its_case(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text(
        f'format_version = 1\ntitle = "Speeds"\ncase = {str(OILED)!r}\n'
        "[grid]\n'load.speed_rpm' = [90, 110]\n"
    )
    assert load_sweep(path).title == "Speeds"
    assert load_sweep(path, ["sprocket.teeth=25"]).title == "Speeds, with sprocket.teeth = 25"


@pytest.mark.parametrize(
    ("title", "words"),
    [
        ("x" * 201, "must have at most 200 characters"),
        ("Hoist\x07", "holds U+0007: remove it"),
        ("\x1b[31mHoist", "holds U+001B"),
        ("Hoist\x00", "holds U+0000"),
        ("Hoist\u202e", "holds U+202E"),
        ("Hoist\n2", "holds U+000A"),
        ("Hoist\u2028", "holds U+2028"),
    ],
)
def test_title_is_one_line_that_can_be_read(title, words):
    chain = tomllib.loads(OILED.read_text(encoding="utf-8"))
    for tables in (chain, GEARS):
        with pytest.raises(CaseError, match=re.escape(words)):
            load_case({**tables, "title": title})
    with pytest.raises(CaseError, match=re.escape(words)):
        load_sweep({"format_version": 1, "title": title, "case": str(OILED), "grid": {"sprocket.teeth": [9]}})


@pytest.mark.parametrize("length", [180, 200])
def test_title_that_tells_what_is_set_is_no_longer_than_one_may_be(tmp_path, length):
    path = tmp_path / "a.toml"
    tables = {**tomllib.loads(OILED.read_text(encoding="utf-8")), "title": "x" * length}
    save_designs(tmp_path, {path.name: ""}, Design("a", tables, {}, ("sprocket.teeth",), ((25,),)))
    whole = "x" * length + ", with sprocket.teeth = 25"
    assert load_case(path).title == f"{whole[:197]}..."


def test_unseen_characters_that_are_set_are_named_once():
    with pytest.raises(CaseError, match="no such wear condition") as found:
        load_case(OILED, ["wear.condition=oiled\x1b"])
    assert len(found.value.faults) == 1


@pytest.mark.parametrize("key", ["maintenance.currency", "joint.source"])
def test_other_texts_of_answers_are_lines_too(key):
    with pytest.raises(CaseError, match="without control characters") as found:
        load_case(
            OILED, [f"{key}=a\x1b", "maintenance.chain_price=1", "joint.specific_wear_rate_mm2_per_N=1e-10"]
        )
    assert f"--set {key}" in str(found.value)


def test_values_of_a_sweep_are_lines_too():
    with pytest.raises(CaseError, match="holds U\\+001B"):
        load_sweep({"format_version": 1, "case": str(OILED), "grid": {"wear.condition": ["a\x1b", "b"]}})
