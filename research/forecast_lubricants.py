"""Forecast of the readings withheld from the data of 67 lubricants, and how such forecasts did on the others.

Run from a checkout with ``python research/forecast_lubricants.py`` (about two minutes); it writes
reports/reference/forecast_lubricants.csv and forecast_lubricants.md. Same numbers every time.
"""

import csv
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import lubricant_ages as ages
import lubricant_coefficients as coefficients
import numpy as np
import pandas as pd
from lubricant_rig import DATA, KM_PER_HOUR, blocks_read, coefficient_of_rate, kinds, mid_quantiles

REPORTS = Path(__file__).parent.parent / "reports" / "reference"
HEAD = Path(__file__).with_name("forecast_lubricants_head.md")
PARTS = (0.05, 0.25, 0.5, 0.75, 0.95)
READ = [f"block_{number}" for number in range(1, 7)]
JUMPS, ALLOWANCES = ([f"{road}_{what}_km" for road in ages.ROADS] for what in ("jump", "allowance"))
QUANTITIES = ("block_5", "block_6", *ALLOWANCES[:2], JUMPS[2], ALLOWANCES[2])

Cell = tuple[str, str]
"""A lubricant and a quantity."""


def lubricants() -> tuple[pd.DataFrame, list[Cell]]:
    """All lubricants with blocks and single applications, NaN where not read, and the withheld cells."""
    single = pd.read_csv(DATA / "lubricant_single_application.csv", comment="#", dtype=str)
    table = (
        blocks_read().merge(single, on=["id", "category"], how="outer").sort_values("id", ignore_index=True)
    )
    later = table.note.fillna("").str.contains("blocks_5_and_6_withheld")
    withheld = [(lubricant, block) for lubricant in table.id[later] for block in READ[4:]]
    for quantity in QUANTITIES[2:]:
        withheld += [(lubricant, quantity) for lubricant in table.id[table[quantity] == "withheld"]]
    number = table[[*JUMPS, *ALLOWANCES]].replace("withheld", np.nan).astype(float)
    return table.assign(**number), sorted(withheld, key=lambda cell: (cell[0], QUANTITIES.index(cell[1])))


def without(read: np.ndarray, groups: Iterable[np.ndarray], first: int) -> np.ndarray:
    """Sets of readings, each without the blocks from ``first`` on of a group of lubricants."""
    sets = []
    for group in groups:
        left = read.copy()
        left[group, first:] = np.nan
        sets.append(left)
    return np.array(sets)


def draws_of(read: np.ndarray, table: pd.DataFrame, rounds: int) -> coefficients.Draws:
    """Fit sets of readings of the lubricants of a table."""
    return coefficients.fit(read, *kinds(table.category), rounds)


def left_out_blocks(
    table: pd.DataFrame, first: int, rounds: int, groups: int | None = None
) -> dict[Cell, np.ndarray]:
    """Draw the first block left out and all later ones from those before and from the other lubricants.

    Lubricants are left out in so many groups, each alone without a number.
    """
    read = table[READ].to_numpy(dtype=float)
    known = np.flatnonzero(~np.isnan(read[:, first]))
    member = np.arange(len(known)) % (groups or len(known))
    parts = [known[member == group] for group in range(member.max() + 1)]
    fitted = draws_of(without(read, parts, first), table, rounds)
    found = {}
    for number, part in enumerate(parts):
        drawn = fitted.only(number).readings(np.random.default_rng(number), part)
        for place, lubricant in enumerate(part):
            for block in range(first, 6):
                found[table.id[lubricant], READ[block]] = drawn[:, place, block]
    return found


def lubricated(fitted: coefficients.Draws) -> np.ndarray:
    """Wear of lubricated joints on road, gravel and in extreme wet, medians: (lubricants, 3) [1/km]."""
    clean, _, dust, wet, extreme, _ = np.moveaxis(np.exp(fitted.theta[:, 0]), -1, 0)
    rates = np.stack([clean, clean + dust, clean + wet * extreme], axis=-1)
    return np.median(rates, axis=0) / KM_PER_HOUR


def on_one_application(
    table: pd.DataFrame, wear: np.ndarray, lubricant: int, roads: Iterable[int], rounds: int
) -> dict[Cell, np.ndarray]:
    """Draw the allowances of a lubricant on roads, and its jump in extreme wet, looking at none of them."""
    generator = np.random.default_rng(1000 + lubricant)
    jumps, allowances = table[JUMPS].to_numpy(), table[ALLOWANCES].to_numpy()
    own = table.id[lubricant]
    allowances[lubricant], jumps[lubricant, 2] = np.nan, np.nan
    found = {}
    for road in roads:
        if road == 2:
            wet = wear[:, 2] * 1000.0
            seen = np.column_stack([wet, jumps[:, :2], allowances[:, 2]])
            kind = kinds(table.category)
            drawn = ages.extreme(seen, jumps[:, 2], wear[:, 2], *kind, rounds, generator)
            jump, dry = drawn.jump[:, lubricant], drawn.dry[:, lubricant]
            found[own, JUMPS[2]] = jump
        else:
            jump = jumps[lubricant, road]
            others = (jumps[:, :2], allowances[:, :2], wear[:, :2])
            dry = ages.dry_after(jump, *others, 4000, generator)
        found[own, ALLOWANCES[road]] = ages.allowance(jump, wear[lubricant, road], dry)
    return found


def left_out_applications(table: pd.DataFrame, wear: np.ndarray, rounds: int) -> dict[Cell, np.ndarray]:
    """Draw the allowances that were read, and jumps in extreme wet, each lubricant from the others."""
    found = {}
    for lubricant in range(len(table)):
        roads = [road for road in range(3) if table[ALLOWANCES[road]].notna()[lubricant]]
        found |= on_one_application(table, wear, lubricant, roads, rounds)
    return found


def band(quantity: str, draws: np.ndarray) -> list[float]:
    """Quantiles of a cell, rounded so that no band loses its edge."""
    return ages.outward(mid_quantiles(draws, PARTS), 1.0 if quantity.endswith("_km") else 1e-4)


def bands(drawn: Mapping[Cell, np.ndarray]) -> dict[Cell, list[float]]:
    """Quantiles of cells."""
    return {cell: band(cell[1], draws) for cell, draws in drawn.items()}


def held(found: Mapping[Cell, list[float]], reading: Callable[[Cell], float]) -> pd.DataFrame:
    """Whether readings lie in the bands of 50 % and 90 %, and below the median."""
    rows = []
    for cell, (low, lower, middle, upper, high) in found.items():
        read = reading(cell)
        if not np.isnan(read):
            rows.append((*cell, read, lower <= read <= upper, low <= read <= high, read < middle))
    return pd.DataFrame(rows, columns=["id", "quantity", "read", "in_50", "in_90", "below"])


def read_in(table: pd.DataFrame) -> Callable[[Cell], float]:
    """The reading of a cell."""
    indexed = table.set_index("id")
    return lambda cell: float(indexed[cell[1]][cell[0]])


def forecasts(
    table: pd.DataFrame, withheld: list[Cell], fitted: coefficients.Draws, rounds: int
) -> dict[Cell, np.ndarray]:
    """Draw the withheld cells."""
    wear, found = lubricated(fitted), {}
    every = np.arange(len(table))
    drawn = fitted.readings(np.random.default_rng(5), every)
    for lubricant in every:
        own = table.id[lubricant]
        found |= {(own, block): drawn[:, lubricant, READ.index(block)] for block in READ[4:]}
        wanted = {quantity.split("_")[0] for name, quantity in withheld if name == own}
        roads = [road for road, name in enumerate(ages.ROADS) if name in wanted]
        found |= on_one_application(table, wear, lubricant, roads, rounds)
    return {cell: found[cell] for cell in withheld}


def expected(drawn: Mapping[Cell, np.ndarray]) -> pd.DataFrame:
    """Chance of each cell to lie in its bands, by its own draws; ties make it more or less."""
    rows = []
    for (lubricant, quantity), draws in drawn.items():
        low, lower, _, upper, high = band(quantity, draws)
        chance = [np.mean((draws >= a) & (draws <= b)) for a, b in ((lower, upper), (low, high))]
        rows.append((lubricant, quantity, *chance))
    return pd.DataFrame(rows, columns=["id", "quantity", "in_50", "in_90"])


def coverage_lines(chances: pd.DataFrame, tried: pd.DataFrame) -> Iterable[str]:
    """A table of what is expected of the forecast, and what came of the same where readings are known."""
    yield "| quantity | forecasts | expected in 50 % | in 90 % | tried | were in 50 % | in 90 % | below p50 |"
    yield "|---|---|---|---|---|---|---|---|"
    for name in (*QUANTITIES, "all"):
        asked, known = (rows if name == "all" else rows[rows.quantity == name] for rows in (chances, tried))
        shares = (asked.in_50, asked.in_90, known.in_50, known.in_90, known.below)
        first, second, *others = (f"{100 * share.mean():.0f} %" for share in shares)
        yield f"| {name} | {len(asked)} | {first} | {second} | {len(known)} | {' | '.join(others)} |"


def category_lines(fitted: coefficients.Draws, unit: float) -> Iterable[str]:
    """A table of the coefficients of the mean lubricant of a category."""
    yield "| category | clean | dust | wet | extreme | removed by a relubrication |"
    yield "|---|---|---|---|---|---|"
    mean = fitted.mean[:, 0]
    clean, dust, wet = (np.exp(mean[..., one]) for one in (0, 2, 3))
    extreme = wet * np.exp(mean[..., 4])
    removed = 1.0 / (1.0 + np.exp(-mean[..., 5]))
    for number, name in enumerate(("immersive_wax", "wax_drip, rub_on_wax", "wet_drip", "other")):
        rates = (rate * unit for rate in (clean, clean + dust, clean + wet, clean + extreme))
        quantiles = [np.quantile(values[:, number], (0.25, 0.5, 0.75)) for values in (*rates, removed)]
        yield f"| {name} | " + " | ".join(" / ".join(f"{one:.2g}" for one in row) for row in quantiles) + " |"


def main() -> None:
    """Write the table and the page."""
    rounds = 3000
    table, withheld = lubricants()
    fitted = draws_of(table[READ].to_numpy(dtype=float)[None], table, rounds)
    drawn = forecasts(table, withheld, fitted, rounds)
    tried = left_out_blocks(table, 4, rounds // 2) | left_out_applications(
        table, lubricated(fitted), rounds // 2
    )
    with (REPORTS / "forecast_lubricants.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["id", "quantity", *(f"p{100 * part:02.0f}" for part in PARTS)])
        for cell in withheld:
            digits = 0 if cell[1].endswith("_km") else 4
            writer.writerow([*cell, *(f"{value:.{digits}f}" for value in band(cell[1], drawn[cell]))])
    text = HEAD.read_text(encoding="utf-8")
    shown = {
        "coverage": "\n".join(coverage_lines(expected(drawn), held(bands(tried), read_in(table)))),
        "categories": "\n".join(category_lines(fitted, coefficient_of_rate())),
        "spread": f"{np.median(fitted.spread):.2f}",
    }
    for name, part in shown.items():
        text = text.replace(f"{{{name}}}", part)
    (REPORTS / "forecast_lubricants.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
