"""A marker sheet under a wheel: scale and camera by its dots, and the picture without them."""

import math
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image, ImageDraw
from scipy.spatial import ConvexHull

from wearsim.geometry.profile_points import Vector
from wearsim.scanning.known_scales import LookUp
from wearsim.scanning.marker_grid import DOT, RULER, dot_points, free_radius
from wearsim.scanning.marker_search import Markers, find_markers
from wearsim.scanning.new_wheel import NewWheel
from wearsim.scanning.photograph import Light, Photograph, bad_photograph
from wearsim.scanning.placement import CHAMFER_ERROR, KnownCamera, KnownScale
from wearsim.scanning.projection import Projection
from wearsim.scanning.sheet_camera import SheetCamera, sheet_camera

_PRINT_ERROR = 2e-3
"""Standard deviation of what a printer stretches, and of a reading of the ruler, relative."""

_LIFT_ERROR = 0.15
"""Standard deviation of the height of the teeth's middle plane over their thickness."""

_UNEVEN = (0.1, 0.5)
"""Scatter of the dots that is doubtful, and that is wrong [mm]."""

_THICKEST = 0.1
"""Largest thickness of the teeth over the height of the camera."""

_REMEDY = "measure the printed ruler, give its length with --ruler-mm, and check the chain"

_UNKNOWN_HEIGHT = 0.1
"""Standard deviation of the camera's height, relative, from which the height itself is doubtful."""

_SECOND = 24
"""Dots that lie elsewhere from which there is a second sheet."""

_AROUND_DOT = 1.0
"""Width about a dot that is cleared with it [mm]."""


@dataclass(frozen=True, eq=False)
class SeenSheet:
    """A marker sheet in a photograph."""

    markers: Markers
    camera: SheetCamera
    stretch: float  # of the print: length over that of the drawing

    @property
    def height(self) -> float:
        """Height of the camera above the sheet [mm]."""
        return self.camera.height * self.stretch

    @property
    def height_known(self) -> bool:
        """Whether the height of the camera is certain enough for what lies above the sheet."""
        return self.camera.height_error < _UNKNOWN_HEIGHT

    @property
    def scatter(self) -> float:
        """Standard deviation of a dot in each direction [mm]."""
        return self.camera.noise / self.camera.scale(np.zeros(2)) * self.stretch

    @property
    def free_radius(self) -> float:
        """Radius of its free circle, by its outermost column that is seen [mm]."""
        return free_radius(int(np.abs(self.markers.dots[:, 0]).max())) * self.stretch

    @property
    def print_error(self) -> float:
        """Standard deviation of a length by printer and ruler, relative."""
        return math.hypot(_PRINT_ERROR, self.scatter / RULER)

    @property
    def mirrored(self) -> bool:
        """Whether the picture is a mirror image."""
        return bool(np.linalg.det(self.camera.projection.matrix) > 0.0)

    def scale_of(self, wheel: NewWheel) -> LookUp:
        """Return the scale in the middle plane of a wheel that lies on the sheet."""

        def known(projection: Projection) -> KnownScale:
            at = self._below(projection, np.zeros((1, 2)))[0]
            middle = 0.5 * wheel.thickness / self.height
            error = math.hypot(
                self.print_error,
                self.camera.scale_error(at),
                _LIFT_ERROR * wheel.thickness / self.height,
                middle * self.camera.height_error,
            )
            scale = self.camera.scale(at) / self.stretch / (1.0 - middle)
            return KnownScale(scale, error, self._words(wheel), self._remedy)

        return known

    @property
    def _remedy(self) -> str:
        if self.height_known:
            return _REMEDY
        lens = "use a picture that states the focal length, as the height of the camera is uncertain"
        return f"{lens}; {_REMEDY}"

    def camera_over(self, wheel: NewWheel) -> KnownCamera:
        """Return the camera as it sees a wheel that lies on the sheet."""
        seen, half = self.camera.projection, 0.5 * wheel.thickness

        def place(projection: Projection) -> Vector:
            step = 0.1 * wheel.pitch
            centre, *ends = self._below(projection, step * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
            axes = np.column_stack([(end - centre) / step for end in ends])
            below = np.linalg.solve(axes, self.camera.position[:2] - centre)
            return np.array([*below, self.height - half])

        return KnownCamera(
            distortion=seen.distortion,
            distortion_error=self.camera.distortion_error,
            second_distortion=seen.second_distortion,
            half_thickness=half,
            sides_error=math.hypot(CHAMFER_ERROR, self.camera.height_error),
            place=place,
        )

    def _below(self, projection: Projection, points: Vector) -> Vector:
        """Return the points of the sheet that points of a wheel's plane [mm] are seen before."""
        return self.camera.projection.behind(projection.seen(points))

    def _words(self, wheel: NewWheel) -> str:
        return (
            f"the marker sheet ({len(self.markers.dots)} dots, ruler {RULER * self.stretch:g} mm, camera "
            f"about {round(self.height, -1):.0f} mm above it, teeth {wheel.thickness:.3g} mm thick)"
        )

    def cleared(self, photograph: Photograph, beside: Vector | None = None) -> Photograph:
        """Return a photograph with paper in place of the dots and of all that does not lie between them.

        What lies in an outline beside the wheel [px] is paper too.
        """
        rims = self.camera.projection.seen(
            dot_points(self.markers.dots)[:, None] + _circle(DOT + _AROUND_DOT)
        )
        corners = np.concatenate([*rims])
        hull = corners[ConvexHull(corners).vertices]
        held = Image.fromarray(self._beside_cleared(photograph.light, hull, beside))
        draw = ImageDraw.Draw(held)
        for rim, paper in zip(rims, self.markers.paper, strict=True):
            draw.polygon([*map(tuple, rim)], fill=float(paper))
        return replace(photograph, light=np.array(held))

    def _beside_cleared(self, light: Light, hull: Vector, beside: Vector | None) -> Light:
        """Return light with that of paper outside of an outline: a plane through that beside the dots."""
        height, width = light.shape
        mask = Image.new("1", (width, height))
        draw = ImageDraw.Draw(mask)
        draw.polygon([*map(tuple, hull)], fill=1)
        if beside is not None:
            draw.polygon([*map(tuple, beside)], fill=0)
        rows = np.column_stack([np.ones(len(self.markers.points)), self.markers.points])
        level, across, down = np.linalg.lstsq(rows, self.markers.paper, rcond=None)[0].astype(np.float32)
        x, y = np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32)
        least, most = float(self.markers.paper.min()), float(self.markers.paper.max())
        paper = np.clip((level + down * y)[:, None] + across * x, least, most)
        return np.where(np.asarray(mask), light, paper)


def find_sheet(photograph: Photograph, ruler: float | None = None) -> SeenSheet | None:
    """Return the marker sheet in a photograph, None where there is none.

    Raises CaseError where the length of its ruler [mm] is given and it is not found, where there are two, and
    where it is far from flat.
    """
    markers = find_markers(photograph)
    if markers is None:
        if ruler is None:
            return None
        raise bad_photograph(
            photograph.name,
            "the marker sheet must be visible if its ruler is given, but too few dots were found: photograph "
            "at least half of it without shadows, or leave the ruler out",
        )
    if markers.other >= _SECOND:
        raise bad_photograph(
            photograph.name,
            f"one marker sheet must be in the picture, but {markers.other} dots belong to another one: "
            "remove it",
        )
    size = photograph.width, photograph.height
    camera = sheet_camera(markers.dots, markers.points, size, photograph.focal_length)
    sheet = SeenSheet(markers, camera, (ruler or RULER) / RULER)
    if sheet.scatter > _UNEVEN[1]:
        raise bad_photograph(
            photograph.name,
            f"the marker sheet must be flat, but its dots deviate by {sheet.scatter:.2g} mm: lay it on "
            "a hard table, and press it down at its edges",
        )
    return sheet


def check_circle(wheel: NewWheel, sheet: SeenSheet, photograph: str) -> None:
    """Raise for a wheel that covers dots of the sheet, which are cleared from the picture with its teeth."""
    if wheel.tip_radius > sheet.free_radius:
        raise bad_photograph(
            photograph,
            f"the sprocket must lie in the free circle of the marker sheet, {2.0 * sheet.free_radius:.0f} mm "
            f"wide by the dots that are seen, but has {2.0 * wheel.tip_radius:.0f} mm over its tips: print "
            "the sheet for a larger paper, or photograph the sprocket without it",
        )


def check_thickness(thickness: float, sheet: SeenSheet | None, photograph: str) -> None:
    """Raise for a thickness of the teeth [mm] without a sheet, or one that the camera could not look over."""
    if sheet is None:
        raise bad_photograph(
            photograph,
            "a marker sheet must be visible if the thickness of the teeth is given, but too few dots were "
            "found: photograph at least half of it without shadows, or leave the thickness out",
        )
    if thickness > _THICKEST * sheet.height:
        raise bad_photograph(
            photograph,
            f"the teeth must be thinner than {_THICKEST * sheet.height:.0f} mm below a camera "
            f"{sheet.height:.0f} mm above the sheet, but {thickness:g} mm is given: correct the thickness",
        )


def height_warning(sheet: SeenSheet) -> str:
    """Return what is to be said of a camera whose height is not certain; empty where it is."""
    if sheet.height_known:
        return ""
    return (
        "the height of the camera is uncertain, as the picture states no focal length and is hardly tilted: "
        "visible sides of thick teeth may change the depth by more than its standard error; use the "
        "original file from the camera, not a copy without its metadata"
    )


def uneven_warning(sheet: SeenSheet) -> str:
    """Return what is to be said of a sheet that is not flat; empty where it is."""
    if sheet.scatter <= _UNEVEN[0]:
        return ""
    return (
        f"the marker sheet is not flat, or badly printed: its dots deviate by {sheet.scatter:.2g} mm; lay "
        "it on a hard table, or print it again"
    )


def _circle(radius: float) -> Vector:
    """Return points on a circle about the origin."""
    angle = np.linspace(0.0, math.tau, 64, endpoint=False)
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])
