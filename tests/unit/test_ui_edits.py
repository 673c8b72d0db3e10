"""Going back, comparing and trying values on the page of ``wearsim ui``."""

from pathlib import Path

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed")

from nicegui import Client, ui
from nicegui.page import page

from wearsim.chain.rating_findings import RatingFinding
from wearsim.drive.drive_start import start_text
from wearsim.drive.load_case import load_case, load_drive
from wearsim.input.document import CaseText
from wearsim.input.mechanism_registry import is_whole_drive
from wearsim.page.answer_panel import light, rating_list
from wearsim.page.answers import edited_case
from wearsim.page.case_file import example, example_titles
from wearsim.page.comparison_panel import compared_rows
from wearsim.page.edit_history import EditHistory
from wearsim.page.toml_source import parsed_tables, with_value
from wearsim.page.what_if import knobs
from wearsim.result import Life, LowerBound


def test_undo_goes_back_field_by_field_and_redo_forth():
    history = EditHistory()
    for left, typing in (("a", "x"), ("ab", "x"), ("abc", "y"), ("abcd", "")):
        history.leave(left, typing)
    back = [history.undo("abcde"), history.undo("abcd"), history.undo("abc")]
    assert back == ["abcd", "abc", "a"] and not history.can_undo
    assert [history.redo("a"), history.redo("abc"), history.redo("abcd")] == ["abc", "abcd", "abcde"]
    assert not history.can_redo
    history.undo("abcde")
    history.leave("abcd", "z")
    assert not history.can_redo, "an edit after an undo leaves nothing to do again"


def test_typing_into_a_field_after_an_undo_is_a_step_of_its_own():
    history = EditHistory()
    history.leave("1", "x")
    history.undo("12")
    history.leave("1", "x")
    assert history.undo("13") == "1"


@pytest.mark.parametrize(
    ("after", "words"),
    [
        (Life(1.0, 9100.0), "before 8 296 h, after 9 100 h (+9.69 %)"),
        (Life(1.0, 4148.0), "before 8 296 h, after 4 148 h (-50 %)"),
        (LowerBound(1.0, 20_000.0), "before 8 296 h, after > 20 000 h"),
    ],
)
def test_a_life_beside_the_pinned_one(after, words):
    """9100 / 8296 = 1.0969; of a bound nobody knows how much longer it is."""
    assert compared_rows("a = 1", {"chain": Life(1.0, 8296.0)}, "a = 1", {"chain": after}) == [
        ("chain", words),
        ("Changed", "nothing yet"),
    ]


def test_what_was_changed_since_the_pinned_run():
    rows = compared_rows("[load]\npower_kW = 3", {}, '[load]\nspeed_rpm = "2 rps"', {"life": Life(1.0, 5.0)})
    assert rows == [
        ("life", "after 5 h"),
        ("Changed", "load.power_kW: 3, now not given; load.speed_rpm: not given, now 2 rps"),
    ]


@pytest.mark.parametrize(
    ("value", "at_least", "word"),
    [(8.9, False, "within"), (9.0, False, "near"), (10.1, False, "outside"), (9.0, True, "outside")],
)
def test_lights_of_ratings(value, at_least, word):
    one = RatingFinding("plate fatigue", value, 10.0, "kW", "a rule", at_least=at_least)
    assert light(one) == word
    with Client(page("/ratings")) as client:
        rating_list([one])
        shown = [found.text for found in client.elements.values() if isinstance(found, ui.label)]
    assert word in shown and "plate fatigue" in shown


def test_a_rating_that_only_informs_is_no_alarm():
    elsewhere = "for information, the table is for GOST 13568 chains"
    one = RatingFinding("joint pressure", 70.9, 32.7, "MPa", "GOST practice", elsewhere)
    plates = RatingFinding("plate fatigue", 4.2, 4.6, "kW", "ANSI B29.1, H1")
    with Client(page("/ratings")) as client:
        rating_list([plates, one])
        lights = [found for found in client.elements.values() if "ws-light" in found.classes]
    assert [(found.text, found.props["data-light"]) for found in lights] == [
        ("near", "near"),
        ("outside (for information)", "informs"),
    ]


def test_sliders_are_of_plain_numbers_only():
    drive = {"sprocket": [{"name": "motor", "teeth": 9}, {"teeth": 57}, {"teeth": 20}], "load": {}}
    assert [(knob.words, knob.around) for knob in knobs(drive)] == [
        ("Teeth, motor", (9, 18.0)),
        ("Teeth, sprocket 2", (28.0, 114.0)),
    ]
    odd = {
        "sprocket": {"teeth": True},
        "load": {"power_kW": -3, "torque_N_m": float("inf"), "speed_rpm": [1]},
    }
    huge = {"sprocket": {"teeth": 10**400}}
    for tables in (odd, huge, {}, {"sprocket": 3, "load": 4}, {"sprocket": [3, {}]}):
        assert knobs(tables) == []


def test_every_example_opens_in_a_form_and_loads():
    titles = example_titles()
    assert {"packaging-conveyor", "16b-20t-oiled", "fzg-c14-16t-mild"} < {*titles}
    for name, title in titles.items():
        file = example(name)
        load = load_drive if is_whole_drive(parsed_tables(file.begun)) else load_case
        assert load(CaseText(file.path, file.begun)).title == title
        assert (file.path, file.content) == (Path(f"{name}.toml"), None)


def test_title_of_an_example_tells_what_is_changed_and_one_of_the_user_stays():
    file = example("16b-20t-oiled")
    edited = with_value(file.begun, "sprocket.teeth", "25")
    title = edited_case(CaseText(file.path, edited), file).title
    assert title == "Evolute sprocket, 16B chain, 20 teeth, with sprocket.teeth = 25"
    own = with_value(edited, "title", "Mine", is_text=True)
    assert edited_case(CaseText(file.path, own), file).title == "Mine"


def test_title_of_a_new_drive_follows_chain_and_teeth():
    text = with_value(start_text({"chain": "12B-1"}), "sprocket.1.teeth", "21")
    assert load_drive(CaseText(Path("drive.toml"), text)).title == "12B-1, 21 to 25 teeth"
