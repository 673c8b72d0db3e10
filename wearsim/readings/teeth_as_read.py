"""What teeth wear by where only the chain was read: a choice, as no reading tells."""

from typing import Literal

Teeth = Literal["case", "chain"]
"""The coefficient of the case, or that times the factor of the chain."""

TEETH_WORDS: dict[Teeth, str] = {
    "case": "teeth wear as the case says, and joints as was read: --teeth case",
    "chain": "teeth wear as much faster or slower than the case says as the joints do: --teeth chain",
}
