"""Keys of a contact stress that is prescribed along a line of action."""

import itertools


def stress_conflicts(
    stress: tuple[float, ...], distance: tuple[float, ...] | None, names: tuple[str, str]
) -> list[tuple[str, str]]:
    """Return what is wrong with stresses and the distances from the pole at which they are given."""
    found = []
    if not all(value > 0.0 for value in stress) or not stress:
        found.append((names[0], f"must be above 0 (got {listed(stress)})"))
    if distance is None:
        if len(stress) > 1:
            found.append((names[1], "several stresses need one distance for each"))
        return found
    if len(distance) != len(stress):
        message = f"must have one entry for each stress, {len(stress)} (got {len(distance)})"
        found.append((names[1], message))
    if not all(a < b for a, b in itertools.pairwise(distance)):
        found.append((names[1], f"must ascend (got {listed(distance)})"))
    return found


def listed(values: tuple[float, ...]) -> str:
    """Return numbers as a fault names them."""
    return ", ".join(f"{value:g}" for value in values) or "nothing"
