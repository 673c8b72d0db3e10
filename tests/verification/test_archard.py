"""Benchmarks B2 and B8: exact consequences of Archard's law.

B2: block on flat, F = 100 N, A = 100 mm2, k = 1e-7 mm2/N, s = 1e6 mm: V = 10 mm3, h = 0.1 mm.
B8: (i) h = k q |v_s|/v_t, B7 point A: 7.930e-8 mm; (ii) worn area = k q s for any pressure
distribution; (iii) L(c k) = L(k)/c; (v) zero slip, zero wear; (vi) constant sigma s on a
circle leaves a circle of radius R - N w. (B8 iv, units, stands in test_units_of_input.py.)
"""

from collections.abc import Callable

import numpy as np
import pytest

import wearsim
from wearsim.contact.engagement import ContactKind
from wearsim.kernels.hertz_wear import wear_depth
from wearsim.mechanisms.strand.contact import StrandMechanism
from wearsim.wear.law import archard

CaseMaker = Callable[..., wearsim.Case]

MODULUS = 2.1e5 / (2.0 * 0.91)
ARC = np.linspace(0.0, 10.0, 101)


def archard_law(rate: float) -> dict[str, object]:
    return {"law": "archard", "specific_wear_rate_mm2_per_N": rate}


def depth_per_cycle(load: np.ndarray, slip: np.ndarray, relative: np.ndarray, rate: float) -> np.ndarray:
    """Depth of one passage of a travelling contact, from the engine's kernel."""
    speed, depth = np.zeros(load.size), np.empty(load.size)
    wear_depth(load, slip, speed, relative, MODULUS, archard(rate).numbers(ContactKind.TRAVELLING), depth)
    return depth


def last_depths(result: wearsim.WearResult) -> np.ndarray:
    nodes = int(result.flank_columns["node"].max())
    return result.flank_columns["depth_mm"][-nodes:]


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_b2_block_on_flat(validated: Callable[..., None], prescribed: CaseMaker, method: str) -> None:
    """A flat of 10 x 10 mm under 1 MPa everywhere, slid over 100 mm a cycle."""
    roller_radius = 5.0
    case = prescribed(
        {
            "arc_length_mm": ARC,
            "load_per_width_N_per_mm": np.pi * roller_radius / MODULUS,
            "flank_curvature_per_mm": 0.0,
            "sliding_distance_mm": 100.0,
        },
        archard_law(1e-7),
        0.1,
        roller_radius,
        [f"run.method={method}"],
    )
    result = wearsim.simulate(case)
    validated(
        "sliding of a block on a flat until 0.1 mm is worn off",
        *(100.0 * result.cycles, 1e6, 1e-9, "h = k F s/A by hand", "mm"),
        page=method == "advance",
    )
    assert 10.0 * result.history_columns["removed_area_mm2"][-1] == pytest.approx(10.0, rel=1e-9)


def test_b8i_depth_is_k_q_lambda(validated: Callable[..., None]) -> None:
    """FZG C14 pinion at point A: k 1e-10, q 211.146 N/mm, |1 - v2/v1| 3.7556: 7.930e-8 mm."""
    depth = depth_per_cycle(np.array([211.146]), np.array([3.7556]), np.array([0.17]), 1e-10)
    source = "h = k q lambda by hand, FZG C14 at A"
    validated("depth of one passage", depth[0], 7.930e-8, 5e-5, source, "mm")


def test_m1_intensity_on_the_strand_is_k_q_slip_ratio(
    reference_mechanism: Callable[..., StrandMechanism],
) -> None:
    mechanism = reference_mechanism(nodes=201)
    profile = mechanism.profile
    touch = mechanism.contact.engage(np.array(profile.x), np.array(profile.y), np.zeros(201))
    depth = depth_per_cycle(touch.load_per_width, touch.slip, touch.relative_curvature, 1e-8)
    np.testing.assert_allclose(depth, 1e-8 * touch.load_per_width * touch.slip, rtol=1e-12)


@pytest.mark.parametrize("curvature", [0.0, 0.05, 0.05 * np.cos(ARC)])
def test_b8ii_worn_area_is_k_q_s(
    validated: Callable[..., None], prescribed: CaseMaker, curvature: object
) -> None:
    """One passage slides over the integral of the slip ratio along the flank."""
    slip = 0.5 + 0.3 * np.sin(ARC)
    case = prescribed(
        {
            "arc_length_mm": ARC,
            "load_per_width_N_per_mm": 100.0,
            "flank_curvature_per_mm": curvature,
            "slip_ratio": slip,
        },
        archard_law(1e-9),
        1e-3,
        6.035,
    )
    result = wearsim.simulate(case)
    area = np.trapezoid(last_depths(result), ARC)
    sliding = result.cycles * np.trapezoid(slip, ARC)
    validated(
        "worn area on a flank whose curvature changes sign",
        *(area, 1e-9 * 100.0 * sliding, 1e-9, "k q s, independent of the pressure", "mm2"),
        page=np.min(curvature) < 0.0,
    )


@pytest.mark.parametrize(("exponent", "factor"), [(1, 3.0), (1.5, 0.01), (2, 7.0)])
def test_b8iii_life_times_coefficient_is_constant(
    reference: CaseMaker, exponent: float, factor: float
) -> None:
    key = {1: "wear.specific_wear_rate_mm2_per_N", 1.5: "wear.coefficient", 2: "wear.coefficient"}
    rate = {1: 1e-8, 1.5: 3e-10, 2: 1e-11}[exponent]
    life = wearsim.simulate(reference(exponent, "run.horizon_hours=1e6")).cycles
    scaled = wearsim.simulate(
        reference(exponent, f"{key[exponent]}={rate * factor!r}", "run.horizon_hours=1e6")
    ).cycles
    assert scaled * factor == pytest.approx(life, rel=1e-12)


def test_b8iii_per_cycle(reference: CaseMaker) -> None:
    """A quarter of k in updates of four cycles is the same sequence of flanks."""
    life = wearsim.simulate(reference(1, "run.method=per_cycle")).cycles
    quarter = wearsim.simulate(
        reference(
            1, "run.method=per_cycle", "run.cycles_per_update=4", "wear.specific_wear_rate_mm2_per_N=2.5e-9"
        )
    ).cycles
    assert quarter == pytest.approx(4.0 * life, rel=1e-9)


def test_b8v_zero_slip_zero_wear(prescribed: CaseMaker) -> None:
    """At a pitch point in the middle of the flank nothing is worn off, beside it something is."""
    slip = np.abs(np.linspace(-1.0, 1.0, 101))
    slip[45:56] = 0.0
    case = prescribed(
        {
            "arc_length_mm": ARC,
            "load_per_width_N_per_mm": 100.0,
            "flank_curvature_per_mm": 0.0,
            "slip_ratio": slip,
        },
        archard_law(1e-9),
        1e-3,
        6.035,
    )
    depth = last_depths(wearsim.simulate(case))
    assert (depth[slip == 0.0] == 0.0).all()
    assert (depth[slip > 0.0] > 0.0).all()


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
@pytest.mark.parametrize("radius", [39.1, -20.0])
def test_b8vi_a_circle_stays_a_circle(prescribed: CaseMaker, radius: float, method: str) -> None:
    """Convex circles shrink, concave ones grow by the depth; the centre does not move."""
    case = prescribed(
        {
            "arc_length_mm": ARC,
            "load_per_width_N_per_mm": 100.0,
            "flank_curvature_per_mm": 1.0 / radius,
            "sliding_distance_mm": 0.3,
        },
        archard_law(1e-7),
        0.5,
        6.035,
        [f"run.method={method}", "run.life_tolerance=1e-6"],
    )
    result = wearsim.simulate(case)
    columns = result.flank_columns
    # The flank starts at (0, 0) along -x with its normal towards +y.
    distance = np.hypot(columns["x_mm"], columns["y_mm"] + radius)
    expected = np.abs(radius - columns["depth_mm"])
    np.testing.assert_allclose(distance, expected, rtol=0.0, atol=1e-8)
    relative = 1.0 / 6.035 + 1.0 / radius
    step = 1e-7 * np.sqrt(100.0 * relative * MODULUS / np.pi) * 0.3
    np.testing.assert_allclose(columns["depth_mm"], columns["cycles"] * step, rtol=1e-8)
