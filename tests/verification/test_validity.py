"""What a result says of itself: warnings, bounds, limits; nothing wrong passes silently.

Expected: Hertz's limits 1/rho_H > 0 and half-width 0.1 r, the ratio of lives 1/k, a horizon.
"""

import json
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

import wearsim
from tests.drives import depth_limit
from wearsim.contact.engagement import ContactKind, FlankContact
from wearsim.geometry.profile_points import Profile
from wearsim.jit.compiled import kernel
from wearsim.jit.signatures import CONTACT
from wearsim.kernels.prescribed import prescribed_contact
from wearsim.wear.advance import run_advance
from wearsim.wear.law import archard
from wearsim.wear.problem import WearProblem
from wearsim.wear.trajectory import Trajectory, check_fold

CaseMaker = Callable[..., wearsim.Case]

ARC = np.linspace(0.0, 4.0, 201)
ARCHARD = {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-9}


def columns(**changes: object) -> dict[str, object]:
    return {
        "arc_length_mm": ARC,
        "load_per_width_N_per_mm": 50.0,
        "flank_curvature_per_mm": 0.0,
        "slip_ratio": 0.5,
    } | changes


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_conforming_flank_is_an_error_with_cycle_and_place(prescribed: CaseMaker, method: str) -> None:
    case = prescribed(
        columns(flank_curvature_per_mm=-1.0 / 5.0), ARCHARD, 0.01, 5.0, [f"run.method={method}"]
    )
    with pytest.raises(wearsim.ContactError, match=r"cycle 0, 0 mm from the root.*1/rho_H > 0"):
        wearsim.simulate(case)


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_flank_that_wears_until_it_conforms_gives_no_life(prescribed: CaseMaker, method: str) -> None:
    """At m = 1 a given slip ratio digs w = k q lambda N whatever the curvature.

    1/rho_H = 1/5 - 0.19 + w'' reaches 0 at a depth of 0.0122 mm, before the limit of 0.05 mm.
    """
    changes = {"flank_curvature_per_mm": -0.19, "slip_ratio": 0.5 * (1.0 + 0.5 * np.cos(0.5 * math.pi * ARC))}
    case = prescribed(columns(**changes), ARCHARD, 0.05, 5.0, [f"run.method={method}"])
    with pytest.raises(wearsim.ContactError, match="conforms"):
        wearsim.simulate(case)


def test_wide_contact_is_warned_of_once(prescribed: CaseMaker) -> None:
    """a = sqrt(4 q rho/(pi E*)) passes 0.1 r = 0.5 mm at q = 2500 N/mm on a curvature 0.1/mm."""
    modulus = 2.1e5 / 1.82
    for load, warned in ((2100.0, False), (2500.0, True)):
        half_width = math.sqrt(4.0 * load * 10.0 / (math.pi * modulus))
        assert (half_width > 0.5) == warned
        case = prescribed(
            columns(load_per_width_N_per_mm=load, flank_curvature_per_mm=-0.1), ARCHARD, 0.01, 5.0
        )
        found = wearsim.simulate(case).warnings
        assert sum("0.1 of the radius of roller or mate" in text for text in found) == int(warned)


def test_coarse_grid_is_warned_of(reference: CaseMaker) -> None:
    case = reference(2, "sprocket.nodes=21", "run.life_tolerance=1e-5")
    result = wearsim.simulate(case)
    assert result.numerical_error > 1e-5
    assert any("exceeds the tolerance" in text for text in result.warnings)
    assert any("wider than the contact's half-width" in text for text in result.warnings)


@pytest.mark.parametrize("nodes", [51, 101, 201])
def test_stated_error_covers_the_true_one(reference: CaseMaker, nodes: int) -> None:
    """Against 801 nodes: within the stated error and the asked tolerance."""
    fine = wearsim.simulate(reference(1, "sprocket.nodes=801")).cycles
    result = wearsim.simulate(reference(1, f"sprocket.nodes={nodes}"))
    assert abs(result.cycles / fine - 1.0) <= result.numerical_error + result.life_tolerance


def test_pressure_exponent_below_one_with_a_slip_ratio_is_refused(prescribed: CaseMaker) -> None:
    wear = {"law": "power", "coefficient": 1e-9, "pressure_exponent": 0.9}
    with pytest.raises(wearsim.CaseError, match=r"wear.pressure_exponent.*ill-posed"):
        prescribed(columns(), wear, 0.01, 5.0)
    local = columns(sliding_distance_mm=0.5)
    del local["slip_ratio"]
    wearsim.simulate(prescribed(local, wear, 0.01, 5.0))


def test_zero_load_or_slip_everywhere_gives_no_life(prescribed: CaseMaker) -> None:
    for changes in ({"load_per_width_N_per_mm": 0.0}, {"slip_ratio": 0.0}):
        with pytest.raises(wearsim.ContactError, match="cycle 0"):
            wearsim.simulate(prescribed(columns(**changes), ARCHARD, 0.01, 5.0))


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_limit_out_of_reach_is_a_lower_bound(reference: CaseMaker, method: str) -> None:
    """5 h at 100 rpm are 30 000 of 81 389 cycles; three times the coefficient takes 27 130."""
    result = wearsim.simulate(
        reference(1, f"run.method={method}", "run.horizon_hours=5", "wear.band_factor=3.0")
    )
    assert isinstance(result.life, wearsim.LowerBound)
    assert result.stop == "horizon_hours"
    for value in ("hours", "cycles"):
        with pytest.raises(wearsim.WearsimError, match=r"no limit was met within 5 h \(30000 cy"):
            getattr(result.life, value)
    with pytest.raises(ValueError, match="30000"):
        _ = result.cycles
    assert result.hours_run == pytest.approx(5.0, rel=1e-9)
    assert isinstance(result.life_low, wearsim.Life)
    assert result.life_low.cycles == pytest.approx(8.1389e4 / 3.0, rel=5e-4)
    assert isinstance(result.life_high, wearsim.LowerBound)
    summary = result.summary()
    assert summary["life_hours"] is None
    assert summary["cycles"] is None
    assert summary["life_reached"] is False
    assert summary["life_hours_high"] is None


def test_band_of_a_reached_life_is_k_scaling(reference: CaseMaker) -> None:
    result = wearsim.simulate(reference(1.5, "wear.band_factor=4.0"))
    assert result.life_low.hours == pytest.approx(result.life.hours / 4.0, rel=1e-12)
    assert result.life_high.hours == pytest.approx(result.life.hours * 4.0, rel=1e-12)


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_tip_land_can_end_the_life_and_is_named(reference: CaseMaker, method: str) -> None:
    limit = 9.1
    case = reference(1, f"run.method={method}", f"stop.min_tip_land_mm={limit}", "stop.critical_depth_mm=0.5")
    result = wearsim.simulate(case)
    assert result.stop == "min_tip_land_mm"
    assert result.stop_value == limit
    assert result.max_depth < 0.5
    flank = result.flank_columns
    worn = case.drive.tooth.worn_tip_land(flank["x_mm"][-201:], flank["y_mm"][-201:])
    assert worn == pytest.approx(limit, abs=1e-9)


def test_tip_land_that_holds_does_not_end_the_life(reference: CaseMaker) -> None:
    result = wearsim.simulate(reference(1, "stop.min_tip_land_mm=5.0"))
    assert result.stop == "critical_depth_mm"
    assert result.cycles == pytest.approx(8.1389e4, rel=5e-4)


def test_tip_land_of_the_new_tooth_bounds_the_limit(reference: CaseMaker) -> None:
    with pytest.raises(wearsim.CaseError, match=r"stop.min_tip_land_mm: must be below"):
        reference(1, "stop.min_tip_land_mm=9.2")


@pytest.mark.wide
@pytest.mark.parametrize(("method", "exponent"), [("advance", 1), ("advance", 2), ("per_cycle", 2)])
def test_no_number_of_a_result_is_nan(reference: CaseMaker, exponent: float, method: str) -> None:
    result = wearsim.simulate(reference(exponent, f"run.method={method}", "stop.critical_depth_mm=0.75"))
    for table in (result.history_columns, result.flank_columns):
        for name, values in table.items():
            # Where no roller touches the flank it has no sliding speed.
            known = (
                table["load_per_width_N_per_mm"] > 0.0 if name == "sliding_speed_mm_per_s" else slice(None)
            )
            assert np.isfinite(values[known]).all(), name
    json.dumps(result.summary(), allow_nan=False)


def test_only_what_a_table_does_not_give_is_nan(prescribed: CaseMaker) -> None:
    """No contact ratio and, without its column, no sliding speed."""
    result = wearsim.simulate(prescribed(columns(), ARCHARD, 0.01, 5.0))
    unknown = {
        name
        for table in (result.history_columns, result.flank_columns)
        for name, values in table.items()
        if not np.isfinite(values).all()
    }
    assert unknown == {"worn_contact_ratio", "sliding_speed_mm_per_s", "max_sliding_speed_mm_per_s"}
    json.dumps(result.summary(), allow_nan=False)


FLAT = Profile(np.zeros(9), np.linspace(0.0, 8.0, 9))


def flat_contact(kernel: Callable[..., None]) -> FlankContact:
    """A flat flank of 8 mm under a contact of the test's own."""
    return FlankContact(
        kind=ContactKind.LOCAL,
        kernel=kernel,
        constants=np.zeros(1),
        columns=np.zeros((1, 1)),
        profile=FLAT,
        arc_length=FLAT.arc_length,
        mate_radius=5.0,
        modulus=1e5,
        slip_curvature_exponent=0.0,
        offset_form=False,
    )


def test_stall_has_cycle_and_place() -> None:
    """Sliding at 3 mm from the root stops being a number once 1 um is worn off."""

    @kernel(CONTACT)
    def stalling(x, y, nx, ny, curvature, depth, constants, columns, load, slip, speed, relative):
        load[:], slip[:], speed[:], relative[:] = 100.0, 1.0, 1.0, 0.2
        if depth.max() > 1e-3:
            slip[3] = np.nan

    with pytest.raises(wearsim.ConvergenceError, match=r"cycle [\d.e+]+, 3 mm from the root.*go on"):
        run_advance(WearProblem(flat_contact(stalling), archard(1e-9), (depth_limit(0.1),), 1e9), 1e-3)


@pytest.mark.slow
def test_vanished_contact_has_cycle_and_place() -> None:
    """The load is gone once 1 um is worn off, deepest 5 mm from the root."""

    @kernel(CONTACT)
    def vanishing(x, y, nx, ny, curvature, depth, constants, columns, load, slip, speed, relative):
        load[:], slip[:], speed[:], relative[:] = 100.0, 1.0, 1.0, 0.2
        slip[:] = 2.0 - 0.01 * (np.arange(9) - 5.0) ** 2
        if depth.max() > 1e-3:
            load[:] = 0.0

    with pytest.raises(wearsim.ContactError, match=r"cycle [\d.e+]+, deepest 5 mm from.*touches no"):
        run_advance(WearProblem(flat_contact(vanishing), archard(1e-9), (depth_limit(0.1),), 1e9), 1e-3)


def test_flank_turned_over_has_cycle_and_place() -> None:
    """Two points have changed places along a flat flank in the second snapshot."""
    x, y = np.tile(FLAT.x, (3, 1)), np.tile(FLAT.y, (3, 1))
    for i in (1, 2):
        x[i, 3:5], y[i, 3:5] = x[0, 4:2:-1], y[0, 4:2:-1]
    run = Trajectory(np.array([0.0, 7.0, 9.0]), x, y, 0.0 * x, None, 3)
    with pytest.raises(
        wearsim.ConvergenceError, match=r"cycle 7, [\d.]+ mm from the root.*centre of curvature"
    ):
        check_fold(flat_contact(prescribed_contact), run)


def test_fold_has_cycle_and_place() -> None:
    """A fin worn through from both sides in the second snapshot: its walls change places."""
    wall, top = np.array([0.0, 0.0, 0.0]), np.array([0.25, 0.5, 0.75])
    x = np.tile(np.concatenate([wall, top, wall + 1.0]), (3, 1))
    y = np.tile([0.0, 1.0, 2.0, 2.1, 2.2, 2.1, 2.0, 1.0, 0.0], (3, 1))
    for i in (1, 2):
        x[i, 0:2], x[i, 7:9] = 0.7, 0.3
    run = Trajectory(np.array([0.0, 7.0, 9.0]), x, y, 0.0 * x, None, 3)
    contact = flat_contact(prescribed_contact)
    with pytest.raises(wearsim.ConvergenceError, match=r"cycle 7, [\d.]+ mm from the root.*cross itself"):
        check_fold(contact, run)
    check_fold(contact, replace(run, x=x[:1], y=y[:1], cycles=run.cycles[:1]))
