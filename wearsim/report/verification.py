"""What a sheet verifies: the drive as it was given, and the loads and the lubrication that follow from it."""

from collections.abc import Mapping, Sequence
from typing import Any

from wearsim.case.model import Case
from wearsim.chain.drive_layout import DriveLayout
from wearsim.chain.power_rating import shock_class, strand_factor, tooth_factor
from wearsim.chain.practice_drive import PracticeDrive
from wearsim.chain.rating_findings import RatingFinding
from wearsim.lubrication.lubrication_life_factor import lubrication_state
from wearsim.lubrication.recommended import lubrication_speed_limits, recommended_oils
from wearsim.mechanisms.wrap.drive import WrapDrive, supply_in_words
from wearsim.quantities import grouped
from wearsim.report.text_lines import listed

Rows = list[tuple[str, str]]
"""Labels with their texts."""

NOT_GIVEN = "not given"

_LOADS = {"power_kW": "kW", "torque_N_m": "N m", "tension_N": "N of tension"}
"""Units of the keys of which one gives a load."""

_TYPES = {
    "drip": "drip, or by hand every 8 hours (type A of ANSI B29.1)",
    "oil bath": "oil bath or disc (type B of ANSI B29.1)",
    "forced": "oil stream (type C of ANSI B29.1)",
}
"""Lubrications that are required, in words."""

_MOST_BLOCKS = 4
"""Blocks of a duty that are written out."""


def given_rows(inputs: Mapping[str, Any], case: Case) -> Rows:
    """Return what was given of a chain drive, as it was written; no rows without a chain that wraps.

    Inputs are the tables as they were written, the case is that of the driver, completed.
    """
    wrap = case.drive
    if not isinstance(wrap, WrapDrive):
        return []
    teeth = wrap.layout.rated_teeth
    return [
        ("load as given", _load(inputs)),
        ("shock class", _shocks(inputs, wrap)),
        ("running time", _running_time(inputs)),
        ("lubrication", _lubrication(inputs)),
        ("centre distance", _centre_distance(inputs, wrap)),
        ("chain", f"{wrap.chain.in_words}, {wrap.layout.links} links"),
        ("sprockets", f"{listed([f'{z:g}' for z in teeth])} teeth, ratio {max(teeth) / min(teeth):.4g}"),
    ]


def _load(inputs: Mapping[str, Any]) -> str:
    blocks = inputs.get("duty") or []
    if blocks:
        shown = [f"{_share(block)} {_one_load(block)}" for block in blocks[:_MOST_BLOCKS]]
        more = len(blocks) - len(shown)
        return "; ".join(shown) + (f"; {more} more blocks" if more else "")
    table = inputs.get("load") or {}
    if "duty_file" in table:
        return f"log {table['duty_file']}"
    regime = f", typical regime {table['regime']}" if table.get("regime") is not None else ""
    return f"{_one_load(table)}{regime}"


def _share(block: Mapping[str, Any]) -> str:
    share = next((key for key in ("share_of_time", "share_of_cycles") if block.get(key) is not None), "")
    kind = share.removeprefix("share_of_")
    return f"{100.0 * block[share]:.4g} % of the {kind}" if share else ""


def _one_load(table: Mapping[str, Any]) -> str:
    loads = [_amount(table[key], unit) for key, unit in _LOADS.items() if table.get(key) is not None]
    return f"{', '.join(loads) or NOT_GIVEN} at {_amount(table.get('speed_rpm', NOT_GIVEN), 'rpm')}"


def _amount(value: Any, unit: str) -> str:
    """Return a value as it was written, a number with the unit of its key."""
    return value if isinstance(value, str) else f"{value:.6g} {unit}"


def _shocks(inputs: Mapping[str, Any], wrap: WrapDrive) -> str:
    factor = wrap.service_factor
    if (inputs.get("drive") or {}).get("service_factor") is None:
        return f"{NOT_GIVEN}: f1 = {factor:g} is assumed (smooth driver, smooth load)"
    found = shock_class(factor)
    if found is None:
        return f"f1 = {factor:g}, not a class of ISO 10823"
    driver, driven = found
    return f"driver {driver}, driven machine {driven} (f1 = {factor:g} of ISO 10823)"


def _running_time(inputs: Mapping[str, Any]) -> str:
    hours = (inputs.get("service") or {}).get("hours_per_day")
    return NOT_GIVEN if hours is None else f"{_amount(hours, 'h')} a day"


def _lubrication(inputs: Mapping[str, Any]) -> str:
    table = inputs.get("lubrication") or {}
    condition = (inputs.get("wear") or {}).get("condition")
    wear = f"wear condition {condition!r}" if condition else "wear coefficient given"
    lubricant, environment = table.get("lubricant"), table.get("environment")
    texts = [lubricant or f"type {NOT_GIVEN}, {wear}", f"environment {environment}" if environment else ""]
    return ", ".join(filter(None, texts))


def _centre_distance(inputs: Mapping[str, Any], wrap: WrapDrive) -> str:
    layout = wrap.layout
    if not isinstance(layout, DriveLayout):
        return "prescribed by the positions of the sprockets"
    found = f"{layout.centre_distance:.2f} mm (taut)"
    prescribed = (inputs.get("drive") or {}).get("centre_distance_mm")
    if prescribed is None:
        return f"not prescribed; {layout.links} links give {found}"
    return f"prescribed {_amount(prescribed, 'mm')}; {layout.links} links need {found}"


def verification_rows(case: Case, ratings: Sequence[RatingFinding]) -> Rows:
    """Return bearing pressure, factors and the lubrication that is required; no rows without a wrap."""
    wrap = case.drive
    if not isinstance(wrap, WrapDrive):
        return []
    blocks = wrap.practice(case)
    return [
        *(_pressure_rows(wrap, max(blocks, key=lambda one: one.pressure)) if blocks else []),
        *_factor_rows(wrap, ratings),
        *(_lubrication_rows(case, max(blocks, key=lambda one: one.chain_speed)) if blocks else []),
    ]


def _pressure_rows(wrap: WrapDrive, worst: PracticeDrive) -> Rows:
    factor = wrap.joint_application_factor
    pressed = f"; {grouped(factor * worst.pressure)} N/mm2 with K_e = {factor:g}" if factor != 1.0 else ""
    return [
        ("chain speed", f"{worst.chain_speed:.4g} m/s"),
        ("chain pull", f"{grouped(worst.pull)} N"),
        (
            "bearing pressure",
            f"{grouped(worst.pressure)} N/mm2 on {worst.bearing_area:g} mm2{_strands(worst)}{pressed}",
        ),
    ]


def _strands(drive: PracticeDrive) -> str:
    """Say how unequally several strands share the load; nothing of one."""
    if drive.strands == 1:
        return ""
    return f", where {drive.strands} strands carry {strand_factor(drive.strands):g} times the load of one"


def _factor_rows(wrap: WrapDrive, ratings: Sequence[RatingFinding]) -> Rows:
    teeth = min(wrap.layout.rated_teeth)
    corrected = next((one for one in ratings if one.name == "corrected power"), None)
    return [
        ("application factor f1", f"{wrap.service_factor:g}, shocks (ISO 10823)"),
        ("tooth factor f2", f"{tooth_factor(teeth):.3g} for {teeth:g} teeth (ISO 10823)"),
        *(
            [("corrected power P f1 f2", f"{grouped(corrected.value)} {corrected.unit}")]
            if corrected is not None
            else []
        ),
    ]


def _lubrication_rows(case: Case, fastest: PracticeDrive) -> Rows:
    required = fastest.recommended
    drip, bath = lubrication_speed_limits(fastest.pitch)
    limits = f"drip up to {drip:.3g} m/s, bath up to {bath:.3g} m/s"
    supplied, environment = supply_in_words(case)
    usual, *others = sorted(recommended_oils(), key=lambda oil: not oil.coldest <= 20.0 <= oil.warmest)
    other = "; ".join(f"{oil.sae} at {oil.coldest:g} to {oil.warmest:g}" for oil in others)
    return [
        ("required lubrication", f"{_TYPES[required]}; at this pitch {limits}"),
        *(
            [("lubrication given", f"{supplied}: {lubrication_state(supplied, required, environment)}")]
            if supplied
            else []
        ),
        (
            "required viscosity",
            f"{usual.sae} (ISO VG {usual.iso_vg}) at {usual.coldest:g} to {usual.warmest:g} °C; "
            f"{other} (Renold)",
        ),
    ]
