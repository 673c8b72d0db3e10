"""Editing the text of a case key by key, as ``wearsim ui`` does."""

import tomllib

import pytest

from wearsim.cli.init import new_case
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError
from wearsim.input.document import CaseText
from wearsim.page.toml_source import parsed_tables, shown_values, with_table, with_value, without_table

TEXT = """\
# Mine.
title = 'A'   # the first

[load]   # what it pulls
power_kW = 3.50  # shaft
# torque_N_m = 3

[[duty]]
speed_rpm = 1
[[duty]]  # second
speed_rpm = 2
"""


def test_a_changed_value_keeps_everything_else():
    assert with_value(TEXT, "load.power_kW", "4") == TEXT.replace("3.50", "4")
    assert with_value(TEXT, "duty.2.speed_rpm", "7") == TEXT.replace("= 2", "= 7")
    assert with_value(TEXT, "title", "B", is_text=True) == TEXT.replace("'A'", '"B"')


@pytest.mark.parametrize(
    ("typed", "is_text", "value"),
    [
        ("3", False, 3),
        (" 3 ", False, 3),
        ("3", True, "3"),
        (".5", False, 0.5),
        ("1e3", False, 1e3),
        ("3 kW", False, "3 kW"),
        ("true", False, True),
        ("[1, 2]", False, [1, 2]),
        ("1 # x", False, "1 # x"),
        ('"a"', False, "a"),
        ('"a"', True, '"a"'),
        ("a\"b\\'<x>", True, "a\"b\\'<x>"),
        ("'''", False, "'''"),
        ("\x00\x1b", True, "\x00\x1b"),
        ("1\nb = 2", False, "1\nb = 2"),
        ("inf", False, float("inf")),
        ("=", False, "="),
        ("[", False, "["),
    ],
)
def test_what_is_typed_becomes_a_toml_value_or_a_string(typed, is_text, value):
    edited = with_value(TEXT, "load.power_kW", typed, is_text)
    assert tomllib.loads(edited)["load"]["power_kW"] == value
    assert edited.startswith(TEXT.partition("power_kW")[0])


def test_what_is_shown_gives_the_same_value_when_typed():
    values = shown_values(TEXT)
    assert values == {"title": "A", "load.power_kW": "3.50", "duty.1.speed_rpm": "1", "duty.2.speed_rpm": "2"}
    for key, shown in values.items():
        edited = with_value(TEXT, key, shown, is_text=key == "title")
        assert tomllib.loads(edited) == tomllib.loads(TEXT)


@pytest.mark.parametrize(
    "key",
    [
        "load.speed_rpm",
        "stop.critical_depth_mm",
        "material.sprocket.name",
        "fatigue.sprocket.hardness_HB",
        "format_version",
    ],
)
@pytest.mark.parametrize("text", [TEXT, "", new_case("16B-1", 20, "strand"), "a = {b = 1}\n"])
def test_a_missing_key_is_added_with_its_tables_and_removed_with_them(text, key):
    edited = with_value(text, key, "7")
    place = tomllib.loads(edited)
    for part in key.split("."):
        place = place[part]
    assert place == 7
    for line in text.splitlines():
        assert line in edited or line.startswith(key.rpartition(".")[2])
    removed = with_value(edited, key, "")
    if key in shown_values(text):
        assert key not in shown_values(removed)
    else:
        assert shown_values(removed) == shown_values(text)
    comments = [line for line in text.splitlines() if line.startswith("#")]
    assert [line for line in removed.splitlines() if line.startswith("#")] == comments


def test_a_table_of_comments_is_kept():
    text = "[stop]\n# why not\ncritical_depth_mm = 1\n"
    assert "# why not" in with_value(text, "stop.critical_depth_mm", "")


def test_dotted_keys_inline_tables_and_tables_out_of_order():
    text = "load.power_kW = 3\nstop = {critical_depth_mm = 1}\n[a.b]\nc = 1\n[d]\n[a.e]\nf = 2\n"
    assert parsed_tables(text)["a"] == {"b": {"c": 1}, "e": {"f": 2}}
    for key in ("load.power_kW", "stop.critical_depth_mm", "a.b.c", "a.e.f"):
        edited = with_value(text, key, "9")
        inline = {"stop": "{critical_depth_mm = 9}"} if key.startswith("stop.") else {}
        assert shown_values(edited) == shown_values(text) | inline | {key: "9"}


def test_tables_of_a_list_come_and_go():
    more = with_table(TEXT, "duty")
    assert len(tomllib.loads(more)["duty"]) == 3
    assert without_table(more, "duty", 3) == TEXT
    assert tomllib.loads(without_table(TEXT, "duty", 1))["duty"] == [{"speed_rpm": 2}]
    assert "duty" not in tomllib.loads(without_table(without_table(TEXT, "duty", 1), "duty", 1))
    assert tomllib.loads(with_table("", "duty")) == {"duty": [{}]}


DRIVE = """\
[[sprocket]]
name = "motor"  # on the left

[[sprocket]]
take_up = {guide_deg = 0}
cog = [
    {teeth = 11},  # small
    {teeth = 12},
]

[load]
power_kW = 1
"""


def test_tables_of_a_sprocket_come_and_go():
    more = with_table(DRIVE, "sprocket.2.cog")
    assert more == DRIVE.replace("    {teeth = 12},\n", "    {teeth = 12},\n    {},\n")
    filled = with_value(more, "sprocket.2.cog.3.teeth", "13")
    assert tomllib.loads(filled)["sprocket"][1]["cog"] == [{"teeth": 11}, {"teeth": 12}, {"teeth": 13}]
    assert without_table(filled, "sprocket.2.cog", 3) == DRIVE
    first = without_table(DRIVE, "sprocket.2.cog", 1)
    assert "cog" not in tomllib.loads(without_table(first, "sprocket.2.cog", 1))["sprocket"][1]
    assert with_value(DRIVE, "sprocket.2.take_up.guide_deg", "") == DRIVE.replace(
        "take_up = {guide_deg = 0}\n", ""
    )
    third = with_value(with_table(DRIVE, "sprocket"), "sprocket.3.teeth", "17")
    assert third == DRIVE.replace("[load]", "[[sprocket]]\nteeth = 17\n\n[load]")
    worn = with_value(DRIVE, "sprocket.1.wear.condition", "hardened, dry", is_text=True)
    table = '[sprocket.wear]\ncondition = "hardened, dry"\n\n'
    assert worn == DRIVE.replace("left\n\n", f"left\n\n{table}")
    assert tomllib.loads(with_value(worn, "sprocket.1.wear.condition", "")) == tomllib.loads(DRIVE)


@pytest.mark.parametrize("text", ["[", "a = 1\na = 2", "a = [" * 3000, "a ="])
def test_what_is_no_toml_has_no_tables(text):
    assert parsed_tables(text) is None


@pytest.mark.parametrize("broken", ["power_kW = -3", "power_kW = ", "powr_kW = 3"])
def test_a_text_has_the_faults_of_its_file(tmp_path, broken):
    path = tmp_path / "drive.toml"
    text = new_case("16B-1", 20, "strand").replace("power_kW = 6.1", broken)
    path.write_text(text)
    with pytest.raises(CaseError) as of_file:
        load_case(path)
    path.write_text("other")
    with pytest.raises(CaseError) as of_text:
        load_case(CaseText(path, text))
    assert of_text.value.faults == of_file.value.faults
    assert of_text.value.faults[0].file == str(path)


def test_a_text_finds_files_beside_its_path(tmp_path):
    (tmp_path / "log.csv").write_text("time_s,tension_N,speed_rpm\n0,3000,100\n3600,3000,100\n")
    text = new_case("16B-1", 20, "strand").replace("power_kW = 6.1", 'duty_file = "log.csv"')
    text = text.replace("speed_rpm = 120\n", "")
    case = load_case(CaseText(tmp_path / "not_there.toml", text))
    assert case.name == "not_there"
    assert case.files == (tmp_path / "log.csv",)
