"""Files in the folder of a run: each lies in it, and is what was written with the others."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from wearsim.files import given_text
from wearsim.input.named_files import lies_inside

_DIGESTS = "sha256"


class RunFiles:
    """Files of a folder, as they are read."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._found: dict[str, str] = {}

    def text(self, name: str, errors: str = "strict") -> str:
        """Return the text of a file; raise as `given_text`, and `ValueError` for a link out of the folder."""
        if not lies_inside(self._folder, name):
            raise ValueError(f"{name} must lie in this folder, but is a link out of it")
        try:
            text = given_text(self._folder / name, errors)
        except UnicodeDecodeError:
            raise ValueError(f"{name} must be UTF-8 text") from None
        self._found[name] = _digest(text.encode("utf-8", "surrogateescape"))
        return text

    def json(self, name: str) -> dict[str, Any]:
        """Return the object in a file."""
        text = self.text(name)
        try:
            content = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise ValueError(f"{name} is not readable JSON: {error}") from None
        if not isinstance(content, dict):
            raise ValueError(f"{name} must hold one JSON object")
        try:
            json.dumps(content, ensure_ascii=False).encode()
        except UnicodeEncodeError:
            raise ValueError(f"{name} must hold whole characters, but holds half of a pair") from None
        return content

    def toml(self, name: str) -> dict[str, Any]:
        """Return the tables in a file."""
        import tomllib

        text = self.text(name)
        try:
            return tomllib.loads(text)
        except (ValueError, RecursionError) as error:
            raise ValueError(f"{name} is not readable TOML: {error}") from None

    def check(self, name: str, stored: Mapping[str, Any]) -> None:
        """Raise `ValueError` where a file that was read is not what was written with the object in this one.

        Earlier versions of wearsim wrote no digests.
        """
        digests = stored.get(_DIGESTS)
        if digests is None:
            return
        for file, digest in {name: _digest_of(stored), **self._others(name)}.items():
            if digests.get(file) != digest:
                raise ValueError(
                    f"{file} must be as wearsim wrote it with the others, but is changed or of another run"
                )

    def _others(self, name: str) -> dict[str, str]:
        return {file: digest for file, digest in self._found.items() if file != name}


def with_digests(
    content: Mapping[str, Any], folder: Path, name: str, others: Iterable[str]
) -> dict[str, Any]:
    """Return the object for a file with the digests of itself and of other files of its folder."""
    digests = {other: _digest((folder / other).read_bytes()) for other in others}
    return {**content, _DIGESTS: {name: _digest_of(content), **digests}}


def _digest_of(content: Mapping[str, Any]) -> str:
    """Return the digest of an object, but for those in it, however it is laid out."""
    own = {key: value for key, value in content.items() if key != _DIGESTS}
    return _digest(json.dumps(own, sort_keys=True).encode())


def _digest(content: bytes) -> str:
    """Return the SHA-256 of a text, the same for all kinds of line ends."""
    plain = content.removeprefix(b"\xef\xbb\xbf").replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return hashlib.sha256(plain).hexdigest()
