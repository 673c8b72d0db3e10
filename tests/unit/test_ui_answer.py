"""The answer of ``wearsim ui`` on an overloaded drive, as the page holds it."""

import pytest

pytest.importorskip("nicegui", reason="nicegui is not installed")

from nicegui import Client, ui
from nicegui.page import page

import wearsim
from wearsim.chain.rating_findings import RatingFinding
from wearsim.input.document import CaseText
from wearsim.page.answer_panel import AnswerPanel, rating_list
from wearsim.page.answers import SprocketAnswer

WRAP = {
    "format_version": 1,
    "chain": {"designation": "ANSI 40"},
    "sprocket": {"teeth": 19, "profile": "ansi_b29", "nodes": 101},
    "mechanism": {"phases": 2},
    "wear": {"condition": "hardened, oiled"},
    "run": {"horizon_hours": 20, "life_tolerance": 0.1},
}


@pytest.mark.parametrize(("power", "words"), [(7, "Overloaded: plate fatigue 152 %, "), (4, None)])
def test_overload_stands_below_the_hours(power, words):
    """The rating of no. 40 with 19 teeth at 1000 rpm is 4.60 kW."""
    load = {"power_kW": power, "speed_rpm": 1000}
    case = wearsim.load_case({**WRAP, "load": load})
    answer = SprocketAnswer(CaseText(None, ""), case).words(wearsim.simulate(case))
    with Client(page("/answer")) as client:
        AnswerPanel({}).show_words(answer)
        texts = [one.text for one in client.elements.values() if isinstance(one, ui.label)]
    told = [text for text in texts if "verloaded" in text]
    if words is None:
        assert told == []
    else:
        headline, below = told
        assert headline == "> 20 h (overloaded)" and below.startswith(words)
        assert texts.index(headline) < texts.index(below) < texts.index("as given")


def test_the_elongation_that_ends_the_life_is_no_rating():
    """It always uses all of its limit, and is neither near nor outside it."""
    elongation = RatingFinding("elongation at the end", 3.0, 3.0, "%", "3 %")
    with Client(page("/ratings")) as client:
        rating_list([RatingFinding("plate fatigue", 4.4, 4.6, "kW", "ANSI B29.1"), elongation])
        texts = [one.text for one in client.elements.values() if isinstance(one, ui.label)]
    assert texts[-4:-2] == ["4.4 ≤ 4.6 kW (96 %)", "near"]
    assert texts[-2:] == ["elongation at the end", "3 ≤ 3 %; it defines the life and is no rating"]
