"""Powers of load and cycles, severe wear by p v and by T-gamma, against their closed forms.

On a flank of uniform load and sliding the depth per cycle is constant, so tau cycles of a constant
coefficient wear tau I off; N = N_ref (tau/N_ref)^(1/b) of them are run. Rates are the formulas written out
here.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wearsim
from tests.drives import LIGHT_WRAP, changed
from wearsim.catalogue.catalogues import wear_laws
from wearsim.drive.wear_task import wear_law
from wearsim.errors import CaseError, ConvergenceError
from wearsim.kernels.severity import t_gamma_rate
from wearsim.study.remaining.model import SingleReading, remaining_life
from wearsim.wear.mate_clock import LubricatedClock, MateClock
from wearsim.wear.running_in import CyclesPower
from wearsim.wear.severe_wear import severe_multiple, t_gamma_energy

CaseMaker = Callable[..., wearsim.Case]

STRAND = Path(__file__).parents[2] / "cases" / "16b-20t-oiled.toml"
FEW = ["sprocket.nodes=61", "stop.critical_depth_mm=0.05"]
GEARS = Path(__file__).parents[2] / "cases" / "fzg-c14-16t-mild.toml"
ROLLER, SPEED, RPM = 6.035, 700.0, 100.0
MODULUS = 2.1e5 / (2.0 * 0.91)
RELATIVE = 1.0 / ROLLER
WRAP = changed(
    LIGHT_WRAP,
    {
        "sprocket.nodes": 101,
        "joint": {"specific_wear_rate_mm2_per_N": 1e-9, "pitch": "uniform"},
        "wear.specific_wear_rate_mm2_per_N": 1e-9,
        "stop": {"critical_depth_mm": 0.02, "elongation_percent": 3},
        "run.life_tolerance": 0.1,
    },
)


def sigma(load: float) -> float:
    return math.sqrt(load * MODULUS * RELATIVE / math.pi)


@pytest.fixture
def flat(prescribed: CaseMaker) -> CaseMaker:
    """Return a case of a flat flank with a load, and a path or a slip ratio."""

    def case(
        wear: dict[str, Any], *settings: str, load: float = 100.0, slip: float = 0.3, ratio: bool = False
    ) -> wearsim.Case:
        column = "slip_ratio" if ratio else "sliding_distance_mm"
        columns = {
            "arc_length_mm": np.linspace(0.0, 6.0, 31),
            "load_per_width_N_per_mm": load,
            "flank_curvature_per_mm": 0.0,
            column: slip,
            "sliding_speed_mm_per_s": SPEED,
        }
        return prescribed(columns, wear, 0.01, ROLLER, settings)

    return case


ARCHARD = {"law": "archard", "specific_wear_rate_mm2_per_N": 1e-9}


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
@pytest.mark.parametrize("exponent", [0.2, 0.5, 0.9])
def test_life_by_a_power_of_the_cycles(
    validated: Callable[..., None], flat: CaseMaker, exponent: float, method: str
) -> None:
    case = flat(ARCHARD, f"wear.cycles_exponent={exponent}", "wear.reference_hours=5", f"run.method={method}")
    steady, reference = 0.01 / (1e-9 * sigma(100.0) * 0.3), 5.0 * 60.0 * case.speed_rpm
    result = wearsim.simulate(case.with_({"run.horizon_hours": 1e13}))
    validated(
        f"life, wear proportional to cycles to the power {exponent}",
        result.cycles,
        reference * (steady / reference) ** (1.0 / exponent),
        *(1e-8, "closed form at constant load, curvature and path", "cycles"),
        page=method == "advance" and exponent == 0.5,
    )
    column = result.history_columns
    part = 0.5 ** (1.0 / exponent)
    at_half = np.interp(part * result.cycles, column["cycles"], column["max_depth_mm"])
    assert at_half == pytest.approx(0.005, rel=1e-4)


def test_power_one_changes_no_digit() -> None:
    plain = wearsim.simulate(wearsim.load_case(STRAND, FEW))
    one = wearsim.simulate(
        wearsim.load_case(STRAND, [*FEW, "wear.cycles_exponent=1", "wear.reference_hours=7"])
    )
    assert one.cycles == plain.cycles
    for name, column in plain.history_columns.items():
        np.testing.assert_array_equal(one.history_columns[name], column)


@pytest.mark.parametrize("case", [STRAND, GEARS])
def test_same_wear_later_on_strand_and_gears(case: Path) -> None:
    """The flank takes the same shapes, only at other times: N_ref (N/N_ref)^2 for b = 1/2."""
    few = FEW if case == STRAND else ["gear.nodes=61"]
    plain = wearsim.simulate(wearsim.load_case(case, few))
    loaded = wearsim.load_case(
        case, [*few, "wear.cycles_exponent=0.5", "wear.reference_hours=10", "run.horizon_hours=1e12"]
    )
    slow = wearsim.simulate(loaded)
    reference = 10.0 * loaded.cycles_per_hour
    assert slow.cycles == pytest.approx(plain.cycles**2 / reference, rel=1e-3)
    assert slow.life_high.cycles / slow.cycles == pytest.approx(
        (plain.life_high.cycles / plain.cycles) ** 2, rel=1e-9
    )
    assert slow.removed_area == pytest.approx(plain.removed_area, rel=1e-3)


def test_lives_in_batches_are_the_same() -> None:
    case = wearsim.load_case(STRAND, [*FEW, "wear.cycles_exponent=0.7", "wear.reference_hours=10"])
    [many] = wearsim.simulate_many([case])
    assert many.life.cycles == wearsim.simulate(case).cycles


@pytest.mark.wide
def test_joints_of_every_chain_begin_anew() -> None:
    """Chain k lives as long as the first: by hand, N = N_ref (limit/(rate N_ref))^(1/b)."""
    settings = [
        "wear.cycles_exponent=0.5",
        "wear.reference_hours=50",
        "joint.specific_wear_rate_mm2_per_N=1.5e-7",
    ]
    plain = wearsim.simulate(wearsim.load_case(WRAP, [settings[-1]]))
    case = wearsim.load_case(WRAP, settings)
    slow = wearsim.simulate(case)
    reference = 50.0 * case.cycles_per_hour
    expected = plain.parts["chain"].cycles ** 2 / reference
    assert slow.parts["chain"].cycles == pytest.approx(expected, rel=1e-9)
    column = slow.history_columns
    last = [column["cycles"][column["chain"] == k].max() for k in np.unique(column["chain"])[:-1]]
    assert len(last) >= 2
    np.testing.assert_allclose(np.diff([0.0, *last]), expected, rtol=1e-6)


@pytest.mark.wide
def test_a_whole_drive_has_one_clock() -> None:
    """N = N_ref (tau/N_ref)^(1/b) in hours, the same for all sprockets and both ends of the band."""
    case = Path(__file__).parents[2] / "cases" / "drives" / "packaging-conveyor.toml"
    rough = ["run.life_tolerance=0.1", "stop.critical_depth_mm=0.02"]
    rough += ["mechanism.phases=1", "sprocket.1.nodes=31", "sprocket.2.nodes=31"]
    plain = wearsim.simulate(wearsim.load_case(case, rough))
    slow = wearsim.simulate(
        wearsim.load_case(case, [*rough, "wear.cycles_exponent=0.8", "wear.reference_hours=1000"])
    )

    def later(hours: float) -> float:
        return 1000.0 * (hours / 1000.0) ** 1.25

    for result in slow.results.values():
        assert result.parts["chain"].hours_run == pytest.approx(later(plain.chain.hours_run), rel=1e-9)
    ends = [later(life.hours_run) for life in plain.band("chain")]
    assert [life.hours_run for life in slow.band("chain")] == pytest.approx(ends, rel=1e-9)


@pytest.mark.parametrize(("load_power", "cycles_power"), [(0.6, 0.2)])
def test_powers_of_load_and_cycles_on_a_given_path(
    flat: CaseMaker, load_power: float, cycles_power: float
) -> None:
    """Wear ~ load^a N^b, the powers of V1: under a given path the pressure exponent is 2 a."""
    wear = {"law": "power", "coefficient": 1e-8, "pressure_exponent": 2.0 * load_power}
    lives = [
        wearsim.simulate(
            flat(
                wear,
                f"wear.cycles_exponent={cycles_power}",
                "wear.reference_hours=1",
                "run.horizon_hours=1e15",
                load=load,
            )
        ).cycles
        for load in (10.0, 100.0)
    ]
    slope = math.log(lives[0] / lives[1]) / math.log(10.0)
    assert slope == pytest.approx(load_power / cycles_power, rel=1e-6)


@pytest.mark.parametrize("exponent", [0.1, 0.3, 0.8])
@pytest.mark.parametrize("run", [1e-3, 7.0, 1e9])
def test_the_clock_goes_back(exponent: float, run: float) -> None:
    clock = CyclesPower(exponent, 1e4)
    worn = clock.steady_cycles(run)
    assert worn == pytest.approx(1e4 * math.exp(exponent * math.log(run / 1e4)), rel=1e-12)
    assert clock.running_cycles(np.array([worn]))[0] == pytest.approx(run, rel=1e-12)
    renewed = MateClock(LubricatedClock(clock), clock).put_on(3e5)
    assert renewed.until(renewed.worn(8e5)) == pytest.approx(8e5, rel=1e-12)


def test_remaining_life_of_a_power_of_the_cycles(flat: CaseMaker) -> None:
    """Read 0.004 mm of 0.01 mm after 100 h: the limit is met after 100 (0.01/0.004)^(1/b) h."""
    case = flat(ARCHARD, "wear.cycles_exponent=0.5", "wear.reference_hours=5")
    found = remaining_life(case, SingleReading("max_depth_mm", 0.004, 1e-4, 100.0))
    assert found.life.hours_run == pytest.approx(625.0, rel=1e-6)
    assert found.remaining.hours_run == pytest.approx(525.0, rel=1e-6)
    rate = 0.004 / (5.0 * 60.0 * case.speed_rpm * math.sqrt(100.0 / 5.0)) / (sigma(100.0) * 0.3)
    assert found.coefficient == pytest.approx(rate, rel=1e-6)


def test_remaining_life_of_a_chain_whose_joints_slow_down() -> None:
    """Read 1 % of 3 % after 100 h with b = 1/2: 900 h in all."""
    case = wearsim.load_case(WRAP, ["wear.cycles_exponent=0.5", "wear.reference_hours=50"])
    found = remaining_life(case, SingleReading("elongation_percent", 1.0, 0.01, 100.0))
    assert found.life.hours_run == pytest.approx(900.0, rel=1e-9)


@pytest.mark.parametrize("method", ["advance", "per_cycle"])
@pytest.mark.parametrize(("part", "multiple"), [(0.9, 1.0), (1.05, 3.0), (1.2, 9.0)])
def test_life_beyond_a_limit_of_pressure_times_speed(
    validated: Callable[..., None], flat: CaseMaker, part: float, multiple: float, method: str
) -> None:
    """In the middle of the transition the coefficient is multiplied by the root of the factor."""
    limit = sigma(100.0) * SPEED / part
    case = flat(
        ARCHARD, f"wear.pv_limit_MPa_mm_per_s={limit!r}", "wear.severe_factor=9", f"run.method={method}"
    )
    validated(
        f"life at {part:g} of the limit of p v, severe factor 9",
        wearsim.simulate(case).cycles,
        0.01 / (multiple * 1e-9 * sigma(100.0) * 0.3),
        *(1e-8, "closed form at constant load, curvature and path", "cycles"),
        page=method == "advance" and part > 1.0,
    )


def test_severe_wear_on_part_of_a_strand() -> None:
    """Every point wears by its own pressure and speed: the end of a short run, against the formula."""
    settings = ["sprocket.nodes=61", "stop.critical_depth_mm=1e-6", "run.life_tolerance=0.1"]
    plain = wearsim.simulate(wearsim.load_case(STRAND, settings))
    last = {name: plain.flank_columns[name][:61] for name in plain.flank_columns}
    product = last["pressure_MPa"] * last["sliding_speed_mm_per_s"]
    limit = 0.7 * float(np.nanmax(product))
    severe = wearsim.simulate(
        wearsim.load_case(
            STRAND, [*settings, f"wear.pv_limit_MPa_mm_per_s={limit!r}", "wear.severe_factor=5"]
        )
    )
    expected = np.clip((product / limit - 1.0) / 0.1, 0.0, 1.0)
    expected = 5.0 ** (3.0 * expected**2 - 2.0 * expected**3)
    loaded = last["load_per_width_N_per_mm"] > 0.0
    rates = [run.flank_columns["depth_mm"][-61:][loaded] / run.cycles for run in (plain, severe)]
    assert 1.0 in expected[loaded] and 5.0 in expected[loaded]
    inside = slice(1, -1)  # where the load ends, either run follows it on its own
    np.testing.assert_allclose((rates[1] / rates[0])[inside], expected[loaded][inside], rtol=1e-3)


def test_severity_is_one_below_the_limit_and_the_factor_beyond() -> None:
    values = [severe_multiple(pressure, 2.0, 1000.0, 7.0) for pressure in (1.0, 500.0, 550.0, 9e3)]
    assert values == pytest.approx([1.0, 1.0, 7.0, 7.0], rel=1e-15)


@pytest.mark.parametrize(
    ("energy", "rate"),
    [(1.0, 5.3), (10.0, 53.0), (10.4, 55.0), (50.0, 55.0), (77.2, 55.0), (100.0, 55.0 + 61.9 * 22.8)],
)
def test_published_rate_by_t_gamma(energy: float, rate: float) -> None:
    assert t_gamma_rate(energy) == pytest.approx(rate, rel=1e-12)


@pytest.mark.wide
@pytest.mark.parametrize("method", ["advance", "per_cycle"])
@pytest.mark.parametrize("slip", [0.01, 0.2])
def test_life_by_t_gamma(validated: Callable[..., None], flat: CaseMaker, slip: float, method: str) -> None:
    """Twin discs on a flank: mild at 1 % of slip, catastrophic at 20 %."""
    load, friction = 500.0, 0.45
    wear = {"law": "t_gamma", "coefficient": 1e-3, "friction_coefficient": friction}
    case = flat(wear, f"run.method={method}", load=load, slip=slip, ratio=True)
    energy = friction * math.pi / 4.0 * sigma(load) * slip
    width = 2.0 * math.sqrt(4.0 * load / (math.pi * MODULUS * RELATIVE))
    worn = 5.3 * energy if energy < 10.4 else 55.0 + 61.9 * (energy - 77.2)
    assert energy < 10.4 or energy > 77.2
    validated(
        f"life by T-gamma, {energy:.3g} N/mm2, C = 0.001",
        wearsim.simulate(case).cycles,
        10.0 / (worn * width / 7.85e6),
        *(1e-8, "published rate at constant load, curvature and slip", "cycles"),
        page=method == "advance",
    )
    assert t_gamma_energy(math.pi / 4.0 * sigma(load), slip, friction) == pytest.approx(energy, rel=1e-12)


def test_t_gamma_between_mild_and_steep_is_refused(flat: CaseMaker) -> None:
    wear = {"law": "t_gamma", "coefficient": 1.0, "friction_coefficient": 0.45}
    with pytest.raises(CaseError, match=r"wear\.law.*10\.4.*77\.2.*ill-posed"):
        wearsim.simulate(flat(wear, load=500.0, slip=0.05, ratio=True))


def test_explicit_steps_are_held_to_the_steepest_transition(flat: CaseMaker) -> None:
    """Near the limit the depth rises much faster with the pressure than the law alone says."""
    settings = [f"wear.pv_limit_MPa_mm_per_s={sigma(100.0) * SPEED / 1.05!r}", "run.method=per_cycle"]
    case = flat(
        ARCHARD, *settings, "wear.severe_factor=1e4", "run.cycles_per_update=400000", "run.life_tolerance=0.1"
    )
    with pytest.raises(ConvergenceError, match="cycles_per_update"):
        wearsim.simulate(case)


@pytest.mark.parametrize(
    ("setting", "key"),
    [
        ("wear.cycles_exponent=0.5", "reference_hours"),
        ("wear.reference_hours=5", "cycles_exponent"),
        ("wear.severe_factor=5", "pv_limit_MPa_mm_per_s"),
        ("wear.pv_limit_MPa_mm_per_s=5", "severe_factor"),
        ("wear.cycles_exponent=1.2", "cycles_exponent"),
        ("wear.severe_factor=0.5", "severe_factor"),
        ("wear.friction_coefficient=0.5", "friction_coefficient"),
    ],
)
def test_keys_that_lack_another_or_leave_their_range_are_named(setting: str, key: str) -> None:
    with pytest.raises(CaseError, match=key):
        wearsim.load_case(STRAND, [setting])


PV = ("wear.pv_limit_MPa_mm_per_s=5", "wear.severe_factor=5")


def test_two_ways_of_running_in_are_refused() -> None:
    settings = ["wear.cycles_exponent=0.5", "wear.reference_hours=5"]
    settings += ["wear.running_in_factor=2", "wear.running_in_distance_mm=5"]
    with pytest.raises(CaseError, match="never ends"):
        wearsim.load_case(STRAND, settings)


def test_a_wrap_refuses_severity() -> None:
    with pytest.raises(CaseError, match=r"wear\.pv_limit_MPa_mm_per_s.*rest"):
        wearsim.load_case(WRAP, PV)
    law = {"wear": {"law": "t_gamma", "coefficient": 1.0, "friction_coefficient": 0.4}}
    with pytest.raises(CaseError, match=r"wear\.law.*rest"):
        wearsim.load_case({**WRAP, **law})


def test_a_duty_refuses_severity() -> None:
    duty = {
        "duty": [
            {"share_of_time": 0.5, "tension_N": 800, "speed_rpm": 50},
            {"share_of_time": 0.5, "tension_N": 400, "speed_rpm": 50},
        ]
    }
    tables = {
        "format_version": 1,
        "chain": {"designation": "16B-1"},
        "sprocket": {"teeth": 20, "profile": "evolute"},
        "wear": {"condition": "hardened, oiled", "pv_limit_MPa_mm_per_s": 1e5, "severe_factor": 5},
        **duty,
    }
    with pytest.raises(CaseError, match=r"wear\.pv_limit_MPa_mm_per_s.*one constant load"):
        wearsim.load_case(tables)


@pytest.mark.parametrize("command", ["maintain", "calibrate"])
def test_scaled_lives_refuse_a_power_of_the_cycles(command: str) -> None:
    from wearsim.runner.scaled_percentiles import check_no_running_in

    case = wearsim.load_case(WRAP, ["wear.cycles_exponent=0.5", "wear.reference_hours=50"])
    with pytest.raises(CaseError, match=f"cycles_exponent.*{command}"):
        check_no_running_in(case, command)


def test_every_law_of_the_registry_is_known_to_the_engine() -> None:
    case = wearsim.load_case(STRAND)
    for name, entry in wear_laws().items():
        assert entry.formula and entry.valid and entry.source and entry.not_for, name
        if entry.kind == "law":
            given = replace(case.wear, law=name, constants=dict.fromkeys(entry.keys[1:], 0.5))
            assert wear_law(given, 1.0).coefficient > 0.0
