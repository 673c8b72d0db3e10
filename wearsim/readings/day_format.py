"""Days as people write them, in any form that tells what it means."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
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


_EITHER = ("day/month/year", "month/day/year")
"""Forms that a day may have both of."""

_SURE = "2026-03-31"
"""A day in the form that nobody reads otherwise."""


def iso_days(texts: Sequence[str]) -> tuple[list[str], dict[int, str]]:
    """Return days as year-month-day, and by their places why others are none or may be two.

    A day that has one meaning is read by itself, whatever form the others have. Where day and month may be
    either, the form is that of days that only it fits, else the one in which no day comes before the one
    above it.

    Examples
    --------
    >>> iso_days(["3/28/2026", "4/2/2026", "2026-05-01"])
    (['2026-03-28', '2026-04-02', '2026-05-01'], {})
    >>> iso_days(["5.4.2026", "31.4.2026"])[1]
    {1: 'must be a day, day.month.year as others here or such as 2026-03-31'}
    """
    meanings = [_meanings(text) for text in texts]
    ways = {tuple(_read(meanings, form)): form for form in _open_forms(meanings)}
    days = next(iter(ways))
    wrong = {
        place: f"may be {' or '.join(ways.values())}: write year-month-day, such as {_SURE}"
        for place, several in enumerate(zip(*ways, strict=True))
        if len(set(several)) > 1
    }
    known = sorted({form for one in meanings if len(one) == 1 for form in one})
    others = f", {' or '.join(known)} as others here or" if known else ""
    wrong |= {place: f"must be a day{others} such as {_SURE}" for place, day in enumerate(days) if not day}
    return [day.isoformat() if day else text for day, text in zip(days, texts, strict=True)], wrong


def _meanings(text: str) -> dict[str, date]:
    """Return the days that a text may mean, by what their forms are called."""
    found: dict[str, date] = {}
    for form, name in _FORMS.items():
        with suppress(ValueError):
            found[name] = _day(text, form)
    return found


def _open_forms(meanings: Sequence[Mapping[str, date]]) -> Sequence[str]:
    """Return the forms that days of two meanings may have."""
    told = {form for one in meanings if len(one) == 1 for form in one}.intersection(_EITHER)
    if len(told) == 1:
        return tuple(told)
    rising = [form for form in _EITHER if _rise([day for day in _read(meanings, form) if day])]
    return rising or _EITHER


def _rise(days: list[date]) -> bool:
    return days == sorted(days)


def _read(meanings: Sequence[Mapping[str, date]], form: str) -> list[date | None]:
    """Return what texts mean where those of two meanings have a form; None for what is no day."""
    return [one.get(form, next(iter(one.values()), None)) for one in meanings]


def _day(text: str, form: str) -> date:
    read: Callable[[str, str], datetime] = datetime.strptime
    return read(text, form).date()
