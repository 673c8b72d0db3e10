"""A lubricant of one's own, beside those of the catalogue."""

from typing import Literal

from pydantic import ValidationError

from wearsim.catalogue.catalogues import Lubricant, condition_name, lubricants, nearest, wear_conditions
from wearsim.input.faults import Faults
from wearsim.input.units import plain_value
from wearsim.lubrication.keys import LubricationTable

_SUPPLIES = ("applied", "continuous", "none")


def lubricant(
    name: str,
    *,
    wear_condition: str,
    source: str,
    supply: Literal["applied", "continuous", "none"] = "applied",
    lasts_sliding_m: float | None = None,
    fades_over_sliding_m: float | None = None,
    dry_factor: float | None = None,
    contamination_removed: float | None = None,
) -> str:
    """Add a lubricant of your own to the catalogue, for as long as the program runs.

    Cases may name it as ``lubrication.lubricant`` from then on, and so may ``[[lubrication.option]]``. What
    is left out is a key of the case, as with a lubricant of the catalogue. To add it again replaces it; cases
    that were loaded before keep its old numbers.

    Parameters
    ----------
    name : str
        Name of its row; not one of the catalogue, which ``wearsim list lubricants`` shows.
    wear_condition : str
        From ``wearsim list wear-conditions``: it gives the wear coefficients while the lubricant is fresh.
    source : str
        Where the numbers come from; it is listed among the assumptions of every life.
    supply : str, optional
        ``"applied"`` now and then, ``"continuous"``, or ``"none"``.
    lasts_sliding_m : float, optional
        Sliding distance of the joints over which it keeps its effect [m].
    fades_over_sliding_m : float, optional
        Sliding distance over which it loses it then [m].
    dry_factor : float, optional
        Wear coefficient of dry contacts over that of lubricated ones, at least 1.
    contamination_removed : float, optional
        Part of the effect of dirt that an application removes, 0 to 1.

    Returns
    -------
    str
        Its name, for the case.

    Raises
    ------
    CaseError
        What is wrong with it.

    Examples
    --------
    >>> import wearsim
    >>> wearsim.lubricant(
    ...     "my wax",
    ...     wear_condition="bicycle, immersion wax",
    ...     lasts_sliding_m=600.0,
    ...     dry_factor=150.0,
    ...     source="own rig, 5 chains",
    ... )
    'my wax'
    """
    numbers = {
        "lasts_sliding_m": plain_value(lasts_sliding_m),
        "fades_over_sliding_m": plain_value(fades_over_sliding_m),
        "dry_factor": plain_value(dry_factor),
        "contamination_removed": plain_value(contamination_removed),
    }
    faults = Faults(f"lubricant {name!r}", "", ())
    wear_condition = condition_name(wear_condition)
    _check_words(faults, name, wear_condition, supply, source)
    try:
        table = LubricationTable.model_validate({key: at for key, at in numbers.items() if at is not None})
    except ValidationError as error:
        faults.add_validation(error, LubricationTable)
        table = LubricationTable()
    if lasts_sliding_m is not None and dry_factor is None:
        faults.add(
            "dry_factor", "must be given for a lubricant with a limited life: dry wear over lubricated wear"
        )
    faults.check()
    lubricants()[name] = Lubricant(
        name,
        wear_condition,
        supply,
        table.lasts_sliding_m,
        table.fades_over_sliding_m,
        table.dry_factor,
        table.contamination_removed,
        source,
        is_own=True,
    )
    return name


def _check_words(faults: Faults, name: str, wear_condition: str, supply: str, source: str) -> None:
    """Add what is wrong with the words of a row."""
    if not name.strip() or (name in lubricants() and not lubricants()[name].is_own):
        faults.add("name", f"must not be a name of the catalogue (got {name!r})")
    if wear_condition not in wear_conditions():
        hint = nearest(wear_condition, dict(wear_conditions()))
        text = f"no such wear condition{hint} (wearsim list wear-conditions) (got {wear_condition!r})"
        faults.add("wear_condition", text)
    if supply not in _SUPPLIES:
        faults.add("supply", f"must be {', '.join(map(repr, _SUPPLIES))} (got {supply!r})")
    if not source.strip():
        faults.add("source", "must say where the numbers come from")
