"""What commands that write one file share: its place, its ending, stdout for ``-``."""

import sys
from pathlib import Path

from wearsim.command.options import warn
from wearsim.errors import OutputError


def check_place(place: Path, source: Path, force: bool) -> None:
    """Raise where a file would be written over another one, or over its own source."""
    from wearsim.files import check_free

    if str(place) == "-":
        return
    check_free(place, force)
    if place.resolve() == source.resolve():
        raise OutputError(f"{place}: must not be the case itself: choose another place")


def format_of(place: Path, given: str | None, known: tuple[str, ...], hint: str) -> str:
    """Return the format of a file by its ending."""
    found = given or place.suffix.removeprefix(".").lower().replace("stp", "step")
    if found not in known:
        endings = ", ".join(f".{name}" for name in known)
        raise OutputError(f"{place}: must end in one of {endings}: choose another name, or {hint}")
    return found


def write_content(place: Path, content: bytes, force: bool) -> None:
    """Write a file, all of it or nothing, and say so; to stdout where the place is ``-``."""
    if str(place) == "-":
        sys.stdout.buffer.write(content)
        return
    from wearsim.files import write_file

    write_file(place, content, force)
    warn(f"written to {place}")
