"""Lives on mechanisms that load every point of a flank once a cycle: strand and table of loads."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from wearsim.case.model import Case
from wearsim.contact.engagement import FlankContact, Mechanism
from wearsim.contact.hertz import peak_pressure
from wearsim.drive.flank_grids import LEVELS, FlankRun, GridSearch, SettledLife, settle_grid
from wearsim.drive.history import common_history
from wearsim.drive.lubricant import dry_warning, lasting_warning, late_relubrication
from wearsim.drive.validity import few_cycles, film_assumptions, validity
from wearsim.drive.wear_task import WearTask, clock_assumptions, limit_states, new_flank_pressure, wear_task
from wearsim.errors import WearsimError
from wearsim.geometry.profile_points import Vector, area_between, area_swept
from wearsim.result import Life, LowerBound, WearResult, environment, life_of
from wearsim.result.folder import with_files
from wearsim.wear.accuracy import GridStudy, grid_study
from wearsim.wear.loop import check_length, run_per_cycle
from wearsim.wear.trajectory import Trajectory, check_fold, difference


def simulate_points(case: Case, progress: Callable[[float], None] = lambda part: None) -> WearResult:
    """Wear the flank of a case on a strand or under a table of loads; cycle by cycle, call `progress`."""
    warnings = list(case.warnings)
    new = case.drive.mechanism(case)
    settled = _settled_life(case, new, warnings, progress)
    mechanism, task, run = settled.mechanism, settled.run.task, settled.run.trajectory
    history, flank = _tables(case, mechanism, run)
    warnings += validity(mechanism.contact, history, flank)
    low, high = _band(case, task, run, warnings)
    if run.met is not None:
        warnings += few_cycles(float(run.cycles[-1]))
    warnings += late_relubrication(case, task.clock.lubricant, {"flank": _life(case, run)})
    warnings += dry_warning(case, task.clock)
    warnings += lasting_warning(case, task.clock, "flank", _life(case, run), case.wear.band_is_given)
    # On the points of the case, as all that is asked of a new flank.
    new_pressure = new_flank_pressure(new.contact)
    fatigue = _fatigue(case, _life(case, run), new_pressure, warnings)
    deepest = int(run.depth[-1].argmax())
    return WearResult(
        case=case.name,
        title=case.title,
        life=_life(case, run),
        life_low=low,
        life_high=high,
        band=task.clock.band_source(case.wear.band, case.wear.band_is_given),
        stop=run.met.name if run.met else "horizon_hours",
        stop_value=run.met.limit if run.met else case.run.horizon_hours,
        cycles_run=float(run.cycles[-1]),
        hours_run=float(run.cycles[-1]) / case.cycles_per_hour,
        max_depth=float(run.depth[-1, deepest]),
        max_depth_arc_length=float(mechanism.contact.arc_length[deepest]),
        removed_area=area_between(run.x[0], run.y[0], run.x[-1], run.y[-1]),
        worn_area=area_swept(run.x, run.y, run.depth),
        initial_peak_pressure=new_pressure,
        final_peak_pressure=float(history["peak_pressure_MPa"][-1]),
        speed_rpm=case.speed_rpm,
        method=case.run.method,
        updates=run.updates,
        numerical_error=settled.error,
        life_tolerance=case.run.life_tolerance,
        parts=fatigue,
        limits=limit_states(task.stop_limits, run.x[-1], run.y[-1], run.depth[-1]),
        bands={},
        ratings=(),
        practice=None,
        assumptions=(
            *mechanism.assumptions(),
            *clock_assumptions(task.clock.part),
            *film_assumptions(case),
            *settled.assumptions(),
            *case.assumptions,
        ),
        warnings=tuple(warnings),
        inputs=with_files(case.inputs, ""),
        input_files=case.input_files,
        history_columns=history,
        flank_columns=flank,
        environment=environment(),
    )


def points_grid_study(case: Case, life_tolerance: float) -> GridStudy:
    """Run a case on a strand or under a table of loads on three grids."""
    tight = replace(case, run=replace(case.run, life_tolerance=life_tolerance))
    return grid_study(case.drive.mechanism(case).contact, lambda grid: wear_task(tight, grid).run()[0])


def _settled_life(
    case: Case, mechanism: Mechanism, warnings: list[str], progress: Callable[[float], None]
) -> SettledLife:
    """Find the life on points on which it is within its tolerance, or say that it is not."""
    advances = case.run.method == "advance"
    tolerance, levels = case.run.life_tolerance, LEVELS if advances else 0
    search: GridSearch = settle_grid(mechanism, tolerance, levels)
    contacts = next(search)
    first = FlankRun(wear_task(case, contacts[0]), *_first_run(case, contacts[0], warnings, progress))
    found: list[FlankRun | None] = [first, *(_run_on(case, other) for other in contacts[1:])]
    while True:
        try:
            contacts = search.send(found)
        except StopIteration as end:
            settled: SettledLife = end.value
            break
        found = [_run_on(case, contact) for contact in contacts]
    warnings += settled.warnings(tolerance)
    return settled


def _first_run(
    case: Case, contact: FlankContact, warnings: list[str], progress: Callable[[float], None]
) -> tuple[Trajectory, float]:
    """Return the run of a case on its own points, and the error of its steps."""
    task = wear_task(case, contact)
    if case.run.method == "advance":
        run, error = task.run()
        check_fold(contact, run)
        return run, error
    cycles, check = case.run.cycles_per_update, None
    try:
        check, change = task.run()
    except WearsimError as reason:
        warnings.append(
            f"the step error could not be estimated by method 'advance', 100 % is stated: {reason}"
        )
    else:
        expected = task.clock.steady_cycles(float(check.cycles[-1]))
        check_length(task, expected, cycles)
    run = task.run_in(run_per_cycle(task, cycles, progress))
    check_fold(contact, run)
    return run, 1.0 if check is None else change + difference(run, check)


def _run_on(case: Case, contact: FlankContact) -> FlankRun | None:
    """Return the run on other points; None where there is none."""
    task = wear_task(case, contact)
    try:
        run, error = task.run()
        check_fold(contact, run)
    except WearsimError:
        return None
    return FlankRun(task, run, error)


def _tables(case: Case, mechanism: Mechanism, run: Trajectory) -> tuple[dict[str, Vector], dict[str, Vector]]:
    """Return the columns of history.csv and flank.csv."""
    contact = mechanism.contact
    shots, points = run.depth.shape
    touches = [contact.engage(x, y, depth) for x, y, depth in zip(run.x, run.y, run.depth, strict=True)]
    load = np.array([touch.load_per_width for touch in touches])
    relative = np.array([touch.relative_curvature for touch in touches])
    speed = np.array([touch.sliding_speed for touch in touches])
    # A strand says 0 where no roller touches, which is no speed of anything.
    touched = np.where((load > 0.0) | (speed > 0.0), speed, np.nan)
    pressure = peak_pressure(load, np.maximum(relative, 0.0), contact.modulus)
    history = {
        **common_history(case, run),
        "peak_pressure_MPa": pressure.max(axis=1),
        "max_sliding_speed_mm_per_s": speed.max(axis=1),
        "removed_area_mm2": np.array(
            [0.0]
            + [area_between(run.x[0], run.y[0], x, y) for x, y in zip(run.x[1:], run.y[1:], strict=True)]
        ),
        "worn_contact_ratio": np.array(
            [mechanism.worn_contact_ratio(x, y) for x, y in zip(run.x, run.y, strict=True)]
        ),
    }
    flank = {
        "cycles": np.repeat(run.cycles, points),
        "node": np.tile(np.arange(1, points + 1), shots),
        "arc_length_mm": np.tile(contact.arc_length, shots),
        "x_mm": run.x.ravel(),
        "y_mm": run.y.ravel(),
        "depth_mm": run.depth.ravel(),
        "pressure_MPa": pressure.ravel(),
        "sliding_speed_mm_per_s": touched.ravel(),
        "load_per_width_N_per_mm": load.ravel(),
        "relative_curvature_per_mm": relative.ravel(),
        **mechanism.mate_columns(run.depth),
    }
    return history, flank


def _band(
    case: Case, task: WearTask[FlankContact], run: Trajectory, warnings: list[str]
) -> tuple[Life | LowerBound, Life | LowerBound]:
    """Lives at the high and at the low coefficient: by scaling where the life is known."""
    life = _life(case, run)
    steady = task.clock.steady_cycles(life.cycles_run)
    wear = case.wear
    least, most = task.clock.factors(steady, wear.low, wear.high, wear.band_is_given)
    if isinstance(life, Life):
        factors = np.array([most, least])
        low, high = task.clock.running_cycles(steady / factors).tolist()
        return Life(low, low / case.cycles_per_hour), Life(high, high / case.cycles_per_hour)
    law = replace(task.law, coefficient=most * task.law.coefficient)
    try:
        worse, _ = replace(task, law=law).run()
    except WearsimError as reason:
        # What the run has shown holds for the higher coefficient over proportionally fewer cycles.
        warnings.append(f"no life with the wear coefficient at its high end: {reason}")
        cycles = float(task.clock.running_cycles(np.array([steady / most]))[0])
        return LowerBound(cycles, cycles / case.cycles_per_hour), life
    return _life(case, worse), life


def _fatigue(
    case: Case, life: Life | LowerBound, peak_pressure: float, warnings: list[str]
) -> dict[str, Life | LowerBound]:
    """Return the lives until pitting; none where they are not asked for."""
    if case.fatigue is None:
        return {}
    from wearsim.drive.pitting import fatigue_parts

    highest = case.fatigue.load_factor**0.5 * peak_pressure
    greatest = max((block.tension for block in case.drive.duty), default=1.0)
    stresses = [(highest * (block.tension / greatest) ** 0.5, block.share) for block in case.drive.duty]
    lives, found = fatigue_parts(case, case.fatigue, stresses or [(highest, 1.0)], life, life)
    warnings += found
    return lives


def _life(case: Case, run: Trajectory) -> Life | LowerBound:
    return life_of(float(run.cycles[-1]), case.cycles_per_hour, run.met is not None)
