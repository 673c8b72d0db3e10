"""The file of a case: read, compared with what is on disk, written."""

import tomllib
from dataclasses import dataclass, replace
from pathlib import Path

from wearsim.catalogue.shipped_cases import shipped_cases
from wearsim.errors import CaseError, Fault, OutputError
from wearsim.files import given_bytes, write_file
from wearsim.input.document import leaves

_EDITED = ("cases", "drives")
"""Folders of shipped cases whose keys the form has."""

NEW = Path("drive.toml")
"""Where a new case stands before it is saved."""

FIRST = {"lubrication": "oil bath"}
"""What is known of the drive that the page opens with: with the lubrication that is recommended for it."""


@dataclass(frozen=True)
class CaseFile:
    """A file and what it held when it was last read or written."""

    path: Path  # its place, there or not
    content: bytes | None  # none where it was not there
    ends: str = "\n"  # what ends its lines when it is written
    origin: str = ""  # text that it was made from where it was not there

    @property
    def text(self) -> str:
        """Its text, lines ended as in Python."""
        if self.content is None:
            return ""
        return self.content.decode("utf-8-sig").replace("\r\n", "\n")

    @property
    def is_blank(self) -> bool:
        """Whether it begins with nothing."""
        return self.content is None and not self.origin

    @property
    def begun(self) -> str:
        """Text that its title was written for."""
        return self.origin if self.content is None else self.text

    @property
    def changed(self) -> bool:
        """Whether the disk holds something else by now."""
        return _content(self.path) != self.content

    def renamed(self, path: Path) -> "CaseFile":
        """Return a file of another name that is to be written with the same line ends."""
        return replace(self, path=path, content=None, origin=self.begun)

    def saved(self, text: str) -> "CaseFile":
        """Write the file, whatever the disk holds."""
        content = text.replace("\r\n", "\n").replace("\n", self.ends).encode("utf-8", "replace")
        # A link stays one: what it leads to is replaced.
        write_file(self.path.resolve(), content, force=True)
        return replace(self, content=content)


def read_file(path: Path) -> CaseFile:
    """Return a file as it is on disk."""
    try:
        content = given_bytes(path)
        file = CaseFile(path, content, "\r\n" if b"\r\n" in content else "\n")
        _ = file.text
    except OSError as error:
        message = f"must be a readable file: {error.strerror}"
        raise CaseError([Fault(message, "", str(path))]) from None
    except UnicodeDecodeError:
        raise CaseError([Fault("must be UTF-8 text: save it as UTF-8", "", str(path))]) from None
    return file


def new_file(path: Path, origin: str = "") -> CaseFile:
    """Return a file that is to be written, of a text that it begins with."""
    return CaseFile(path, None, origin=origin)


def example(name: str) -> CaseFile:
    """Return a shipped case as a new file: it is changed in a file of one's own."""
    return new_file(Path(f"{name}.toml"), read_file(shipped_cases()[name]).text)


def example_titles() -> dict[str, str]:
    """Return the titles of the shipped cases that a page can begin with, by their names.

    A case that names other files beside it is none of them: they stay where wearsim is.
    """
    found = {}
    for name, path in shipped_cases().items():
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
        if path.parent.name in _EDITED and not any(key.endswith("_file") for key, _ in leaves(tables)):
            found[name] = tables["title"]
    return found


def named_beside(path: Path, name: str) -> Path:
    """Return the place of a file in the folder of another, which paths in the case are relative to.

    Examples
    --------
    >>> named_beside(Path("drives/a.toml"), "b").as_posix()
    'drives/b.toml'
    """
    wanted = name.strip().removesuffix(".toml")
    if not wanted.strip(".") or any(mark in wanted for mark in '/\\:\0\n*?"<>|'):
        raise OutputError(
            f"{name!r}: must be the name of a file in {path.parent.resolve()}, without a folder: the "
            "files that a case names are found relative to it"
        )
    return path.with_name(f"{wanted}.toml")


def _content(path: Path) -> bytes | None:
    """What is there, empty where it cannot be read; None where there is nothing."""
    try:
        return given_bytes(path)
    except FileNotFoundError:
        return None
    except OSError:
        return b""
