"""[lubrication] with its defaults taken and its contradictions named."""

import math
from collections.abc import Iterator, Sequence

from wearsim.catalogue.catalogues import (
    HARDNESSES,
    Lubricant,
    condition_of_teeth,
    lubricants,
    wear_conditions,
)
from wearsim.input.faults import CaseRecord
from wearsim.lubrication.dirt import Dirt, read_dirt
from wearsim.lubrication.keys import (
    AT,
    FADES,
    INTERVAL,
    LASTS,
    SCHEDULES,
    SUPPLY,
    LubricationPhase,
    LubricationTable,
)
from wearsim.lubrication.model import ENDLESS, LubricationInput, PhaseInput, RunningWay, lasting_not_known

_LASTS_BAND = 1.5
"""Factor to either side of how long a lubricant lasts where nobody says how surely that is known."""

_WHY_LASTS = (
    "assumed: products of one kind last 0.6 to 1.8 times their median on one rig (Zero Friction Cycling)"
)

_DRY_BAND = 3.0
"""Factor to either side of a dry factor that a user gives: as of a wear coefficient."""


_BANDS = ("lasts_band_factor", "dry_band_factor", "contamination_band_factor")


def lubrication_input(
    case: CaseRecord,
    table: LubricationTable | None,
    km_per_hour: float | None,
    condition: str | None,
    hardness: str | None,
) -> LubricationInput | None:
    """Return how a case is lubricated; None where it says nothing about it."""
    if table is None:
        return None
    row = lubricants()[table.lubricant] if table.lubricant else None
    reader = _Reader(case, table, row, km_per_hour)
    if row is not None:
        _say_coefficients(case, row, condition, hardness or HARDNESSES[0])
        if row.supply == "none" and table.environment == "soil":
            case.warnings.append(
                "lubrication.environment = 'soil' multiplies the wear of oiled contacts, and with dry ones "
                "counts the missing oil twice: give wear.condition = 'soil-contaminated' alone"
            )
        if row.is_own:
            case.assumptions.append(f"lubricant {row.lubricant!r} is user-defined: {row.source}")
    return reader.input()


def _say_coefficients(case: CaseRecord, row: Lubricant, condition: str | None, hardness: str) -> None:
    """Say whose coefficients hold where they are not those of the lubricant."""
    if condition is None:
        case.assumptions.append(
            f"the wear rates are given by the user and replace those of lubricant {row.lubricant!r}"
        )
        return
    if condition == condition_of_teeth(row, hardness):
        return
    is_oiled, as_named = (wear_conditions()[name].lubricated for name in (condition, row.wear_condition))
    if is_oiled == as_named:
        case.warnings.append(
            f"wear.condition = {condition!r} overrides {row.wear_condition!r}, the condition of "
            f"lubrication.lubricant = {row.lubricant!r}; remove it to use the wear rates of the lubricant"
        )
        return
    words = ("dry or contaminated", "lubricated")
    case.warnings.append(
        f"wear.condition = {condition!r} contradicts lubrication.lubricant = {row.lubricant!r}: those "
        f"contacts are {words[is_oiled]}, with this lubricant they are {words[as_named]}: remove one of the "
        "two"
    )


def warn_of_dried_teeth(case: CaseRecord, given: LubricationInput | None, condition: str) -> None:
    """Say where teeth that have dried out wear faster than dry ones of their hardness in the table."""
    rows = wear_conditions()
    dry = rows.get(f"{condition.split(', ')[0]}, dry")
    if given is None or given.is_constant or dry is None:
        return
    dried = given.dry_factor * rows[condition].typical
    if rows[condition].lubricated and dried > dry.typical:
        case.warnings.append(
            f"lubrication.dry_factor = {given.dry_factor:g} is that of all contacts: teeth that have dried "
            f"out wear at {dried:.3g} mm2/N, teeth of wear condition {dry.condition!r} at "
            f"{dry.typical:.3g} mm2/N; the life of the teeth may be up to {dried / dry.typical:.3g} times "
            "too short"
        )


class _Reader:
    """Completes a table of lubrication."""

    def __init__(
        self, case: CaseRecord, table: LubricationTable, row: Lubricant | None, km_per_hour: float | None
    ) -> None:
        self.case, self.table, self.row = case, table, row
        self.km_per_hour = km_per_hour
        self.run_hours = float(case.inputs.get("run", {}).get("horizon_hours", math.inf))

    def input(self) -> LubricationInput:
        """Return all of it."""
        table = self.table
        self._check_supply()
        ages = self._ages()
        dry_factor = self._dry_factor() if ages else 1.0
        lasts = self._way(LASTS, "lasts_sliding_m") if ages else ENDLESS
        dirt = read_dirt(self.case, table, table, "lubrication")
        phases = tuple(self._phase(number, phase, dirt) for number, phase in enumerate(table.phase, start=1))
        renewed = any(getattr(table, key) not in (None, []) for key in SCHEDULES)
        dirty = any(of.excess > 0.0 for of in (dirt, *(phase.dirt for phase in phases)))
        self._check_bands(lasts, ages, dirty)
        found = LubricationInput(
            name=table.lubricant or "",
            dry_factor=dry_factor,
            lasts=lasts,
            lasts_ends=self._lasts_ends() if lasts not in (ENDLESS, RunningWay()) else (1.0, 1.0),
            dry_ends=self._dry_ends(dry_factor) if ages else (1.0, 1.0),
            stated=tuple(key for key in _BANDS if getattr(table, key) is not None),
            fades=self._way(FADES, "fades_over_sliding_m") if ages else RunningWay(),
            completeness=self._value("completeness", 1.0) if renewed else 1.0,
            dirt_removed=self._value("contamination_removed", 1.0) if renewed and dirty else 1.0,
            dirt=dirt,
            interval=self._interval(),
            at_hours=self._times(),
            first=self._first(),
            threshold=self._threshold(dirt.excess, dry_factor),
            phases=phases,
            application_cost=self._cost(),
            supplied=not ages and self.row is not None and self.row.supply == "continuous",
            supply_cost=self._supply_cost(),
        )
        self._say(found)
        return found

    def _fault(self, key: str, message: str) -> None:
        self.case.faults.add(f"lubrication.{key}", message)

    def _given(self, keys: Sequence[str]) -> str | None:
        return next((key for key in keys if getattr(self.table, key) not in (None, [])), None)

    def _check_bands(self, lasts: RunningWay, ages: bool, dirty: bool) -> None:
        """Name a factor of a band of what there is not."""
        given = (
            (lasts not in (ENDLESS, RunningWay()), "a lubricant that lasts some time"),
            (ages, "a lubricant that ages"),
            (dirty, "dirt that multiplies the wear"),
        )
        for key, (there, what) in zip(_BANDS, given, strict=True):
            if getattr(self.table, key) is not None and not there:
                self._fault(key, f"needs {what}, which this case does not have: remove it")

    def _check_supply(self) -> None:
        """Name a schedule that the lubricant has no use for."""
        row, key = self.row, self._given(SCHEDULES)
        if key == "phase" and not any(phase.relubrications for phase in self.table.phase):
            key = None
        if row is None or key is None:
            return
        if row.supply == "none":
            self._fault(
                key, "a relubrication needs a lubricant, not lubricant = 'dry': name one, or remove this"
            )
        elif row.supply == "continuous" and key != "phase":
            self._fault(
                key,
                f"lubricant = {row.lubricant!r} is supplied continuously: remove this, or name another one",
            )

    def _ages(self) -> bool:
        """Return whether the lubricant ages, and name what is missing for that."""
        row, given = self.row, self._given(LASTS)
        if given is not None:
            if row is not None and row.supply == "none":
                self._fault(given, "dry contacts have no lubricant: remove this, or name one")
            return True
        if row is not None and row.lasts is not None:
            return True
        self._check_lasting()
        fades = self._given(FADES)
        if fades is not None:
            self._fault(
                fades, "needs lasts_hours, lasts_km or lasts_sliding_m too: give one of them, or remove this"
            )
        return False

    def _check_lasting(self) -> None:
        """Say that a schedule changes nothing where a lubricant lasts nobody knows how long, or cannot be."""
        row, schedule = self.row, self._given((*INTERVAL, *AT, "when_rate_exceeds"))
        if schedule is None or (row is not None and row.supply != "applied"):
            return
        if row is not None and schedule != "when_rate_exceeds":
            self.case.warnings.append(lasting_not_known(row.lubricant, f"lubrication.{schedule}"))
            return
        what = "this lubricant" if row is None else f"lubricant {row.lubricant!r}"
        self._fault(
            "lasts_hours",
            f"{schedule} needs this key, lasts_km or lasts_sliding_m: nothing is known about how long "
            f"{what} lasts",
        )

    def _own(self, key: str) -> float | None:
        """Return a number that is given, or that of the row, which is said; None where neither has one."""
        given: float | None = getattr(self.table, key)
        of_row: float | None = getattr(self.row, key, None)
        if given is None and of_row is not None and self.row is not None:
            self.case.take(f"lubrication.{key}", of_row, f"lubricant {self.row.lubricant!r}")
        return of_row if given is None else given

    def _value(self, key: str, default: float) -> float:
        """Return a number, or its default, which is said."""
        own = self._own(key)
        if own is None:
            self.case.take(f"lubrication.{key}", default, "default")
        return default if own is None else own

    def _dry_factor(self) -> float:
        """Return the one of a lubricant that ages."""
        own = self._own("dry_factor")
        if own is None:
            self._fault("dry_factor", "needed where a lubricant ages: dry over lubricated wear coefficient")
        return 1.0 if own is None else own

    def _way(self, keys: Sequence[str], of_row: str) -> RunningWay:
        key = self._given(keys)
        if key is not None:
            return self._running(key, getattr(self.table, key))
        number = None if self.row is None else getattr(self.row, "lasts" if keys is LASTS else "fades")
        if number is None or (keys is FADES and self._given(LASTS) is not None):
            self.case.take(f"lubrication.{keys[0]}", 0.0, "the lubricant is gone at once")
            return RunningWay()
        self.case.take(f"lubrication.{of_row}", number, f"lubricant {self.row.lubricant!r}")  # type: ignore[union-attr]
        return RunningWay(sliding=1000.0 * number)

    def _lasts_ends(self) -> tuple[float, float]:
        """Return the ends of how long it lasts, over that: the user's, those of the row, or usual ones."""
        row, key = self.row, self._given(LASTS)
        typical, ends = (None, None) if row is None else (row.lasts, row.lasts_ends)
        as_row = key is None or (key, getattr(self.table, key)) == ("lasts_sliding_m", typical)
        return self._ends("lasts_band_factor", typical if as_row else None, ends, _LASTS_BAND, _WHY_LASTS)

    def _dry_ends(self, dry_factor: float) -> tuple[float, float]:
        """Return the ends of the dry factor, over it: the user's, those of the row, or usual ones."""
        row = self.row
        ends = None if row is None else row.dry_ends
        typical = dry_factor if row is not None and dry_factor == row.dry_factor else None
        return self._ends("dry_band_factor", typical, ends, _DRY_BAND, "the dry factor is given by the user")

    def _ends(
        self, key: str, typical: float | None, ends: tuple[float, float] | None, usual: float, why: str
    ) -> tuple[float, float]:
        band: float | None = getattr(self.table, key)
        if band is None and typical and ends is not None:
            return ends[0] / typical, ends[1] / typical
        if band is None:
            band = usual
            self.case.assumptions.append(f"lubrication.{key}: a factor of {band:g} to either side, {why}")
        return 1.0 / band, band

    def _running(self, key: str, value: float) -> RunningWay:
        if key.endswith("_sliding_m"):
            return RunningWay(sliding=1000.0 * value)
        return RunningWay(self._hours(key, value))

    def _hours(self, key: str, value: float) -> float:
        """Return a time in hours that may be given in km."""
        if not key.endswith("km"):
            return value
        if self.km_per_hour is None:
            self._fault(key, "a way in km needs service.km_per_hour: give it, or hours")
            return math.nan
        return value / self.km_per_hour

    def _interval(self) -> RunningWay | None:
        key = self._given(INTERVAL)
        if key is None:
            return None
        return self._running(key, getattr(self.table, key))

    def _times(self) -> tuple[float, ...]:
        key = self._given(AT)
        return () if key is None else tuple(self._hours(key, value) for value in getattr(self.table, key))

    def _first(self) -> str:
        key = self._given((*AT, *INTERVAL))
        if key is None:
            return ""
        value = getattr(self.table, key)
        return f"lubrication.{key} = {value[0] if key in AT else value:g}"

    def _threshold(self, excess: float, dry_factor: float) -> float:
        given = self.table.when_rate_exceeds
        if given is None:
            return math.inf
        if given <= 1.0 + excess:
            self._fault(
                "when_rate_exceeds",
                f"must be above {1.0 + excess:g}, the factor of dirt alone (got {given:g}): fresh lubricant "
                "cannot go below it",
            )
        elif given > dry_factor * (1.0 + excess):
            self.case.warnings.append(
                f"lubrication.when_rate_exceeds = {given:g} is never reached: dry contacts wear "
                f"{dry_factor * (1.0 + excess):g} times as fast, so they are never relubricated"
            )
        return given

    def _phase(self, number: int, phase: LubricationPhase, dirt: Dirt) -> PhaseInput:
        key = "km" if phase.hours is None else "hours"
        place = f"phase.{number}"
        hours = self._hours(f"{place}.{key}", phase.hours or phase.km or 0.0)
        own = (phase.environment, phase.contamination_factor, phase.ageing_factor, phase.abrasive_hardness_HV)
        if any(own):
            dirt = read_dirt(self.case, self.table, phase, f"lubrication.{place}")
        return PhaseInput(hours, dirt, phase.relubrications, phase.contaminations)

    def _cost(self) -> float | None:
        """Return what a relubrication costs."""
        table = self.table
        minutes, hourly, price = (
            table.minutes_per_application,
            table.labour_cost_per_hour,
            table.price_per_application,
        )
        if minutes is not None and hourly is None:
            self._fault(
                "minutes_per_application", "the cost needs labour_cost_per_hour too: give it, or remove this"
            )
        if hourly is not None and minutes is None and not table.option:
            self._fault(
                "labour_cost_per_hour", "the cost needs minutes_per_application too: give it, or remove this"
            )
        if self.row is not None and self.row.supply == "continuous":
            for key in ("price_per_application", "minutes_per_application"):
                if getattr(table, key) is not None:
                    self._fault(key, "does not apply to a lubricant that is supplied continuously: remove it")
        if minutes is None and price is None:
            return None
        return (minutes or 0.0) / 60.0 * (hourly or 0.0) + (price or 0.0)

    def _supply_cost(self) -> float | None:
        """Return what an hour of a supply costs."""
        given = {key: getattr(self.table, key) for key in SUPPLY if getattr(self.table, key) is not None}
        if not given:
            return None
        for key in given:
            if self.row is None or self.row.supply != "continuous":
                text = "needs a lubricant that is supplied continuously: give price_per_application instead"
                self._fault(key, text)
            elif len(given) < len(SUPPLY):
                (other,) = set(SUPPLY) - set(given)
                self._fault(key, f"the cost needs {other} too: give it, or remove this")
        return float(1e-3 * math.prod(given.values()))

    def _say(self, found: LubricationInput) -> None:
        self.case.assumptions += _assumptions(found)
        run, end = self.run_hours, f"the run, run.horizon_hours = {self.run_hours:g}"
        late = sum(time >= run for time in found.at_hours)
        if found.first_hours >= run:
            by_hours = not (found.lasts.sliding or found.fades.sliding)
            lasts = found.lasts.hours / found.dirt.ageing if by_hours else math.inf
            dries = lasts + found.fades.hours / found.dirt.ageing
            self.case.warnings.append(found.never_relubricated(end, "contacts are", run, lasts, dries))
        elif late:
            self.case.warnings.append(
                f"lubrication.{self._given(AT)}: {late} of {len(found.at_hours)} relubrications come after "
                f"{end}"
            )


def _assumptions(found: LubricationInput) -> Iterator[str]:
    """What the state of the lubricant takes for granted."""
    if found.lasts is not ENDLESS or found.dirt.excess or found.phases:
        yield (
            "lubrication: the state of the lubricant multiplies the wear of all contacts equally; a new "
            "chain has lubricated, clean joints, which are relubricated with the drive; it does not "
            "lubricate the teeth"
        )
    if found.phases:
        yield (
            "lubrication.phase: relubrications are spread evenly over a phase, the first at its start, "
            "contaminations in the middle of equal parts; if both coincide, contacts are relubricated "
            "first and stay dirty; after the last phase the first one follows again"
        )
    if found.at_hours and found.interval is None:
        yield f"lubrication: after {found.at_hours[-1]:g} h contacts are no longer relubricated"
