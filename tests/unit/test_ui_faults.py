"""What the page of ``wearsim ui`` says of a wrong input, while it is typed and when a field is left."""

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed")

from nicegui import Client, ui
from nicegui.page import page

from wearsim.errors import Fault
from wearsim.page.fault_view import FaultView
from wearsim.page.form_panel import FormPanel
from wearsim.page.header import Header
from wearsim.page.text_elements import FaultList
from wearsim.page.toml_source import parsed_tables, shown_values

TEXT = "[sprocket]\nteeth = 1\n"
WRONG = Fault("must be at least 5 (got 1)", "sprocket.teeth")


class Page:
    """A form, the list of faults and the bar above, and what they say."""

    def __init__(self):
        self.client = Client(page("/faults"))
        with self.client:
            header = Header(())
            self.form = FormPanel(print, lambda: self.faults.complete(), print, print)
            self.form.show(parsed_tables(TEXT), shown_values(TEXT), "")
            self.faults = FaultView(self.form, FaultList(), header)

    def state(self):
        """What the bar says."""
        texts = [one.text for one in self.client.elements.values() if isinstance(one, ui.label)]
        return next(text for text in texts if text.endswith(("result", "yet")) and ":" in text)

    def errors(self):
        """What stands beside fields, and in the list."""
        found = [one.error for one in self.client.elements.values() if isinstance(one, ui.input)]
        listed = [one.text for one in self.client.elements.values() if "ws-fault" in one.classes]
        return [text for text in found if text], listed


def test_what_is_being_typed_is_no_fault_until_the_field_is_left():
    shown = Page()
    shown.faults.clear()
    shown.faults.begin(typing=True)
    shown.faults.fail([WRONG])
    assert shown.state() == "input incomplete: showing the previous result"
    assert shown.errors() == ([], [])
    shown.faults.complete()
    assert shown.state() == "input error: showing the previous result"
    assert shown.errors() == ([str(WRONG)], [str(WRONG)])


def test_a_fault_that_is_seen_follows_what_is_typed():
    shown = Page()
    shown.faults.begin(typing=False)
    shown.faults.fail([WRONG])
    assert shown.state() == "input error: no result yet"
    other = Fault("must be at least 5 (got 2)", "sprocket.teeth")
    shown.faults.begin(typing=True)
    shown.faults.fail([other, Fault("must be above 0", "load.power_kW")])
    assert shown.state() == "2 input errors: no result yet"
    assert shown.errors()[1] == [str(other), "load.power_kW: must be above 0"]
    shown.faults.clear()
    assert shown.errors() == ([], [])


def test_an_input_that_is_gone_has_no_faults():
    shown = Page()
    shown.faults.begin(typing=True)
    shown.faults.fail([WRONG])
    shown.faults.begin(typing=True)
    shown.faults.complete()
    assert shown.errors() == ([], [])
