"""How to cite: the facts of CITATION.cff, which stands beside the package or in it."""

import re
from dataclasses import dataclass
from pathlib import Path

import wearsim


@dataclass(frozen=True)
class Citation:
    """How to cite wearsim.

    Attributes
    ----------
    sentence : str
        Authors, title, version, licence.
    file : str
        Text of CITATION.cff, with the source of the method.
    """

    sentence: str
    file: str


def citation(version: str) -> Citation:
    """Return how to cite a result.

    Parameters
    ----------
    version : str
        Of the wearsim that calculated it.

    Returns
    -------
    Citation
        From CITATION.cff.

    Examples
    --------
    >>> citation("0.1.0").sentence
    'The wearsim authors: wearsim, version 0.1.0 (MIT).'
    """
    package = Path(wearsim.__file__).parent
    places = (package / "CITATION.cff", package.parent / "CITATION.cff")
    text = next(path for path in places if path.is_file()).read_text(encoding="utf-8")
    author, title, licence = (
        re.search(rf"^{key}: (.+)$", text, re.MULTILINE) for key in ("  - name", "title", "license")
    )
    assert author and title and licence
    return Citation(f"{author[1]}: {title[1]}, version {version} ({licence[1]}).", text)
