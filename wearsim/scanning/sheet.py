"""The wear that a photograph shows: text, JSON, tables and what other commands take."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from wearsim._version import ANSWER_HEAD
from wearsim.quantities import grouped
from wearsim.report.answer_table import AnswerTable, Column, csv_of, plain, table_of
from wearsim.report.text_lines import Finding, answer_text, closing
from wearsim.result import life_keys
from wearsim.result.lives import hours
from wearsim.scanning.chain_beside import SeenChain
from wearsim.scanning.model import SURE, ScannedWheel
from wearsim.scanning.over_pins import OverPins, over_pins
from wearsim.scanning.sheet_placement import SeenSheet
from wearsim.study.remaining.model import RemainingLife


def tooth_table(found: ScannedWheel) -> AnswerTable[int]:
    """Return a row for each tooth: where it is in the picture, and its depth."""
    depths, place = found.depths, found.depths.place
    tips = place.edges.tips.points.mean(axis=1)
    worn = (place.stations.from_middle > 0.0) == place.left_worn
    # Tooth n follows gap n counterclockwise: the left side of gap n is its own, the right one that of n + 1.
    gaps = (
        np.arange(found.wheel.teeth)
        if place.left_worn
        else (np.arange(found.wheel.teeth) + 1) % found.wheel.teeth
    )
    return AnswerTable(
        [
            Column("tooth", lambda n: n + 1, "tooth", "{}"),
            Column("tip_x_px", lambda n: float(tips[n, 0])),
            Column("tip_y_px", lambda n: float(tips[n, 1])),
            Column("depth_mm", lambda n: float(depths.of_teeth[gaps[n]]), "depth, mm", "{:.3f}"),
            Column("deepest_mm", lambda n: _deepest(depths.teeth[gaps[n]][worn])),
        ],
        range(found.wheel.teeth),
    )


def _deepest(values: Any) -> float:
    return float(np.nanmax(values)) if np.isfinite(values).any() else math.nan


def depth_table(found: ScannedWheel) -> AnswerTable[int]:
    """Return a row for each place along the mean gap, from its right tip to its left one."""
    depths, stations = found.depths, found.depths.place.stations
    spread = np.nanstd(np.where(np.isfinite(depths.teeth), depths.teeth, depths.mean), axis=0)
    return AnswerTable(
        [
            Column("arc_length_mm", lambda n: float(stations.way[n])),
            Column("new_x_mm", lambda n: float(stations.points[n, 0])),
            Column("new_y_mm", lambda n: float(stations.points[n, 1])),
            Column("depth_mm", lambda n: float(depths.mean[n])),
            Column("depth_se_mm", lambda n: float(depths.error[n])),
            Column("spread_mm", lambda n: float(spread[n])),
        ],
        range(stations.way.size),
    )


def points_csv(found: ScannedWheel) -> str:
    """Return the mean gap as ``profile = "points"`` takes it."""
    return csv_of(table_of({"x_mm": x, "y_mm": y} for x, y in np.round(found.depths.worn_gap, 5).tolist()))


def readings_csv(found: ScannedWheel) -> str:
    """Return the depth as a reading for ``wearsim calibrate``."""
    depths = found.depths
    return csv_of(
        table_of(
            [
                {
                    "time_hours": found.hours,
                    "quantity": "max_depth_mm",
                    "value": round(depths.depth, 5),
                    "error": round(depths.depth_error, 5),
                }
            ]
        )
    )


def scan_text(found: ScannedWheel, explain: bool = False) -> str:
    """Return the answer as ``wearsim scan`` prints it."""
    title = f"{found.photograph.name}: {found.wheel.words}"
    return answer_text(title, *scan_findings(found), *closing(found.assumptions, found.warnings, explain))


def scan_findings(found: ScannedWheel) -> Iterator[Finding]:
    """Return what is said of the teeth, their depth and the picture."""
    depths, place, wheel = found.depths, found.depths.place, found.wheel
    teeth = depths.of_teeth[np.isfinite(depths.of_teeth)]
    yield Finding("Teeth", f"{wheel.teeth} " + ("as given, and counted" if wheel.per_case else "counted"))
    if found.is_worn:
        yield Finding("Worn flank", f"the one that faces {depths.facing}, as seen in the picture")
        yield Finding(
            "Depth",
            f"{depths.depth:.3f} mm +- {depths.depth_error:.3f} (standard error), mean of {teeth.size} "
            f"teeth, deepest at a diameter of {2.0 * depths.deepest_radius:.4g} mm",
        )
    else:
        least = max(depths.depth, 0.0) + SURE * depths.depth_error
        yield Finding("Depth", f"no measurable wear: at most {least:.3f} mm")
    yield Finding(
        "Each tooth",
        f"{teeth.min():.3f} to {teeth.max():.3f} mm there, standard deviation {teeth.std():.3f} mm",
    )
    yield Finding("Other flank", f"{max(depths.other_depth, 0.0):.3f} mm where it is deepest")
    if (pins := over_pins(depths)) is not None:
        yield _pins_finding(pins)
    if found.chain is not None:
        yield _chain_finding(found.chain)
    yield Finding("New form", f"fits within {depths.misfit:.3f} mm where the wheel is not worn")
    by = (
        f"the form of the teeth, if their pitch is {wheel.pitch:g} mm: a wrong chain gives wrong millimetres "
        "without another sign, so check it with --bore-mm or --scale"
        if place.known is None
        else place.known.words
    )
    yield Finding("Scale", f"{place.scale:.4g} pixels per mm by {by}")
    yield Finding(
        "Picture",
        f"{found.photograph.width} x {found.photograph.height} pixels, {wheel.pitch * place.scale:.0f} to a "
        f"pitch; blur {place.blur:.1f}, scatter of the edge {place.noise:.2f} pixels"
        + ("" if found.sheet is None else f"; {_seen_by(found.sheet)}"),
    )
    if found.remaining is not None:
        left = found.remaining
        band = f"{hours(left.remaining_low)} to {hours(left.remaining_high)}"
        yield Finding("Remaining", f"{hours(left.remaining)} after {grouped(left.reading.hours)} h")
        yield Finding("Band", f"{band} by two standard errors of the depth")


def _pins_finding(pins: OverPins) -> Finding:
    less = "as the new form, within the error"
    if pins.decrease > SURE * pins.error:
        less = f"{pins.decrease:.3f} mm less than the new form"
    return Finding(
        "Over pins",
        f"{pins.size:.3f} mm +- {pins.error:.3f} with pins of the roller's diameter, "
        f"{pins.pin_diameter:g} mm: {less}",
    )


def _chain_finding(chain: SeenChain) -> Finding:
    longer = f"{chain.elongation:.2f} % +- {chain.elongation_error:.2f} longer than new"
    return Finding(
        "Chain", f"{longer}: {chain.links} links measure {chain.length:.2f} mm, new {chain.new_length:.6g} mm"
    )


def chain_csv(chain: SeenChain, hours: float) -> str:
    """Return the elongation as a reading for ``wearsim remaining``."""
    row = {
        "time_hours": hours,
        "quantity": "elongation_percent",
        "value": round(chain.elongation, 4),
        "error": round(chain.elongation_error, 4),
    }
    return csv_of(table_of([row]))


def _seen_by(sheet: SeenSheet) -> str:
    seen = sheet.camera.projection
    return (
        f"camera tilted by {math.degrees(sheet.camera.tilt):.1f} +- "
        f"{math.degrees(sheet.camera.tilt_error):.1f} degrees, lens distortion "
        f"{100.0 * (seen.distortion + seen.second_distortion):+.2f} %, dots within {sheet.scatter:.3f} mm"
    )


def scan_json(found: ScannedWheel) -> dict[str, Any]:
    """Return the answer as ``wearsim scan --json`` prints it."""
    depths, place, left = found.depths, found.depths.place, found.remaining
    return {
        **ANSWER_HEAD,
        "photograph": found.photograph.name,
        "form": found.wheel.words,
        "teeth": found.wheel.teeth,
        "is_worn": found.is_worn,
        "worn_flank": depths.facing if found.is_worn else None,
        "depth_mm": depths.depth,
        "depth_se_mm": depths.depth_error,
        "deepest_diameter_mm": 2.0 * depths.deepest_radius,
        "teeth_depth_mm": [plain(float(value)) for value in depths.of_teeth],
        "other_flank_depth_mm": depths.other_depth,
        **_over_pins_json(over_pins(depths)),
        "misfit_mm": depths.misfit,
        "scale_px_per_mm": place.scale,
        "scale_by": "form of the teeth" if place.known is None else place.known.words,
        "blur_px": place.blur,
        "edge_scatter_px": place.noise,
        **({} if found.sheet is None else _sheet_json(found.sheet)),
        **({} if found.chain is None else _chain_json(found.chain)),
        "hours": found.hours,
        **({} if left is None else _remaining_json(left)),
        "assumptions": list(found.assumptions),
        "warnings": list(found.warnings),
    }


def _over_pins_json(pins: OverPins | None) -> dict[str, Any]:
    if pins is None:
        return {}
    return {
        "pin_diameter_mm": pins.pin_diameter,
        "size_over_pins_mm": pins.size,
        "over_pins_mm": pins.decrease,
        "over_pins_se_mm": pins.error,
    }


def _sheet_json(sheet: SeenSheet) -> dict[str, Any]:
    seen = sheet.camera.projection
    return {
        "sheet_dots": len(sheet.markers.dots),
        "sheet_scatter_mm": sheet.scatter,
        "camera_tilt_degrees": math.degrees(sheet.camera.tilt),
        "camera_tilt_se_degrees": math.degrees(sheet.camera.tilt_error),
        "camera_height_mm": sheet.height,
        "camera_height_se_mm": sheet.height * sheet.camera.height_error,
        "lens_distortion": seen.distortion + seen.second_distortion,
        "mirrored": sheet.mirrored,
    }


def _chain_json(chain: SeenChain) -> dict[str, Any]:
    return {
        "chain_links": chain.links,
        "chain_length_mm": chain.length,
        "chain_elongation_percent": chain.elongation,
        "chain_elongation_se_percent": chain.elongation_error,
    }


def _remaining_json(left: RemainingLife) -> dict[str, Any]:
    return {
        **life_keys("life_hours", left.life),
        **life_keys("remaining_hours", left.remaining),
        **life_keys("remaining_hours_low", left.remaining_low),
        **life_keys("remaining_hours_high", left.remaining_high),
        "coefficient": left.coefficient,
    }
