"""At which elongation a chain is worn out, and how the limit of a drive stands to that rule."""

from wearsim.chain.drive_layout import DriveLayout
from wearsim.chain.loop_layout import LoopLayout
from wearsim.chain.rating_findings import RatingFinding


def elongation_limit(teeth: int, adjustable: bool = True) -> float:
    """Return the elongation at which a chain is worn out.

    3 % where the centre distance can be adjusted or a tensioner takes it up, 1.5 % where not;
    never above 2/z of the larger sprocket, at which the rollers ride 0.318 p too high.

    Parameters
    ----------
    teeth : int
        Gaps of the larger sprocket.
    adjustable : bool
        Whether the elongation can be taken up.

    Returns
    -------
    float
        Elongation as a fraction.

    Examples
    --------
    >>> elongation_limit(57), elongation_limit(100), elongation_limit(57, adjustable=False)
    (0.03, 0.02, 0.015)
    """
    return min(greatest_elongation(adjustable), 2.0 / teeth)


def greatest_elongation(adjustable: bool) -> float:
    """Return the elongation at which a chain is worn out on wheels of few teeth, as a fraction."""
    return 0.03 if adjustable else 0.015


def elongation_rule(layout: DriveLayout | LoopLayout) -> tuple[float, str]:
    """Return the elongation at which a chain is worn out [%], to four digits, and the rule in words."""
    # Of two wheels the centre distance is adjusted; a loop has a take-up or none.
    fixed = isinstance(layout, LoopLayout) and layout.drive.take_up is None
    most = f"{100.0 * greatest_elongation(not fixed):g} %{' without a take-up' if fixed else ''}"
    return float(f"{100.0 * elongation_limit(max(layout.all_teeth), not fixed):.4g}"), most


def elongation_finding(layout: DriveLayout | LoopLayout, limit: float) -> RatingFinding:
    """Return how the elongation at which a chain is replaced stands to the rule for it."""
    allowed, most = elongation_rule(layout)
    value = float(f"{100.0 * limit:.4g}")
    rule = f"{most}, 200 % over the teeth of the larger sprocket"
    return RatingFinding("elongation at the end", value, allowed, "%", rule)
