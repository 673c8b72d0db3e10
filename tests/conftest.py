"""What tests of all folders share, and the pages that a run can write from their rows."""

import importlib
import os
import runpy
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from wearsim.input.faults import known_keys

os.environ["WEARSIM_RUNS"] = ""
"""Commands under test run what they are asked for, and leave nothing in the cache of the user."""

DOCS, RESEARCH = (Path(__file__).parents[1] / name for name in ("docs", "research"))
PAGES = {
    "validated": "validation_page",
    "measured": "measured_page",
    "judged": "laws_page",
    "practised": "practice_page",
}
"""Name of a row that a test hands over, and the option and writer of its page."""


def pytest_addoption(parser):
    parser.addoption(
        "--validation-page",
        metavar="FILE",
        help="write docs/validation.md to FILE from the rows of tests/verification",
    )
    parser.addoption(
        "--measured-page",
        metavar="FILE",
        help="write docs/measured.md to FILE from the rows of tests/validation",
    )
    parser.addoption(
        "--laws-page", metavar="FILE", help="write docs/laws.md to FILE from the tables of tests/laws"
    )
    parser.addoption(
        "--practice-page",
        metavar="FILE",
        help="write docs/practice.md to FILE from the drives of tests/practice",
    )


def pytest_sessionstart(session):
    """Let programs be interrupted; have all kernels compiled before workers would compile each its own."""
    # A shell that starts the tests in its background has them, and what they start, ignore the interrupt.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    config = session.config
    whole = config.args_source is config.ArgsSource.TESTPATHS and not config.option.collectonly
    if whole and config.getoption("numprocesses") and not hasattr(config, "workerinput"):
        command = [sys.executable, "-c", "import wearsim.cli; wearsim.cli.main()", "warm", "-q"]
        subprocess.run(command, check=True)


def pytest_collection_modifyitems(items):
    """Number the tests: workers end them in an order of their own, and pages have the one of the files."""
    for number, item in enumerate(items):
        item.user_properties.append(("number", number))


def pytest_terminal_summary(terminalreporter, exitstatus, config):
    """Write the pages where all tests passed; with xdist only the controller comes here."""
    for kind, writer in PAGES.items():
        if file := config.getoption(writer):
            write_page(terminalreporter, exitstatus, file, kind, writer)


def write_page(terminalreporter, exitstatus, file, kind, writer):
    if exitstatus:
        terminalreporter.write_line(f"{file}: not written, not all tests passed")
        return
    reports = sorted(
        terminalreporter.getreports("passed"), key=lambda report: dict(report.user_properties)["number"]
    )
    rows = [
        (report.nodeid, report.location[1], row)
        for report in reports
        for name, row in report.user_properties
        if name == kind
    ]
    page = runpy.run_path(str(DOCS / f"{writer}.py"))["page"](rows)
    Path(file).write_text(page, encoding="utf-8")
    terminalreporter.write_line(f"{file}: {len(rows)} rows")


@pytest.fixture
def not_for_ever():
    """Have a test fail that would wait for ever, as for a pipe that nobody writes to."""

    def late(number, frame):
        pytest.fail("waits for ever")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(60)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


@pytest.fixture(scope="session")
def research():
    """Return the importer of the scripts in research/."""

    def module(name):
        with pytest.MonkeyPatch.context() as patch:
            patch.syspath_prepend(str(RESEARCH))
            return importlib.import_module(name)

    return module


@pytest.fixture(scope="session")
def stated_error(research):
    """research/stated_error.py as a module: random drives and the references of their lives."""
    return research("stated_error")


@pytest.fixture(scope="session")
def leaves():
    """Function that lists the dotted keys of a model that are no tables."""

    def keys(model):
        names = known_keys(model)
        return [name for name in names if not any(other.startswith(f"{name}.") for other in names)]

    return keys
