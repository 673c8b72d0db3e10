"""The trap of comparing tooth forms on a wrap: the chain may end first, whatever the teeth are like."""

from collections.abc import Iterable, Sequence

from wearsim.geometry.forms import TOOTH_FORMS
from wearsim.quantities import grouped
from wearsim.result import Life, WearResult

STOP = "elongation_percent"
"""Limit of the chain."""

FORM_KEYS = {"profile", *(key for form in TOOTH_FORMS.values() for key in (*form.own_keys, *form.options))}
"""Keys of [sprocket] that say which form the teeth have."""


def is_of_form(key: str) -> bool:
    """Whether a dotted key says which form the teeth of a sprocket have.

    Examples
    --------
    >>> is_of_form("sprocket.profile"), is_of_form("sprocket.2.form"), is_of_form("sprocket.teeth")
    (True, True, False)
    """
    return key.startswith("sprocket.") and key.rpartition(".")[2] in FORM_KEYS


def chain_first(stops: Iterable[object]) -> str:
    """Return a warning where the chain ends some of the lives of several tooth forms, else nothing."""
    ends = list(stops)
    count = ends.count(STOP)
    if not count:
        return ""
    return (
        f"the chain ends first in {count} of {len(ends)} cases: their hours are those of the chain and do "
        "not compare tooth forms"
    )


def chain_first_of(results: Sequence[WearResult]) -> str:
    """Return the same of results, with the lives of their sprockets, which do compare forms."""
    forms = [
        tuple((key, str(result.inputs.get("sprocket", {}).get(key))) for key in sorted(FORM_KEYS))
        for result in results
    ]
    text = chain_first(result.stop for result in results) if len(set(forms)) > 1 else ""
    lives = ", ".join(
        f"{grouped(life.hours)} h ({result.case})"
        for result in results
        if isinstance(life := result.parts.get("sprocket"), Life)
    )
    return f"{text}; the sprockets last {lives}" if text and lives else text
