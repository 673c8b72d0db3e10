"""A worn sprocket in a photograph: its teeth, the depth of their flanks, and what is doubtful about them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from wearsim.scanning.chain_beside import SeenChain
from wearsim.scanning.flank_depths import FlankDepths, flank_depths
from wearsim.scanning.known_scales import LookUp
from wearsim.scanning.new_wheel import NewWheel
from wearsim.scanning.photograph import Photograph, bad_photograph
from wearsim.scanning.placement import ANY_CAMERA, SEARCH, Placement, edge_bias, place_wheel
from wearsim.scanning.sheet_placement import SeenSheet, height_warning, uneven_warning
from wearsim.scanning.silhouette import Silhouette
from wearsim.study.remaining.model import RemainingLife

_TILTED = 0.97
"""Smaller diameter over the larger one, below which the sides of the teeth are seen too."""

_TILTED_SHEET = math.radians(8.0)
"""Tilt against a marker sheet from which their chamfers move the depth [rad]."""

_OFF_FORM = 0.15
"""How far the mean of all gaps may be off the new form where it does not wear [px]."""

_UNCLEAR = 0.012
"""How far light may be off a blurred step, over the contrast, before edges are doubtful."""

_OTHER = 1.5
"""Depth of the flank that is to be the less worn over that of the other, from which the form is wrong."""

_PLAIN = 0.02
"""Depth over the pitch that no error explains."""

_SCALES_DIFFER = (0.01, 0.05)
"""Relative difference of two scales that is doubtful, and that is wrong."""

_SEEN = 0.8
"""Part of the places along the worn flank that must have an edge."""

SURE = 2.0
"""Standard errors from which a depth is told from none."""


@dataclass(frozen=True, eq=False)
class ScannedWheel:
    """What a photograph tells of a worn sprocket."""

    photograph: Photograph
    seen: Silhouette
    depths: FlankDepths
    warnings: tuple[str, ...]
    sheet: SeenSheet | None = None  # that lies under it
    chain: SeenChain | None = None  # that lies beside it
    hours: float | None = None  # running time of the sprocket [h]
    remaining: RemainingLife | None = None  # what is left of its life after them

    @property
    def wheel(self) -> NewWheel:
        """Its new form."""
        return self.depths.place.wheel

    @property
    def is_worn(self) -> bool:
        """Whether the depth is told from none."""
        return self.depths.depth > SURE * self.depths.depth_error

    @property
    def assumptions(self) -> tuple[str, ...]:
        """What the depth rests on."""
        known = self.depths.place.known
        seen = "the teeth are seen along their axis, and their edges are the outline of the wheel"
        if self.sheet is not None:
            seen = "the teeth lie flat on the marker sheet, and the lens points at the middle of the picture"
        return (
            f"the new form is {self.wheel.words}",
            "roots, tips and the less worn flank are as new where they fit the form; the tip diameter is any",
            "the scale is that of the form: the chain is the right one"
            if known is None
            else f"the scale is that of {known.words}",
            seen,
            "the picture is coded as sRGB, as cameras and scanners do",
            *(() if self.chain is None else (self.chain.assumption,)),
        )


def scan_photograph(
    photograph: Photograph,
    seen: Silhouette,
    wheel: NewWheel,
    known: LookUp | None = None,
    sheet: SeenSheet | None = None,
) -> ScannedWheel:
    """Return the wear of the sprocket in a photograph; raise CaseError where it cannot be measured.

    The dots of a marker sheet are already cleared from the photograph.
    """
    if wheel.teeth != seen.teeth:
        raise bad_photograph(
            photograph.name,
            f"the wheel must have {wheel.teeth} teeth as given, but {seen.teeth} are counted: give the case "
            "of this wheel, or correct the number of teeth",
        )
    camera = ANY_CAMERA if sheet is None else sheet.camera_over(wheel)
    depths = flank_depths(place_wheel(photograph, wheel, seen, known, camera))
    _check_fit(photograph, depths)
    warnings = (*_warnings(depths), *_tilt_warnings(seen, sheet))
    return ScannedWheel(photograph, seen, depths, warnings, sheet)


def _check_fit(photograph: Photograph, depths: FlankDepths) -> None:
    """Raise where the wheel in the picture cannot be the one that is said."""
    place = depths.place
    if place.known and abs(part := place.known.scale / place.form_scale - 1.0) > _SCALES_DIFFER[1]:
        raise bad_photograph(
            photograph.name,
            f"the scale of {place.known.words} and that of the teeth must agree, but differ by "
            f"{100.0 * part:+.1f} %: {place.known.remedy}, and the profile",
        )
    doubtful = min(3.0 * depths.depth_error, _PLAIN * place.wheel.pitch)
    if depths.other_depth > max(_OTHER * depths.depth, 0.0) + doubtful:
        raise bad_photograph(
            photograph.name,
            "one flank of the teeth must fit the given new form, but neither does (the less worn one "
            f"deviates by {depths.other_depth:.2g} mm): check chain and profile, and that it is a sprocket",
        )
    share = depths.seen_share
    if not share > 0.5:
        raise bad_photograph(
            photograph.name,
            f"the worn flank must be visible, but only {100.0 * share:.0f} % of it lies near the new form: "
            "check chain and profile, clean the wheel, and light it without shadows",
        )


def _warnings(depths: FlankDepths) -> Iterator[str]:
    place = depths.place
    misfit = depths.misfit * place.scale
    if misfit > _OFF_FORM:
        yield (
            f"the unworn part of the wheel deviates from the new form by {depths.misfit:.2g} mm "
            f"({misfit:.2f} pixels): check chain and profile; the depth may be wrong by several times as much"
        )
    if abs(place.bias) > 3.0 * edge_bias(place.blur, place.edge_misfit):
        yield (
            f"edges deviate by {place.bias:+.2f} pixels from the new form all around: check chain and "
            "profile, or light the wheel from all sides"
        )
    if place.edge_misfit > _UNCLEAR:
        yield (
            "edges between steel and background are not clean (bright rims, shadows, or sharpening by the "
            "camera), so the depth is less certain: light the wheel from behind, or from all sides"
        )
    if depths.both_worn:
        yield (
            f"both flanks are worn ({depths.other_depth:.2g} mm on the other one), so little is left to "
            "locate the wheel, or the profile is wrong: the sum of both depths is more certain than either"
        )
    yield from _scale_warnings(place)
    if depths.seen_share < _SEEN:
        yield (
            f"only {100.0 * depths.seen_share:.0f} % of the worn flank has a clear edge: clean the wheel, "
            "and avoid shadows"
        )
    if depths.depth > 0.8 * SEARCH * place.wheel.pitch:
        yield f"edges are searched down to {SEARCH * place.wheel.pitch:.2g} mm: the wear may be deeper"


def _scale_warnings(place: Placement) -> Iterator[str]:
    if place.known is None:
        return
    part = place.known.scale / place.form_scale - 1.0
    if abs(part) > max(_SCALES_DIFFER[0], SURE * place.known.error):
        yield (
            f"the scale of {place.known.words} differs by {100.0 * part:+.1f} % from that of the teeth: "
            f"{place.known.remedy}"
        )


def _tilt_warnings(seen: Silhouette, sheet: SeenSheet | None) -> Iterator[str]:
    tilt = math.acos(min(1.0, seen.roundness)) if sheet is None else sheet.camera.tilt
    if tilt > (math.acos(_TILTED) if sheet is None else _TILTED_SHEET):
        yield (
            f"the camera was tilted by about {math.degrees(tilt):.0f} degrees, and may see sides of teeth: "
            "hold it level"
        )
    if sheet is not None:
        if sheet.mirrored:
            yield "the picture is a mirror image, as the marker sheet shows: flanks face as in the picture"
        yield from filter(None, (height_warning(sheet), uneven_warning(sheet)))
