"""What all pages take their templates from."""

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from wearsim.report.text_lines import pages_kept

_TEMPLATES = Path(__file__).with_name("templates")


def environment(*folders: Path) -> Environment:
    """Return the templates of all pages and those of some folders, with the filter ``kept``."""
    found = Environment(
        loader=FileSystemLoader([*folders, _TEMPLATES]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    found.filters["kept"] = pages_kept
    return found
