"""``wearsim ui``: a local page to try designs."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from wearsim.catalogue.shipped_cases import place_of_case
from wearsim.command.complete import CasePath
from wearsim.command.options import common_options, keeping_runs, overrides, warn
from wearsim.errors import OutputError

if TYPE_CHECKING:
    from wearsim.page.case_file import CaseFile


@click.command(short_help="Edit a case on a local web page and watch its life.")
@click.argument("case", required=False, type=CasePath(path_type=Path), metavar="[CASE]")
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    default=0,
    metavar="N",
    help="Port on 127.0.0.1; default: any free port.",
)
@click.option("--no-browser", is_flag=True, help="Only print the address; do not open a browser.")
@keeping_runs
@overrides
@common_options
def ui(case: Path | None, port: int, no_browser: bool, settings: tuple[str, ...]) -> None:
    """Serve a local web page to edit CASE (.toml), or a new case, while its life is recomputed.

    Only this machine can reach the page; it needs no network. --set changes the values that the page
    starts with, not the file. Ctrl-C stops it. Needs nicegui (pip install 'wearsim[ui]').
    """
    from wearsim.extras import check_installed

    check_installed(("nicegui", "plotly", "jinja2"), "ui", "ui")
    opened = _Opened(case, settings)
    opened()
    from wearsim.page.request_guard import loopback_socket

    server_socket = loopback_socket(port)
    from wearsim.page.server import serve  # takes a second

    address = f"http://127.0.0.1:{server_socket.getsockname()[1]}/"
    click.echo(address)
    warn("Ctrl-C stops it")
    if not no_browser:
        import threading
        import webbrowser

        # A browser in the terminal keeps its caller waiting.
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
    serve(opened, server_socket, _cases_to_warm())


class _Opened:
    """What a new page begins with: what is in the file by then, or a new case."""

    def __init__(self, path: Path | None, settings: tuple[str, ...]) -> None:
        self._path, self._settings = path, settings

    def __call__(self) -> "tuple[CaseFile, str]":
        from wearsim.drive.drive_start import start_text
        from wearsim.input.document import STDIN, text_of
        from wearsim.page.case_file import FIRST, NEW, example, new_file, read_file

        if self._path is None:
            file, text = new_file(NEW), start_text(FIRST)
        elif self._path == STDIN:
            text = text_of(STDIN)
            file = new_file(NEW, text)
        elif place_of_case(self._path) == self._path:
            file = read_file(self._path)
            text = file.text
        else:
            file = example(str(self._path))
            text = file.begun
        for setting in self._settings:
            text = _with_setting(text, setting)
        return file, text


def _with_setting(text: str, setting: str) -> str:
    from wearsim.page.toml_source import parsed_tables, with_value

    key, equals, typed = setting.partition("=")
    if not equals or not all(key.strip().split(".")):
        raise OutputError(f"--set {setting}: must have the form table.key=VALUE")
    if parsed_tables(text) is None:
        raise OutputError(f"--set {setting}: the case must be valid TOML for that: correct it first")
    return with_value(text, key.strip(), typed)


def _cases_to_warm() -> tuple[str, ...]:
    from wearsim.cli.init import new_case
    from wearsim.page.toml_source import with_value

    wrap = new_case("08B-1", 19, "wrap")
    for key, least in (("mechanism.phases", "1"), ("sprocket.nodes", "51")):
        wrap = with_value(wrap, key, least)
    return new_case("16B-1", 20, "strand"), wrap
