"""What tests of all folders share, and the validation page that a run can write."""

import runpy
from pathlib import Path

import pytest

from wearsim.case.messages import known_keys

WRITER = Path(__file__).parents[1] / "docs" / "validation_page.py"


def pytest_addoption(parser):
    parser.addoption(
        "--validation-page",
        metavar="FILE",
        help="write docs/validation.md to FILE from the rows of tests/verification",
    )


def pytest_terminal_summary(terminalreporter, exitstatus, config):
    """Write the page where all tests passed; with xdist only the controller comes here."""
    file = config.getoption("validation_page")
    if not file:
        return
    if exitstatus:
        terminalreporter.write_line(f"{file}: not written, not all tests passed")
        return
    rows = [
        (report.nodeid, report.location[1], row)
        for report in terminalreporter.getreports("passed")
        for name, row in report.user_properties
        if name == "validated"
    ]
    Path(file).write_text(runpy.run_path(str(WRITER))["page"](rows), encoding="utf-8")
    terminalreporter.write_line(f"{file}: {len(rows)} rows")


@pytest.fixture(scope="session")
def leaves():
    """Function that lists the dotted keys of a model that are no tables."""

    def keys(model):
        names = known_keys(model)
        return [name for name in names if not any(other.startswith(f"{name}.") for other in names)]

    return keys
