"""Files: those that a user gives are read, and what is written is old, new or nothing at every moment."""

import contextlib
import csv
import errno
import hashlib
import io
import os
import re
import shutil
import stat
import sys
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import IO

from wearsim._version import __version__
from wearsim.errors import OutputError

MOST_BYTES = 50_000_000
"""Of a file that a user gives, if nothing else is said: some three million rows of two numbers."""

MOST_ROWS = 2_000_000
"""Of a table that a user gives: it takes some hundred megabytes in memory."""


def check_given(path: Path, most: int = MOST_BYTES) -> None:
    """Look at a file that a user gives before it is opened.

    Raises
    ------
    OSError
        It cannot be read, is larger than that, or is no regular file, which is not opened: a pipe that nobody
        writes to would wait for ever, and a device may have no end.
    """
    status = path.stat()
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(status.st_mode):
        raise OSError(errno.EINVAL, "it is a pipe or a device, not a regular file")
    if status.st_size > most:
        raise OSError(errno.EFBIG, f"it has {status.st_size / 1e6:.3g} MB, {most / 1e6:.3g} MB are the most")


def given_bytes(path: Path, most: int = MOST_BYTES) -> bytes:
    """Return a file that a user gives, or raise as `check_given`."""
    check_given(path, most)
    return path.read_bytes()


def given_text(path: Path, errors: str = "strict") -> str:
    """Return the UTF-8 text of a file that a user gives, as `given_bytes`, with line ends of one kind."""
    text = given_bytes(path).decode("utf-8-sig", errors)
    return text.replace("\r\n", "\n").replace("\r", "\n")


def given_lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    """Yield the cells of every line of a CSV file that a user gives, with the number of the line.

    Raises
    ------
    OSError, ValueError, csv.Error
        It cannot be read, is no UTF-8 or no CSV.
    """
    content = given_bytes(path)
    rows = max(content.count(b"\n"), content.count(b"\r"))
    if rows > MOST_ROWS:
        raise OSError(errno.EFBIG, f"it has {rows} rows, {MOST_ROWS} are the most")
    reader = csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""))
    yield from ((reader.line_num, line) for line in reader)


def check_free(path: Path, force: bool) -> None:
    """Raise where something is in the way."""
    try:
        with contextlib.suppress(FileNotFoundError, NotADirectoryError, ValueError):
            path.stat()  # raises for links in a loop, of which exists() is silent
        taken = path.exists()
        file = next((parent for parent in path.parents if parent.is_file()), None)
    except OSError as error:
        raise OutputError(f"{path}: must be reachable: {error.strerror}") from None
    if file is not None:
        raise OutputError(f"{path}: must lie in a folder, but {file} is a file: choose another place")
    if taken and not force:
        raise OutputError(f"{path}: must not exist yet, but does: choose another place or --force")


def check_file(path: Path, force: bool) -> None:
    """Raise where a file cannot be written or replaced."""
    check_free(path, force)
    if path.is_dir():
        raise OutputError(f"{path}: must be a file, but is a folder: choose another place")


MARKER = ".wearsim"
"""File in every folder of wearsim: a head with who wrote it, then the names of the files, one a line."""


def mark(folder: Path, names: Iterable[str]) -> None:
    """Note in the marker of a folder which files wearsim writes there; those that are gone fall out."""
    head = f"written by wearsim {__version__}, with --force replaced or removed:"
    kept = {name for name in written(folder) if (folder / name).exists()}
    lines = (head, *sorted({*kept, *names} - {MARKER}), "")
    write_file(folder / MARKER, os.fsencode("\n".join(lines)), force=True)


def written(folder: Path) -> set[str]:
    """Return the names that the marker of a folder holds and its own; none where there is no marker."""
    marker = folder / MARKER
    if not marker.is_file():
        return set()
    try:
        content = given_bytes(marker, _MOST_MARKER)
    except OSError as error:
        raise OutputError(f"{marker}: must be readable: {error.strerror or error}") from None
    return {MARKER, *os.fsdecode(content).splitlines()[1:]}


_MOST_MARKER = 5_000_000
"""Bytes of a marker: the names of some hundred thousand files."""


def check_folder(folder: Path, force: bool) -> None:
    """Raise where a folder cannot be made or replaced without loss."""
    check_free(folder, force)
    if not folder.exists():
        return
    if not folder.is_dir():
        raise OutputError(f"{folder}: must be a folder to be replaced, but is a file: choose another place")
    own = written(folder)
    foreign = next((name for name in _names(folder) if name not in own), None)
    if foreign is not None:
        raise OutputError(
            f"{folder}: must hold nothing but what its file {MARKER} lists to be replaced, but holds "
            f"{foreign}: move that away, or choose another place"
        )
    if Path.cwd().is_relative_to(folder.resolve()):
        raise OutputError(f"{folder}: must not be the folder you are in: choose another place")


def _names(folder: Path) -> Iterator[str]:
    """Give the names of the files in a folder and below, and of the folders that hold nothing."""
    for path in folder.rglob("*"):
        if path.is_symlink() or not path.is_dir() or not any(path.iterdir()):
            yield path.relative_to(folder).as_posix()


@contextlib.contextmanager
def temporary_folder() -> Iterator[Path]:
    """Give a folder that is gone afterwards, or raise `OutputError` where there is no place for one."""
    try:
        made = tempfile.TemporaryDirectory()
    except OSError as error:
        reason = error.strerror or error
        raise OutputError(f"temporary folder: must be writable: {reason}: set TMPDIR to a folder") from None
    with made as folder:
        yield Path(folder)


@contextlib.contextmanager
def new_folder(folder: Path, force: bool) -> Iterator[Path]:
    """Give a temporary folder that takes its final name when all of it is written.

    What a killed process left of the same folder is cleared away first.
    """
    with contextlib.suppress(OSError):
        _clear_beside(folder.resolve())
    check_folder(folder, force)
    folder = folder.resolve()
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with (
            tempfile.TemporaryDirectory(prefix=_prefix(folder), dir=folder.parent) as beside,
            _held(Path(beside)),
        ):
            new, old = Path(beside) / "new", Path(beside) / "old"
            new.mkdir()
            yield new
            mark(new, _names(new))
            try:
                if folder.exists():
                    os.rename(folder, old)
                os.rename(new, folder)
            except BaseException:
                if old.exists() and not folder.exists():
                    os.rename(old, folder)
                raise
            if old.exists():
                # From here on a killed process must not bring it back.
                os.rename(old, Path(beside) / "replaced")
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        raise OutputError(f"{folder}: must be writable: {error.strerror or error}") from None


_LOCK = "writer.lock"
"""File in a folder beside that its writer holds locked as long as it lives."""


@contextlib.contextmanager
def _held(beside: Path) -> Iterator[None]:
    """Hold the lock of a folder beside, named only when it is held; none where there are no locks."""
    with (beside / "unheld").open("wb") as file:
        with contextlib.suppress(OSError):
            if _lock(file):
                os.rename(file.name, beside / _LOCK)
        yield


def _lock(file: IO[bytes]) -> bool:
    """Lock a file if nobody holds it; the system takes the lock back from a process that ends."""
    if sys.platform == "win32":
        return False
    import fcntl

    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def _clear_beside(folder: Path) -> None:
    """Remove what killed writers left beside a folder; what they had moved aside comes back."""
    for lock in folder.parent.glob(f"{_prefix(folder)}*/{_LOCK}"):
        beside, old = lock.parent, lock.parent / "old"
        if not lock.is_file():
            continue  # A pipe would be waited for.
        with contextlib.suppress(OSError), lock.open("rb") as file:
            if not _lock(file):
                continue
            if old.exists() and not folder.exists():
                os.rename(old, folder)
            shutil.rmtree(beside, ignore_errors=True)


def file_names(cases: Sequence[str]) -> list[str]:
    """Return names of files for cases, all different whatever the file system makes of capitals.

    Examples
    --------
    >>> file_names(["drive", "Drive", "index", "a/b <c>"])
    ['drive', 'Drive-2', 'index-2', 'a_b_c_']
    """
    taken, found = {"index"}, []
    for case in cases:
        stem = re.sub(r"[^\w.-]+", "_", case).lstrip(".") or "drive"
        number, name = 1, stem
        while name.lower() in taken:
            number += 1
            name = f"{stem}-{number}"
        taken.add(name.lower())
        found.append(name)
    return found


Content = str | bytes | Iterable[str]
"""Of a file; texts in parts are written as they come."""


def write_file(path: Path, content: Content, force: bool) -> None:
    """Write a file beside its place and rename it."""
    check_free(path, force)
    if path.exists() and not path.is_file():
        raise OutputError(f"{path}: must be a file, but is none: choose another place, or -")
    parts = [content] if isinstance(content, str | bytes) else content
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with new_file(path) as file:
            for part in parts:
                file.write(part.encode("utf-8") if isinstance(part, str) else part)
    except OSError as error:
        raise OutputError(f"{path}: must be writable: {error.strerror or error}") from None


@contextlib.contextmanager
def new_file(path: Path) -> Iterator[IO[bytes]]:
    """Give a file beside a place that takes its name when all of it is written."""
    _clear_left(path)
    handle, beside = tempfile.mkstemp(prefix=_prefix(path), dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            _lock(file)
            yield file
        os.chmod(beside, 0o666 & ~_umask())
        os.replace(beside, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(beside)
        raise


_OLD = 10.0
"""Age of a file beside another [s] at which its writer holds its lock, or has been killed.

One from later than now was there before the clock was set back.
"""


def left_beside(path: Path) -> list[Path]:
    """Return what writers of a file have beside it, or left there when they were killed."""
    return [left for left in path.parent.glob(f"{_prefix(path)}{'[a-z0-9_]' * 8}") if left.is_file()]


def _prefix(path: Path) -> str:
    """Return how the names begin of what is beside a file or folder while it is written.

    Nobody else chooses such a name, so that what is left can be removed; it fits where a longest name fits.
    """
    return f"{MARKER}-{hashlib.sha256(os.fsencode(path.name)).hexdigest()[:12]}-"


def _clear_left(path: Path) -> None:
    """Remove what killed writers left beside a file."""
    for left in left_beside(path):
        with contextlib.suppress(OSError), left.open("rb") as file:
            if abs(time.time() - left.stat().st_mtime) > _OLD and _lock(file):
                left.unlink()


_UMASK = threading.Lock()


def _umask() -> int:
    # It can be read only by setting it, for all threads.
    with _UMASK:
        mask = os.umask(0)
        os.umask(mask)
    return mask
