"""Libraries that not every user has: installed by ``pip install 'wearsim[EXTRA]'``."""

from importlib import import_module
from typing import Any

from wearsim.errors import CaseError, Fault


def library(module: str, extra: str, option: str) -> Any:
    """Return a library of an extra.

    Parameters
    ----------
    module : str
        Its name in Python.
    extra : str
        The extra of wearsim that it belongs to.
    option : str
        What needs it, as the user wrote it.

    Returns
    -------
    module
        The library.

    Raises
    ------
    CaseError
        It is not installed.

    Examples
    --------
    >>> library("math", "report", "--xlsx").sqrt(9.0)
    3.0
    """
    try:
        return import_module(module)
    except ImportError:
        text = f"needs {module}, which is not installed: pip install 'wearsim[{extra}]'"
        raise CaseError([Fault(text, file=option)]) from None
