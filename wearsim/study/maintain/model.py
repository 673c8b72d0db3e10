"""Maintenance: a chain replaced at a chosen elongation, its sprocket kept, turned or replaced."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from wearsim.case.keys import MaintenanceTable, maintenance_of
from wearsim.case.model import Case
from wearsim.drive.part_life import simulate
from wearsim.drive.wrap_life import wrap_of
from wearsim.errors import CaseError, ContactError, ConvergenceError, WearsimError
from wearsim.mechanisms.wrap.drive import WrapDrive, wrap_drive
from wearsim.result import Life, LowerBound
from wearsim.runner.scaled_percentiles import check_no_running_in, check_steady_lubricant
from wearsim.study.maintain.reversed_sprocket import reversed_life
from wearsim.study.maintain.tooth_count import ToothCount, meetings_around, variant

Progress = Callable[[int, int], None]
"""Called before each run with the number done and the number of all."""

POLICIES = (1.0, 1.5, 2.0, 3.0)
"""Elongations in percent to compare where none are given, as far as they lie below the drive's limit."""

CONVENTIONS = (
    "a new sprocket gets a new chain: the last chain goes with its sprocket, however little it is worn",
    "one stop per chain, the last one shared with the sprocket, and one for turning",
)
TURN_CONVENTION = (
    "a sprocket is turned when its first flank is worn, with the chain in use; both flanks share the wear "
    "of the seat; the depth limit then applies to the working half of the gap"
)


@dataclass(frozen=True)
class ReplacementPolicy:
    """What follows from replacing the chain at an elongation."""

    replace_at: float  # relative elongation at which a new chain is put on
    reversed_: bool  # whether the sprocket is turned when its first flank is worn
    chain_hours: float  # life of one chain [h]
    sprocket: Life | LowerBound  # of the sprocket, both flanks if it is turned
    numerical_error: float  # estimated relative error of the sprocket's life
    # per 1000 h, in the currency of the prices; None where these are not given or the sprocket's
    # life is not known
    cost: float | None = None

    @property
    def hours(self) -> float:
        """Life of the sprocket, or what its run covers [h]."""
        return self.sprocket.hours_run

    @property
    def chains(self) -> int:
        """Chains that one sprocket takes, the one in use at its end included."""
        return max(1, math.ceil(self.hours / self.chain_hours - 1e-9))

    @property
    def last_chain_used(self) -> float:
        """Part of its life that the last chain has had, from 0 to 1."""
        return self.hours / self.chain_hours - (self.chains - 1)

    @property
    def stops(self) -> int:
        """Stops in the life of one sprocket: for its chains, the last with the sprocket, and a turn."""
        return self.chains + (1 if self.reversed_ else 0)


@dataclass(frozen=True)
class MaintenancePlan:
    """Policies of one drive side by side, and tooth and link counts near its own."""

    case: str  # of the case
    title: str  # of the case
    policies: tuple[ReplacementPolicy, ...]  # by elongation; a turned sprocket after the same without
    # meetings near the case's own numbers of teeth and links, with lives of four of them
    counts: tuple[ToothCount, ...]
    count_limit: float  # relative elongation at which the chain is replaced in these lives
    conventions: tuple[str, ...]  # how chains and stops are counted
    # assumptions, warnings: what the case takes for granted, and what the user should look at
    assumptions: tuple[str, ...]
    warnings: tuple[str, ...]
    currency: str = ""  # of the prices

    @property
    def cheapest(self) -> ReplacementPolicy | None:
        """The policy with the least cost, None where no cost is known."""
        priced = [(policy.cost, i) for i, policy in enumerate(self.policies) if policy.cost]
        return self.policies[min(priced)[1]] if priced else None


def cost_per_1000_hours(table: MaintenanceTable, hours: float, chains: int, stops: int) -> float | None:
    """Return what chains, sprocket and stops cost per 1000 h of running.

    1000 (chains times their price + price of the sprocket + stops times hours of standstill
    times their cost)/hours.

    Examples
    --------
    (3 * 40 + 100 + 3 * 2 * 30)/8000 * 1000 = 400/8:

    >>> table = MaintenanceTable(
    ...     chain_price=40, sprocket_price=100, downtime_hours=2, downtime_cost_per_hour=30
    ... )
    >>> cost_per_1000_hours(table, 8000.0, 3, 3)
    50.0
    """
    if table.chain_price is None or table.sprocket_price is None:
        return None
    parts = chains * table.chain_price + table.sprocket_price
    return 1000.0 * (parts + stops * table.stop_cost) / hours


def maintain(case: Case, progress: Progress = lambda done, of: None) -> MaintenancePlan:
    """Compare policies of replacing the chain of a case.

    Each policy is a run to the sprocket's limit with a new chain whenever one has grown to
    the elongation; a turned sprocket is a second run on the mirrored outline from the depth
    and the chain at the end of the first.
    """
    drive = wrap_drive(case, "'maintain' needs a chain that wraps the sprocket")
    check_steady_lubricant(case, "maintain", "use wearsim lubricate to study relubrication")
    check_no_running_in(case, "maintain")
    table = maintenance_of(case.inputs)
    limit: float = case.inputs["stop"]["elongation_percent"]
    elongations = table.replace_at_percent or [*(e for e in POLICIES if e < limit), limit]
    counts = meetings_around(case, drive)
    runs = sum(count.run for count in counts) - (limit in elongations)
    steps = _Steps(len(elongations) * (2 if table.turn_sprocket else 1) + max(runs, 0), progress)
    warnings = list(case.warnings)
    policies = _all_policies(case, drive, table, elongations, steps, warnings)
    own = [policy for policy in policies if policy.replace_at == drive.joint.elongation_limit]
    counts = _with_lives(counts, case, own[0] if own else None, steps, warnings)
    return MaintenancePlan(
        case=case.name,
        title=case.title,
        policies=tuple(policies),
        counts=counts,
        count_limit=drive.joint.elongation_limit,
        conventions=(*CONVENTIONS, *((TURN_CONVENTION,) if table.turn_sprocket else ())),
        assumptions=case.assumptions,
        warnings=tuple(dict.fromkeys(warnings)),
        currency=table.currency or "",
    )


def _with_limit(case: Case, drive: WrapDrive, percent: float) -> Case:
    """Return the case with another elongation at which its chain is replaced."""
    joint = replace(drive.joint, elongation_limit=0.01 * percent)
    stop = {**case.inputs["stop"], "elongation_percent": percent}
    return replace(case, drive=replace(drive, joint=joint), inputs={**case.inputs, "stop": stop})


class _Steps:
    """Runs one after the other, each told about before it starts."""

    def __init__(self, total: int, progress: Progress) -> None:
        self.total, self.progress, self.done = total, progress, 0

    def next(self) -> None:
        self.progress(self.done, self.total)
        self.done += 1


def _all_policies(
    case: Case,
    drive: WrapDrive,
    table: MaintenanceTable,
    elongations: list[float],
    steps: _Steps,
    warnings: list[str],
) -> list[ReplacementPolicy]:
    """Run every policy; what fails becomes a warning, unless all do."""
    policies: list[ReplacementPolicy] = []
    failure: WearsimError | None = None
    for percent in elongations:
        done = steps.done
        try:
            policies += _policies(_with_limit(case, drive, percent), table, steps, warnings)
        except (CaseError, ContactError, ConvergenceError) as reason:
            failure = reason
            warnings.append(f"replacing the chain at {percent:g} % fails: {reason}")
        steps.done = done + (2 if table.turn_sprocket else 1)
    if failure is not None and not policies:
        raise failure
    return policies


def _policies(
    case: Case, table: MaintenanceTable, steps: _Steps, warnings: list[str]
) -> list[ReplacementPolicy]:
    """Return one policy, and the same with the sprocket turned where that is wanted."""
    drive = wrap_of(case)
    what = f"chain replaced at {100.0 * drive.joint.elongation_limit:.3g} %"
    steps.next()
    first = simulate(case)
    warnings += [text for text in first.warnings if text not in warnings]
    policy = ReplacementPolicy(
        replace_at=drive.joint.elongation_limit,
        reversed_=False,
        chain_hours=chain_life(case).hours,
        sprocket=first.parts["sprocket"],
        numerical_error=first.numerical_error,
    )
    found = [policy]
    if table.turn_sprocket and isinstance(policy.sprocket, Life):
        steps.next()
        try:
            second, error = reversed_life(case, first)
        except (ContactError, ConvergenceError) as reason:
            warnings.append(f"turning the sprocket, {what}, fails: {reason}")
        else:
            error = max(error, first.numerical_error)
            life = _sum(policy.sprocket, second)
            found.append(replace(policy, reversed_=True, sprocket=life, numerical_error=error))
    return [
        replace(entry, cost=cost_per_1000_hours(table, entry.hours, entry.chains, entry.stops))
        if isinstance(entry.sprocket, Life)
        else entry
        for entry in found
    ]


def _sum(first: Life, second: Life | LowerBound) -> Life | LowerBound:
    return type(second)(first.cycles + second.cycles_run, first.hours + second.hours_run)


def _with_lives(
    counts: tuple[ToothCount, ...],
    case: Case,
    own: ReplacementPolicy | None,
    steps: _Steps,
    warnings: list[str],
) -> tuple[ToothCount, ...]:
    """Return the counts with the lives of those to be run; the case's own is a policy as a rule."""
    found = []
    drive = wrap_of(case)
    numbers = drive.gaps, drive.layout.links
    for count in counts:
        meetings = count.meetings
        if not count.run:
            found.append(count)
        elif own is not None and (meetings.teeth, meetings.links) == numbers:
            found.append(replace(count, lives={"chain": chain_life(case), "sprocket": own.sprocket}))
        else:
            steps.next()
            found.append(_run_count(count, case, warnings))
    return tuple(found)


def _run_count(count: ToothCount, case: Case, warnings: list[str]) -> ToothCount:
    try:
        changed = variant(case, count.meetings)
        sprocket = simulate(changed).parts["sprocket"]
    except (CaseError, ContactError, ConvergenceError) as reason:
        warnings.append(f"{count.meetings.teeth} teeth, {count.meetings.links} links: {reason}")
        return count
    return replace(count, lives={"chain": chain_life(changed), "sprocket": sprocket})


def chain_life(case: Case) -> Life:
    """Return the life of a chain, whose joints wear at a constant rate."""
    cycles = wrap_of(case).contact(case).cycles_per_mate
    return Life(cycles, cycles / case.cycles_per_hour)
