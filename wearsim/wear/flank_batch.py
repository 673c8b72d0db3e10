"""Lives of many flanks at once: the production run of ``advance`` in compiled batches."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from wearsim.contact.engagement import FlankContact
from wearsim.geometry.profile_points import Vector
from wearsim.kernels.advance_batch import CHANGE, STATUS, TIME_RUN, WIDEST, wear_flanks
from wearsim.kernels.controlled_steps import CLOCK, STATE_ROWS
from wearsim.kernels.hertz_wear import DEPTH_REACHED, RUNNING
from wearsim.kernels.rosenbrock import STAGES, WORK_ROWS, rosenbrock_step
from wearsim.wear.advance import MAX_STEPS
from wearsim.wear.law import WearLaw
from wearsim.wear.trajectory import overturned


@dataclass(frozen=True, eq=False)
class BatchFlank:
    """A flank to wear down to a depth."""

    contact: FlankContact  # the flank and its contact
    law: WearLaw  # the wear law; its coefficient is left out
    critical_depth: float  # depth at which the life ends [mm]
    horizon: float  # cycles times coefficient at which the run ends in any case
    life_tolerance: float  # relative tolerance of the life


@dataclass(frozen=True, eq=False)
class BatchResult:
    """What came of a flank."""

    # time, horizon: cycles times coefficient of the run, and at which it would have ended in any case
    time: float
    horizon: float
    reached: bool  # whether it ended at the critical depth, not at the horizon
    change: float  # relative difference of its last two runs
    half_width: float  # greatest half-width of the contact [mm], new or worn
    # x, y, depth: the flank in the end [mm]
    x: Vector
    y: Vector
    depth: Vector


def advance_batch(flanks: Sequence[BatchFlank]) -> list[BatchResult | None]:
    """Wear flanks under one kind of contact, in one compiled call that holds no lock."""
    contacts = [flank.contact for flank in flanks]
    one, points = contacts[0], contacts[0].profile.x.size
    starts = np.zeros((len(flanks), 3, points))
    for start, contact in zip(starts, contacts, strict=True):
        start[0], start[1] = contact.profile.x, contact.profile.y
    numbers = [
        (
            flank.critical_depth,
            flank.horizon,
            flank.life_tolerance,
            flank.contact.modulus,
            flank.law.diffusion(flank.contact.kind, flank.contact.slip_curvature_exponent),
        )
        for flank in flanks
    ]
    worn, found = np.empty((len(flanks), 4, points)), np.empty((len(flanks), 4))
    wear_flanks(
        rosenbrock_step,
        one.kernel,
        starts,
        np.array([contact.constants for contact in contacts]),
        np.array([contact.columns for contact in contacts]),
        np.array(numbers),
        np.array([flank.law.unit_numbers(flank.contact.kind) for flank in flanks]),
        int(not one.offset_form),
        MAX_STEPS,
        np.zeros((WORK_ROWS, points)),
        np.zeros((STAGES, 3 * points)),
        np.zeros(CLOCK),
        np.empty(2),
        np.empty((2, STATE_ROWS, points)),
        worn,
        found,
    )
    simple = shapely.is_simple(shapely.linestrings(worn[:, :2].transpose(0, 2, 1)))
    simple &= [
        not overturned(*np.stack([start[:2], end[:2]], axis=1)).any()
        for start, end in zip(starts, worn, strict=True)
    ]
    return [
        BatchResult(
            time=float(row[TIME_RUN]),
            horizon=given.horizon,
            reached=row[STATUS] == DEPTH_REACHED,
            change=float(row[CHANGE]),
            half_width=math.sqrt(4.0 * row[WIDEST] / (math.pi * contact.modulus)),
            x=flank[0],
            y=flank[1],
            depth=flank[2],
        )
        if row[STATUS] != RUNNING and uncrossed
        else None
        for row, flank, contact, given, uncrossed in zip(found, worn, contacts, flanks, simple, strict=True)
    ]
