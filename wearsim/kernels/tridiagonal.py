"""Linear systems of rows that reach one neighbour on either side, from both ends at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import TABLE, VECTOR, float64, void

if TYPE_CHECKING:
    from wearsim.jit.signatures import Vector

BEFORE, ON, AFTER, ENDS = range(4)
"""Rows of a system: entries before, on and after the diagonal; of its factors also the multipliers of the two
end rows."""


@kernel(void(TABLE, float64, TABLE))
def factorise(rows: Vector, scale: float, factors: Vector) -> None:
    """Factorise I - scale A.

    ``rows``: entries of A before, on and after the diagonal, at least 3 columns. The end rows
    may reach two places inwards: ``rows[0, 0]`` is A[0, 2] and ``rows[2, -1]`` is A[-1, -3];
    each is eliminated by the row beside it, which must not vanish there. Elimination runs
    from both ends to the middle, so that two chains of operations overlap. ``factors``, 4 rows:
    multipliers of the elimination, reciprocal pivots, multipliers of the substitution, and
    those of the two end rows.
    """
    n = rows.shape[1]
    middle = n // 2
    for j in range(n):
        factors[BEFORE, j] = -scale * rows[BEFORE, j]
        factors[ON, j] = 1.0 - scale * rows[ON, j]
        factors[AFTER, j] = -scale * rows[AFTER, j]
    first = factors[BEFORE, 0] / factors[AFTER, 1] if factors[BEFORE, 0] != 0.0 else 0.0
    last = factors[AFTER, n - 1] / factors[BEFORE, n - 2] if factors[AFTER, n - 1] != 0.0 else 0.0
    top, bottom = factors[ON, 1], factors[ON, n - 2]
    factors[ON, 0] -= first * factors[BEFORE, 1]
    factors[AFTER, 0] -= first * top
    factors[ON, n - 1] -= last * factors[AFTER, n - 2]
    factors[BEFORE, n - 1] -= last * bottom
    factors[ON, 0] = 1.0 / factors[ON, 0]
    factors[ON, n - 1] = 1.0 / factors[ON, n - 1]
    down, up = factors[ON, 0], factors[ON, n - 1]
    for i in range(1, n - 1 - middle):
        k = n - 1 - i
        factors[BEFORE, i] *= down
        factors[AFTER, k] *= up
        down = 1.0 / (factors[ON, i] - factors[BEFORE, i] * factors[AFTER, i - 1])
        up = 1.0 / (factors[ON, k] - factors[AFTER, k] * factors[BEFORE, k + 1])
        factors[ON, i], factors[ON, k] = down, up
    for i in range(n - 1 - middle, middle):
        factors[BEFORE, i] *= down
        down = 1.0 / (factors[ON, i] - factors[BEFORE, i] * factors[AFTER, i - 1])
        factors[ON, i] = down
    factors[BEFORE, middle] *= factors[ON, middle - 1]
    factors[AFTER, middle] *= factors[ON, middle + 1]
    factors[ON, middle] = 1.0 / (
        factors[ON, middle]
        - factors[BEFORE, middle] * factors[AFTER, middle - 1]
        - factors[AFTER, middle] * factors[BEFORE, middle + 1]
    )
    for j in range(middle):
        factors[AFTER, j] *= factors[ON, j]
    for j in range(middle + 1, n):
        factors[BEFORE, j] *= factors[ON, j]
    factors[ENDS, 0], factors[ENDS, n - 1] = first, last


@kernel(void(TABLE, VECTOR))
def solve(factors: Vector, right: Vector) -> None:
    """Replace the right side by the solution."""
    n = right.size
    middle = n // 2
    before, inverse, after = factors[BEFORE], factors[ON], factors[AFTER]
    down = right[0] - factors[ENDS, 0] * right[1]
    up = right[n - 1] - factors[ENDS, n - 1] * right[n - 2]
    right[0], right[n - 1] = down, up
    for i in range(1, n - 1 - middle):
        k = n - 1 - i
        down = right[i] - before[i] * down
        up = right[k] - after[k] * up
        right[i], right[k] = down, up
    for i in range(n - 1 - middle, middle):
        down = right[i] - before[i] * down
        right[i] = down
    right[middle] -= before[middle] * right[middle - 1] + after[middle] * right[middle + 1]
    for j in range(n):
        right[j] *= inverse[j]
    down = up = right[middle]
    for i in range(1, n - middle):
        down = right[middle + i] - before[middle + i] * down
        up = right[middle - i] - after[middle - i] * up
        right[middle + i], right[middle - i] = down, up
    for j in range(n - middle, middle + 1):
        right[middle - j] -= after[middle - j] * right[middle - j + 1]
