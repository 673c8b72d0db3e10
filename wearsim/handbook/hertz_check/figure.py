"""Stresses below the contact and the pressure in it, as a picture."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wearsim.contact.line_stress import axis_shear, axis_stresses, axis_von_mises, greatest_von_mises
from wearsim.handbook.hertz_check.hertz_fem import FemContact
from wearsim.handbook.hertz_check.model import HertzCheck
from wearsim.handbook.hertz_check.published import AxisFile
from wearsim.report.text_lines import literal

_DEEPEST = 3.0
"""Depth that is shown, in half-widths."""


def hertz_check_figure(
    title: str, check: HertzCheck, meshes: Sequence[FemContact], axis: AxisFile | None
) -> Figure:
    """Return the stresses along the depth, and the pressure that finite elements found."""
    panels = 2 if meshes else 1
    figure = Figure(figsize=(4.9 * panels + 0.5, 5.4), layout="constrained")
    axes = figure.subplots(1, panels, squeeze=False)[0]
    _draw_depth(axes[0], check, meshes, axis)
    if meshes:
        _draw_pressure(axes[1], check, meshes)
    figure.suptitle(literal(title), fontsize=9, x=0.01, ha="left")
    return figure


def _draw_depth(panel: Axes, check: HertzCheck, meshes: Sequence[FemContact], axis: AxisFile | None) -> None:
    contact = check.contact
    pressure, half_width = contact.peak_pressure, contact.half_width
    depth = np.linspace(0.0, _DEEPEST, 301)
    along, across = axis_stresses(depth)
    place = depth * half_width
    panel.plot(-pressure * along, place, color="0.6", lw=1.0, label="along the surface, pressure +")
    panel.plot(-pressure * across, place, "--", color="0.6", lw=1.0, label="across it, pressure +")
    panel.plot(pressure * axis_shear(depth), place, color="tab:green", lw=1.2, label="shear")
    mises = pressure * axis_von_mises(depth, contact.poissons_ratio)
    panel.plot(mises, place, color="tab:blue", lw=1.8, label="von Mises")
    if axis is not None:
        near = axis.depth <= _DEEPEST * half_width
        panel.plot(
            axis.von_mises[near],
            axis.depth[near],
            "o",
            mfc="none",
            color="black",
            markersize=5,
            mew=0.8,
            label="von Mises, axis_file",
        )
    for mesh in meshes[-1:]:
        near = mesh.depth <= _DEEPEST * half_width
        panel.plot(
            mesh.von_mises[near],
            mesh.depth[near],
            "+",
            color="tab:orange",
            markersize=6,
            label=f"von Mises, finite elements ({mesh.elements} per a)",
        )
    _draw_published(panel, check)
    panel.set_ylim(_DEEPEST * half_width, -0.08 * half_width)
    panel.set_xlim(left=0.0)
    panel.set_xlabel("stress on the axis, MPa")
    panel.set_ylabel("depth below the surface, mm")
    panel.grid(alpha=0.3)
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, frameon=False, fontsize=7)


def _draw_published(panel: Axes, check: HertzCheck) -> None:
    """Mark the published stresses; their depth is not published, so it is that of the theory."""
    if check.comparison is None:
        return
    columns = check.comparison.columns
    greatest = greatest_von_mises(check.contact.poissons_ratio).depth * check.contact.half_width
    for values, mark, label in (
        ([columns["surface"].hertz, columns["depth"].hertz], "s", "published, Hertz (depth not given)"),
        (
            [columns["surface"].finite_elements, columns["depth"].finite_elements],
            "D",
            "published, finite elements (depth not given)",
        ),
    ):
        if not all(math.isnan(value) for value in values):
            panel.plot(
                values,
                [0.0, greatest],
                mark,
                color="tab:red",
                markersize=6,
                clip_on=False,
                mfc="tab:red" if mark == "s" else "white",
                label=label,
            )


def _draw_pressure(panel: Axes, check: HertzCheck, meshes: Sequence[FemContact]) -> None:
    pressure, half_width = check.contact.peak_pressure, check.contact.half_width
    place = half_width * np.sin(np.linspace(0.0, 0.5 * math.pi, 200))
    shape = pressure * np.sqrt(np.maximum(1.0 - (place / half_width) ** 2, 0.0))
    panel.plot(place, shape, color="tab:blue", lw=1.8, label="Hertz")
    colours = ("tab:orange", "tab:green", "tab:purple", "tab:brown", "tab:pink", "tab:grey")
    for mesh, mark, colour in zip(meshes[::-1], "+x.123", colours, strict=False):
        label = f"finite elements ({mesh.elements} per a)"
        panel.plot(mesh.place, mesh.pressure, mark, color=colour, markersize=6, label=label)
    if check.comparison is not None:
        for name, mark in (("hertz", "s"), ("finite_elements", "D")):
            value = getattr(check.comparison.columns["contact"], name)
            panel.plot(
                0.0,
                value,
                mark,
                color="tab:red",
                markersize=6,
                clip_on=False,
                mfc="tab:red" if mark == "s" else "white",
            )
    panel.set_xlim(0.0, 1.5 * half_width)
    panel.set_ylim(bottom=0.0)
    panel.set_xlabel("distance from the centre of the contact, mm")
    panel.set_ylabel("contact pressure, MPa")
    panel.grid(alpha=0.3)
    panel.legend(loc="upper right", frameon=False, fontsize=8)
