"""Strength of a gear pair: text, tables and JSON."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wearsim.fatigue.endurance import Endurance, EnduredHours
from wearsim.handbook.strength.keys import StrengthTables
from wearsim.handbook.strength.model import (
    GearEndurance,
    PairLoad,
    PairStrength,
    StressCheck,
    ToothLoad,
    first_life,
    shown_hours,
)
from wearsim.quantities import grouped
from wearsim.report.answer_table import plain
from wearsim.report.calculation_sheet import CalculationSheet
from wearsim.report.text_lines import Finding, answer_text

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_WIDTHS = (46, 23, 23)


def strength_text(tables: StrengthTables, pair: PairStrength) -> str:
    """Return what ``wearsim handbook strength`` prints."""
    hardness = [f"{gear.hardness:g} {gear.treatment.scale}" for gear in pair.gears]
    lines = [
        tables.title,
        "",
        _columns("", [gear.name for gear in pair.gears]),
        _columns("  treatment", [gear.treatment.name.replace("_", " ") for gear in pair.gears]),
        _columns("  hardness", hardness),
        _columns("  load cycles N", [f"{gear.cycles:.4g}" for gear in pair.gears]),
    ]
    lines += ["contact", *_endured_lines([gear.contact for gear in pair.gears], "H")]
    lines += _acting_lines([contact for contact, _ in pair.stresses], "H")
    lines += ["bending", *_endured_lines([gear.bending for gear in pair.gears], "F")]
    lines += _acting_lines([bending for _, bending in pair.stresses], "F")
    return answer_text(*lines, "", *_findings(tables, pair))


def _endured_lines(endured: list[Endurance], letter: str) -> list[str]:
    greatest = ["not known" if math.isnan(e.greatest) else f"{e.greatest:.1f}" for e in endured]
    limits = [f"{e.endurance_limit:.1f}" for e in endured]
    factors = [f"{e.factor:.4f} ({e.raw_factor:.4f})" for e in endured]
    return [
        _columns(f"  endurance limit sigma_{letter}lim, MPa", limits),
        _columns(f"  equivalence factor mu_{letter}", [f"{e.equivalence:.4g}" for e in endured]),
        _columns(f"  equivalent cycles N_{letter}E", [f"{e.equivalent_cycles:.4g}" for e in endured]),
        _columns(f"  base cycles N_{letter}G", [f"{e.curve.base_cycles:.4g}" for e in endured]),
        _columns(f"  life factor K_{letter}L (before limits)", factors),
        _columns(f"  allowable [sigma]_{letter}, MPa", [f"{e.allowable:.1f}" for e in endured]),
        _columns(f"  allowable at overload [sigma]_{letter}max, MPa", greatest),
    ]


def _columns(label: str, values: list[str]) -> str:
    first, *rest = _WIDTHS
    cells = "".join(f"{value:>{width}}" for value, width in zip(values, rest, strict=True))
    return f"{label:{first}}{cells}"


def _acting_lines(acting: list[StressCheck], letter: str) -> list[str]:
    if not acting:
        return []
    peaks = ["not known" if math.isnan(s.peak_margin) else f"{s.peak_margin:.3f}" for s in acting]
    return [
        _columns(f"  acting sigma_{letter}, MPa", [f"{s.lasting:.1f}" for s in acting]),
        _columns("  margin, allowable over acting", [f"{s.margin:.3f}" for s in acting]),
        _columns(f"  acting at overload sigma_{letter}max, MPa", [f"{s.peak:.1f}" for s in acting]),
        _columns("  margin at overload", peaks),
        _columns("  allowed running time", [_hours(s.life) for s in acting]),
    ]


def _hours(life: EnduredHours) -> str:
    if life.bound:
        return f"> {grouped(life.hours)} h"
    return f"{grouped(life.hours)} h"


def _findings(tables: StrengthTables, pair: PairStrength) -> list[Finding]:
    governs = pair.contact_governs
    allowed = f"[sigma]_H = {governs.contact.allowable:.1f} MPa (limited by the {governs.name})"
    lines = [Finding("Pair", f"{allowed} for {grouped(pair.hours)} h; load: {pair.spectrum.name}")]
    if pair.load is not None:
        contact, bending = zip(*pair.stresses, strict=True)
        lines += [
            *_load_findings(pair.load),
            Finding("Life", _lives(contact, pair, "contact")),
            Finding("", _lives(bending, pair, "bending")),
        ]
    return lines


def _load_findings(load: ToothLoad) -> list[Finding]:
    mesh, contact, bending = load.mesh, load.contact_factor, load.bending_factor
    factors = (
        f"K_A {contact.application:g}, face {contact.face:.4g}, transverse {contact.transverse:.4g}, "
        f"dynamic {contact.dynamic:g}"
    )
    return [
        Finding(
            "Load",
            f"T = {1e-3 * mesh.torque:g} N m, F_t = {mesh.tangential_force:.1f} N; "
            f"K_H = {contact.total:.4f} ({factors}), K_F = {bending.total:.4f}",
        ),
        Finding(
            "Contact",
            f"sigma_H = {load.corrected_contact_stress:.1f} MPa from the normal force, "
            f"{load.printed_contact_stress:.1f} MPa from the tangential force as printed; the "
            f"{'first' if load.contact_stress == load.corrected_contact_stress else 'second'} is used",
        ),
    ]


def _lives(acting: Sequence[StressCheck], pair: PairStrength, what: str) -> str:
    """Say which gear is the first to reach its life by one kind of fatigue."""
    place, life = first_life([one.life for one in acting])
    if life.bound:
        return f"{what} fatigue: {_hours(life)}, neither gear reaches its limit"
    return f"{what} fatigue: {_hours(life)}, {pair.gears[place].name} first"


def _assumptions(tables: StrengthTables, load: ToothLoad | None) -> tuple[str, ...]:
    reading = tables.fatigue.base_cycles
    found = [
        f"N_HG follows {'GOST 21354' if reading == 'gost' else 'the surviving text of the source'}",
        "1 HRC is taken as 10 HB; hardness and endurance limit are at the middle of their ranges",
    ]
    if tables.fatigue.long_life == "gost":
        found.append("beyond N_HG the allowable contact stress falls with the 20th root, down to 0.75 (GOST)")
    else:
        found.append("K_HL and K_FL are at least 1: a stress endured for N_HG cycles is endured indefinitely")
    if tables.overload.static_safety != 1.0:
        found.append(f"S_st = {tables.overload.static_safety:g} (textbook: not in the source)")
    if tables.load_spectrum:
        found.append("which torques count as overloads is decided at the required life")
    if load is not None:
        found.append(
            "spur gears without profile shift; K_H, K_F and Y_FS follow textbooks, as the source lacks them"
        )
        if tables.load is not None and tables.load.application_factor is None:
            found.append(f"load.application_factor = {load.contact_factor.application:g} (default)")
    return tuple(found)


_NAMES = ("contact", "bending")


def strength_sheet(tables: StrengthTables, pair: PairStrength) -> CalculationSheet:
    """Return what ``wearsim handbook strength`` shows."""
    gears = [_gear_row(gear, acting) for gear, acting in _acting(pair)]

    def _made() -> dict[str, "pd.DataFrame"]:
        import pandas as pd

        frame = pd.DataFrame
        return {"gears": frame(gears), "allowable_over_hours": frame(_over_hours(pair))}

    def _drawn() -> dict[str, "Figure"]:
        from wearsim.handbook.strength.figure import strength_figure

        return {"strength": strength_figure(tables.title, pair)}

    return CalculationSheet(
        text=strength_text(tables, pair),
        content={
            "title": tables.title,
            **_pair_content(pair),
            "gears": gears,
            "assumptions": list(_assumptions(tables, pair.load)),
        },
        tables=_made,
        figures=_drawn,
        warnings=tuple(_warnings(tables, pair)),
    )


def _acting(pair: PairStrength) -> list[tuple[GearEndurance, Sequence[StressCheck]]]:
    """Return each gear with its stresses in contact and in bending, none without a load."""
    return list(zip(pair.gears, pair.stresses or ((), ()), strict=True))


def _pair_content(pair: PairStrength) -> dict[str, Any]:
    content: dict[str, Any] = {
        "life_hours": pair.hours,
        "spectrum": pair.spectrum.name,
        "peak_ratio": pair.peak,
        "peak_cycles": pair.spectrum.peak_cycles,
        "contact_governs": pair.contact_governs.name,
        "allowable_contact_MPa": pair.contact_governs.contact.allowable,
    }
    load = pair.load
    if load is not None:
        content |= {
            "long_acting_torque_N_m": 1e-3 * load.mesh.torque,
            "tangential_force_N": load.mesh.tangential_force,
            "face_width_ratio": load.mesh.face_width / load.mesh.pinion_diameter,
            "contact_load_factor": load.contact_factor.total,
            "bending_load_factor": load.bending_factor.total,
            "contact_stress_MPa": load.contact_stress,
            "printed_contact_stress_MPa": load.printed_contact_stress,
            "corrected_contact_stress_MPa": load.corrected_contact_stress,
        }
    for name, acting in zip(_NAMES, zip(*pair.stresses, strict=True), strict=False):
        place, life = first_life([one.life for one in acting])
        content |= {
            f"{name}_life_hours": life.hours,
            f"{name}_life_is_bound": life.bound,
            f"{name}_life_of": None if life.bound else pair.gears[place].name,
        }
    return content


def _gear_row(gear: GearEndurance, acting: Sequence[StressCheck]) -> dict[str, Any]:
    found: dict[str, Any] = {
        "gear": gear.name,
        "treatment": gear.treatment.name,
        "hardness_HB": gear.brinell,
        "load_cycles": gear.cycles,
    }
    for name, endured in (("contact", gear.contact), ("bending", gear.bending)):
        found |= {
            f"{name}_limit_MPa": endured.endurance_limit,
            f"{name}_equivalence": endured.equivalence,
            f"equivalent_{name}_cycles": endured.equivalent_cycles,
            f"{name}_base_cycles": endured.curve.base_cycles,
            f"raw_{name}_life_factor": endured.raw_factor,
            f"{name}_life_factor": endured.factor,
            f"allowable_{name}_MPa": endured.allowable,
            f"greatest_{name}_MPa": plain(endured.greatest),
        }
    for name, one in zip(_NAMES, acting, strict=False):
        found |= {
            f"{name}_stress_MPa": one.lasting,
            f"{name}_margin": one.margin,
            f"peak_{name}_stress_MPa": one.peak,
            f"{name}_overload_margin": plain(one.peak_margin),
            f"{name}_life_hours": one.life.hours,
            f"{name}_life_is_bound": one.life.bound,
        }
    return found


def _over_hours(pair: PairStrength) -> list[dict[str, Any]]:
    return [
        {
            "time_hours": hours,
            "gear": gear.name,
            "allowable_contact_MPa": gear.contact.allowable_at(hours),
            "allowable_bending_MPa": gear.bending.allowable_at(hours),
        }
        for gear in pair.gears
        for hours in np.geomspace(*shown_hours(pair), 121).tolist()
    ]


def _warnings(tables: StrengthTables, pair: PairStrength) -> list[str]:
    found = [*_input_warnings(tables, pair), *_undercut(tables)]
    for gear, acting in _acting(pair):
        for name, one in zip(_NAMES, acting, strict=False):
            found += _strength_warnings(pair, gear, name, one)
    return found


def _input_warnings(tables: StrengthTables, pair: PairStrength) -> list[str]:
    found = []
    for gear, table in zip(pair.gears, (tables.pinion, tables.wheel), strict=True):
        outside = gear.treatment.outside(gear.hardness)
        if outside:
            found.append(f"{gear.name}.hardness_{gear.treatment.scale}: {outside}")
        if not 1.4 <= table.bending_safety <= 2.2:
            found.append(
                f"{gear.name}.bending_safety: the source uses 1.4 to 2.2 (got {table.bending_safety:g})"
            )
    factor, cycles = tables.overload.overload_frequency_factor, pair.spectrum.peak_cycles
    if factor > 1.0 and cycles >= 1e3:
        found.append(
            f"overload.overload_frequency_factor: {factor:g} applies to single overloads, but this one lasts "
            f"{cycles:g} cycles; the source then uses 1"
        )
    return found


def _undercut(tables: StrengthTables) -> list[str]:
    load = None if tables.load is None else tables.load.plain(PairLoad)
    if load is None or load.pinion_teeth >= load.undercut_below:
        return []
    return [
        f"load.pinion_teeth: {load.pinion_teeth} teeth without profile shift are undercut; below "
        f"{load.undercut_below} teeth, stress and life are rough estimates only"
    ]


def _strength_warnings(pair: PairStrength, gear: GearEndurance, name: str, one: StressCheck) -> list[str]:
    found = []
    if one.margin < 1.0:
        found.append(
            f"{gear.name}: the {name} stress of {one.lasting:.1f} MPa exceeds the "
            f"{one.endurance.allowable:.1f} MPa allowed for {grouped(pair.hours)} h"
        )
    if one.peak_margin < 1.0:
        found.append(
            f"{gear.name}: the {name} stress at overload, {one.peak:.1f} MPa, exceeds the "
            f"{one.endurance.greatest:.1f} MPa allowed"
        )
    if pair.peak > 1.0 and math.isnan(one.peak_margin):
        found.append(
            f"{gear.name}: {name} at overload cannot be checked: give "
            f"{gear.name}.yield_strength_MPa or {gear.name}.greatest_{name}_MPa"
        )
    return found
