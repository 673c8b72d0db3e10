"""Tensions of a closed chain, loads of its shafts and losses of its joints against other ways to them.

A loop at rest carries no net force, whatever pulls in it. A tensioner's force over its travel is the work of
stretching the loop: the tension times the length that the travel takes up, found here by moving the wheel.
Losses are summed up joint by joint.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from wearsim.chain.chain_loop import ChainLoop, Wheel
from wearsim.chain.drive_layout import layout_with_links
from wearsim.chain.loop_forces import LoopForces, SpanLevel, loop_forces, looser_span
from wearsim.chain.loop_layout import LoopDrive, loop_layout
from wearsim.chain.span_tension import catenary_tension
from wearsim.chain.take_up import TakeUp
from wearsim.errors import CaseError

PITCH = 12.7


def random_loops(count: int) -> list[LoopForces]:
    """Loops of 3 to 6 wheels on a ring, some of them idlers, under random pulls."""
    draw, found = np.random.default_rng(7), []
    while len(found) < count:
        number = int(draw.integers(3, 7))
        angles = np.sort(draw.uniform(0.0, 2.0 * math.pi, number))
        radii = draw.uniform(300.0, 900.0, number)
        wheels = tuple(
            Wheel(f"w{i}", (radius * math.cos(angle), radius * math.sin(angle)), int(draw.integers(9, 31)))
            for i, (angle, radius) in enumerate(zip(angles, radii, strict=True))
        )
        driven = draw.uniform(0.1, 1.0, number - 1) * (draw.uniform(size=number - 1) < 0.7)
        driven[-1] += 0.2
        shares = (1.0, *(-driven / driven.sum()))
        try:
            loop = ChainLoop(PITCH, wheels)
        except CaseError:
            continue
        level = SpanLevel(float(draw.uniform(10.0, 200.0)), span=looser_span(loop, shares))
        pull, lever, centrifugal = (
            draw.uniform(100.0, 5000.0),
            draw.uniform(0.0, 0.8),
            draw.uniform(0.0, 90.0),
        )
        found.append(loop_forces(loop, float(pull), shares, level, float(lever), float(centrifugal)))
    return found


def test_two_sprockets_have_the_tensions_of_today(validated: Callable[..., None]) -> None:
    """Pull plus slack on one span, the slack's catenary on the other; shafts bear both along the spans."""
    wheels = Wheel("driver", (0.0, 0.0), 17), Wheel("driven", (500.0, 0.0), 34)
    loop, level = ChainLoop(PITCH, wheels), SpanLevel(60.0, span=0)
    forces = loop_forces(loop, 1500.0, (1.0, -1.0), level)
    slope = math.asin((loop.pitch_radii[1] - loop.pitch_radii[0]) / 500.0)
    along, across = 1620.0 * math.cos(slope), 1500.0 * math.sin(slope)
    validated(
        "tensions and shaft loads of two sprockets",
        [*forces.tensions, *forces.shaft_loads],
        [60.0, 1560.0, math.hypot(along, across), math.hypot(along, across)],
        1e-12,
        "pull and slack along both tangents",
        "N",
    )


def test_random_loops_balance(validated: Callable[..., None]) -> None:
    """Of every wheel the power, of the whole loop the force and the power, in parts of the pull."""
    worst = np.zeros(3)
    for forces in random_loops(60):
        loop, speed = forces.loop, 1234.5
        omega = speed / (loop.teeth * PITCH / (2.0 * math.pi))
        pull = forces.pulls.max()
        # What the shaft gives less what the joints lose goes into the chain, which leaves slacker.
        into_chain = (forces.arriving - forces.tensions) * speed
        wheel = forces.torques * omega - forces.losses * speed - into_chain
        whole = float((forces.torques * omega).sum() - (forces.losses * speed).sum())
        net = forces.shaft_vectors.sum(axis=0)
        worst = np.maximum(
            worst,
            [np.abs(wheel).max() / (pull * speed), abs(whole) / (pull * speed), np.abs(net).max() / pull],
        )
        assert 0.5 < forces.efficiency <= 1.0
    validated(
        "power of a wheel, of the loop and net force (60 loops)",
        list(worst),
        [0.0] * 3,
        1e-9,
        "balance",
        absolute=True,
    )


def test_losses_joint_by_joint(validated: Callable[..., None]) -> None:
    """A joint that meets a wheel turns by 2 pi/z under what pulls there, and back where it leaves."""
    forces = random_loops(1)[0]
    friction, radius = 0.12, 1.9
    forces = replace(forces, friction_lever=friction * radius)
    work = 0.0
    for wheel, leaving, arriving in zip(
        forces.loop.wheels, forces.tensions, np.roll(forces.tensions, 1), strict=True
    ):
        for tension in (arriving, leaving):
            work += friction * radius * (tension + forces.centrifugal) * 2.0 * math.pi / wheel.teeth
    validated(
        "friction work of a joint in a loop",
        float(forces.losses.sum()) * PITCH,
        work,
        1e-13,
        "sum over its turns",
        "N mm",
    )


@pytest.mark.parametrize("outside", [True, False])
def test_a_tensioner_does_the_work_of_stretching(validated: Callable[..., None], outside: bool) -> None:
    """Virtual work: force times travel is tension times what the loop grows by."""
    at = (250.0, -20.0) if outside else (250.0, -150.0)
    order = ("driver", (0.0, 0.0), 17), ("idler", at, 13), ("driven", (500.0, 0.0), 25)
    wheels = [Wheel(*row, outside=outside and row[0] == "idler") for row in order]
    loop, angle = ChainLoop(PITCH, wheels), 1.9 if outside else -1.2
    direction = math.cos(angle), math.sin(angle)
    forces = loop_forces(loop, 900.0, (1.0, 0.0, -1.0), SpanLevel(75.0, wheel=1, direction=direction))
    lengths = []
    for step in (1e-3, -1e-3):
        moved = replace(wheels[1], centre=(at[0] + step * direction[0], at[1] + step * direction[1]))
        lengths.append(ChainLoop(PITCH, (wheels[0], moved, wheels[2])).circle_length)
    tension = 75.0 / ((lengths[0] - lengths[1]) / 2e-3)
    validated(
        f"span tension of a tensioner {'outside' if outside else 'inside'}",
        list(forces.tensions[:2]),
        [tension, tension],
        1e-6,
        "virtual work, length by differences",
        "N",
    )


def test_a_span_that_holds_all_slack_sags_by_its_length() -> None:
    """Without a take-up the links decide: the parabola's length by quadrature gives the excess back."""
    wheels = Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (403.0, 0.0), 20)
    layout = loop_layout(LoopDrive(ChainLoop(PITCH, wheels), (1.0, -1.0)))
    sag, span = layout.sag(0), 403.0
    x = np.linspace(-0.5, 0.5, 20001) * span
    slope = 8.0 * sag * x / span
    length = float(np.trapezoid(np.sqrt(1.0 + slope**2), x))
    assert length - span == pytest.approx(layout.excess * PITCH, rel=0.02)
    stiff, soft = (layout.level(0.7e-6, None, None, stiffness).force for stiffness in (1e15, 5e4))
    assert stiff == pytest.approx(catenary_tension(0.7e-6, span, sag), rel=1e-9)
    # The chain stretches by 102 T/5e4, which hangs with the rest: sag and T by steps.
    stretched = catenary_tension(0.7e-6, span, sag)
    for _ in range(50):
        more = layout.excess * PITCH + layout.links * stretched / 5e4
        stretched = catenary_tension(0.7e-6, span, math.sqrt(0.375 * more / span))
    assert soft == pytest.approx(stretched, rel=1e-9)


@pytest.mark.parametrize("short", [-1e-9, 1e-9, 0.02, 0.08])
def test_a_chain_that_fits_without_slack_is_stretched(short: float) -> None:
    """Two equal wheels further apart by `short`/2: the stretch of all links less the sag's length."""
    wheels = Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (50 * PITCH + 0.5 * short, 0.0), 20)
    layout = loop_layout(LoopDrive(ChainLoop(PITCH, wheels), (1.0, -1.0)))
    assert layout.links == 120
    tension = layout.level(0.7e-6, None, None, 5e4).force
    sag = 0.7e-6 * 9806.65 * wheels[1].centre[0] / (8.0 * tension)
    hanging = 8.0 / 3.0 * sag**2 * wheels[1].centre[0]
    assert 120 * tension / 5e4 - hanging == pytest.approx(short, abs=1e-6)


def test_what_does_not_fit_is_told_with_what_would() -> None:
    """Equal wheels: X = 2 a/p + 20; 100.2 pitches of spans are 0.2 short of 120 links, 1.8 over for 122."""
    wheels = Wheel("driver", (0.0, 0.0), 20), Wheel("driven", (50.1 * PITCH, 0.0), 20)
    drive = LoopDrive(ChainLoop(PITCH, wheels), (1.0, -1.0))
    with pytest.raises(
        CaseError, match=r"need 120\.2 links; 120 links are 2\.54 mm too short, 0\.17 % of"
    ) as error:
        loop_layout(drive, 120)
    assert str(error.value).endswith(f"or set the centre distance to {50 * PITCH:.3f} mm for 120 links")
    with pytest.raises(
        CaseError, match=r"too short.*; with 122 links the span 'driver' to 'driven' sags by 11\.6 %"
    ):
        loop_layout(drive)
    assert loop_layout(drive, 121).links == 121


def test_a_placed_drive_of_two_is_laid_out_as_by_its_links() -> None:
    """One formula: the centre distance that the take-up finds."""
    expected = layout_with_links(PITCH, 19, 25, 120)
    wheels = Wheel("driver", (0.0, 0.0), 19), Wheel("driven", (expected.centre_distance - 4.0, 0.0), 25)
    take_up = TakeUp("driven", (1.0, 0.0), -10.0, 10.0)
    layout = loop_layout(LoopDrive(ChainLoop(PITCH, wheels), (1.0, -1.0), take_up), 120)
    assert layout.travel == pytest.approx(4.0, abs=1e-9)
    assert layout.wrap_angle == pytest.approx(expected.wrap_angle_1, rel=1e-12)


WILSON = {24: (94.2, 96.2, 97.4, 98.1), 19: (94.1, 96.4, 97.6, 98.4), 13: (92.1, 94.9, 96.9, 97.8)}
"""Efficiency of a bicycle chain at 50, 100, 200 and 400 W on cogs of so many teeth [%]: Wilson, Bicycling
Science, p. 343, second hand; chainring and cadence are missing there."""


def _efficiency(teeth: int, watts: float) -> float:
    """Efficiency of a chain of 12.7 mm on a ring of 44 teeth at 75 rpm [%]: both assumed."""
    wheels = Wheel("ring", (0.0, 0.0), 44), Wheel("cog", (420.0, 0.0), teeth)
    speed = PITCH * 44 * 75.0 / 60.0
    lever = 0.11 * 0.5 * 3.6
    forces = loop_forces(
        ChainLoop(PITCH, wheels), 1e3 * watts / speed, (1.0, -1.0), SpanLevel(20.0, span=0), lever
    )
    return 100.0 * forces.efficiency


def test_losses_have_the_order_and_trend_of_wilson() -> None:
    """Less is lost with more teeth and with more tension; what joints alone lose is 0.8 to 6.4 points less.

    Of 24 and 19 teeth Wilson's rows themselves stand within 0.3 points, in either order.
    """
    found = {teeth: [_efficiency(teeth, watts) for watts in (50, 100, 200, 400)] for teeth in WILSON}
    for teeth, row in found.items():
        assert row == sorted(row), teeth
    for column in range(4):
        assert found[13][column] < found[19][column] < found[24][column]
    missing = np.array([np.subtract(found[teeth], WILSON[teeth]) for teeth in WILSON])
    assert missing.min() > 0.8 and missing.max() < 6.4


def test_what_cannot_run_is_refused() -> None:
    wheels = [Wheel(name, at, 20) for name, at in zip("abc", ((0, 0), (300, 0), (150, 250)), strict=True)]
    loop = ChainLoop(PITCH, tuple(wheels))
    with pytest.raises(CaseError, match="must sum to 1 and those of driven wheels to -1"):
        loop_forces(loop, 100.0, (1.0, -0.5, -0.4), SpanLevel(10.0, span=0))
    with pytest.raises(CaseError, match="every span must be in tension, 'a' to 'b' would have -70 N"):
        loop_forces(loop, 100.0, (1.0, -0.8, -0.2), SpanLevel(10.0, span=1))
    across = loop.directions[1] - loop.directions[0]
    level = SpanLevel(10.0, wheel=1, direction=(float(across[1]), -float(across[0])))
    with pytest.raises(CaseError, match="'b' must tension the chain, but acts across"):
        loop_forces(loop, 100.0, (1.0, -0.8, -0.2), level)
