"""The drives that pass: a table as text, JSON and CSV, and what refuses the others."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column
from wearsim.report.text_lines import Finding, answer_text, assumed
from wearsim.study.select.considered_chains import ConsideredChains, considered_chains
from wearsim.study.select.model import LEAST_WRAP, SAG, CandidateDrive, judged_drives
from wearsim.study.select.ranking import best_of_each_chain, nearest_miss, ranked, refused_by
from wearsim.study.select.requirements import MOST_TEETH, DriveRequirements
from wearsim.study.select.wish import Wish

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
        return ranked(self.drives, self.need.ratio)

    @cached_property
    def shown(self) -> tuple[CandidateDrive, ...]:
        """The first of them."""
        passing = self.passing
        return (passing if self.every_pair else best_of_each_chain(passing))[: self.count]

    @property
    def criterion(self) -> str:
        """What the drives are ordered by, in words."""
        equals = "for a chain and a small sprocket the nearest ratio; then teeth, chain"
        weighed = "chain q X p and sprockets as steel discs of pitch diameter and tooth width, no hubs"
        if self.priced:
            return f"cost: metres of chain and kilograms of sprockets at the prices given; {equals}"
        return f"mass: {weighed}; {equals}"


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


def drives_table(drives: Sequence[CandidateDrive]) -> AnswerTable[CandidateDrive]:
    """Return a row for each drive; on the screen without columns that hold nothing."""
    priced = any(one.cost is not None for one in drives)
    poorer = any(one.lubricated_life != one.life for one in drives)
    return AnswerTable(
        [
            Column("designation", lambda one: one.chain.designation, "chain"),
            Column("strands", lambda one: one.chain.strands, "strands"),
            Column("driver_teeth", lambda one: one.layout.teeth_1),
            Column("driven_teeth", lambda one: one.layout.teeth_2),
            Column("", lambda one: f"{one.layout.teeth_1}/{one.layout.teeth_2}", "teeth"),
            Column("gear_ratio", lambda one: one.layout.ratio, "ratio", "{:.4g}"),
            Column("links", lambda one: one.layout.links, "links"),
            Column("centre_distance_mm", lambda one: one.layout.centre_distance, "centre mm", "{:.1f}"),
            Column("chain_speed_m_per_s", lambda one: one.chain_speed, "m/s", "{:.2f}"),
            Column("drive_mass_kg", lambda one: one.mass, "kg", "{:.2f}"),
            Column("drive_cost", lambda one: one.cost, "cost" if priced else None, "{:.2f}", missing=""),
            Column("chain_life_hours", lambda one: one.life, "chain life h", grouped),
            Column("chain_life_hours_low", lambda one: one.life_low),
            Column("chain_life_hours_high", lambda one: one.life_high),
            Column("", _span, "low to high"),
            Column("recommended_lubrication", lambda one: one.recommended_lubrication),
            Column("lubricated_life_hours", lambda one: one.lubricated_life),
            Column("", _lubrication, "lubrication" if poorer else None),
            Column("most_used_rating", lambda one: one.most_used.name, "most used rating"),
            Column(
                "rating_margin_percent", lambda one: 100.0 * (1.0 - one.most_used.used), "margin %", "{:.1f}"
            ),
            Column("shaft_load_N", lambda one: one.shaft_load, "shaft N", "{:.0f}"),
            Column("largest_tip_diameter_mm", lambda one: one.tip_diameter, "tip mm", "{:.1f}"),
        ],
        drives,
    )


def selection_json(answer: SelectionAnswer) -> dict[str, Any]:
    """Return what ``wearsim select --json`` prints."""
    miss = None if answer.passing else nearest_miss(answer.drives)
    return {
        **ANSWER_HEAD,
        "criterion": "cost" if answer.priced else "mass",
        "chains": len(answer.considered.chains),
        "judged": len(answer.drives),
        "passed": len(answer.passing),
        "drives": drives_table(answer.shown).records(),
        "refused": refused_by(answer.drives),
        "nearest_miss": None
        if miss is None
        else {**drives_table([miss]).records()[0], "used": {one.limit: one.used for one in miss.refusals}},
        "skipped": {reason: list(names) for reason, names in answer.considered.skipped.items()},
        "assumptions": list(_assumptions(answer)),
    }


def selection_text(answer: SelectionAnswer, explain: bool = False) -> str:
    """Return what ``wearsim select`` prints."""
    need = answer.need
    drive = f"{need.power:g} kW at {need.speed:g} rpm, ratio {need.ratio:g}"
    title = f"{drive}, {grouped(need.hours)} h ({answer.use})"
    parts: list[object] = [title]
    if answer.shown:
        parts += [drives_table(answer.shown), Finding("Ranked by", answer.criterion)]
        parts.append(Finding("Passed", _passed(answer)))
    else:
        parts += [Finding("Passed", f"none of {_judged(answer)}"), Finding("Nearest", _nearest(answer))]
    parts.append(Finding("Refused", _refused(answer)))
    if answer.considered.skipped:
        parts.append(Finding("Left out", _skipped(answer.considered.skipped)))
    return answer_text(*parts, assumed(_assumptions(answer), explain))


def _span(drive: CandidateDrive) -> str:
    return f"{grouped(drive.life_low, 3)} to {grouped(drive.life_high, 3)}"


def _lubrication(drive: CandidateDrive) -> str:
    """Name the recommended lubrication and the hours with a poorer one; empty where it is no poorer."""
    if drive.lubricated_life == drive.life:
        return ""
    return f"below {drive.recommended_lubrication}: {grouped(drive.lubricated_life)} h"


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
        "centre distance about 40 pitches, within its bounds"
        if need.centre is None
        else f"the next even number of links at {need.centre:g} mm; a take-up removes the slack"
    )
    return (
        f"service factor {need.service_factor:g} on the power, smooth driver; joint application factor "
        f"{need.joint_application_factor:.4g} on the joint pressure, shafts that can be moved",
        f"chain life by wear of its joints, condition {need.joints.condition!r} "
        f"({need.joints.joint_typical:g} mm2/N at {need.joints.joint_reference_pressure:g} MPa and "
        f"{need.joints.joint_reference_speed:g} rpm), to 3 % or 200 % over the larger number of teeth",
        *_lubrication_assumptions(need),
        f"strands share the load equally; the slack span sags by {100 * SAG:g} %",
        centre,
        f"at most {MOST_TEETH} teeth and at least {math.degrees(LEAST_WRAP):.0f} degrees of wrap angle, as "
        "handbooks say",
        "tooth life is not calculated here: use --verify N, or wearsim life with the case of --out",
    )


def _lubrication_assumptions(need: DriveRequirements) -> tuple[str, ...]:
    if not need.lubrication:
        return ()
    return (
        f"lubrication {need.lubrication!r}: where pitch and chain speed call for a better one, the chain "
        "must last the hours with the published factor on its life as well",
    )
