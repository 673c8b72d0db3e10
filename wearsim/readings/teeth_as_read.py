"""What teeth wear by where only the chain was read: a choice, as no reading tells."""

from collections.abc import Iterator
from typing import Literal

Teeth = Literal["case", "chain"]
"""The coefficient of the case, or that times the factor of the chain."""

TEETH_WORDS: dict[Teeth, str] = {
    "case": "teeth wear as in the case, joints as measured: --teeth case",
    "chain": "teeth wear faster or slower than in the case by the same factor as the joints: --teeth chain",
}

_FAR = 2.0
"""Factor between chain and case from which teeth by the case alone are doubtful."""


def teeth_warning(factor: float, teeth: Teeth) -> Iterator[str]:
    """Say that teeth are left to a case that the readings of the chain contradict.

    Examples
    --------
    >>> [text[:74] for text in teeth_warning(10.0, "case")]
    ['the chain wears 10 times as fast as the case says, but the teeth are taken']
    >>> list(teeth_warning(10.0, "chain"))
    []
    """
    if teeth == "case" and not 1.0 / _FAR <= factor <= _FAR:
        yield (
            f"the chain wears {factor:.3g} times as fast as the case says, but the teeth are taken to wear "
            "as the case says: --teeth chain takes that factor for them too; to know, measure the teeth and "
            "fit their coefficient with wearsim calibrate"
        )
