"""Modules of the page are looked through for examples where they have some and its library is not missed."""

from importlib.util import find_spec
from pathlib import Path

import pytest


def _looked_through(path: Path) -> bool:
    text = path.read_text(encoding="utf-8")
    return ">>> " in text and (find_spec("nicegui") is not None or "nicegui" not in text)


_PAGE = Path(__file__).parent / "wearsim" / "page"

collect_ignore = [str(path) for path in sorted(_PAGE.glob("*.py")) if not _looked_through(path)]


@pytest.fixture(scope="module")
def catalogue_as_before():
    """The catalogue without what a test adds to it: lubricants and wear laws of a program."""
    from wearsim.catalogue.catalogues import lubricants, wear_laws
    from wearsim.catalogue.own_wear_laws import _LAWS

    yield
    for name in [name for name, row in lubricants().items() if row.is_own]:
        del lubricants()[name]
    for name in list(_LAWS):
        del _LAWS[name], wear_laws()[name]


@pytest.fixture(autouse=True)
def _examples_leave_nothing(request):
    """Laws and lubricants that an example adds are gone after it."""
    if isinstance(request.node, pytest.DoctestItem):
        request.getfixturevalue("catalogue_as_before")
