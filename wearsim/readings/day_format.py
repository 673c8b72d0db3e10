"""Days as people write them, one form for a whole column."""

from collections.abc import Callable, Sequence
from datetime import date, datetime

_FORMS = {
    "%Y-%m-%d": "year-month-day",
    "%Y/%m/%d": "year/month/day",
    "%d.%m.%Y": "day.month.year",
    "%d.%m.%y": "day.month.year",
    "%d-%m-%Y": "day-month-year",
    "%d/%m/%Y": "day/month/year",
    "%m/%d/%Y": "month/day/year",
    "%d/%m/%y": "day/month/year",
    "%m/%d/%y": "month/day/year",
    "%d %b %Y": "day month year",
    "%d %B %Y": "day month year",
}
"""Forms of a day, and what they are called. Points and hyphens always put the day before the month."""


def iso_days(texts: Sequence[str]) -> tuple[list[str], str]:
    """Return days as year-month-day, or as they are and why nobody can tell what they mean.

    A form must fit all of them. Where day and month may be either, it is the one in which no day comes
    before the one above it.

    Examples
    --------
    >>> iso_days(["3/28/2026", "4/2/2026"])
    (['2026-03-28', '2026-04-02'], '')
    """
    read = {form: days for form in _FORMS if (days := _all_days(texts, form))}
    ordered = {form: days for form, days in read.items() if days == sorted(days)}
    meant = {tuple(days): _FORMS[form] for form, days in (ordered or read).items()}
    if len(meant) == 1:
        return [day.isoformat() for day in next(iter(meant))], ""
    why = f"may be {' or '.join(meant.values())}: write year-month-day, such as 2026-03-31" if meant else ""
    return list(texts), why


def _all_days(texts: Sequence[str], form: str) -> list[date]:
    """Return the days that texts of one form mean; none where one of them has another form."""
    try:
        return [_day(text, form) for text in texts]
    except ValueError:
        return []


def _day(text: str, form: str) -> date:
    read: Callable[[str, str], datetime] = datetime.strptime
    return read(text, form).date()
