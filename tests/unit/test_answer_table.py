"""Tables as files: no spreadsheet takes what they hold for a formula.

The first characters are those that OWASP names under "CSV Injection".
"""

import pandas as pd
import pytest

from wearsim.report.answer_table import csv_of


@pytest.mark.parametrize("text", ["=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1+1", "\r=1+1"])
def test_text_like_a_formula_begins_with_an_apostrophe(text):
    written = csv_of(pd.DataFrame({"case": [text, "plain"], "hours": [1.5, -2.0]}))
    rows = written.replace("\r", "?").splitlines()
    assert rows[1].lstrip('"').startswith("'")
    assert rows[2] == "plain,-2.0"


@pytest.mark.parametrize("cell", ["-", "-5.2", "+3", "a=b", "", None, 3, True])
def test_all_else_is_written_as_it_is(cell):
    frame = pd.DataFrame({"cell": [cell, "x"]})
    assert csv_of(frame) == frame.to_csv(index=False)
