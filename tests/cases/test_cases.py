"""Every shipped case: it loads, runs to a complete result, and faces what practice reports."""

import json
import math
import re
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import wearsim
from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.result import Life, LowerBound, WearResult

FOLDER = Path(__file__).parents[2] / "cases"
PATHS = {path.stem: path for path in sorted(FOLDER.glob("*.toml"))}
LAWS = ("archard", "power", "drozdov")
SUMMARY_KEYS = [
    "schema_version",
    "wearsim_version",
    "case",
    "life_hours",
    "cycles",
    "life_reached",
    "hours_run",
    "cycles_run",
    "life_hours_low",
    "life_hours_high",
    "stop",
    "max_depth_mm",
    "max_depth_arc_length_mm",
    "initial_peak_pressure_MPa",
    "final_peak_pressure_MPa",
    "method",
    "updates",
    "assumptions",
    "warnings",
]
HISTORY_COLUMNS = [
    "cycles",
    "time_hours",
    "max_depth_mm",
    "peak_pressure_MPa",
    "max_sliding_speed_mm_per_s",
    "removed_area_mm2",
    "worn_contact_ratio",
]
FLANK_COLUMNS = [
    "cycles",
    "node",
    "arc_length_mm",
    "x_mm",
    "y_mm",
    "depth_mm",
    "pressure_MPa",
    "sliding_speed_mm_per_s",
    "load_per_width_N_per_mm",
    "relative_curvature_per_mm",
]
EVERY_CASE = pytest.mark.parametrize("name", PATHS)
WRAPPED = [name for name, path in PATHS.items() if 'kind = "wrap"' in path.read_text("utf-8")]
NOT_WRAPPED = pytest.mark.parametrize("name", [name for name in PATHS if name not in WRAPPED])
"""Those of a wrapped chain run in test_wrap_cases.py."""


@cache
def loaded(name: str) -> wearsim.Case:
    return wearsim.load_case(PATHS[name])


@cache
def result(name: str, *overrides: str) -> WearResult:
    return wearsim.simulate(wearsim.load_case(PATHS[name], overrides))


@dataclass(frozen=True)
class Header:
    """The comment above a case; low and high in hours, None where practice reports nothing."""

    text: str
    low: float | None
    high: float | None
    factor: float | None
    outside: bool


def read_header(text: str) -> Header:
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line)
    practice = [line for line in lines if line.startswith("# practice:")]
    assert len(practice) == 1, "exactly one '# practice:' line"
    low = high = None
    if not re.match(r"# practice: none found\b", practice[0]):
        found = re.match(r"# practice: (\d+)\.\.(\d+) h \(\S", practice[0])
        assert found, f"'# practice: A..B h (source)' or '# practice: none found': {practice[0]}"
        low, high = (float(group) for group in found.groups())
    factor = re.search(r"^# factor: ([\d.]+) \(\S", "\n".join(lines), re.MULTILINE)
    outside = any(line.startswith("# outside: ") for line in lines)
    return Header("\n".join(lines), low, high, float(factor[1]) if factor else None, outside)


def header(name: str) -> Header:
    return read_header(PATHS[name].read_text(encoding="utf-8"))


def is_outside(life: Life | LowerBound, low: float, high: float, factor: float) -> bool:
    """Life is inversely proportional to k, so a factor of k is one of the range of lives."""
    if isinstance(life, LowerBound):
        return life.hours_run > high * factor
    return not low / factor <= life.hours <= high * factor


def inputs(name: str) -> dict:
    return tomllib.loads(PATHS[name].read_text(encoding="utf-8"))


@EVERY_CASE
def test_it_loads_and_its_name_says_what_teeth_and_condition(name):
    case = loaded(name)
    assert case.name == name
    assert case.title
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*-\d+t-[a-z]+|hertz-arc-prescribed", name)
    teeth = re.search(r"-(\d+)t-", name)
    if teeth and "sprocket" in case.inputs:
        assert case.inputs["sprocket"]["teeth"] == int(teeth[1])


@pytest.mark.wide
@NOT_WRAPPED
def test_it_runs_to_a_complete_result(name):
    run, prescribed = result(name), inputs(name).get("mechanism", {}).get("kind") == "prescribed"
    assert list(run.history_columns) == HISTORY_COLUMNS
    assert list(run.flank_columns)[: len(FLANK_COLUMNS)] == FLANK_COLUMNS
    unknown = {"worn_contact_ratio"} if prescribed else set()
    if name == "hertz-arc-prescribed":
        unknown |= {"max_sliding_speed_mm_per_s", "sliding_speed_mm_per_s"}
    for columns in (run.history_columns, run.flank_columns):
        for key, values in columns.items():
            assert values.size > 1, key
            touched = columns["load_per_width_N_per_mm"] > 0.0 if key == "sliding_speed_mm_per_s" else ...
            assert np.all(np.isnan(values) if key in unknown else np.isfinite(values[touched])), key
    assert np.all(np.diff(run.history_columns["max_depth_mm"]) > 0.0)
    assert run.history_columns["max_depth_mm"][-1] == run.max_depth > 0.0
    assert run.initial_peak_pressure > 0.0
    assert run.final_peak_pressure > 0.0


@NOT_WRAPPED
def test_its_summary_is_json_without_nan(name):
    run = result(name)
    summary = json.loads(json.dumps(run.summary(), allow_nan=False))
    assert not set(SUMMARY_KEYS) - set(summary)
    assert next(iter(summary)) == "schema_version"
    assert (summary["life_hours"] is None) == (summary["cycles"] is None)
    assert (summary["life_hours"] is not None) == summary["life_reached"]


@NOT_WRAPPED
def test_its_numerical_error_is_within_its_tolerance(name):
    run = result(name)
    assert 0.0 <= run.numerical_error <= run.life_tolerance
    assert not [text for text in run.warnings if "nodes" in text]


@EVERY_CASE
def test_its_header_names_practice_and_no_path_of_a_machine(name):
    found = header(name)
    assert (found.low is None) == (found.factor is None), "a range needs '# factor: F (why)'"
    assert not re.search(r"/work|/home|/tmp|shared/|\.md\b", found.text)
    if found.low is not None:
        assert 0.0 < found.low <= found.high


@NOT_WRAPPED
def test_its_life_is_within_a_factor_of_practice_or_it_says_why_not(name):
    found = header(name)
    if found.low is None:
        assert not found.outside, "nothing to be outside of"
        return
    beyond = is_outside(result(name).life, found.low, found.high, found.factor)
    assert found.outside == beyond, result(name).life


def test_the_comparison_with_practice_meets_both_sides():
    ranges = [header(name) for name in PATHS if header(name).low is not None]
    assert len(ranges) >= 3
    assert any(found.outside for found in ranges)
    assert any(not found.outside for found in ranges)


@pytest.mark.parametrize(
    ("life", "outside"),
    [
        (Life(1.0, 999.0), True),
        (Life(1.0, 1001.0), False),
        (Life(1.0, 11_999.0), False),
        (Life(1.0, 12_001.0), True),
        (LowerBound(1.0, 500.0), False),
        (LowerBound(1.0, 12_001.0), True),
    ],
)
def test_the_comparison_itself(life, outside):
    """By hand: 2000..6000 h within a factor 2 of k is 1000..12 000 h."""
    assert is_outside(life, 2000.0, 6000.0, 2.0) is outside


@pytest.mark.parametrize(
    "text", ["# no such line", "# practice: 2000 h", "# practice: 1..2 h", "# practice: unknown"]
)
def test_a_header_without_a_readable_practice_line_is_refused(text):
    with pytest.raises(AssertionError, match="practice"):
        read_header(f"{text}\nformat_version = 1\n")


@pytest.mark.parametrize(
    ("table", "key", "values"),
    [
        ("wear", "law", LAWS),
        ("mechanism", "kind", ("strand", "prescribed", "wrap")),
        ("mechanism", "roller_slip_fraction", (0.1, 1.0)),
        ("sprocket", "profile", ("evolute", "points", "iso606", "ansi_b29", "gost591")),
        ("sprocket", "role", ("driver", "driven")),
        ("sprocket", "engaged_every", (1, 2)),
        ("run", "method", ("advance", "per_cycle")),
    ],
)
def test_every_value_is_used_by_a_case(table, key, values):
    used = [loaded(name).inputs.get(table, {}).get(key) for name in PATHS]
    assert not set(values) - set(used)


def test_the_drives_differ_in_kind():
    cases = [loaded(name) for name in PATHS]
    assert len(cases) >= 8
    loads = {key for case in cases for key in case.inputs["load"]}
    assert {"tension_N", "power_kW", "torque_N_m"} < loads
    chains = [case.drive.chain for case in cases if not isinstance(case.drive, GearDrive)]
    assert len({chain.pitch for chain in chains}) >= 5
    assert len({case.modulus for case in cases}) >= 2
    assert len({case.inputs["wear"].get("condition") for case in cases}) >= 4


def test_every_data_file_belongs_to_a_case():
    named = {path.name for name in PATHS for path in loaded(name).files}
    files = {path.name for path in FOLDER.iterdir() if path.is_file()}
    assert files - {path.name for path in PATHS.values()} == named


def test_benchmark_b9_keeps_its_reference_life():
    """26 102 090 cycles: an independent program, with the exact Hertz coefficient."""
    assert result("hertz-arc-prescribed").cycles == pytest.approx(26_102_090, rel=1e-4)


def test_benchmark_b9_has_its_table():
    """Load, curvature and path by the formulas of the benchmark."""
    table = np.loadtxt(FOLDER / "hertz-arc-prescribed.csv", delimiter=",", skiprows=1)
    u = np.linspace(0.0, 1.0, 501)
    load = 100.0 * (0.2 + 0.8 * np.cos(math.pi * u / 2))
    wanted = np.column_stack([6.0 * u, load, np.full(501, 1 / 39.1), 0.05 + 0.4 * u])
    np.testing.assert_allclose(table, wanted, rtol=1e-10)


def test_fzg_pinion_follows_the_geometry_of_its_gears():
    """Pressure 1441.8 MPa and wear 0.02381 nm a mesh at B: published geometry, closed forms."""
    columns = np.loadtxt(FOLDER / "fzg-c14-16t-slow.csv", delimiter=",", skiprows=1).T
    arc, load, curvature, slip, speed = columns
    base = 0.5 * 4.5 * 16 * math.cos(math.radians(20))
    line, reach = 34.9254, 13.2846
    start = line - math.sqrt(59.272**2 - (1.5 * base) ** 2)
    xi = np.sqrt(start**2 + 2.0 * base * arc)
    at_b = math.sqrt(41.318**2 - base**2) - reach
    assert np.interp(at_b, xi, load) == pytest.approx(422.29, rel=1e-4)
    assert np.interp(at_b, xi, 1e-4 * load * slip) == pytest.approx(0.02381, rel=5e-4)
    np.testing.assert_allclose(speed, 2 * math.pi * 13.05 / 60 * xi * slip, rtol=1e-4)
    relative = np.interp(at_b, xi, curvature + 1.0 / 10.0)
    modulus = 2.06e5 / (2 * (1 - 0.3**2))
    assert math.sqrt(422.29 * relative * modulus / math.pi) == pytest.approx(1441.84, rel=1e-4)


def test_fzg_pinion_lives_by_its_closed_form():
    """m = 1 and a given slip ratio: cycles = depth / (k max(q slip)), whatever the pressure."""
    columns = np.loadtxt(FOLDER / "fzg-c14-16t-slow.csv", delimiter=",", skiprows=1).T
    cycles = 0.02 / (1e-10 * (columns[1] * columns[3]).max())
    assert result("fzg-c14-16t-slow").cycles == pytest.approx(cycles, rel=1e-6)


def test_crawler_hours_count_every_other_turn():
    """A gap of the 27 is loaded every second turn: N = 60 n L / 2."""
    run = result("d6-crawler-27t-soil")
    assert run.cycles == pytest.approx(60 * 17.5 * run.life.hours / 2, rel=1e-12)


def test_engaged_every_second_gap_doubles_the_hours():
    """Equation (13) with n/2."""
    every = ["sprocket.teeth=27", "sprocket.profile=evolute"]
    one = result("fzg-c14-16t-slow")
    two = result("fzg-c14-16t-slow", *every, "sprocket.engaged_every=2")
    assert two.life.cycles == one.life.cycles
    assert two.life.hours == pytest.approx(2.0 * one.life.hours, rel=1e-12)


def test_crawler_cycle_by_cycle_agrees_with_the_step_control():
    tables = inputs("d6-crawler-27t-soil")
    tables["run"] = {"method": "advance"}
    other = wearsim.simulate(wearsim.load_case(tables))
    assert result("d6-crawler-27t-soil").cycles == pytest.approx(other.cycles, rel=1e-3)


def test_power_law_starts_at_the_linear_law():
    """K c_2 sigma_0 = k c_1 at the point of the new flank that is pressed most."""
    coefficient = inputs("16a-20t-oilbath")["wear"]["coefficient"]
    pressure = result("16a-20t-oilbath").initial_peak_pressure
    assert coefficient * (2 / 3) * pressure / (5e-11 * math.pi / 4) == pytest.approx(1, rel=1e-3)


def test_drozdov_law_starts_at_the_linear_law():
    """K c_m (sigma/H)^m (v/v0)^n = k c_1 sigma at the point that is pressed most."""
    wear = inputs("10a-20t-drip")["wear"]
    m, n = wear["pressure_exponent"], wear["speed_exponent"]
    columns = result("10a-20t-drip").flank_columns
    worst = np.flatnonzero(columns["cycles"] == 0.0)[columns["pressure_MPa"][:201].argmax()]
    pressure, speed = (columns[key][worst] for key in ("pressure_MPa", "sliding_speed_mm_per_s"))
    u = np.linspace(0.0, 1.0, 200_001)
    mean = np.trapezoid((1.0 - u * u) ** (m / 2), u)
    intensity = wear["coefficient"] * mean * (pressure / wear["hardness_MPa"]) ** m
    intensity *= (speed / wear["reference_speed_mm_per_s"]) ** n
    assert intensity / (5e-11 * math.pi / 4 * pressure) == pytest.approx(1.0, rel=3e-3)


def test_wheel_of_57_teeth_outlives_the_chain_that_is_asked_about():
    run = result("08b-57t-oiled")
    assert isinstance(run.life, LowerBound)
    assert run.hours_run == pytest.approx(15_000.0, rel=1e-9)
    assert run.summary()["life_hours"] is None


def test_motorcycle_sprocket_ends_by_its_tip():
    run = result("520-15t-road")
    assert (run.stop, run.stop_value) == ("min_tip_land_mm", 5.0)
    assert run.max_depth < 0.5


def test_numbers_with_units_reach_the_engine():
    """8 in = 203.2 mm, 5/8 in = 15.875 mm, 1 mm3/(N m) = 1e-3 mm2/N by definition."""
    assert loaded("d6-crawler-27t-soil").drive.chain.pitch == pytest.approx(203.2)
    road = loaded("520-15t-road")
    assert road.drive.chain.pitch == pytest.approx(15.875)
    assert 1e9 * road.wear.coefficient == pytest.approx(1.0)


def test_flank_from_noisy_points_lives_like_the_evolute_flank_it_came_from():
    """2 % for m = 1, the promise for 200 points with 0.1 um noise."""
    tables = inputs("beet-harvester-18t-soil")
    sprocket = tables["sprocket"]
    del sprocket["points_file"], sprocket["points_noise_mm"]
    sprocket["profile"] = "evolute"
    drawn = wearsim.simulate(wearsim.load_case(tables))
    points = np.loadtxt(FOLDER / "beet-harvester-18t-soil.csv", delimiter=",", skiprows=1)
    assert points.shape == (200, 2)
    assert result("beet-harvester-18t-soil").cycles == pytest.approx(drawn.cycles, rel=0.02)
