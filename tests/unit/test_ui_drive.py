"""What the page of ``wearsim ui`` takes of a whole drive and shows of its lives."""

from pathlib import Path

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed")

from nicegui import Client, ui
from nicegui.page import page

from wearsim.drive import life
from wearsim.drive.life import drive_life
from wearsim.drive.load_case import load_drive
from wearsim.input.document import CaseText
from wearsim.page.answer_panel import AnswerPanel
from wearsim.page.answers import DriveAnswer, taken_inputs
from wearsim.page.case_file import new_file
from wearsim.page.edited_input import EditedInput, StaleError
from wearsim.page.fields import form_fields, value_at
from wearsim.page.form_panel import FormPanel
from wearsim.page.toml_source import parsed_tables, shown_values, with_value
from wearsim.report.drive.drive_words import drive_headline

SHARES = "duty.1.power_share"
DRIVE = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": 2 * [{"teeth": 19, "profile": "ansi_b29", "nodes": 51}],
    "drive": {"links": 100},
    "mechanism": {"phases": 2},
    "wear": {"condition": "hardened, oiled"},
    "run": {"horizon_hours": 20, "life_tolerance": 0.1},
}


def test_empty_fields_show_what_a_drive_takes():
    drive = load_drive(Path(__file__).parents[2] / "cases" / "drives" / "camshaft-loop.toml")
    taken = taken_inputs(drive)
    shown = {field.key for table in form_fields(taken).values() for field in table}
    for key, value in (
        ("sprocket.1.role", "driver"),
        ("sprocket.2.role", "idler"),
        ("sprocket.3.role", "driven"),
        ("sprocket.3.name", "camshaft"),
        ("sprocket.3.teeth", 42),
        ("sprocket.4.form", "min"),
        ("mechanism.phases", 6),
        ("run.horizon_hours", 100 * 365.25 * 1.5),
    ):
        assert key in shown and value_at(taken, key) == value


def test_the_shares_of_a_duty_block_are_one_field():
    """They have names of sprockets for keys, and no fields of their own."""
    text = "sprocket = [{}]\n[[duty]]\npower_share = {pump = 0.7, fan = 0.3}\n"
    typed = []
    with Client(page("/form")) as client:
        form = FormPanel(lambda field, value: typed.append((field, value)), print, print, print)
        form.show(parsed_tables(text), shown_values(text), "")
        (shares,) = [one for one in client.elements.values() if one.props.get("data-key") == SHARES]
        assert shares.value == "{pump = 0.7, fan = 0.3}"
        shares.value = '{pump = 0.6, "cooling fan" = 0.4}'
    ((field, value),) = typed
    after = parsed_tables(with_value(text, field.key, value, field.is_text))
    assert after["duty"] == [{"power_share": {"pump": 0.6, "cooling fan": 0.4}}]


@pytest.mark.parametrize(
    ("power", "words"), [(7, "OVERLOADED: plate fatigue 152 %, "), (4, "Ratings: within ")]
)
def test_ratings_stand_beside_the_hours(power, words):
    """The rating of no. 40 with 19 teeth at 1000 rpm is 4.60 kW."""
    load = {"power_kW": power, "speed_rpm": 1000}
    found = drive_life(load_drive({**DRIVE, "load": load}))
    with Client(page("/drive")) as client:
        AnswerPanel({}).show_words(DriveAnswer(CaseText(Path("drive.toml"), ""), found.drive).words(found))
        texts = [one.text for one in client.elements.values() if isinstance(one, ui.label)]
    place = texts.index("> 20 h")
    assert texts[place + 2].startswith(words)
    assert drive_headline(found) == ("> 20 h (overloaded)" if power == 7 else "> 20 h")


def test_runs_that_nobody_waits_for_do_not_begin(monkeypatch):
    monkeypatch.setattr(life, "simulate", lambda case, progress: pytest.fail("began"))
    path = Path("drive.toml")
    edited = EditedInput(CaseText(path, ""), new_file(path), lambda: True, lambda part: pytest.fail("told"))
    drive = load_drive({**DRIVE, "load": {"power_kW": 4, "speed_rpm": 1000}})
    with pytest.raises(StaleError):
        drive_life(drive, progress=edited.watch)
