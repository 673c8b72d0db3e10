"""Studies that scale lives need a coefficient that does not change with the running time."""

from wearsim.case.model import Case
from wearsim.errors import CaseError, Fault


def check_steady_coefficient(case: Case, command: str) -> None:
    """Raise where the wear of a case runs in."""
    if case.wear.running_in_factor != 1.0:
        message = (
            f"{command!r} scales lives, which holds for a constant coefficient only: remove "
            "running_in_factor and running_in_distance_mm"
        )
        raise CaseError([Fault(message, "wear.running_in_factor", case.name)])
