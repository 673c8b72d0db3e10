"""Strength of a gear pair: text, tables and JSON."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from wearsim.command.calculation_sheet import Sheet
from wearsim.handbook.strength.figure import shown_hours, strength_figure
from wearsim.handbook.strength.keys import StrengthTables
from wearsim.handbook.strength.model import Gear, PairStrength, Stresses, first_life
from wearsim.handbook.strength.text import strength_text
from wearsim.report.answer import grouped

_NAMES = ("contact", "bending")
_LEAST_TEETH = 2.0
"""Over sin^2 of the pressure angle: teeth below which a gear without shift is undercut."""


def strength_sheet(tables: StrengthTables, pair: PairStrength) -> Sheet:
    """Return what ``wearsim strength`` shows.

    Parameters
    ----------
    tables : StrengthTables
        The case.
    pair : PairStrength
        What it comes to.

    Returns
    -------
    Sheet
        With the tables ``gears`` and ``allowable_over_hours``.
    """
    gears = [_gear_row(gear, acting) for gear, acting in _acting(pair)]
    return Sheet(
        text=strength_text(tables, pair),
        content={"title": tables.title, **_pair_content(pair), "gears": gears},
        tables={"gears": pd.DataFrame(gears), "allowable_over_hours": _over_hours(pair)},
        figures={"strength": strength_figure(tables.title, pair)},
        warnings=tuple(_warnings(tables, pair)),
    )


def _acting(pair: PairStrength) -> list[tuple[Gear, Sequence[Stresses]]]:
    """Return each gear with its stresses in contact and in bending, none without a load."""
    return list(zip(pair.gears, pair.stresses or ((), ()), strict=True))


def _known(value: float) -> float | None:
    return None if math.isnan(value) else value


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


def _gear_row(gear: Gear, acting: Sequence[Stresses]) -> dict[str, Any]:
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
            f"greatest_{name}_MPa": _known(endured.greatest),
        }
    for name, one in zip(_NAMES, acting, strict=False):
        found |= {
            f"{name}_stress_MPa": one.lasting,
            f"{name}_margin": one.margin,
            f"peak_{name}_stress_MPa": one.peak,
            f"{name}_overload_margin": _known(one.peak_margin),
            f"{name}_life_hours": one.life.hours,
            f"{name}_life_is_bound": one.life.bound,
        }
    return found


def _over_hours(pair: PairStrength) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "time_hours": hours,
            "gear": gear.name,
            "allowable_contact_MPa": gear.contact.allowable_at(hours),
            "allowable_bending_MPa": gear.bending.allowable_at(hours),
        }
        for gear in pair.gears
        for hours in np.geomspace(*shown_hours(pair), 121).tolist()
    )


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
                f"{gear.name}.bending_safety: the source takes 1.4 to 2.2, it is {table.bending_safety:g}"
            )
    factor, cycles = tables.overload.overload_frequency_factor, pair.spectrum.peak_cycles
    if factor > 1.0 and cycles >= 1e3:
        found.append(
            f"overload.overload_frequency_factor: {factor:g} is for single overloads, this one acts for "
            f"{cycles:g} cycles: 1 is the source's value"
        )
    return found


def _undercut(tables: StrengthTables) -> list[str]:
    load = tables.load
    if load is None:
        return []
    least = _LEAST_TEETH / math.sin(math.radians(load.pressure_angle_deg)) ** 2
    if load.pinion_teeth >= math.floor(least):
        return []
    return [
        f"load.pinion_teeth: {load.pinion_teeth} teeth without profile shift are undercut, below "
        f"{math.floor(least)} stress and life are only a guess"
    ]


def _strength_warnings(pair: PairStrength, gear: Gear, name: str, one: Stresses) -> list[str]:
    found = []
    if one.margin < 1.0:
        found.append(
            f"{gear.name}: the {name} stress of {one.lasting:.1f} MPa exceeds the "
            f"{one.endurance.allowable:.1f} MPa allowed for {grouped(pair.hours)} h"
        )
    if one.peak_margin < 1.0:
        found.append(
            f"{gear.name}: the {name} stress in an overload of {one.peak:.1f} MPa exceeds the "
            f"{one.endurance.greatest:.1f} MPa allowed"
        )
    if pair.peak > 1.0 and math.isnan(one.peak_margin):
        found.append(
            f"{gear.name}: {name} in an overload cannot be judged: give "
            f"{gear.name}.yield_strength_MPa or {gear.name}.greatest_{name}_MPa"
        )
    return found
