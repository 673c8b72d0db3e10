"""Benchmark B9 and the strand on any number of nodes, and the ways of solving them.

Every way returns the life in cycles, the rates it has evaluated and its seconds: those of the
compiled call alone, or of SciPy's loop with everything that it calls.
"""

import math
from dataclasses import dataclass
from time import perf_counter

import integrators
import numpy as np
from scipy.integrate import LSODA, RK45

from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.contact.stop_limits import stop_limit
from wearsim.drive.load_case import load_case
from wearsim.kernels.controlled_steps import CLOCK, END, RATES, STATE_ROWS, wear_in_steps
from wearsim.kernels.flank_geometry import flank_frame
from wearsim.kernels.hertz_wear import DEPTH_REACHED, soften_edges, wear_depth
from wearsim.kernels.per_cycle_loop import CYCLES_ROWS, run_cycles
from wearsim.kernels.rosenbrock import STAGES, rosenbrock_step
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.wear.law import WearLaw, archard, power
from wearsim.wear.loop import run_per_cycle
from wearsim.wear.problem import WearProblem

HORIZON = 1e12
MODULUS = math.pi * 0.418**2 * 2.1e5
"""Contact modulus [MPa] that makes p = 0.418 sqrt(q E/rho_H), the rounded factor of B9, exact."""


def depth_limit(depth):
    """The limit of the source, physics.md (12)."""
    return stop_limit("critical_depth_mm", depth, lambda x, y, worn: float(worn.max()))


STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.5},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"law": "archard", "specific_wear_rate_mm2_per_N": 5e-11},
    "stop": {"critical_depth_mm": 0.2},
}

STEPS = {
    "ROS2": (integrators.ros2_step, 0.5),
    "implicit Euler": (integrators.euler_step, 0.5),
    "RKC2": (integrators.chebyshev_step, 1.0 / 3.0),
}
"""Step and power of the step control, 1 over the order of its error."""


@dataclass(frozen=True, eq=False)
class Problem:
    """A flank, its wear law, the depth that ends its life, 1 where its end points bend as they wear."""

    contact: FlankContact
    law: WearLaw
    limit: float
    ends: int

    @property
    def numbers(self):
        return self.law.unit_numbers(self.contact.kind)

    @property
    def diffusion(self):
        return self.law.diffusion(self.contact.kind, self.contact.slip_curvature_exponent)

    def start(self):
        profile = self.contact.profile
        return np.array([profile.x, profile.y, np.zeros(profile.x.size)])


@dataclass(frozen=True)
class Run:
    """Life in cycles (nan: none found), rates evaluated, seconds."""

    life: float
    rates: int
    seconds: float


def b9(nodes):
    """Benchmark B9; its lives with 200 and 500 nodes were confirmed cycle by cycle."""
    u = np.linspace(0.0, 1.0, nodes)
    mechanism = PrescribedMechanism(
        kind=ContactKind.LOCAL,
        arc_length=6.0 * u,
        load_per_width=100.0 * (0.2 + 0.8 * np.cos(0.5 * np.pi * u)),
        slip=0.05 + 0.4 * u,
        sliding_speed=np.full(nodes, np.nan),
        flank_curvature=np.full(nodes, 1.0 / 39.1),
        mate_radius=6.035,
        modulus=MODULUS,
    )
    return Problem(mechanism.contact, archard(1e-10), 0.5, 0)


def strand(exponent, nodes):
    """Chain 16B-1 on 20 teeth with an evolute flank, pressure exponent m."""
    case = load_case(STRAND, [f"sprocket.nodes={nodes}"])
    contact = case.drive.mechanism(case).contact
    return Problem(contact, power(5e-11 / 800.0 ** (exponent - 1.0), exponent), 0.2, 1)


class Compiled:
    """A one-step method compiled with its step control; only the compiled call is timed.

    The path is a ring of two states. ``control``: of the package's loop where None, else the
    powers that ``integrators.wear_under_control`` takes.
    """

    def __init__(self, step, control=None):
        self.step, self.control = step, control

    def __call__(self, problem, tolerance, horizon=HORIZON):
        contact, state = problem.contact, problem.start()
        points = state.shape[1]
        work, increments = np.zeros((integrators.WORK_ROWS, points)), np.zeros((STAGES, 3 * points))
        work[integrators.REPORT, 0] = STAGES
        clock, times, path = np.zeros(CLOCK), np.zeros(2), np.zeros((2, STATE_ROWS, points))
        given = (
            self.step,
            contact.kernel,
            state,
            contact.constants,
            contact.columns,
            contact.modulus,
            problem.numbers,
            problem.diffusion,
            problem.ends,
            problem.limit,
            tolerance,
            horizon * problem.law.coefficient,
        )
        if self.control is None:
            function, last = wear_in_steps, 2**62
        else:
            function, last = integrators.wear_under_control, np.array([*self.control, 1.0])
        begin = perf_counter()
        status = function(*given, last, work, increments, clock, times, path)
        seconds = perf_counter() - begin
        life = clock[END] if status == DEPTH_REACHED else math.nan
        return Run(life / problem.law.coefficient, int(clock[RATES]), seconds)


PACKAGE = Compiled(rosenbrock_step)
PI_CONTROLLED = Compiled(rosenbrock_step, (1.0 / 3.0, 0.7 / 3.0, 0.4 / 3.0))


class Rate:
    """Rate of the ways along x and y and of the depth, interleaved, as SciPy's solvers take it."""

    def __init__(self, problem):
        self.problem, points = problem, problem.contact.profile.x.size
        self.numbers, self.calls = problem.numbers, 0
        self.frame, self.touch = np.empty((4, points)), np.empty((4, points))
        self.step = np.empty(points)

    def __call__(self, time, state):
        self.calls += 1
        contact = self.problem.contact
        way_x, way_y, depth = np.ascontiguousarray(state.reshape(-1, 3).T)
        x, y = contact.profile.x + way_x, contact.profile.y + way_y
        flank_frame(x, y, *self.frame)
        normal_x, normal_y, curvature = self.frame[:3]
        contact.kernel(
            x, y, normal_x, normal_y, curvature, depth, contact.constants, contact.columns, *self.touch
        )
        load, slip, speed, relative = self.touch
        # A trial of the solver may conform where the solution does not.
        np.maximum(relative, 1e-6 / contact.mate_radius, out=relative)
        wear_depth(load, slip, speed, relative, contact.modulus, self.numbers, self.step)
        soften_edges(depth, self.numbers, self.step)
        rate = np.empty((self.step.size, 3))
        rate[:, 0], rate[:, 1], rate[:, 2] = -self.step * normal_x, -self.step * normal_y, self.step
        return rate.ravel()


def _by_scipy(solver, problem, tolerance, **options):
    """Step until the limit, then bisect the dense output."""
    rate, limit = Rate(problem), problem.limit
    state = np.zeros(3 * problem.contact.profile.x.size)
    begin = perf_counter()
    fastest = float(rate(0.0, state).max())
    run = solver(
        rate,
        0.0,
        state,
        np.inf,
        first_step=1e-4 * limit / fastest,
        rtol=tolerance,
        atol=tolerance * limit,
        **options,
    )
    while run.status == "running" and run.y[2::3].max() < limit:
        run.step()
    seconds = perf_counter() - begin
    if run.status != "running" or not np.isfinite(run.y).all():
        return Run(math.nan, rate.calls, seconds)
    dense, low, high = run.dense_output(), run.t_old, run.t
    middle = 0.5 * (low + high)
    while low < middle < high:
        low, high = (middle, high) if dense(middle)[2::3].max() < limit else (low, middle)
        middle = 0.5 * (low + high)
    return Run(high / problem.law.coefficient, rate.calls, perf_counter() - begin)


def by_lsoda(problem, tolerance):
    """LSODA as the package took it before: a point reaches x, y and depth of two points on."""
    return _by_scipy(LSODA, problem, tolerance, lband=8, uband=8)


def by_rk45(problem, tolerance):
    """The explicit pair of Dormand and Prince."""
    return _by_scipy(RK45, problem, tolerance)


def every_cycle(problem):
    """The package's loop over all cycles, whole."""
    begin = perf_counter()
    run = run_per_cycle(WearProblem(problem.contact, problem.law, (depth_limit(problem.limit),), HORIZON), 1)
    return Run(float(run.cycles[-1]), run.updates, perf_counter() - begin)


def by_updates(problem, cycles):
    """Explicit updates of so many cycles by the general loop; the last is interpolated."""
    contact, (x, y, depth) = problem.contact, problem.start()
    work, done = np.zeros((CYCLES_ROWS, x.size)), np.zeros(1)
    begin = perf_counter()
    status = run_cycles(
        contact.kernel,
        x,
        y,
        depth,
        contact.constants,
        contact.columns,
        work,
        contact.modulus,
        problem.law.numbers(contact.kind),
        problem.diffusion,
        cycles,
        problem.limit,
        2**62,
        done,
    )
    seconds = perf_counter() - begin
    if status != DEPTH_REACHED:
        return Run(math.nan, int(done[0]), seconds)
    beyond = float(((depth - problem.limit) / work[8])[depth >= problem.limit].max())
    return Run((done[0] - beyond) * cycles, int(done[0]), seconds)
