"""The watch over a run: sawtooth, conformity, vanished contact.

Expected: an alternating depth is an unstable run (odd-even mode), a smooth depth or one with
kinks is not; Hertz needs 1/rho_H > 0.
"""

import re
from dataclasses import replace

import numpy as np
import pytest

from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.errors import ContactError, ConvergenceError
from wearsim.mechanisms.prescribed.contact import PrescribedMechanism
from wearsim.wear.trajectory import check_sawtooth, check_touch

NODES = 101
ARC = np.linspace(0.0, 20.0, NODES)


def contact(curvature: float | np.ndarray = 0.0, load: float | np.ndarray = 100.0) -> FlankContact:
    full = [np.array(np.broadcast_to(value, NODES), dtype=float) for value in (load, curvature)]
    return PrescribedMechanism(
        kind=ContactKind.TRAVELLING,
        arc_length=ARC,
        load_per_width=full[0],
        slip=np.full(NODES, 0.5),
        sliding_speed=np.full(NODES, np.nan),
        flank_curvature=full[1],
        mate_radius=6.0,
        modulus=1e5,
    ).contact


def touch(given: FlankContact, depth: np.ndarray, cycles: float) -> None:
    worn = given.profile.recede(depth)
    check_touch(given, np.array(worn.x), np.array(worn.y), depth, cycles)


def smooth_depth() -> np.ndarray:
    return 0.2 * np.sin(np.pi * ARC / 20.0) ** 2


@pytest.mark.parametrize(
    "depth",
    [
        np.zeros(NODES),
        np.full(NODES, 0.2),
        smooth_depth(),
        0.2 * ARC / 20.0,
        0.2 * np.abs(ARC / 10.0 - 1.0),
        0.2 * np.minimum(1.0, np.minimum(ARC, 20.0 - ARC)),
        0.2 * np.exp(-(((ARC - 7.0) / 0.8) ** 2)),
    ],
    ids=["none", "uniform", "smooth", "ramp", "kink", "trapezium", "bump"],
)
def test_smooth_and_kinked_depths_pass(depth: np.ndarray) -> None:
    check_sawtooth(contact(), depth, 10.0, 0.2)


@pytest.mark.parametrize("amplitude", [1e-2, 1e-3, 1e-4])
def test_alternating_depth_is_caught(amplitude: float) -> None:
    depth = smooth_depth() + amplitude * (-1.0) ** np.arange(NODES)
    with pytest.raises(ConvergenceError, match=r"cycle 1234, .* mm from the root"):
        check_sawtooth(contact(), depth, 1234.0, 0.2)


def test_alternation_over_a_stretch_is_caught_where_it_is() -> None:
    depth = smooth_depth()
    depth[60:75] += 5e-3 * (-1.0) ** np.arange(15)
    with pytest.raises(ConvergenceError) as found:
        check_sawtooth(contact(), depth, 1.0, 0.2)
    place = re.search(r"([0-9.]+) mm from the root", str(found.value))
    assert place is not None
    assert 11.0 <= float(place[1]) <= 15.0


def test_rounding_of_a_flat_depth_is_no_sawtooth() -> None:
    check_sawtooth(contact(), 0.2 + 1e-12 * (-1.0) ** np.arange(NODES), 1.0, 0.2)


def test_conforming_flank_names_cycle_and_place() -> None:
    """A concave flank of the roller's own radius from 12 mm on."""
    curvature = np.where(ARC >= 12.0 - 1e-9, -1.0 / 6.0, -0.1)
    with pytest.raises(ContactError, match=r"cycle 77, 12 mm from the root.*conforms"):
        touch(contact(curvature), np.zeros(NODES), 77.0)


def test_conforming_points_without_load_do_not_matter() -> None:
    curvature = np.where(ARC > 12.0, -0.2, -0.1)
    touch(contact(curvature, load=np.where(ARC > 12.0, 0.0, 100.0)), np.zeros(NODES), 1.0)


def test_pit_that_conforms_is_found() -> None:
    """w'' = -0.1/mm in a pit of 0.05 (1 - x^2) mm on a flank that leaves 1/6 - 0.08 1/mm."""
    depth = np.maximum(0.0, 0.05 * (1.0 - (ARC - 10.0) ** 2))
    with pytest.raises(ContactError, match="conforms"):
        touch(contact(-0.08), depth, 5.0)
    touch(contact(-0.05), depth, 5.0)


def test_vanished_contact_is_an_error() -> None:
    with pytest.raises(ContactError, match=r"cycle 3, deepest 0 mm from the root: the roller must touch"):
        touch(contact(load=0.0), np.zeros(NODES), 3.0)
    gears = replace(contact(load=0.0), mate="mating flank")
    with pytest.raises(ContactError, match="the mating flank must touch the loaded stretch"):
        touch(gears, np.zeros(NODES), 3.0)
