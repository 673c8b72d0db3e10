"""Coefficients that change as a drive wears: running-in and the hardened layer; further limits.

Expected: the integral of K(N) by quadrature; piecewise linear depth of a flat flank under uniform
load; a layer of no depth is no layer; thickness by the intersection of circle and worn flank.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from scipy.integrate import quad

import wearsim
from tests.drives import LIGHT_WRAP, changed
from wearsim.errors import CaseError, ContactError
from wearsim.lubrication.clock import LubricantClock
from wearsim.lubrication.law import LubricantLaw
from wearsim.lubrication.schedule import LubricantSchedule
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.report.answer import answer
from wearsim.result import WearResult
from wearsim.wear.mate_clock import STEADY, LubricatedClock, MateClock
from wearsim.wear.running_in import NO_RUNNING_IN, RunningIn

STRAND = Path(__file__).parents[2] / "cases" / "16b-20t-oiled.toml"
FEW = ["sprocket.nodes=61", "stop.critical_depth_mm=0.05"]
WRAP = changed(
    LIGHT_WRAP,
    {
        "sprocket.nodes": 101,
        "joint": {"specific_wear_rate_mm2_per_N": 1e-9, "pitch": "uniform"},
        "wear.specific_wear_rate_mm2_per_N": 1e-9,
        "stop.critical_depth_mm": 0.02,
    },
)


STRETCHING = (
    "joint.specific_wear_rate_mm2_per_N=3e-8",
    "stop.elongation_percent=7",
    "stop.critical_depth_mm=0.2",
)


def strand(*settings: str) -> WearResult:
    return wearsim.simulate(wearsim.load_case(STRAND, [*FEW, *settings]))


def wrap(*settings: str) -> WearResult:
    return wearsim.simulate(wearsim.load_case(WRAP, settings))


@pytest.mark.parametrize(("factor", "cycles"), [(1.0, 5.0), (3.0, 100.0), (20.0, 1e6)])
@pytest.mark.parametrize("run", [0.0, 1.0, 50.0, 1e3, 1e7])
def test_running_in_is_the_integral_of_its_coefficient(factor: float, cycles: float, run: float) -> None:
    warp = RunningIn(factor, cycles)
    excess, _ = quad(lambda n: math.exp(-n / cycles), 0.0, min(run, 40 * cycles), limit=200)
    worn = warp.steady_cycles(run)
    assert worn == pytest.approx(run + (factor - 1.0) * excess, rel=1e-9, abs=1e-12)
    assert warp.running_cycles(np.array([worn]))[0] == pytest.approx(run, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("factor", [1.0, 1.2, 3.0, 10.0, 30.0])
def test_amplification_is_the_greatest_change_of_the_cycles_run(factor: float) -> None:
    """Over that of the constant cycles: from differences of both."""
    warp = RunningIn(factor, 100.0)
    constant = np.geomspace(0.1, 1e8, 20001)
    moved = np.diff(np.log(warp.running_cycles(constant))) / np.diff(np.log(constant))
    assert warp.amplification == pytest.approx(moved.max(), rel=1e-3)


def test_running_in_does_not_follow_the_density_of_the_rows(tmp_path: Path) -> None:
    """The mean path is that over the arc length: 0.75 of a path that grows from 0.5 to 1."""
    lives = []
    for power in (1.0, 3.0):
        arc = 10.0 * np.linspace(0.0, 1.0, 81) ** power
        rows = [f"{s!r},100,0,{0.5 + 0.05 * s!r}" for s in arc.tolist()]
        head = "arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,sliding_distance_mm"
        (tmp_path / "rows.csv").write_text("\n".join([head, *rows]), encoding="utf-8")
        tables = {
            "format_version": 1,
            "chain": {"designation": "16B-1"},
            "mechanism": {"kind": "prescribed", "table_file": str(tmp_path / "rows.csv")},
            "load": {"speed_rpm": 100},
            "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
            "stop": {"critical_depth_mm": 0.05},
            "run": {"life_tolerance": 1e-4},
        }
        plain = wearsim.simulate(wearsim.load_case(tables))
        way = 0.75 * plain.cycles
        settings = ("wear.running_in_factor=3", f"wear.running_in_distance_mm={way!r}")
        run = wearsim.simulate(wearsim.load_case(tables, settings))
        warp = RunningIn(3.0, plain.cycles)
        assert run.cycles == pytest.approx(warp.running_cycles(np.array([plain.cycles]))[0], rel=1e-3)
        lives.append(run.cycles)
    assert lives[1] == pytest.approx(lives[0], rel=2e-3)


def test_no_running_in_changes_no_digit() -> None:
    cycles = np.array([0.1, 3.7, 1e9 / 3.0])
    np.testing.assert_array_equal(NO_RUNNING_IN.running_cycles(cycles), cycles)
    assert NO_RUNNING_IN.steady_cycles(0.1) == 0.1


@pytest.mark.wide
@pytest.mark.parametrize("life", [strand, wrap])
def test_running_in_shortens_a_life_by_what_it_wore_too_much(life: Any) -> None:
    """Over a distance far below that of the life the cost is (f - 1) N_r cycles.

    The tolerances are those that make all three the same run over cycles of constant coefficient.
    """

    def runs_in(factor: float) -> WearResult:
        tolerance = 1e-2 * RunningIn(factor, 1.0).amplification
        return life(
            f"wear.running_in_factor={factor}",
            "wear.running_in_distance_mm=10",
            f"run.life_tolerance={tolerance!r}",
        )

    plain, short, twice = life("run.life_tolerance=1e-2"), runs_in(4.0), runs_in(7.0)
    lost = plain.cycles - short.cycles if hasattr(plain.life, "hours") else 0.0
    assert lost > 0.0
    # The chain runs in by a way of its own, and its length moves the places of the rollers a little.
    assert plain.cycles - twice.cycles == pytest.approx(2.0 * lost, rel=1e-5)
    assert short.max_depth == pytest.approx(plain.max_depth, rel=1e-9)
    history, other = plain.history_columns, short.history_columns
    assert other["max_depth_mm"][-1] == pytest.approx(history["max_depth_mm"][-1], rel=1e-9)
    assert other["cycles"][-1] < history["cycles"][-1]


def test_running_in_over_the_whole_life_only_multiplies() -> None:
    plain = strand()
    fast = strand("wear.running_in_factor=4", "wear.running_in_distance_mm=1e15")
    assert fast.cycles == pytest.approx(plain.cycles / 4.0, rel=1e-6)


def flat(folder: Path, *settings: str) -> WearResult:
    """A flat flank under uniform load and path: it stays flat."""
    rows = ["arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,sliding_distance_mm"]
    rows += [f"{0.5 * i},100,0,0.5" for i in range(21)]
    (folder / "flat.csv").write_text("\n".join(rows), encoding="utf-8")
    tables = {
        "format_version": 1,
        "chain": {"designation": "16B-1"},
        "mechanism": {"kind": "prescribed", "table_file": str(folder / "flat.csv")},
        "load": {"speed_rpm": 100},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-8},
        "stop": {"critical_depth_mm": 0.02},
    }
    return wearsim.simulate(wearsim.load_case(tables, settings))


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
def test_hardened_layer_of_a_flat_flank(tmp_path: Path, method: str) -> None:
    plain = flat(tmp_path, f"run.method={method}")
    layers = ("wear.case_depth_mm=0.005", "wear.core_factor=8")
    soft = flat(tmp_path, f"run.method={method}", *layers)
    assert soft.cycles == pytest.approx(plain.cycles * (0.25 + 0.75 / 8.0), rel=1e-3)


@pytest.mark.wide
@pytest.mark.parametrize("life", [strand, wrap])
def test_no_layer_at_all_is_the_core_alone(life: Any) -> None:
    plain = life("joint.specific_wear_rate_mm2_per_N=1e-20") if life is wrap else life()
    layers = ["wear.case_depth_mm=1e-9", "wear.core_factor=5"]
    if life is wrap:
        layers.append("joint.specific_wear_rate_mm2_per_N=1e-20")
    soft = life(*layers)
    assert soft.cycles == pytest.approx(plain.cycles / 5.0, rel=1e-2)


def test_deeper_layer_than_the_limit_changes_nothing() -> None:
    plain, hard = wrap(), wrap("wear.case_depth_mm=1", "wear.core_factor=50")
    assert hard.cycles == plain.cycles


@pytest.mark.parametrize("life", [strand, wrap])
def test_life_ends_with_the_hardened_layer(life: Any) -> None:
    result = life("stop.case_depth_mm=0.01")
    assert result.stop == "case_depth_mm"
    found = {state.name: state.value for state in result.limits}
    assert found["case_depth_mm"] == pytest.approx(0.01, rel=1e-6)
    assert found["critical_depth_mm"] == pytest.approx(0.01, rel=1e-6)


def test_thickness_of_a_worn_tooth_on_a_strand() -> None:
    case = wearsim.load_case(STRAND, FEW)
    tooth = case.drive.tooth
    radius = tooth.strand.centrode_radius
    assert case.drive.worn_thickness(tooth.flank.x, tooth.flank.y) == pytest.approx(
        tooth.pitch_line_thickness, rel=1e-12
    )
    worn = tooth.flank.recede(0.3)
    circle = shapely.Point(0.0, 0.0).buffer(radius, 4096).exterior
    angles = [
        math.atan2(-place.x, place.y)
        for flank in (tooth.flank, worn)
        for place in [circle.intersection(shapely.LineString(np.column_stack([flank.x, flank.y])))]
    ]
    new = 2.0 * math.asin(tooth.pitch_line_thickness / (2.0 * radius))
    expected = 2.0 * radius * math.sin(0.5 * (new - (angles[1] - angles[0])))
    assert case.drive.worn_thickness(worn.x, worn.y) == pytest.approx(expected, rel=1e-4)


def last_thickness(case: wearsim.Case, result: WearResult) -> float:
    last = result.flank[result.flank["cycles"] == result.flank["cycles"].iloc[-1]]
    return float(case.drive.worn_thickness(last["x_mm"].to_numpy(), last["y_mm"].to_numpy()))


@pytest.mark.wide
@pytest.mark.parametrize("life", [strand, wrap])
def test_life_ends_with_the_thickness(life: Any) -> None:
    case = wearsim.load_case(STRAND, FEW) if life is strand else wearsim.load_case(WRAP)
    # Only a stretched chain climbs to the pitch line.
    more = () if life is strand else STRETCHING
    new, end = case.drive.pitch_line_thickness, last_thickness(case, life(*more))
    assert end < new
    least = 0.5 * (new + end)
    result = life(*more, f"stop.min_tooth_thickness_mm={least}")
    assert last_thickness(case, result) == pytest.approx(least, rel=1e-6)
    if life is strand:
        assert result.stop == "min_tooth_thickness_mm"
        found = {state.name: state.value for state in result.limits}
        assert found["min_tooth_thickness_mm"] == pytest.approx(least, rel=1e-6)


@pytest.mark.wide
def test_life_ends_with_the_measurement_over_pins() -> None:
    finer = "stop.critical_depth_mm=0.2", "sprocket.nodes=301", "mechanism.phases=8"
    free = wrap(*finer)
    change = free.history_columns["over_pins_mm"][0] - free.history_columns["over_pins_mm"]
    limit = 0.5 * float(change.max())
    result = wrap(*finer, f"stop.over_pins_change_mm={limit}")
    assert result.stop == "over_pins_change_mm"
    # A thousandth of a millimetre comes and goes with the last points: where it is met first.
    met, cycles = int((change >= limit).argmax()), free.history_columns["cycles"]
    assert 0.94 * cycles[met - 1] < result.cycles < 1.06 * cycles[met]


@pytest.mark.parametrize(
    ("setting", "key"),
    [
        ("wear.case_depth_mm=1", "wear.core_factor"),
        ("wear.core_factor=2", "wear.case_depth_mm"),
        ("wear.running_in_factor=2", "wear.running_in_distance_mm"),
        ("wear.running_in_distance_mm=2", "wear.running_in_factor"),
        ("stop.min_tooth_thickness_mm=50", "stop.min_tooth_thickness_mm"),
        ("stop.over_pins_change_mm=0.1", "stop.over_pins_change_mm"),
    ],
)
def test_what_does_not_fit_is_named(setting: str, key: str) -> None:
    with pytest.raises(wearsim.CaseError) as caught:
        wearsim.load_case(STRAND, [*FEW, setting])
    assert key in str(caught.value)


@pytest.mark.parametrize("factor", [2.0, 150.0, 1e4])
def test_running_in_is_undone_for_any_factor(factor: float) -> None:
    """Also where the excess is far above the lasting rate: increasing, never below zero."""
    warp = RunningIn(factor, 100.0)
    worn = np.geomspace(1e-3, 1e9, 200)
    cycles = warp.running_cycles(worn)
    assert (cycles > 0.0).all() and (np.diff(cycles) > 0.0).all()
    back = [warp.steady_cycles(float(run)) for run in cycles]
    np.testing.assert_allclose(back, worn, rtol=1e-9)


MARGIN = (
    "joint.pitch=alternating",
    "mechanism.friction_roller_tooth=0.1",
    "mechanism.friction_roller_bush=0.1",
    "run.life_tolerance=0.1",
)


@pytest.mark.slow
def test_life_ends_where_the_slack_tension_needed_reaches_its_limit() -> None:
    """The chain needs less before; at the end as much as was allowed, as near as worn gaps let that be said.

    The tension needed is found by bisection, but rollers in worn gaps may rest at one tension and not at a
    slightly greater one.
    """
    plain = wrap(*MARGIN)
    result = wrap(*MARGIN, "stop.min_slack_tension_N=2.5")
    assert (result.stop, result.stop_value) == ("min_slack_tension_N", 2.5)
    assert 0.0 < result.cycles < plain.cycles
    assert result.max_depth < 0.02
    state = {limit.name: limit for limit in result.limits}["min_slack_tension_N"]
    assert (state.limit, state.value) == (2.5, pytest.approx(2.5, rel=0.1))
    assert "needs a slack tension of 2.5 N" in answer(result, "case.toml")


def test_what_a_new_drive_needs_cannot_be_the_limit() -> None:
    with pytest.raises(
        CaseError, match=r"min_slack_tension_N: must be above the slack tension at which a new drive jumps"
    ):
        wrap(*MARGIN, "stop.min_slack_tension_N=0.01")


def test_rollers_that_wear_are_told() -> None:
    """Half as soft as the teeth, they lose what follows from the area that the gaps lose."""
    result = wrap("wear.roller_wear_ratio=0.5")
    history = result.history_columns
    first = history["chain"] == 1.0
    area, worn = history["removed_area_mm2"][first], history["roller_wear_mm"][first]
    lost = math.pi * (4.255**2 - (4.255 - worn) ** 2)
    np.testing.assert_allclose(lost, 0.5 * 13 / 60 * (1.0 + 13 / 20) * area, rtol=5e-3, atol=1e-9)
    assert {limit.name for limit in result.limits} >= {"roller_wear_mm"}
    assert any("rollers wear all round" in text for text in result.assumptions)


def test_rollers_worn_through_are_refused() -> None:
    with pytest.raises(ContactError, match="roller: must keep a wall around its bush"):
        wrap("wear.roller_wear_ratio=30000")


def test_part_renewed_later_runs_in_once_more() -> None:
    """The integral of its own coefficient over the cycles since it was new, by quadrature."""
    bodies, mate = RunningIn(3.0, 100.0), RunningIn(5.0, 300.0)
    new_at, until = (bodies.steady_cycles(cycles) for cycles in (200.0, 1000.0))
    expected, _ = quad(lambda n: 1.0 + 4.0 * math.exp(-n / 300.0), 0.0, 800.0)
    first, _ = quad(lambda n: 1.0 + 4.0 * math.exp(-n / 300.0), 0.0, 1000.0)
    clock = MateClock(LubricatedClock(bodies), mate)
    in_use = clock.put_on(new_at)
    assert in_use.worn(until) == pytest.approx(expected, rel=1e-9)
    assert in_use.until(expected) == pytest.approx(until, rel=1e-9)
    assert clock.put_on(0.0).worn(until) == pytest.approx(first, rel=1e-9)
    assert STEADY.put_on(7.0).worn(9.0) == 2.0
    assert STEADY.put_on(7.0).until(2.0) == 9.0


def test_part_renewed_later_is_lubricated_once_more() -> None:
    """Dry from 100 cycles on, at four times the wear: the bodies were so when the mate was put on."""
    lubricant = LubricantClock(LubricantLaw(4.0, 100.0), LubricantSchedule())
    in_use = MateClock(LubricatedClock(NO_RUNNING_IN, lubricant), NO_RUNNING_IN).put_on(100.0 + 4.0 * 60.0)
    # The mate wears 100 cycles lubricated and 40 dry while the bodies wear 140 dry.
    until = 100.0 + 4.0 * 200.0
    assert in_use.worn(until) == pytest.approx(100.0 + 4.0 * 40.0, rel=1e-12)
    assert in_use.until(260.0) == pytest.approx(until, rel=1e-12)


def test_every_chain_runs_in() -> None:
    """Chains of one drive live alike, and each grows by the integral of its own coefficient in every row."""
    settings = (
        "wear.running_in_factor=5",
        "wear.running_in_distance_mm=100",
        "joint.specific_wear_rate_mm2_per_N=2e-7",
        "stop.elongation_percent=2",
        "run.horizon_hours=60",
        "run.life_tolerance=0.1",
    )
    result, case = wrap(*settings), wearsim.load_case(WRAP, settings)
    assert isinstance(case.drive, WrapDrive)
    falls_over = 100.0 / case.drive.contact(case).joint_sliding_per_cycle
    cycles, chain = result.history_columns["cycles"], result.history_columns["chain"]
    ends = [cycles[chain == number][-1] for number in (1.0, 2.0, 3.0)]

    def worn(run: Any) -> Any:
        return run + 4.0 * falls_over * -np.expm1(-run / falls_over)

    age = cycles - np.array([0.0, *ends])[chain.astype(int) - 1]
    grown = result.history_columns["elongation_percent"]
    np.testing.assert_allclose(grown, 2.0 * worn(age) / worn(ends[0]), rtol=1e-6, atol=1e-12)
    # The end of a chain is the last row with its number.
    np.testing.assert_allclose(np.diff([0.0, *ends]), result.parts["chain"].cycles, rtol=1e-6)
    assert any("every new chain" in text for text in result.assumptions)
