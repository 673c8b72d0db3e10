"""Whether an error from the steps of one run could replace the coarser run beside it: random wraps.

``python research/error_of_steps.py`` (a quarter of an hour on two cores) prints how many of the 120 wraps of
research/stated_error.py are within bounds of both kinds. The best that an estimate from the steps can do is
the error of the steps itself, found here by steps a quarter as long on the same points and phases.
"""

import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np
import stated_error

from wearsim.drive.wrap_life import wrap_of, wrap_task
from wearsim.wear.implicit_steps import run_seated

FLOOR = 5e-3
"""What every stated error holds beside its estimate."""


def lives(number: int) -> tuple[list[float], list[float]]:
    """Return the life of a wrap, with steps a quarter and twice as long, and of its coarser run; seconds."""
    case, _ = stated_error.drive("wrap", number, Path(tempfile.mkdtemp()))
    task = wrap_task(case, wrap_of(case).contact(case))
    coarser = task.on(task.contact.coarsened())
    found, seconds = [], []
    for problem, level in ((task, 0), (task, 2), (task, -1), (coarser, -1)):
        begun = time.process_time()
        found.append(float(run_seated(problem, level).cycles[-1]))
        seconds.append(time.process_time() - begun)
    return found, seconds


def main() -> None:
    """Print coverage and cost."""
    rows = [row for row in stated_error.read() if row.kind == "wrap"]
    with ProcessPoolExecutor() as pool:
        found = list(pool.map(lives, (row.number for row in rows)))
    (life, finer, longer, coarse), (own, _, _, beside) = (
        np.array(part).T for part in zip(*found, strict=True)
    )
    true = np.abs(life / np.array([row.reference for row in rows]) - 1.0)
    print(f"{len(rows)} wraps; a coarser run takes {100 * beside.sum() / own.sum():.0f} % of its own")
    estimates = {
        "error of the steps": 16.0 / 15.0 * np.abs(life / finer - 1.0),
        "difference of steps twice as long": np.abs(longer / life - 1.0),
        "coarser run": np.abs(coarse / life - 1.0),
    }
    for name, estimate in estimates.items():
        for factor in (1.0, 1.5, 3.0, 10.0):
            within = 100.0 * np.mean(true <= factor * estimate + FLOOR)
            print(f"{factor:4.1f} times the {name}, and {100 * FLOOR:g} %: {within:.0f} % are within")


if __name__ == "__main__":
    main()
