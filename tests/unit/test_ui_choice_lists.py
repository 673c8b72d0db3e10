"""The list of chains on the page of ``wearsim ui``."""

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed")

from nicegui import Client, ui
from nicegui.page import page

from wearsim.catalogue.catalogues import chains
from wearsim.page.choice_lists import choice_list, fill_list
from wearsim.page.field_words import choice_words
from wearsim.page.fields import catalogue_words
from wearsim.page.form_panel import FormPanel
from wearsim.page.toml_source import parsed_tables, shown_values

NAME = "designation"
CHAINS = catalogue_words(f"chain.{NAME}")


def listed(value):
    with Client(page("/list")):
        return choice_list(NAME, CHAINS, value, "Chain")


def leave(element, typed):
    """Leave the list with something typed into it, as a browser tells it."""
    (listener,) = [one for one in element._event_listeners.values() if one.type == "blur"]
    element._handle_event({"listener_id": listener.id, "args": typed})


def test_every_chain_of_the_catalogue_is_listed_once_and_found_by_all_its_names():
    assert len({*CHAINS}) == len(CHAINS)
    for name, chain in chains().items():
        assert chain.designation in CHAINS
        words = choice_words(NAME, chain.designation)
        assert name.removesuffix("-1") in words and f"{chain.pitch:g} mm" in words


def test_the_form_has_a_list_of_chains():
    text = '[chain]\ndesignation = "10B-1"\n'
    with Client(page("/form")) as client:
        FormPanel(print, print, print, print).show(parsed_tables(text), shown_values(text), "")
        (element,) = [
            one for one in client.elements.values() if one.props.get("data-key") == "chain.designation"
        ]
    assert isinstance(element, ui.select) and element.value == "10B-1"
    assert element.options["10B-1"] == "10B-1: 15.875 mm pitch"


@pytest.mark.parametrize(
    ("typed", "value"),
    [
        ("12B-1", "12B-1"),
        (" 12B-1: 19.05 mm pitch", "12B-1"),
        ("ANSI 60", "ANSI 60"),
        ("10", "10"),
        ("", "16B-1"),
        ("16B-1: 25.4 mm pitch", "16B-1"),
    ],
)
def test_what_is_typed_is_taken_when_the_list_is_left(typed, value):
    element = listed("16B-1")
    leave(element, typed)
    assert element.value == value
    assert element.options["12B-1"] == "12B-1: 19.05 mm pitch"
    assert [*element.options] == [*CHAINS, *([] if value in CHAINS else [value])]


@pytest.mark.parametrize(
    ("typed", "value"), [("16B-1: 25.4 mm pitch", "16B-1"), ("12B-1", "12B-1"), ("RS99", "RS99")]
)
def test_what_the_browser_hands_over_as_a_new_word(typed, value):
    """The key Tab does so with what the field shows, on the way to the next field too."""
    element = listed("16B-1")
    assert element._event_args_to_value(type("Event", (), {"args": typed})) == value


def test_a_value_that_is_no_chain_of_the_list_is_shown():
    element = listed("")
    assert element.value is None
    fill_list(element, NAME, CHAINS, "RS99")
    assert element.value == "RS99" and element.options["RS99"] == "RS99"
