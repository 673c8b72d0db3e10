"""What teeth wear by where only the chain was read: a choice, as no reading tells."""

from typing import Literal

Teeth = Literal["case", "chain"]
"""The coefficient of the case, or that times the factor of the chain."""

TEETH_WORDS: dict[Teeth, str] = {
    "case": "teeth wear as in the case, joints as measured: --teeth case",
    "chain": "teeth wear faster or slower than in the case by the same factor as the joints: --teeth chain",
}
