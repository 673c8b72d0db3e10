"""What ``wearsim COMMAND --help`` says, as reStructuredText: signs stay signs, an example is a block."""

import re
from typing import Any

from sphinx.application import Sphinx

_STAR = re.compile(r"(?<![*\\])\*(?!\*)")
_SHOWN = ("description", "options", "arguments", "epilog")


def _plain(app: Sphinx, context: Any, lines: list[str]) -> None:
    """Escape what would begin an emphasis, such as the star of ``*.html``."""
    lines[:] = [_STAR.sub(r"\\*", line) for line in lines]


def _example(app: Sphinx, context: Any, lines: list[str]) -> None:
    """Set the commands below ``Example:`` as a block of shell."""
    commands = [line.strip("| ") for line in lines if line.strip("| ").startswith("wearsim ")]
    if commands:
        lines[:] = [".. code-block:: sh", "", *(f"   {command}" for command in commands), ""]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register both."""
    app.setup_extension("sphinx_click")
    for part in _SHOWN:
        app.connect(f"sphinx-click-process-{part}", _plain)
    app.connect("sphinx-click-process-epilog", _example)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
