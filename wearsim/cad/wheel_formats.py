"""Wheels of a case or run in the formats of CAD."""

from collections.abc import Sequence

from wearsim._version import __version__
from wearsim.cad import WHEELS
from wearsim.cad.printed_page import drawing_bytes
from wearsim.cad.wheel_drawing import wheel_scene
from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.geometry.hub import NO_HUB
from wearsim.geometry.wheel_outline import State, WheelShape
from wearsim.lazy import named
from wearsim.quantities import either, grouped
from wearsim.report.worn_flank import wheel_shapes
from wearsim.result import WearResult

_TOLERANCE = 1e-3
"""Distance [mm] of the arcs in a drawing from the curves that they stand for."""


def export(case: Case, result: WearResult | None, states: Sequence[State], form: str) -> bytes:
    """Return the wheels of a case as the content of a file."""
    shapes, wheel = wheel_shapes(case, result), WHEELS[form]
    if wheel.hub:
        _check_hubs(case, shapes, states)
    if wheel.writer:
        content: bytes = named(wheel.writer)(shapes, states)
        return content
    drawn = [shape.with_few_arcs(_TOLERANCE) for shape in shapes]
    scene, layers = wheel_scene(drawn, states, wheel_note(case, result, shapes, states))
    return drawing_bytes(scene, layers, form)


def check_solid(case: Case, form: str | None) -> None:
    """Raise, before a case is worn, where it has no wheel or none that can be a solid."""
    shapes = wheel_shapes(case, None)
    if form is not None and WHEELS[form].solid and not all(shape.new[0].rooted for shape in shapes):
        flat = either(name for name, wheel in WHEELS.items() if not wheel.solid)
        message = (
            "the outlines of both gears must be closed for a solid, but the case gives no tooth root: use "
            f"--format {flat}, which hold the flanks"
        )
        raise CaseError([Fault(message, "gear", case.name)])


def _check_hubs(case: Case, shapes: Sequence[WheelShape], states: Sequence[State]) -> None:
    """Raise where the gaps are worn down to the bore or to the hub."""
    for shape in shapes:
        if "worn" not in states or shape.hub == NO_HUB:
            continue
        root = min(space.root_radius for space in set(shape.worn))
        if shape.hub.reach >= root:
            key = "hub_diameter_mm" if shape.hub.hub_diameter else "bore_mm"
            message = (
                f"must stay below the root diameter of the worn gaps, {2.0 * root:.5g} mm, but reaches to "
                f"{2.0 * shape.hub.reach:.5g} mm: give a smaller one, or --state new"
            )
            raise CaseError([Fault(message, f"sprocket.{key}", case.name)])


def wheel_note(
    case: Case, result: WearResult | None, shapes: Sequence[WheelShape], states: Sequence[State]
) -> list[str]:
    """Return what stands below the wheels in a drawing."""
    taken = [f"{shape.name}: {text}" for shape in shapes for text in shape.notes]
    if len(shapes) > 1 and shapes[0].notes == shapes[1].notes:
        taken = list(shapes[0].notes)
    return [
        f"{case.title} (case {case.name})",
        _condition(result if "worn" in states else None, states),
        f"All in mm, 1:1. Lines and arcs, within {_TOLERANCE:g} mm of the computed outline.",
        *(f"{text[0].upper()}{text[1:]}." for text in taken),
        f"wearsim {__version__}",
    ]


def _condition(result: WearResult | None, states: Sequence[State]) -> str:
    if result is None:
        return "New."
    both = "New, and worn" if len(states) > 1 else "Worn"
    deepest = f"{result.max_depth:.3g} mm worn at the deepest point"
    return f"{both} after {grouped(result.hours_run)} h: {deepest}."
