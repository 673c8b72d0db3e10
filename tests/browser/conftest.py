"""A headless Chromium for the pages, where the machine has one."""

import shutil
from importlib.util import find_spec

import pytest

import wearsim
from tests import drives

from .ui_server import REMEMBERED, Server

ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

HOSTILE = "<script>document.title = 'taken'</script> & <b>bold</b> \"x\""

STRAND = {
    "format_version": 1,
    "title": HOSTILE,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 51},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
    "run": {"horizon_hours": 100, "life_tolerance": 0.1},
}
WRAP = {
    **STRAND,
    "title": "A wrap",
    "sprocket": {"teeth": 20, "profile": "iso606", "nodes": 101},
    "mechanism": {"kind": "wrap", "phases": 2},
}
GEARS = drives.changed(drives.GEARS, {"title": "Gears"})

if find_spec("pytest_playwright") is None:

    @pytest.fixture
    def page():
        pytest.skip("pytest-playwright is not installed: pip install 'wearsim[browser]'")

    @pytest.fixture
    def new_context():
        pytest.skip("pytest-playwright is not installed: pip install 'wearsim[browser]'")


@pytest.fixture(scope="session")
def browser_type_launch_args():
    """Debian's Chromium instead of a browser that playwright would have to download."""
    found = shutil.which("chromium") or shutil.which("chromium-browser")
    if found is None:
        pytest.skip("no Chromium: apt-get install chromium")
    return {"executable_path": found, "args": ARGUMENTS}


@pytest.fixture(scope="session")
def results():
    """Runs of a strand, a wrap and a pair of gears."""
    return [
        wearsim.simulate(wearsim.load_case(tables, [f"run.horizon_hours={hours}"]))
        for tables, hours in ((STRAND, 100), (WRAP, 100), (GEARS, 50_000))
    ]


@pytest.fixture(scope="session")
def reports(results, tmp_path_factory):
    """Folder with the reports ``strand``, ``wrap``, ``gears`` and ``all``, pages beside their script."""
    from wearsim.report.html.page_writer import save_report

    folder = tmp_path_factory.mktemp("reports")
    for name, result in zip(("strand", "wrap", "gears"), results, strict=True):
        save_report([result], folder / name, False, single_file=False, detail="full")
        save_report([result], folder / f"{name}_alone", False, single_file=True, detail="brief")
    save_report(results, folder / "all", False, single_file=False, detail="full")
    return folder


@pytest.fixture
def watched(page):
    """A page that remembers what it asked for and what its console said."""
    page.context.add_init_script(REMEMBERED)
    page.requested, page.said = [], []
    page.on("request", lambda request: page.requested.append(request.url))
    page.on("console", lambda message: page.said.append(message.text))
    page.on("pageerror", lambda error: page.said.append(str(error)))
    page.on("dialog", lambda dialog: page.said.append(f"dialog {dialog.message}"))
    return page


@pytest.fixture
def serve(tmp_path):
    """Function that serves a case of the given text and stops it after the test."""
    if find_spec("nicegui") is None:
        pytest.skip("nicegui is not installed: pip install 'wearsim[ui]'")
    servers = []

    def start(text, *arguments, name="drive.toml", browser=None):
        path = tmp_path / name
        if text is not None:
            path.write_text(text)
        case = [path] if text is not None else []
        servers.append(Server(tmp_path, *case, *arguments, browser=browser))
        servers[-1].path = path
        return servers[-1]

    yield start
    for server in servers:
        code, said = server.stop()
        assert code == 130, said
        assert "Traceback" not in said, said
