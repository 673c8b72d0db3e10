"""Lives of a sprocket that a chain wraps, and of the chain."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from wearsim.case.model import Case, WearBand
from wearsim.chain.rating_findings import rating_warnings
from wearsim.contact.resting_engagement import NEW_MATE, MateWear, RestingContact
from wearsim.contact.stop_limits import StopLimit
from wearsim.drive.history import common_history
from wearsim.drive.lubricant import dry_warning, lasting_warning, late_relubrication, with_knees
from wearsim.drive.wear_task import (
    WearTask,
    clock_assumptions,
    contact_clock,
    limit_states,
    task_of,
    wear_law,
)
from wearsim.geometry.profile_points import Vector, area_between
from wearsim.lubrication.model import DIRT
from wearsim.mechanisms.wrap.contact import WrapContact
from wearsim.mechanisms.wrap.drive import WrapDrive, over_pins, wrap_drive
from wearsim.quantities import grouped
from wearsim.result import Life, LimitState, LowerBound, WearResult, environment, life_of
from wearsim.result.folder import with_files
from wearsim.result.second_opinions import SecondOpinions, second_opinions
from wearsim.wear.accuracy import GridStudy, exceeds, grid_study
from wearsim.wear.implicit_steps import RestingTrajectory, part_of, reported_progress, run_resting
from wearsim.wear.law import WearLaw
from wearsim.wear.loop import check_length
from wearsim.wear.mate_clock import LubricatedClock, MateClock
from wearsim.wear.problem import Rows, StartState
from wearsim.wear.resting_bodies import highest_load
from wearsim.wear.running_in import NO_RUNNING_IN
from wearsim.wear.settled_run import advance_resting, outlives
from wearsim.wear.trajectory import difference

_FLANKS = 40
"""Worn outlines kept in flank.csv, about."""

_ADVANCED = 0.1
"""Part of the progress of a run cycle by cycle that the long steps before take."""


def wrap_of(case: Case) -> WrapDrive:
    """Return the drive of a case on which rollers rest, which only a wrap's do."""
    return wrap_drive(case, "the rollers must rest in gaps")


def simulate_wrap(case: Case, progress: Callable[[float], None] = lambda part: None) -> WearResult:
    """Wear the gaps of a wrapped sprocket and its chain until the first limit.

    The run goes on to the sprocket's own limit, with a new chain whenever one has grown
    to its limit; chain and sprocket life are both reported and the shorter is the life.
    """
    drive = wrap_of(case)
    contact = drive.contact(case)
    task = wrap_task(case, contact)
    law, clock = task.law, task.clock
    ratings, practice = drive.ratings(case), chain_practice(case)
    of_practice = practice.warnings if practice else ()
    warnings = [*of_practice, *case.warnings, *rating_warnings(ratings)]
    run, error = _run(case, task, warnings, progress)
    warnings += _gave_up(run, task.horizon)
    constant = run.cycles
    run = task.run_in(run)
    chain = _chain_life(case, contact)
    sprocket = life_of(float(run.cycles[-1]), case.cycles_per_hour, run.met is not None)
    life, stop, stop_value = _first(case, drive, run, chain, sprocket)
    ended = "chain" if stop == "elongation_percent" else "sprocket"
    bands = {
        part: _band(case, part, its, _clock_of(case, part, contact, clock))
        for part, its in (("chain", chain), ("sprocket", sprocket))
    }
    low, high = bands[ended]
    history, flank = _tables(case, contact, drive, run, law)
    history = with_knees(history, constant, law.mates, contact.elongation_per_cycle, case.cycles_per_hour)
    parts = {"chain": chain, "sprocket": sprocket}
    warnings += late_relubrication(case, clock.lubricant, parts)
    warnings += dry_warning(case, clock)
    is_given = drive.wear_band(ended, case.wear).is_given
    warnings += lasting_warning(case, _clock_of(case, ended, contact, clock), ended, life, is_given)
    parts |= _fatigue(case, contact, law, (life, sprocket), warnings)
    deepest = int(run.depth[-1].argmax())
    return WearResult(
        case=case.name,
        title=case.title,
        life=life,
        life_low=low,
        life_high=high,
        band=_band_source(case, ended, _clock_of(case, ended, contact, clock)),
        stop=stop,
        stop_value=stop_value,
        cycles_run=float(run.cycles[-1]),
        hours_run=float(run.cycles[-1]) / case.cycles_per_hour,
        max_depth=float(run.depth[-1, deepest]),
        max_depth_arc_length=float(contact.arc_length[deepest]),
        removed_area=math.fsum(
            area_between(run.x[0], run.y[0], x, y)
            for x, y in zip(*contact.profile.receded(run.all_depth[-1]), strict=True)
        ),
        worn_area=run.area,
        initial_peak_pressure=float(history["peak_pressure_MPa"][0]),
        final_peak_pressure=float(history["peak_pressure_MPa"][-1]),
        speed_rpm=case.speed_rpm,
        method=case.run.method,
        updates=run.updates,
        numerical_error=error,
        life_tolerance=case.run.life_tolerance,
        parts=parts,
        limits=_limits(contact, drive, task.stop_limits, run, life),
        bands=bands,
        ratings=ratings,
        practice=practice,
        assumptions=(*contact.assumptions(), *_clock_assumptions(case, law), *case.assumptions),
        warnings=tuple(warnings),
        inputs=with_files(case.inputs, ""),
        input_files=case.input_files,
        history_columns=history,
        flank_columns=flank,
        environment=environment(),
    )


def chain_practice(case: Case) -> SecondOpinions | None:
    """Return what published rules say of the chain of a case; None where it transmits nothing."""
    duty = wrap_of(case).practice(case)
    return second_opinions(*duty) if duty else None


def wrap_task(case: Case, contact: WrapContact) -> WearTask[RestingContact]:
    """Return what a wrap asks of the wear engine."""
    clock = contact_clock(case, contact.sliding_per_cycle, contact.joint_sliding_per_cycle)
    mates = MateClock(clock, joint_clock(case, contact).part)
    law = replace(wear_law(case.wear, case.wear.coefficient), running_in=clock.part, mates=mates)
    return task_of(case, contact, law, wrap_of(case).gap_limits(case, contact.mechanism.path), clock)


def joint_clock(case: Case, contact: WrapContact) -> LubricatedClock:
    """Return the clock of the joints of the first chain, from what they slide all round the loop."""
    sliding = contact.joint_sliding_per_cycle
    return contact_clock(case, sliding, sliding)


def chain_band(case: Case) -> WearBand:
    """Return the ends of the wear of a chain over that of its case, and what they come from.

    Those of the rate of its joints, wider by what is not known of the lubricant.
    """
    band = case.drive.wear_band("chain", case.wear)
    contact = wrap_of(case).contact(case)
    clock = joint_clock(case, contact)
    ends = clock.factors(contact.cycles_per_mate, band.low, band.high, band.is_given)
    return WearBand(*ends, _band_source(case, "chain", clock), band.is_given)


def chain_prior(case: Case) -> tuple[float, float]:
    """Return the ends of the rate of a chain before it was read: that of its joints, wider by dirt only.

    How long the lubricant lasts and what dry contacts wear follow the clock of the case.
    """
    band = case.drive.wear_band("chain", case.wear)
    contact = wrap_of(case).contact(case)
    clock = joint_clock(case, contact)
    of_dirt = tuple(ends for ends in clock.ends if ends.unsure == DIRT)
    return replace(clock, unsure=lambda: of_dirt).factors(
        contact.cycles_per_mate, band.low, band.high, band.is_given
    )


def _band_source(case: Case, part: str, clock: LubricatedClock) -> str:
    band = case.drive.wear_band(part, case.wear)
    return clock.band_source(band.source, band.is_given)


def chain_clock(case: Case) -> LubricatedClock:
    """Return the clock of the first chain of a case, in the cycles of its sprocket."""
    return joint_clock(case, wrap_of(case).contact(case))


def wrap_grid_study(case: Case, life_tolerance: float) -> GridStudy:
    """Run the sprocket of a wrapped case on three grids."""
    task = wrap_task(case, wrap_of(case).contact(case))
    return grid_study(
        task.contact, lambda grid: task.run_in(advance_resting(task.on(grid), life_tolerance)[0])
    )


def _run(
    case: Case, task: WearTask[RestingContact], warnings: list[str], progress: Callable[[float], None]
) -> tuple[RestingTrajectory, float]:
    """Run the case; the error is that of the steps and of the grid."""
    by_cycles, tolerance = case.run.method == "per_cycle", case.run.life_tolerance
    first = part_of(progress, 0.0, _ADVANCED) if by_cycles else progress
    run, error = advance_resting(task, task.life_tolerance, first)
    if by_cycles:
        check, end, cycles = run, float(run.cycles[-1]), case.run.cycles_per_update
        check_length(task, end, cycles)
        until = task.horizon if check.met else end
        watch = reported_progress(part_of(progress, _ADVANCED, 1.0))
        run = run_resting(replace(task, horizon=until), 0, float(cycles), watch)
        error += difference(run, check)
    error *= task.clock.amplification
    if error > tolerance and not outlives(task, run, error):
        warnings.append(
            f"{exceeds(error, tolerance)}, even with steps halved and phases doubled: use more nodes or "
            "phases, or a larger run.life_tolerance"
        )
    return run, error


def _gave_up(run: RestingTrajectory, horizon: float) -> list[str]:
    """Warn of a run that ended neither at a limit nor at its horizon."""
    if run.met is not None or float(run.cycles[-1]) >= horizon * (1.0 - 1e-9):
        return []
    if run.lost:
        return [f"the run ends before the sprocket's limit, so its life is longer than stated: {run.lost}"]
    return [
        f"the run stopped after {run.updates} steps and {run.mates[-1]:.0f} chains, the most allowed: "
        "the sprocket outlasts them, its own limit was not reached"
    ]


def _chain_life(case: Case, contact: WrapContact) -> Life | LowerBound:
    """Life of a chain: but for running-in and lubricant its joints wear at a constant rate."""
    cycles, clock = contact.cycles_per_mate, joint_clock(case, contact)
    horizon = clock.steady_cycles(case.run.horizon_hours * case.cycles_per_hour)
    run = float(clock.running_cycles(np.array([min(cycles, horizon)]))[0])
    return life_of(run, case.cycles_per_hour, cycles <= horizon)


def _first(
    case: Case,
    drive: WrapDrive,
    run: RestingTrajectory,
    chain: Life | LowerBound,
    sprocket: Life | LowerBound,
) -> tuple[Life | LowerBound, str, float]:
    """Return the shorter of both lives with the limit that ended it."""
    if isinstance(chain, Life) and not (isinstance(sprocket, Life) and sprocket.cycles <= chain.cycles):
        return chain, "elongation_percent", 100.0 * drive.joint.elongation_limit
    if run.met is not None:
        return sprocket, run.met.name, run.met.limit
    return sprocket, "horizon_hours", case.run.horizon_hours


def part_band(case: Case, part: str, life: Life | LowerBound) -> tuple[Life | LowerBound, Life | LowerBound]:
    """Return the life of chain or sprocket at both ends of the band of its wear."""
    clock = LubricatedClock(NO_RUNNING_IN)
    if not (case.wear.is_steady and (case.lubrication is None or case.lubrication.steady)):
        contact = wrap_of(case).contact(case)
        clock = _clock_of(case, part, contact, wrap_task(case, contact).clock)
    return _band(case, part, life, clock)


def _clock_of(case: Case, part: str, contact: WrapContact, teeth: LubricatedClock) -> LubricatedClock:
    return joint_clock(case, contact) if part == "chain" else teeth


def _band(
    case: Case, part: str, life: Life | LowerBound, clock: LubricatedClock
) -> tuple[Life | LowerBound, Life | LowerBound]:
    band = case.drive.wear_band(part, case.wear)
    steady = clock.steady_cycles(life.cycles_run)
    low, high = clock.factors(steady, band.low, band.high, band.is_given)
    return _scaled(life, high, case, clock), _scaled(life, low, case, clock)


def _clock_assumptions(case: Case, law: WearLaw) -> tuple[str, ...]:
    """Return what coefficients that change with the cycles take for granted, of teeth and of joints."""
    found, joints = clock_assumptions(law.running_in), law.mates.mate
    if joints == law.running_in:
        return found
    hours = joints.shortest / case.cycles_per_hour
    return (
        *found,
        "joints of every new chain run in over their own sliding distance on all sprockets, the extra wear "
        "falls to 1/e in "
        f"{grouped(hours)} h",
    )


def _scaled(life: Life | LowerBound, factor: float, case: Case, clock: LubricatedClock) -> Life | LowerBound:
    """Return the life with all wear coefficients multiplied: cycles times coefficient is constant."""
    steady = clock.steady_cycles(life.cycles_run)
    scaled = clock.running_cycles(np.array([steady / factor]))
    return life_of(float(scaled[0]), case.cycles_per_hour, isinstance(life, Life))


def _fatigue(
    case: Case,
    contact: WrapContact,
    law: WearLaw,
    wear: tuple[Life | LowerBound, Life | LowerBound],
    warnings: list[str],
) -> dict[str, Life | LowerBound]:
    """Return the life of the sprocket until pitting; none where it is not asked for."""
    if case.fatigue is None:
        return {}
    from wearsim.drive.pitting import fatigue_parts

    factor = case.fatigue.load_factor
    stresses = [
        (highest_load(replace(contact, blocks=(block,)), law, None, factor)[0], block.share)
        for block in contact.blocks
    ]
    lives, found = fatigue_parts(case, case.fatigue, stresses, *wear)
    warnings += found
    return lives


def _limits(
    contact: WrapContact,
    drive: WrapDrive,
    stop_limits: tuple[StopLimit, ...],
    run: RestingTrajectory,
    life: Life | LowerBound,
) -> tuple[LimitState, ...]:
    """Return what every limit has come to when the life ends."""
    at = int(np.searchsorted(run.cycles, life.cycles_run * (1.0 - 1e-9)))
    at = min(at, run.cycles.size - 1)
    worn = limit_states(stop_limits, run.x[at], run.y[at], run.depth[at])
    limit, elongation = drive.joint.elongation_limit, float(run.elongation[at])
    wear = MateWear(elongation, float(run.mate_depth[at]))
    least = _smallest_slack_tension(contact, run.all_depth[at], wear)
    wall = contact.mate_radius - contact.thinnest_mate
    rollers = LimitState("roller_wear_mm", wall, wear.depth)
    return (
        *worn,
        LimitState("elongation_percent", 100.0 * limit, 100.0 * elongation),
        *((rollers,) if contact.mate_area_ratio else ()),
        LimitState(
            "min_slack_tension_N", contact.slack_limit or drive.slack, min(least, drive.heaviest.tension)
        ),
    )


def _smallest_slack_tension(contact: WrapContact, depth: Rows, wear: MateWear) -> float:
    """Slack tension below which the chain jumps on worn gaps [N]."""
    worn = contact.worn_paths(*contact.profile.receded(depth), wear)
    rollers = contact.heaviest_rollers
    there = rollers.with_slack(contact.slack_limit) if contact.slack_limit else rollers
    return there.smallest_slack_tension(wear.elongation, worn)


def _tables(
    case: Case, contact: WrapContact, drive: WrapDrive, run: RestingTrajectory, law: WearLaw
) -> tuple[dict[str, Vector], dict[str, Vector]]:
    """Return the columns of history.csv and flank.csv."""
    profile, points, path = contact.profile, contact.profile.x.size, contact.mechanism.path
    pressure, speed = highest_load(contact, law, StartState(run.all_depth[0], NEW_MATE, 1))
    history = {
        **common_history(case, run),
        "elongation_percent": 100.0 * run.elongation,
        "roller_wear_mm": run.mate_depth,
        "chain": run.mates,
        "peak_pressure_MPa": np.array([pressure, *run.peak_pressure[1:]]),
        "max_sliding_speed_mm_per_s": np.array([speed, *run.sliding_speed[1:]]),
        "removed_area_mm2": np.array(
            [area_between(run.x[0], run.y[0], x, y) for x, y in zip(run.x, run.y, strict=True)]
        ),
        "tip_land_mm": np.array([drive.worn_tip_land(x, y) for x, y in zip(run.x, run.y, strict=True)]),
        "over_pins_mm": np.array(
            [over_pins(path, x, y, drive.gaps) for x, y in zip(run.x, run.y, strict=True)]
        ),
    }
    shots = np.unique(np.linspace(0, run.cycles.size - 1, _FLANKS).round().astype(int))
    bodies = contact.bodies
    depth = run.all_depth[shots]
    x, y = profile.receded(depth)
    flank = {
        "cycles": np.repeat(run.cycles[shots], bodies * points),
        "gap_kind": np.tile(np.repeat(np.arange(1, bodies + 1), points), shots.size),
        "node": np.tile(np.arange(1, points + 1), shots.size * bodies),
        "arc_length_mm": np.tile(contact.arc_length, shots.size * bodies),
        "x_mm": x.ravel(),
        "y_mm": y.ravel(),
        "depth_mm": depth.ravel(),
    }
    return history, flank
