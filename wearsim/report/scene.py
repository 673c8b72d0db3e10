"""What drives and worn flanks look like."""

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault
from wearsim.geometry.scene import Circle, Stroke
from wearsim.geometry.wheel_outline import WheelShape
from wearsim.report.flank_view import case_of, flanks, snapshot
from wearsim.report.worn_flank import WornFlank
from wearsim.result import WearResult


def wheel_shapes(case: Case, result: WearResult | None) -> tuple[WheelShape, ...]:
    """Return the wheels of a case, worn as at the end of a run where there is one."""
    shapes = case.drive.wheels(case.engaged_every, None if result is None else flanks(result, -1))
    if not shapes:
        message = (
            "the case must have a sprocket or gears to draw, but is a table of loads along a flank "
            "whose place on a wheel it does not tell: give the wheel's own case"
        )
        raise CaseError([Fault(message, "mechanism.kind", case.name)])
    return shapes


def around_flank(result: WearResult, flank: WornFlank) -> tuple[Stroke | Circle, ...]:
    """Return the steel around a new flank, as far as it is known, and the circle that touches it.

    The circle touches it where it wears most.
    """
    drive, new, deepest = case_of(result).drive, flank.new, flank.deepest
    body, mate = drive.body(), drive.mate(snapshot(result, -1), deepest)
    if mate is None:
        return body
    radius, name = mate
    x = float(new.x[deepest] + radius * new.normal_x[deepest])
    y = float(new.y[deepest] + radius * new.normal_y[deepest])
    return *body, Circle("mate", (x, y), abs(radius), name)
