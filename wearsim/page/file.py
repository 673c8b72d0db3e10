"""The file of a case: read, compared with what is on disk, written."""

from dataclasses import dataclass, replace
from pathlib import Path

from wearsim.errors import CaseError, Fault, OutputError
from wearsim.files import write_file


@dataclass(frozen=True)
class CaseFile:
    """A file and what it held when it was last read or written.

    Attributes
    ----------
    path : pathlib.Path
        Its place, there or not.
    content : bytes or None
        None where it was not there.
    ends : str
        What ends its lines when it is written.
    """

    path: Path
    content: bytes | None
    ends: str = "\n"

    @property
    def text(self) -> str:
        """Its text, lines ended as in Python."""
        if self.content is None:
            return ""
        return self.content.decode("utf-8-sig").replace("\r\n", "\n")

    @property
    def changed(self) -> bool:
        """Whether the disk holds something else by now."""
        return _content(self.path) != self.content

    def renamed(self, path: Path) -> "CaseFile":
        """Return a file of another name that is to be written with the same line ends.

        Parameters
        ----------
        path : pathlib.Path
            Its place, taken or not.

        Returns
        -------
        CaseFile
            One that was not there, so that one that is there has changed.
        """
        return replace(self, path=path, content=None)

    def saved(self, text: str) -> "CaseFile":
        """Write the file, whatever the disk holds.

        Parameters
        ----------
        text : str
            All of it.

        Returns
        -------
        CaseFile
            As it is on disk now; line ends of Windows are kept, a mark before the text is not.

        Raises
        ------
        OutputError
            It cannot be written.
        """
        content = text.replace("\r\n", "\n").replace("\n", self.ends).encode("utf-8", "replace")
        # A link stays one: what it leads to is replaced.
        write_file(self.path.resolve(), content, force=True)
        return replace(self, content=content)


def read_file(path: Path) -> CaseFile:
    """Return a file as it is on disk.

    Parameters
    ----------
    path : pathlib.Path
        Its place.

    Returns
    -------
    CaseFile
        What it holds.

    Raises
    ------
    CaseError
        It is not there or holds no UTF-8 text.
    """
    try:
        content = path.read_bytes()
        file = CaseFile(path, content, "\r\n" if b"\r\n" in content else "\n")
        _ = file.text
    except OSError as error:
        message = f"must be a readable file: {error.strerror}"
        raise CaseError([Fault(message, "", str(path))]) from None
    except UnicodeDecodeError:
        raise CaseError([Fault("must be UTF-8 text: save it as UTF-8", "", str(path))]) from None
    return file


def new_file(path: Path) -> CaseFile:
    """Return a file that is to be written.

    Parameters
    ----------
    path : pathlib.Path
        Its place, taken or not.

    Returns
    -------
    CaseFile
        One that was not there, so that one that is there has changed.
    """
    return CaseFile(path, None)


def named_beside(path: Path, name: str) -> Path:
    """Return the place of a file in the folder of another, which paths in the case are relative to.

    Parameters
    ----------
    path : pathlib.Path
        The other file.
    name : str
        A file name; ``.toml`` is added where it is missing.

    Returns
    -------
    pathlib.Path
        Its place.

    Raises
    ------
    OutputError
        It is no name, or one of another folder.

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
        return path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError:
        return b""
