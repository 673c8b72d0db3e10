"""A life, or what is known of one that was not reached."""

from dataclasses import dataclass

from wearsim.errors import LimitNotReachedError


@dataclass(frozen=True)
class Life:
    """A life that was reached.

    Attributes
    ----------
    cycles : float
        Loading cycles of one gap.
    hours : float
        Running time [h], equation (13).
    """

    cycles: float
    hours: float

    @property
    def cycles_run(self) -> float:
        """Loading cycles that the run covers: those of the life."""
        return self.cycles

    @property
    def hours_run(self) -> float:
        """Running time that the run covers [h]: the life."""
        return self.hours


@dataclass(frozen=True)
class LowerBound:
    """A run that ended before any limit was met.

    Attributes
    ----------
    cycles_run : float
        Loading cycles that it covers.
    hours_run : float
        Running time that it covers [h].
    """

    cycles_run: float
    hours_run: float

    @property
    def cycles(self) -> float:
        """Raise: the life is not known.

        Raises
        ------
        LimitNotReachedError
            Always, with the bound.
        """
        raise LimitNotReachedError(self._message)

    @property
    def hours(self) -> float:
        """Raise: the life is not known.

        Raises
        ------
        LimitNotReachedError
            Always, with the bound.
        """
        raise LimitNotReachedError(self._message)

    @property
    def _message(self) -> str:
        return (
            f"life: no limit was met within {self.hours_run:g} h ({self.cycles_run:g} cycles), the "
            "life is longer: raise run.horizon_hours"
        )


def life_of(cycles: float, cycles_per_hour: float, reached: bool) -> Life | LowerBound:
    """Return the life that a run of so many cycles has shown.

    Parameters
    ----------
    cycles : float
        Loading cycles of one gap.
    cycles_per_hour : float
        How many there are in an hour.
    reached : bool
        Whether the run ended at a limit.

    Returns
    -------
    Life or LowerBound
        The life, or that it is longer.

    Examples
    --------
    >>> life_of(12000.0, 6000.0, True)
    Life(cycles=12000.0, hours=2.0)
    """
    hours = cycles / cycles_per_hour
    return Life(cycles, hours) if reached else LowerBound(cycles, hours)


@dataclass(frozen=True)
class LimitState:
    """A limit and how near to it the drive is when its life ends.

    Attributes
    ----------
    name : str
        Key of the limit with its unit.
    limit : float
        Its value.
    value : float
        What the quantity has come to.
    """

    name: str
    limit: float
    value: float
