"""Pictures of a synthesis: path of contact, profiles, indices along it, fields over the plane."""

import math
from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from wearsim.contact.prescribed_stress import LoadedPair
from wearsim.geometry.gear.path_of_contact import PathOfContact
from wearsim.geometry.gear.plane_gearing import Family, PitchCircles
from wearsim.geometry.profile_points import Vector
from wearsim.handbook.synthesise.model import MeshField, MeshPhase
from wearsim.report.text_lines import literal

_RADII = (2.0, 5.0, 10.0, 20.0, 50.0)
_SLIDING = (-10.0, -5.0, -2.0, -1.0, -0.5, 0.0, 0.2, 0.4, 0.6, 0.8)
_ANGLES = (-60.0, -40.0, -30.0, -20.0, -10.0, -5.0, 0.0, 5.0, 10.0, 20.0, 30.0, 40.0, 60.0)
_STRESSES = (200.0, 300.0, 400.0, 600.0, 1000.0)

_STEEPEST = math.radians(65.0)
"""Pressure angle up to which contours are drawn: beyond it they crowd."""


def line_figure(title: str, phases: Sequence[MeshPhase]) -> Figure:
    """Return the paths of contact in the plane of mesh, and the profiles that they make."""
    figure = Figure(figsize=(10.0, 4.6), layout="constrained")
    plane, profiles = figure.subplots(1, 2, width_ratios=(1.6, 1.0))
    for number, phase in enumerate(phases, 1):
        colour = f"C{number - 1}"
        name = f"phase {number}, family {phase.family:+d}"
        plane.plot(*phase.line.contacts.points.T, color=colour, linewidth=1.8, label=name)
        plane.plot(*phase.involute.contacts.points.T, "--", color=colour, linewidth=0.9)
        if phase.line.roll_angle[0] == 0.0:
            plane.plot(*phase.line.contacts.points[0], "o", color=colour, markersize=4)
        _draw_profiles(profiles, phase, colour)
    plane.plot(0.0, 0.0, "k+", markersize=10)
    plane.annotate("pitch point", (0.0, 0.0), (5, -12), textcoords="offset points", fontsize=8)
    _draw_pitch_circles(plane, phases[0].line.contacts.circles)
    plane.set_title("lines of action (dashed: involute) and pitch circles", fontsize=9, loc="left")
    profiles.set_title("profiles in contact (dotted: wheel)", fontsize=9, loc="left")
    for panel in (plane, profiles):
        panel.set_aspect("equal", "datalim")
        panel.set_xlabel("x, mm")
        panel.grid(alpha=0.3)
    plane.set_ylabel("y, mm")
    figure.legend(loc="outside lower left", ncols=3, frameon=False, fontsize=8)
    figure.suptitle(literal(title), fontsize=10, x=0.01, ha="left")
    return figure


def _draw_pitch_circles(panel: Axes, circles: PitchCircles) -> None:
    """Draw both pitch circles over what the panel shows along x."""
    left, right = panel.get_xlim()
    for radius, side in ((circles.pinion_radius, -1.0), (circles.wheel_radius, 1.0)):
        reach = 0.99 * radius
        x = np.linspace(max(left, -reach), min(right, reach), 100)
        y = side * (radius - np.sqrt(radius**2 - x**2))
        panel.plot(x, y, color="0.6", linewidth=0.8)


def _draw_profiles(panel: Axes, phase: MeshPhase, colour: str) -> None:
    circles = phase.line.contacts.circles
    pinion = phase.line.pinion_profile - [0.0, circles.pinion_radius]
    wheel = phase.line.wheel_profile - [0.0, -circles.wheel_radius]
    panel.plot(*pinion.T, color=colour, linewidth=1.6)
    panel.plot(*wheel.T, ":", color=colour, linewidth=1.6)


def indices_figure(title: str, indices: pd.DataFrame) -> Figure:
    """Return the indices along the paths of contact."""
    figure = Figure(figsize=(10.0, 6.4), layout="constrained")
    panels = figure.subplots(2, 3, sharex=True).ravel()
    for number, rows in indices.groupby("mesh_phase"):
        colour = f"C{int(str(number)) - 1}"
        for panel, (_, columns) in zip(panels, _PANELS, strict=True):
            for column, style in columns.items():
                inverse = column.endswith("radius_mm")
                values = 1.0 / rows[column] if inverse else rows[column]
                label = f"phase {number}" if style == "-" else None
                panel.plot(rows["pitch_point_distance_mm"], values, style, color=colour, label=label)
    for panel, (label, _) in zip(panels, _PANELS, strict=True):
        panel.set_title(label, fontsize=9, loc="left")
        panel.grid(alpha=0.3)
    for panel in panels[3:]:
        panel.set_xlabel("distance from the pitch point, mm")
    if indices["mesh_phase"].nunique() > 1:
        panels[2].legend(frameon=False, fontsize=8)
    figure.suptitle(literal(f"{title}; dashed: involute"), fontsize=10, x=0.01, ha="left")
    return figure


_PANELS: tuple[tuple[str, dict[str, str]], ...] = (
    ("contact stress, MPa", {"contact_stress_MPa": "-", "involute_contact_stress_MPa": "--"}),
    ("pressure angle, deg", {"pressure_angle_deg": "-"}),
    ("sliding speed, mm/s", {"sliding_speed_mm_per_s": "-"}),
    ("curvature, 1/mm (dotted: wheel)", {"pinion_flank_radius_mm": "-", "wheel_flank_radius_mm": ":"}),
    (
        "specific sliding of the pinion",
        {"pinion_specific_sliding": "-", "involute_pinion_specific_sliding": "--"},
    ),
    (
        "specific sliding of the wheel",
        {"wheel_specific_sliding": "-", "involute_wheel_specific_sliding": "--"},
    ),
)


def field_figure(
    title: str, pair: LoadedPair, field: MeshField, family: Family, lines: Sequence[PathOfContact]
) -> Figure:
    """Return the fields of indices of one family with the prescribed stress."""
    figure = Figure(figsize=(11.0, 6.4), layout="constrained")
    panels = figure.subplots(2, 3, sharex=True, sharey=True).ravel()
    contacts = field.contacts
    with np.errstate(invalid="ignore", divide="ignore"):
        shown: tuple[tuple[str, Vector, Mapping[float, str]], ...] = (
            ("radius of the pinion's profile, mm", contacts.pinion_curvature, _curvatures()),
            ("radius of the wheel's profile, mm", contacts.wheel_curvature, _curvatures()),
            ("angle from normal to line of action, deg", np.degrees(contacts.direction), _plain(_ANGLES)),
            ("specific sliding of the pinion", contacts.pinion_specific_sliding, _plain(_SLIDING)),
            ("specific sliding of the wheel", contacts.wheel_specific_sliding, _plain(_SLIDING)),
            ("sliding speed, mm/s", pair.speed * contacts.sliding, {}),
        )
    for panel, (label, values, levels) in zip(panels, shown, strict=True):
        _contours(panel, field, values, levels)
        for line in lines:
            panel.plot(*line.contacts.points.T, color="black", linewidth=2.0)
        panel.set_title(label, fontsize=9, loc="left")
    _axes_labels(panels.reshape(2, 3))
    size = "large" if family == 1 else "small"
    note = f"family {family:+d}, {size} radii; hatched: no such profiles; thick: line of action"
    figure.suptitle(literal(f"{title}: {note}"), fontsize=10, x=0.01, ha="left")
    return figure


def direction_figure(title: str, fields: Mapping[float, MeshField]) -> Figure:
    """Return reduced radius and contact stress for paths of contact with given directions."""
    figure = Figure(figsize=(1.0 + 3.4 * len(fields), 6.0), layout="constrained")
    panels = figure.subplots(2, len(fields), sharex=True, sharey=True, squeeze=False)
    for column, (mu, field) in zip(panels.T, fields.items(), strict=True):
        with np.errstate(invalid="ignore", divide="ignore"):
            _contours(column[0], field, field.contacts.relative_curvature, _curvatures())
        _contours(column[1], field, field.contact_stress, _plain(_STRESSES))
        column[0].set_title(f"reduced radius, mm (mu = {mu:g} deg)", fontsize=9, loc="left")
        column[1].set_title(f"contact stress, MPa (mu = {mu:g} deg)", fontsize=9, loc="left")
    _axes_labels(panels)
    figure.suptitle(literal(f"{title}; hatched: profiles interfere"), fontsize=10, x=0.01, ha="left")
    return figure


def _axes_labels(panels: "np.ndarray[tuple[int, int], np.dtype[np.object_]]") -> None:
    for panel in panels[-1]:
        panel.set_xlabel("x, mm")
    for panel in panels[:, 0]:
        panel.set_ylabel("y, mm")


def _curvatures() -> dict[float, str]:
    """Return levels of curvature with their radii as labels."""
    levels = {sign / radius: f"{sign * radius:g}" for radius in _RADII for sign in (1.0, -1.0)}
    return dict(sorted({**levels, 0.0: "∞"}.items()))


def _plain(levels: Sequence[float]) -> dict[float, str]:
    return {level: f"{level:g}" for level in levels}


def _contours(panel: Axes, field: MeshField, values: Vector, levels: Mapping[float, str]) -> None:
    """Draw labelled contours, blue above 0 and red below, and hatch where there are no profiles."""
    barred = np.isin(field.infeasibility, ("complex", "interference", "no stress"))
    if barred.any():
        panel.contourf(field.x, field.y, barred.astype(float), [0.5, 1.5], colors="0.95", hatches=["//"])
    for line in (panel.axhline, panel.axvline):
        line(0.0, color="0.6", linewidth=0.6)
    drawn = (field.infeasibility == "") & (np.abs(field.contacts.pressure_angle) < _STEEPEST)
    known = np.ma.masked_invalid(np.where(drawn, values, math.nan))
    panel.set_xlim(field.x.min(), field.x.max())
    panel.set_ylim(field.y.min(), field.y.max())
    if known.count() == 0:
        return
    least, greatest = float(known.min()), float(known.max())
    at = list(levels) or list(MaxNLocator(9).tick_values(least, greatest))
    at = [level for level in at if least < level < greatest]
    if at:
        colours = ["tab:red" if level < 0.0 else "tab:blue" if level else "black" for level in at]
        lines = panel.contour(field.x, field.y, known, at, colors=colours, linewidths=0.9, linestyles="solid")
        panel.clabel(lines, fmt=dict(levels) or "%g", fontsize=7)
