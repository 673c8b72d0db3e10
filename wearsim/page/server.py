"""The server of the page: on the loopback address, for its own page only."""

import socket
import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path

import uvicorn
from fastapi import FastAPI
from nicegui import app, ui
from starlette.formparsers import MultiPartParser

from wearsim.drive.load_case import load_single
from wearsim.drive.part_life import simulate
from wearsim.errors import WearsimError
from wearsim.input.document import CaseText
from wearsim.page.case_file import CaseFile
from wearsim.page.case_page import CasePage
from wearsim.page.request_guard import MOST_BYTES, Guard

_RECONNECT = 3600.0
"""Seconds that the input of a page is kept after its connection was lost, as when a lid is closed."""


def serve(
    opened: Callable[[], tuple[CaseFile, str]], server_socket: socket.socket, warm: tuple[str, ...]
) -> None:
    """Serve pages until the program is interrupted."""
    stopping = threading.Event()
    MultiPartParser.spool_max_size = MOST_BYTES  # a photograph stays in memory
    ui.page("/", title="wearsim", dark=None, language="en-GB")(partial(_page, opened, stopping))
    app.on_shutdown(stopping.set)
    host = FastAPI(openapi_url=None, docs_url=None, redoc_url=None)
    ui.run_with(host, dark=None, reconnect_timeout=_RECONNECT, show_welcome_message=False)
    # Not sooner: while it starts, nicegui walks through all objects, and a tuple half made breaks by that.
    app.on_startup(threading.Thread(target=_warm_up, args=(warm, stopping), daemon=True).start)
    settings = uvicorn.Config(
        Guard(host, server_socket.getsockname()[1]),
        log_config=None,
        access_log=False,
        proxy_headers=False,
        server_header=False,
        timeout_graceful_shutdown=1,
    )
    uvicorn.Server(settings).run(sockets=[server_socket])


def _page(opened: Callable[[], tuple[CaseFile, str]], stopping: threading.Event) -> None:
    try:
        file, text = opened()
    except WearsimError as error:
        ui.label(str(error))
        return
    CasePage(file, text, stopping)


def _warm_up(texts: tuple[str, ...], stopping: threading.Event) -> None:
    """Load what a first answer needs; a case that fails has done so too."""
    for text in texts:
        if stopping.is_set():
            return
        try:
            simulate(load_single(CaseText(Path("warm.toml"), text), ["run.life_tolerance=0.1"]))
        except WearsimError:
            continue
        except Exception:
            # While the program is taken down a run may fail in any place.
            if not stopping.is_set():
                raise
