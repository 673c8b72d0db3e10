"""Linear systems of rows that reach one neighbour on either side, from both ends at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wearsim.kernels.compiled import kernel
from wearsim.kernels.signatures import TABLE, VECTOR, float64, void

if TYPE_CHECKING:
    from wearsim.kernels.signatures import Vector


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
        factors[0, j] = -scale * rows[0, j]
        factors[1, j] = 1.0 - scale * rows[1, j]
        factors[2, j] = -scale * rows[2, j]
    first = factors[0, 0] / factors[2, 1] if factors[0, 0] != 0.0 else 0.0
    last = factors[2, n - 1] / factors[0, n - 2] if factors[2, n - 1] != 0.0 else 0.0
    top, bottom = factors[1, 1], factors[1, n - 2]
    factors[1, 0] -= first * factors[0, 1]
    factors[2, 0] -= first * top
    factors[1, n - 1] -= last * factors[2, n - 2]
    factors[0, n - 1] -= last * bottom
    factors[1, 0] = 1.0 / factors[1, 0]
    factors[1, n - 1] = 1.0 / factors[1, n - 1]
    down, up = factors[1, 0], factors[1, n - 1]
    for i in range(1, n - 1 - middle):
        k = n - 1 - i
        factors[0, i] *= down
        factors[2, k] *= up
        down = 1.0 / (factors[1, i] - factors[0, i] * factors[2, i - 1])
        up = 1.0 / (factors[1, k] - factors[2, k] * factors[0, k + 1])
        factors[1, i], factors[1, k] = down, up
    for i in range(n - 1 - middle, middle):
        factors[0, i] *= down
        down = 1.0 / (factors[1, i] - factors[0, i] * factors[2, i - 1])
        factors[1, i] = down
    factors[0, middle] *= factors[1, middle - 1]
    factors[2, middle] *= factors[1, middle + 1]
    factors[1, middle] = 1.0 / (
        factors[1, middle]
        - factors[0, middle] * factors[2, middle - 1]
        - factors[2, middle] * factors[0, middle + 1]
    )
    for j in range(middle):
        factors[2, j] *= factors[1, j]
    for j in range(middle + 1, n):
        factors[0, j] *= factors[1, j]
    factors[3, 0], factors[3, n - 1] = first, last


@kernel(void(TABLE, VECTOR))
def solve(factors: Vector, right: Vector) -> None:
    """Replace the right side by the solution."""
    n = right.size
    middle = n // 2
    before, inverse, after = factors[0], factors[1], factors[2]
    down = right[0] - factors[3, 0] * right[1]
    up = right[n - 1] - factors[3, n - 1] * right[n - 2]
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
