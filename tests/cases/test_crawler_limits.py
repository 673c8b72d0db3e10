"""A crawler's flank near the limits of its tooth: no bump for a seat, no load that pulls."""

import numpy as np
import pytest

import wearsim
from wearsim.errors import WearsimError
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.geometry.tooth import RELIEF_PER_PITCH, Tooth

PITCH, RADIUS, TEETH = 203.2, 33.0, 27
CENTRODE = PITCH * TEETH / (4.0 * np.pi)
CRAWLER = {
    "format_version": 1,
    "chain": {"pitch_mm": PITCH, "roller_diameter_mm": 66.0, "inner_width_mm": 90.0},
    "sprocket": {
        "teeth": TEETH,
        "engaged_every": 2,
        "profile": "evolute",
        "face_width_mm": 75.0,
        "contact_end_mm": 2.0,
        "contact_start_mm": 209.0,
        "evolute_offset_mm": 41.7,
    },
    "load": {"tension_N": 90000, "speed_rpm": 17.5},
    "wear": {"condition": "soil-contaminated"},
    "stop": {"critical_depth_mm": 3.0},
}


@pytest.mark.parametrize(
    ("end", "start", "offset"), [(6.0, 211.3, 42.6), (7.0, 211.5, 42.6), (8.0, 212.2, 42.9)]
)
def test_the_seat_stays_in_its_gap(end, start, offset):
    """The seat joins the roots of two flanks of one gap, so it stays a roller's breadth around."""
    strand = Strand(CENTRODE, RADIUS, offset)
    flank = evolute_flank(strand, end, start, 201).profile
    seat = Tooth(strand, flank, TEETH, RELIEF_PER_PITCH * PITCH).seat
    height = CENTRODE - offset - RADIUS
    assert np.all(np.hypot(seat[:, 0], seat[:, 1] - height) < RADIUS)


def test_a_roller_pushes_at_every_point_or_the_run_says_where_it_does_not():
    """Load per width is a push: a root that turns past the strand must not give a result."""
    try:
        run = wearsim.simulate(wearsim.load_case(CRAWLER))
    except WearsimError:
        return
    assert run.flank_columns["load_per_width_N_per_mm"].min() >= 0.0
    assert np.all(np.isfinite(run.flank_columns["pressure_MPa"]))


@pytest.mark.parametrize(("teeth", "every", "turns"), [(27, 2, 2), (28, 2, 1), (30, 4, 2), (27, 3, 1)])
def test_turns_between_two_loadings_of_a_gap(teeth: int, every: int, turns: int) -> None:
    """Counted by rolling: roller m meets gap (m every) mod teeth, teeth/every rollers a turn."""
    met = [m for m in range(1, teeth * every + 1) if m * every % teeth == 0]
    assert met[0] * every / teeth == turns
    chain = {"pitch_mm": PITCH, "roller_diameter_mm": 20.0, "inner_width_mm": 90.0}
    chain |= {"pin_diameter_mm": 10.0, "bearing_area_mm2": 900.0, "mass_kg_per_m": 30.0}
    sprocket = {"teeth": teeth, "engaged_every": every, "profile": "iso606"}
    case = wearsim.load_case({**CRAWLER, "chain": chain, "sprocket": sprocket})
    assert case.turns_per_cycle == turns
    assert case.cycles_per_hour == pytest.approx(60.0 * case.speed_rpm / turns)
