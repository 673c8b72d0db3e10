"""Depth of wear along the gaps of a placed wheel, tooth by tooth and in the mean, with its standard error."""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.signal import savgol_filter

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.placement import Placement, smoothing_window

Facing = Literal["clockwise", "counterclockwise"]
"""Which way a flank faces as one sees the wheel."""

_CORNER = 0.06
"""Part of the half length of a gap at each tip at which no depth is told."""

_BOTH = 0.5
"""Depth of the other flank over that of the worn one, above which both are worn."""

_EDGE_MODEL = 0.02
"""Standard deviation of what light, blur and pixels do to all edges of a kind alike [px]."""


@dataclass(frozen=True, eq=False)
class FlankDepths:
    """Depth along the gaps [mm], from their right tip to their left one."""

    place: Placement
    teeth: Vector  # smoothed, of every gap, nan where it has no edge, shape (teeth, stations)
    mean: Vector  # of all gaps, shape (stations,)
    deviations: (
        Vector  # what one standard deviation of each cause moves the mean by, shape (causes, stations)
    )
    deepest: int  # station of the loaded side where the mean is deepest
    both_worn: bool = False  # whether the other flank is worn too, so that the wheel may be placed turned

    @property
    def error(self) -> Vector:
        """Standard error of the mean [mm], shape (stations,)."""
        return np.asarray(np.hypot.reduce(self.deviations, axis=0))

    @property
    def facing(self) -> Facing:
        """Which way the flank that is worn most faces."""
        return "clockwise" if self.place.left_worn else "counterclockwise"

    @property
    def depth(self) -> float:
        """Mean depth at the deepest place [mm]."""
        return float(self.mean[self.deepest])

    @property
    def depth_error(self) -> float:
        """Standard error of that [mm]."""
        return float(self.error[self.deepest])

    @property
    def of_teeth(self) -> Vector:
        """Depth of every tooth at that place [mm], nan where it has no edge."""
        return np.asarray(self.teeth[:, self.deepest])

    @property
    def other_depth(self) -> float:
        """Greatest mean depth of the other side [mm]."""
        return float(self.mean[self._side(not self.place.left_worn)].max())

    @property
    def seen_share(self) -> float:
        """Part of the places along the worn flank that have an edge."""
        return float(np.isfinite(self.place.edges.off[:, self._side(self.place.left_worn)]).mean())

    @property
    def deepest_radius(self) -> float:
        """Distance of the deepest place from the axis [mm]."""
        return float(np.hypot(*self.place.stations.points[self.deepest]))

    @property
    def misfit(self) -> float:
        """How far the mean of all gaps is off the new form where it does not wear, root mean square [mm]."""
        return float(np.sqrt(np.mean(self.mean[self.place.unworn] ** 2)))

    @property
    def worn_gap(self) -> Vector:
        """Points of the mean gap [mm], from its right tip to its left one, the corners left out."""
        return self.gap_of(self.mean)

    def gap_of(self, depth: Vector) -> Vector:
        """Return points of a gap that is worn so deep [mm], the corners left out."""
        stations = self.place.stations
        inner = np.abs(stations.from_middle) < 1.0 - _CORNER
        return np.asarray((stations.points - depth[:, None] * stations.normals)[inner])

    def _side(self, left: bool) -> Vector:
        side = self.place.stations.from_middle * (1.0 if left else -1.0)
        return np.asarray((side > 0.1) & (side < 1.0 - _CORNER))


def flank_depths(place: Placement) -> FlankDepths:
    """Return the depth along the gaps of a placed wheel."""
    window = smoothing_window(place.stations.way.size)
    teeth = np.stack([_smoothed(row, window) for row in place.depth])
    mean = _mean(teeth)
    placed = (place.depth_by_unknowns @ np.linalg.cholesky(place.covariance)).T
    stretch = place.edges.gaps.stretch.mean(axis=0)
    # A local quadratic over n points has 9/4 of the variance of their mean.
    alone = 2.25 * place.noise**2 * max(1.0, place.correlation) / (window * place.wheel.teeth)
    unworn = mean[place.unworn]
    misfit = float(np.mean(unworn**2)) if unworn.size else 0.0
    own = np.sqrt((alone + _EDGE_MODEL**2) / stretch**2 + misfit)
    side = place.stations.from_middle * (1.0 if place.left_worn else -1.0)
    loaded = np.flatnonzero((side > 0.1) & (side < 1.0 - _CORNER))
    depths = FlankDepths(place, teeth, mean, np.vstack([placed, own]), int(loaded[mean[loaded].argmax()]))
    if depths.other_depth <= max(_BOTH * depths.depth, 3.0 * depths.depth_error):
        return depths
    # By anything up to half of that depth, either way: uniform.
    turned = 0.5 * depths.other_depth / math.sqrt(3.0) * np.sign(side)
    return replace(depths, deviations=np.vstack([placed, own, turned]), both_worn=True)


def _smoothed(row: Vector, window: int) -> Vector:
    """Local quadratics through a row; nan where edges lack for most of the window."""
    known = np.isfinite(row)
    if known.sum() < window:
        return np.full_like(row, math.nan)
    places = np.arange(row.size)
    filled = np.interp(places, places[known], row[known])
    smooth = np.asarray(savgol_filter(filled, window, 2))
    share = np.convolve(known, np.ones(window) / window, mode="same")
    return np.where(share > 0.5, smooth, math.nan)


def _mean(teeth: Vector) -> Vector:
    """Mean of all gaps without those far off, which dirt or a burr has; 0 where no gap has an edge."""
    held = np.where(np.isfinite(teeth).any(axis=0), teeth, 0.0)
    middle = np.nanmedian(held, axis=0)
    spread = 1.4826 * np.nanmedian(np.abs(held - middle), axis=0)
    return np.asarray(
        np.nanmean(np.where(np.abs(held - middle) <= 5.0 * spread + 1e-9, held, math.nan), axis=0)
    )
