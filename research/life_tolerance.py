"""Is ``life_tolerance`` met: the distribution over random feasible cases.

Run from a checkout with ``python research/life_tolerance.py`` (some minutes); it writes
reports/reference/life_tolerance.md.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from importlib.metadata import version
from pathlib import Path

import numpy as np
from random_lives import CASES, ROUNDING, SEED, STEPS, Measured, measured

FILE = Path(__file__).parent.parent / "reports" / "reference" / "life_tolerance.md"
QUANTILES = {"median": 0.5, "90 %": 0.9, "99 %": 0.99, "largest": 1.0}
LIBRARIES = ("wearsim", "numpy", "scipy", "numba")
WORST = 5

HEAD = f"""# Is `life_tolerance` met

Made by `python research/life_tolerance.py`, with {{versions}}.

{CASES} random feasible cases, seed {SEED}: evolute flanks on a strand, the same from points, and tables
of load and sliding; all laws, some with a hardened layer, running-in and further limits; 61 to 401
points, tolerance t of 1e-5 to 1e-2. Each is run as it is, for the life L; with t/10 and four times
the points (4K - 3; above 801 twice, 2K - 1) to begin with, which gives Lg; and on its own points, not
refined, with t and t/10: Lo, Ls. A run that ends at the horizon counts with its greatest depth.

- The steps keep to their share of the tolerance where |Lo/Ls - 1| is at most {STEPS:g} t, and to the
  numerical error that the result states where it is not above that.
- The life meets its tolerance where |L/Lg - 1| is at most t, unless the result warns that its
  numerical error exceeds t: the nodes are the user's choice.
- The stated error holds where |L/Lg - 1| is not above it, or not above t.

{ROUNDING:g} is allowed for rounding. Chains around a sprocket are not among the cases: one of them
takes seconds.
"""

Figure = Callable[[Measured], float]


def steps(case: Measured) -> float:
    return case.steps / case.draw.tolerance


def total(case: Measured) -> float:
    return case.total / case.draw.tolerance


def over_stated(case: Measured) -> float:
    return case.total / case.allowed


def table(head: Sequence[str], rows: Sequence[Sequence[object]]) -> list[str]:
    lines = [f"| {' | '.join(map(str, row))} |" for row in (head, *rows)]
    return [lines[0], "|---" * len(head) + "|", *lines[1:], ""]


def quantiles(what: str, cases: Sequence[Measured], figure: Figure) -> list[object]:
    values = [figure(case) for case in cases]
    return [what, len(values), *(f"{np.quantile(values, part):.2g}" for part in QUANTILES.values())]


def distribution(cases: Sequence[Measured]) -> list[str]:
    silent = [case for case in cases if not case.warned]
    warned = [case for case in cases if case.warned]
    rows = [
        quantiles("steps, over t", cases, steps),
        quantiles("steps and grid, over t", cases, total),
        quantiles("the same without a warning", silent, total),
        quantiles("the same with a warning", warned, total),
        quantiles("steps and grid, over the larger of t and the error stated", cases, over_stated),
    ]
    for kind in dict.fromkeys(case.draw.kind for case in cases):
        of_kind = [case for case in cases if case.draw.kind == kind]
        rows.append(quantiles(f"steps, over t: {kind}", of_kind, steps))
        rows.append(quantiles(f"steps and grid, over t: {kind}", of_kind, total))
    return ["## Relative errors", "", *table(("error", "cases", *QUANTILES), rows)]


def counts(cases: Sequence[Measured]) -> list[str]:
    t = [case.draw.tolerance for case in cases]
    rows = [
        (f"steps above {STEPS:g} t", sum(steps(case) > STEPS for case in cases)),
        ("steps above the error stated", sum(case.steps > case.stated + ROUNDING for case in cases)),
        ("warned that the numerical error exceeds t", sum(case.warned for case in cases)),
        ("steps and grid above t", sum(total(case) > 1.0 for case in cases)),
        ("the same without a warning", sum(total(case) > 1.0 and not case.warned for case in cases)),
        ("steps and grid above t and the error stated", sum(over_stated(case) > 1.0 for case in cases)),
        ("ended at the horizon", sum(case.stop == "horizon_hours" for case in cases)),
        ("t below 1e-4", sum(tolerance < 1e-4 for tolerance in t)),
    ]
    return ["## Numbers of cases", "", *table((f"of {len(cases)}", "cases"), rows)]


def worst(title: str, cases: Sequence[Measured], figure: Figure) -> list[str]:
    head = ("case", "what it is", "points", "ends on", "t", "steps", "all", "stated", "warned")
    rows = [
        (
            case.name,
            case.draw.what,
            case.draw.points,
            case.stop,
            f"{case.draw.tolerance:.2g}",
            f"{case.steps:.2g}",
            f"{case.total:.2g}",
            f"{case.stated:.2g}",
            "yes" if case.warned else "no",
        )
        for case in sorted(cases, key=figure, reverse=True)[:WORST]
    ]
    return [f"## Worst {title}", "", *table(head, rows)]


def redrawn(refused: Counter[str]) -> list[str]:
    rows = [(count, *key.split(" | ")) for key, count in sorted(refused.items())]
    rows.sort(key=lambda row: -row[0])
    head = ("draws", "refused", "error", "what must hold")
    text = f"{refused.total()} draws were refused with a documented error and drawn again."
    return ["## Refused draws", "", text, "", *table(head, rows)]


def main() -> None:
    cases, refused = measured(range(CASES))
    versions = ", ".join(f"{library} {version(library)}" for library in LIBRARIES)
    lines = [
        HEAD.format(versions=versions),
        *distribution(cases),
        *counts(cases),
        *worst("steps, over t", cases, steps),
        *worst("steps and grid, over the larger of t and the error stated", cases, over_stated),
        *redrawn(refused),
    ]
    FILE.write_text("\n".join(lines), "utf-8")


if __name__ == "__main__":
    main()
