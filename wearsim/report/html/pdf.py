"""A page as PDF, printed by the browser that the machine has."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from wearsim.errors import OutputError
from wearsim.files import check_file, write_file

_NAMES = (
    *("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"),
    *("microsoft-edge", "microsoft-edge-stable", "msedge"),
)
"""Commands of browsers that print without a window."""

_PLACES = {
    "darwin": (
        "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
        "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
        "/Applications/Chromium.app/Contents/MacOS/Chromium",
    ),
    "win32": (
        r"C:\Program Files\Google\Chrome\Application\chrome.exe",
        r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
        r"C:\Program Files\Microsoft\Edge\Application\msedge.exe",
    ),
}
"""Where systems keep these browsers that are not on the path of commands."""

_OPTIONS = (
    *("--headless", "--disable-gpu", "--no-first-run", "--no-default-browser-check"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    "--no-pdf-header-footer",
)

_LONGEST = 120.0
"""Seconds after which a browser that prints is given up."""


def is_pdf(out: Path) -> bool:
    """Tell whether a place is one for a PDF."""
    return out.suffix.lower() == ".pdf"


def is_page(out: Path) -> bool:
    """Tell whether a place is one for a single page and not for a folder."""
    return out.suffix.lower() in (".html", ".htm")


def check_pdf(out: Path, force: bool) -> None:
    """Raise where a PDF cannot be written or replaced, or nothing can print it."""
    check_file(out, force)
    _browser(out)


def save_pdf(page: str, out: Path, force: bool) -> None:
    """Print a page of HTML into a file, all of it or nothing."""
    browser = _browser(out)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        # Beside the file and not hidden: a browser in a sandbox of its own may read nothing else.
        with tempfile.TemporaryDirectory(
            prefix="wearsim-print-", dir=out.resolve().parent, ignore_cleanup_errors=True
        ) as beside:
            write_file(out, _printed(browser, page, Path(beside), out), force)
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        raise OutputError(f"{out}: must be writable: {error.strerror or error}") from None


def _browser(out: Path) -> str:
    for place in (*[shutil.which(name) for name in _NAMES], *_PLACES.get(sys.platform, ())):
        if place and Path(place).is_file():
            return str(place)
    raise OutputError(
        f"{out}: a PDF must be printed by Chromium, Chrome or Edge, and none is installed: "
        "install one, or give --out sheet.html and print that page"
    )


def _printed(browser: str, page: str, folder: Path, out: Path) -> bytes:
    source, target = folder / "sheet.html", folder / "sheet.pdf"
    source.write_text(page, encoding="utf-8", newline="\n")
    command = [
        *(browser, *_OPTIONS, *(["--no-sandbox"] if _is_root() else [])),
        *(f"--user-data-dir={folder / 'profile'}", f"--print-to-pdf={target}", source.as_uri()),
    ]
    try:
        done = subprocess.run(command, capture_output=True, timeout=_LONGEST, check=False)
    except subprocess.TimeoutExpired:
        raise OutputError(
            f"{out}: {browser} must print within {_LONGEST:g} s, and did not: give --out sheet.html"
        ) from None
    if done.returncode or not target.is_file():
        said = done.stderr.decode(errors="replace").strip().splitlines()
        raise OutputError(
            f"{out}: {browser} must print the page, and did not (exit code {done.returncode}, "
            f"{said[-1] if said else 'no message'}): give --out sheet.html and print that page"
        )
    return target.read_bytes()


def _is_root() -> bool:
    """Tell whether the user is root, for whom Chromium has no sandbox; the page holds no script of others."""
    return hasattr(os, "geteuid") and os.geteuid() == 0
