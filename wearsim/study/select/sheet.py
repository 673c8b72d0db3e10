"""The drives that pass: a table as text, JSON and CSV, and what refuses the others."""

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.text_lines import numbered_assumptions, row, table_lines
from wearsim.study.select.considered_chains import ConsideredChains, considered_chains
from wearsim.study.select.model import (
    LEAST_WRAP,
    SAG,
    CandidateDrive,
    best_of_each_chain,
    judged_drives,
    nearest_miss,
    ranked,
    refused_by,
)
from wearsim.study.select.requirements import MOST_TEETH, DriveRequirements
from wearsim.study.select.wish import Wish

_HEAD = (
    *("chain", "strands", "teeth", "ratio", "links", "centre mm", "m/s", "kg", "cost"),
    *("chain life h", "low to high", "lubrication", "most used rating", "margin %", "shaft N", "tip mm"),
)
_SHOWN_SKIPPED = 4


@dataclass(frozen=True)
class SelectionAnswer:
    """All drives that were judged, and what they were judged by."""

    need: DriveRequirements
    use: str  # how the drive is used, in words
    considered: ConsideredChains
    drives: tuple[CandidateDrive, ...]
    every_pair: bool  # whether all teeth of a chain are shown, not only the best
    count: int  # rows that are shown
    priced: bool  # whether prices rank the drives

    @cached_property
    def passing(self) -> tuple[CandidateDrive, ...]:
        """The drives that pass in their order."""
        return ranked(self.drives)

    @cached_property
    def shown(self) -> tuple[CandidateDrive, ...]:
        """The first of them."""
        passing = self.passing
        return (passing if self.every_pair else best_of_each_chain(passing))[: self.count]

    @property
    def criterion(self) -> str:
        """What the drives are ordered by, in words."""
        weighed = "chain q X p and sprockets as steel discs of pitch diameter and tooth width, no hubs"
        if self.priced:
            return "cost: metres of chain and kilograms of sprockets at the prices given; then teeth, chain"
        return f"mass: {weighed}; then teeth, chain"


def answer_to(wish: Wish, every_pair: bool, count: int) -> SelectionAnswer:
    """Return the drives that answer what is asked for."""
    considered = considered_chains(wish.need, wish.prices)
    return SelectionAnswer(
        need=wish.need,
        use=wish.use,
        considered=considered,
        drives=judged_drives(wish.need, considered.chains, wish.prices),
        every_pair=every_pair,
        count=count,
        priced=wish.prices is not None,
    )


def drive_columns(drive: CandidateDrive) -> dict[str, Any]:
    """Return a drive as a row of the table, in the units of the columns."""
    layout, most = drive.layout, drive.most_used
    return {
        "designation": drive.chain.designation,
        "strands": drive.chain.strands,
        "driver_teeth": layout.teeth_1,
        "driven_teeth": layout.teeth_2,
        "gear_ratio": layout.ratio,
        "links": layout.links,
        "centre_distance_mm": layout.centre_distance,
        "chain_speed_m_per_s": drive.chain_speed,
        "drive_mass_kg": drive.mass,
        "drive_cost": drive.cost,
        "chain_life_hours": drive.life,
        "chain_life_hours_low": drive.life_low,
        "chain_life_hours_high": drive.life_high,
        "recommended_lubrication": drive.recommended_lubrication,
        "lubricated_life_hours": drive.lubricated_life,
        "most_used_rating": most.name,
        "rating_margin_percent": 100.0 * (1.0 - most.used),
        "shaft_load_N": drive.shaft_load,
        "largest_tip_diameter_mm": drive.tip_diameter,
    }


def selection_csv(answer: SelectionAnswer) -> str:
    """Return the rows that are shown as a CSV file."""
    found = io.StringIO()
    rows = [drive_columns(drive) for drive in answer.shown]
    columns = list(rows[0])
    writer = csv.DictWriter(found, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return found.getvalue()


def selection_json(answer: SelectionAnswer) -> dict[str, Any]:
    """Return what ``wearsim select --json`` prints."""
    miss = None if answer.passing else nearest_miss(answer.drives)
    return {
        **ANSWER_HEAD,
        "criterion": "cost" if answer.priced else "mass",
        "chains": len(answer.considered.chains),
        "judged": len(answer.drives),
        "passed": len(answer.passing),
        "drives": [drive_columns(drive) for drive in answer.shown],
        "refused": refused_by(answer.drives),
        "nearest_miss": None
        if miss is None
        else {**drive_columns(miss), "used": {one.limit: one.used for one in miss.refusals}},
        "skipped": {reason: list(names) for reason, names in answer.considered.skipped.items()},
        "assumptions": list(_assumptions(answer)),
    }


def selection_text(answer: SelectionAnswer) -> str:
    """Return what ``wearsim select`` prints."""
    need = answer.need
    drive = f"{need.power:g} kW at {need.speed:g} rpm, ratio {need.ratio:g}"
    title = f"{drive}, {grouped(need.hours)} h ({answer.use})"
    shown = answer.shown
    lines = [title]
    if shown:
        lines += _table([_cells(drive) for drive in shown])
        lines.append(row("Ranked by", answer.criterion))
        lines.append(row("Passed", _passed(answer)))
    else:
        lines.append(row("Passed", f"none of {_judged(answer)}"))
        lines.append(row("Nearest", _nearest(answer)))
    lines.append(row("Refused", _refused(answer)))
    if answer.considered.skipped:
        lines.append(row("Left out", _skipped(answer.considered.skipped)))
    lines.append(row("Assumes", numbered_assumptions(_assumptions(answer))))
    return "\n".join(lines)


def _cells(drive: CandidateDrive) -> list[str]:
    layout, most = drive.layout, drive.most_used
    return [
        drive.chain.designation,
        f"{drive.chain.strands}",
        f"{layout.teeth_1}/{layout.teeth_2}",
        f"{layout.ratio:.4g}",
        f"{layout.links}",
        f"{layout.centre_distance:.1f}",
        f"{drive.chain_speed:.2f}",
        f"{drive.mass:.2f}",
        "" if drive.cost is None else f"{drive.cost:.2f}",
        grouped(drive.life),
        f"{grouped(drive.life_low, 3)} to {grouped(drive.life_high, 3)}",
        _lubrication(drive),
        most.name,
        f"{100.0 * (1.0 - most.used):.1f}",
        f"{drive.shaft_load:.0f}",
        f"{drive.tip_diameter:.1f}",
    ]


def _lubrication(drive: CandidateDrive) -> str:
    """Name the recommended lubrication and the hours with a poorer one; empty where it is no poorer."""
    if drive.lubricated_life == drive.life:
        return ""
    return f"below {drive.recommended_lubrication}: {grouped(drive.lubricated_life)} h"


def _table(rows: list[list[str]]) -> list[str]:
    """Return rows below their head, without columns that are empty."""
    columns = [column for column in zip(_HEAD, *rows, strict=True) if any(column[1:])]
    return [f"  {line}" for line in table_lines(zip(*columns, strict=True))]


def _judged(answer: SelectionAnswer) -> str:
    return f"{grouped(len(answer.drives))} drives of {len(answer.considered.chains)} chains"


def _passed(answer: SelectionAnswer) -> str:
    passing = answer.passing
    chains = len(best_of_each_chain(passing))
    text = f"{grouped(len(passing))} of {_judged(answer)}"
    if answer.every_pair:
        return f"{text}, on {chains} of the chains"
    return f"{text}; the best teeth of each of {chains} chains (--every-pair for all)"


def _refused(answer: SelectionAnswer) -> str:
    counts = refused_by(answer.drives)
    text = ", ".join(f"{grouped(count)} by {limit}" for limit, count in counts.items())
    return f"{text}; a drive can fail several checks" if len(counts) > 1 else text or "none"


def _nearest(answer: SelectionAnswer) -> str:
    miss = nearest_miss(answer.drives)
    if miss is None:
        return "no chain of these series and strands has all numbers in the catalogue: allow others"
    beyond = ", ".join(f"{one.limit} by {100.0 * (one.used - 1.0):.3g} %" for one in miss.refusals)
    layout = miss.layout
    return f"{miss.chain.designation} on {layout.teeth_1}/{layout.teeth_2} teeth is beyond {beyond}"


def _skipped(skipped: Mapping[str, Sequence[str]]) -> str:
    return "; ".join(
        f"{len(names)} {'chain' if len(names) == 1 else 'chains'}, {reason} ({_some(names)})"
        for reason, names in skipped.items()
    )


def _some(names: Sequence[str]) -> str:
    more = len(names) - _SHOWN_SKIPPED
    return ", ".join(names[:_SHOWN_SKIPPED]) + (f" and {more} more" if more > 0 else "")


def _assumptions(answer: SelectionAnswer) -> tuple[str, ...]:
    need = answer.need
    centre = (
        "about 40 pitches between the shafts, within their bounds"
        if need.centre is None
        else f"the next even number of links at {need.centre:g} mm; its slack is taken up"
    )
    return (
        f"service factor {need.service_factor:g} on the power, smooth driver; joint application factor "
        f"{need.joint_application_factor:.4g} on the joint pressure, shafts that can be moved",
        f"chain life by wear of its joints, condition {need.joints.condition!r} "
        f"({need.joints.joint_typical:g} mm2/N at {need.joints.joint_reference_pressure:g} MPa and "
        f"{need.joints.joint_reference_speed:g} rpm), to 3 % or 200 % over the larger number of teeth",
        *_lubrication_assumptions(need),
        f"strands share the load alike; slack span sags by {100 * SAG:g} %",
        centre,
        f"at most {MOST_TEETH} teeth and at least {math.degrees(LEAST_WRAP):.0f} degrees of wrap, as "
        "handbooks say",
        "how long the teeth live is not calculated here: --verify N, or wearsim life with the case of --out",
    )


def _lubrication_assumptions(need: DriveRequirements) -> tuple[str, ...]:
    if not need.lubrication:
        return ()
    return (
        f"lubrication {need.lubrication!r}: where pitch and chain speed call for a better one, the chain "
        "must last the hours with the published factor on its life as well",
    )
