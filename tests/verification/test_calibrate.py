"""Calibration recovers what synthetic readings were made with, as often as its intervals say.

The readings come from runs of the engine with known coefficients and normal errors of known
size: what is tested is the fit, its intervals and what is left, not the engine.
"""

import copy
import json

import numpy as np
import pytest
import tomlkit

import wearsim
from tests.drives import FAST_WRAP, changed
from wearsim.errors import CaseError
from wearsim.geometry.profile_points import Profile
from wearsim.readings.dated_rows import ServiceTime
from wearsim.readings.relubrications import RelubricationLog
from wearsim.study.calibrate import history_interpolation as blend
from wearsim.study.calibrate import model as calibrations
from wearsim.study.calibrate import predicted_history as courses
from wearsim.study.calibrate.calibration import CalibrationOptions
from wearsim.study.calibrate.model import calibrate
from wearsim.study.calibrate.readings import Reading

pytestmark = pytest.mark.wide

STRAND = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "evolute_offset_mm": 5.6, "nodes": 51},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-10},
    "stop": {"critical_depth_mm": 0.1},
}
POWER = {**STRAND, "wear": {"law": "power", "coefficient": 1.2e-9, "pressure_exponent": 0.7}}
WRAP = changed(FAST_WRAP, {"stop.critical_depth_mm": 0.04, "run.life_tolerance": 0.1})
GEARS = {
    "format_version": 1,
    "gear": {"module_mm": 3.0, "pinion_teeth": 20, "wheel_teeth": 36, "face_width_mm": 20.0},
    "load": {"torque_N_m": 60.0, "speed_rpm": 500.0},
    "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
    "stop": {"critical_depth_mm": 0.05},
}
REPEATS = 200


@pytest.fixture
def once(monkeypatch):
    """Runs that are repeated with other readings only are run once, and readings need no file."""
    known, run = {}, blend.simulate

    def simulate(case):
        key = json.dumps(case.inputs, sort_keys=True)
        if key not in known:
            known[key] = run(case)
        return known[key]

    monkeypatch.setattr(blend, "simulate", simulate)
    nothing, since_new = (
        RelubricationLog("", "time_hours", 0, (), 0.0),
        ServiceTime("time_hours", 1.0, None, 0.0),
    )
    monkeypatch.setattr(calibrations, "read_readings", lambda rows, case: (rows, nothing, since_new))


def readings(rows, scans=(), kind=None):
    """Readings from rows of (hours, quantity, value, error, place), and of scans, of one kind of gap."""
    none = np.empty(0)
    found = [
        Reading(row, hours, quantity, value, error, place, kind, none, none)
        for row, (hours, quantity, value, error, place) in enumerate(rows, start=2)
    ]
    found += [
        Reading(row, hours, "profile", np.nan, error, np.nan, None, x, y)
        for row, (hours, error, x, y) in enumerate(scans, start=2)
    ]
    return tuple(found)


def course(tables):
    """Hours of the life, and everything that can be measured at a part of it."""
    return courses.PredictedHistory(wearsim.simulate(wearsim.load_case(copy.deepcopy(tables))))


class Bench:
    """A case in a folder, and tables of readings beside it."""

    def __init__(self, folder, tables):
        self.folder, self.case = folder, folder / "case.toml"
        self.case.write_text(tomlkit.dumps(tables))

    def fit(self, rows, options=None, overrides=()):
        """Calibrate on rows of (hours, quantity, value, error, arc length)."""
        path = self.folder / "readings.csv"
        lines = [",".join("" if cell is None else f"{cell}" for cell in row) for row in rows]
        head = "time_hours,quantity,value,error,arc_length_mm"
        path.write_text("\n".join([head, "0,new,,,", *lines]) + "\n")
        return calibrate(self.case, path, overrides, options)


def depths(model, places, parts, error, rng):
    """Readings of depths with errors."""
    return [
        (
            part * model.hours,
            "depth_mm",
            model.depth_at(part, place, 1) + rng.normal(0.0, error),
            error,
            place,
        )
        for place in places
        for part in parts
    ]


def inside(interval, truth):
    return interval.low <= truth <= interval.high


@pytest.mark.slow
@pytest.mark.parametrize("error", [0.001, 0.004, 0.015], ids=["1um", "4um", "15um"])
def test_intervals_of_the_coefficient_and_of_the_life_hold_nine_of_ten(tmp_path, once, error):
    """Errors of 1 to 15 % of the limit; the case starts from three times the coefficient."""
    truth, rng = course(STRAND), np.random.default_rng(11)
    bench = Bench(tmp_path, {**STRAND, "wear": {"specific_wear_rate_mm2_per_N": 3e-10}})
    held = np.zeros(2)
    errors = []
    for _ in range(REPEATS):
        rows = depths(truth, (4.0, 9.0), (0.25, 0.5, 0.75), error, rng)
        found = calibrate(bench.case, readings(rows))
        (value,), (part,) = found.values, found.parts
        held += inside(value.interval, 1e-10), inside(part.interval, truth.hours)
        errors.append(np.log(value.value / 1e-10))
        assert value.interval.known
    assert np.all((held >= 0.85 * REPEATS) & (held <= 0.95 * REPEATS))
    assert abs(np.mean(errors)) < 3.0 * np.std(errors) / np.sqrt(REPEATS) + 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("error", [0.0005, 0.002, 0.004], ids=["0.5um", "2um", "4um"])
def test_intervals_of_two_values_hold_nine_of_ten(tmp_path, once, error):
    truth, rng = course(POWER), np.random.default_rng(12)
    bench = Bench(
        tmp_path, {**STRAND, "wear": {**POWER["wear"], "coefficient": 1e-9, "pressure_exponent": 1.0}}
    )
    options, held = CalibrationOptions(shapes=("wear.pressure_exponent",)), np.zeros(3)
    for _ in range(REPEATS):
        rows = depths(truth, (1.0, 4.0, 7.0, 10.0, 13.0), (0.3, 0.6, 0.9), error, rng)
        found = calibrate(bench.case, readings(rows), (), options)
        coefficient, exponent = found.values
        held += (
            inside(coefficient.interval, 1.2e-9),
            inside(exponent.interval, 0.7),
            inside(found.parts[0].interval, truth.hours),
        )
    assert np.all((held >= 0.85 * REPEATS) & (held <= 0.95 * REPEATS)), held


def scan(model, part, error, rng, turn, shift):
    """Points of the worn flank with errors across it, moved."""
    new = model.nominal
    places = np.linspace(0.02, 0.98, 300) * model.chords[-1]
    columns = (new.x, new.y, new.normal_x, new.normal_y)
    x, y, normal_x, normal_y = (np.interp(places, model.chords, one) for one in columns)
    off = rng.normal(0.0, error, places.size) - np.interp(places, model.chords, model.recess(part, 1))
    x, y = x + off * normal_x, y + off * normal_y
    c, s = np.cos(turn), np.sin(turn)
    return Profile(c * x - s * y + shift[0], s * x + c * y + shift[1])


@pytest.mark.slow
@pytest.mark.parametrize("freedom", ["turn", "free"])
def test_intervals_from_scans_hold_nine_of_ten(tmp_path, once, freedom):
    """Registration is part of what the intervals take into account."""
    fine = {**STRAND, "sprocket": {**STRAND["sprocket"], "nodes": 101}}
    truth, rng = course(fine), np.random.default_rng(13)
    bench, held, repeats = Bench(tmp_path, fine), 0, 100
    for _ in range(repeats):
        shift = rng.normal(0.0, 0.02, 2) if freedom == "free" else (0.0, 0.0)
        scans = []
        for part in (0.4, 0.9):
            points = scan(truth, part, 0.004, rng, rng.normal(0.0, 5e-4), shift)
            scans.append((part * truth.hours, 0.004, points.x, points.y))
        found = calibrate(bench.case, readings((), scans), (), CalibrationOptions(freedom=freedom))
        held += inside(found.values[0].interval, 1e-10)
    # Binomial, 100 repeats of 0.9: beyond these bounds in one of a thousand.
    assert 0.79 * repeats <= held <= 0.98 * repeats


def test_elongations_have_the_closed_form_of_a_line_through_zero(tmp_path):
    """Slope sum(h v/s^2)/sum(h^2/s^2), its error 1/sqrt(sum(h^2/s^2)); no run is needed."""
    bench = Bench(tmp_path, WRAP)
    hours, error = np.array([50.0, 90.0, 140.0]), np.array([0.05, 0.05, 0.1])
    values = np.array([0.51, 0.84, 1.45])
    rows = [(h, "elongation_percent", v, e, None) for h, v, e in zip(hours, values, error, strict=True)]
    found = bench.fit(rows)
    (value,), (part,) = found.values, found.parts
    weight = np.sum((hours / error) ** 2)
    slope, spread = np.sum(hours * values / error**2) / weight, 1.6449 / np.sqrt(weight)
    assert part.life == pytest.approx(part.life * slope / slope)
    limit = 100.0 * wearsim.load_case(copy.deepcopy(WRAP)).drive.joint.elongation_limit
    assert part.life == pytest.approx(limit / slope, rel=1e-5)
    assert part.interval.low == pytest.approx(limit / (slope + spread), rel=1e-4)
    assert part.interval.high == pytest.approx(limit / (slope - spread), rel=1e-4)
    assert part.remaining == pytest.approx(limit / slope - 140.0, rel=1e-5)
    assert value.value / part.life**-1 == pytest.approx(
        value.in_case * wearsim.simulate(wearsim.load_case(copy.deepcopy(WRAP))).parts["chain"].hours,
        rel=1e-5,
    )
    assert found.runs == 0


@pytest.mark.slow
def test_teeth_and_chain_of_a_wrap_are_told_apart(tmp_path):
    truth = {
        **WRAP,
        "wear": {"specific_wear_rate_mm2_per_N": 1.4e-9},
        "joint": {"specific_wear_rate_mm2_per_N": 1e-8},
    }
    result = wearsim.simulate(wearsim.load_case(copy.deepcopy(truth)))
    model = courses.PredictedHistory(result)
    chain = result.parts["chain"].hours
    rows = [
        (part * model.hours, "max_depth_mm", model.history("max_depth_mm", part), 0.0005, None)
        for part in (0.4, 0.8)
    ]
    rows += [(part * chain, "elongation_percent", part * 3.0, 0.02, None) for part in (0.3, 0.6)]
    found = Bench(tmp_path, WRAP).fit(rows)
    teeth, joints = found.values
    assert teeth.value == pytest.approx(1.4e-9, rel=0.05)
    assert joints.value == pytest.approx(1e-8, rel=1e-4)
    assert inside(teeth.interval, 1.4e-9)
    assert [part.name for part in found.parts] == ["sprocket", "chain"]
    assert found.runs > 1


def test_pins_tell_the_coefficient_of_a_wrap(tmp_path):
    model = course(WRAP)
    fall = model.history("over_pins_mm", 0.0) - model.history("over_pins_mm", 0.5)
    found = Bench(tmp_path, WRAP).fit([(0.25 * model.hours, "over_pins_mm", fall, 1e-5, None)])
    # On this form pins stand where hardly anything wears: 0.2 um, known to a few percent.
    assert found.values[0].value == pytest.approx(2e-9, rel=0.05)
    assert any("as many fitted values as readings" in text for text in found.warnings)


def test_gears_are_calibrated_by_the_pinion(tmp_path):
    model = course(GEARS)
    deepest = float(
        model.arc_length[model.result.flank_columns["depth_mm"][-model.arc_length.size :].argmax()]
    )
    rows = depths(model, (deepest,), (0.4, 0.8), 1e-5, np.random.default_rng(1))
    found = Bench(tmp_path, GEARS).fit(rows, overrides=("wear.specific_wear_rate_mm2_per_N=3e-9",))
    assert found.values[0].value == pytest.approx(1e-9, rel=1e-3)
    assert found.parts[0].name == "pinion"


def test_slip_and_coefficient_cannot_be_told_apart_but_the_life_is_known(tmp_path):
    """On a strand wear goes with their product only."""
    truth = course(STRAND)
    rows = depths(truth, (4.0, 9.0), (0.3, 0.6, 0.9), 0.001, np.random.default_rng(2))
    bench = Bench(tmp_path, STRAND)
    alone = bench.fit(rows)
    both = bench.fit(rows, CalibrationOptions(shapes=("mechanism.roller_slip_fraction",)))
    assert any(
        "cannot tell wear.specific_wear_rate_mm2_per_N and mechanism.roller_slip_fraction apart" in text
        for text in both.warnings
    )
    assert not alone.warnings
    assert not both.values[1].interval.known
    # The slip is at most 1, so that the coefficient is at least that of the fit with 1.
    assert both.values[0].interval.low == pytest.approx(alone.values[0].interval.low, rel=1e-3)
    for one, other in zip(both.parts, alone.parts, strict=True):
        assert one.life == pytest.approx(other.life, rel=1e-4)
        assert one.interval.low == pytest.approx(other.interval.low, rel=1e-3)
        assert one.interval.high == pytest.approx(other.interval.high, rel=1e-3)


def test_exponent_needs_more_than_one_place(tmp_path):
    """One point says nothing about how wear goes with pressure; five along the flank do."""
    truth, rng = course(POWER), np.random.default_rng(4)
    bench, options = Bench(tmp_path, POWER), CalibrationOptions(shapes=("wear.pressure_exponent",))
    one = bench.fit(depths(truth, (9.0,), (0.1, 0.2), 0.002, rng), options)
    assert any("wear.pressure_exponent" in text for text in one.warnings)
    places = (1.0, 4.0, 7.0, 10.0, 13.0)
    several = bench.fit(depths(truth, places, (0.3, 0.6, 0.9), 0.001, rng), options)
    assert several.values[1].value == pytest.approx(0.7, abs=0.1)
    assert not several.warnings


def test_values_that_were_fitted_give_the_life_that_was_told(tmp_path):
    truth = course(POWER)
    bench = Bench(tmp_path, {**POWER, "wear": {**POWER["wear"], "pressure_exponent": 0.8}})
    rows = depths(truth, (1.0, 7.0, 13.0), (0.5, 0.9), 0.001, np.random.default_rng(5))
    found = bench.fit(rows, CalibrationOptions(shapes=("wear.pressure_exponent",)))
    again = wearsim.simulate(wearsim.load_case(dict(found.tables)))
    assert again.life.hours == pytest.approx(found.parts[0].life, rel=2e-3)


KINDS = {
    **WRAP,
    "sprocket": {"teeth": 20, "profile": "ansi_b29", "nodes": 51},
    "drive": {"mate_teeth": 40, "links": 100},
}


def test_gaps_of_two_kinds_are_told_apart(tmp_path, once):
    model = course(KINDS)
    assert model.kinds == 2
    deepest = [model.deepest(0.4, kind) for kind in (1, 2)]
    assert max(deepest) == pytest.approx(model.history("max_depth_mm", 0.4), rel=1e-2)
    bench, hours = Bench(tmp_path, KINDS), 0.4 * model.hours
    for kind, value in ((1, deepest[0]), (2, deepest[1]), (None, max(deepest))):
        rows = [(hours, "max_depth_mm", value, 1e-5, np.nan)]
        found = calibrate(bench.case, readings(rows, kind=kind))
        assert found.values[0].value == pytest.approx(1e-9, rel=0.02), kind
    with pytest.raises(CaseError, match="gap_kind is needed, as the gaps of this drive wear in 2"):
        calibrate(bench.case, readings([(1.0, "depth_mm", 0.01, 0.01, 1.0)]))


@pytest.mark.slow
def test_told_life_is_that_of_the_case_that_was_fitted(tmp_path):
    """The joints wear three times as fast as the case says, so that the ratio must be followed."""
    truth = {**WRAP, "joint": {"specific_wear_rate_mm2_per_N": 4.5e-8}}
    result = wearsim.simulate(wearsim.load_case(copy.deepcopy(truth)))
    model = courses.PredictedHistory(result)
    rows = [
        (part * model.hours, "max_depth_mm", model.history("max_depth_mm", part), 1e-4, None)
        for part in (0.4, 0.8)
    ]
    rows.append((0.5 * result.parts["chain"].hours, "elongation_percent", 1.5, 1e-3, None))
    found = Bench(tmp_path, WRAP).fit(rows)
    assert found.values[0].value == pytest.approx(1e-9, rel=0.01)
    again = wearsim.simulate(wearsim.load_case(dict(found.tables)))
    assert again.parts["sprocket"].hours == pytest.approx(found.parts[0].life, rel=5e-3)
    assert again.parts["chain"].hours == pytest.approx(found.parts[1].life, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("start", [(3.5, 2e-18), (4.8, 1e-13), (1.0, 1e-9)])
def test_the_answer_does_not_depend_on_the_start(tmp_path, start):
    truth, rng = course(POWER), np.random.default_rng(6)
    rows = depths(truth, (1.0, 7.0, 13.0), (0.3, 0.6, 0.9), 0.002, rng)
    exponent, coefficient = start
    wear = {"law": "power", "coefficient": coefficient, "pressure_exponent": exponent}
    bench = Bench(tmp_path, {**POWER, "wear": wear})
    options = CalibrationOptions(shapes=("wear.pressure_exponent",), confidence=0.99)
    found, known = bench.fit(rows, options), Bench(tmp_path, POWER).fit(rows, options)
    assert found.values[1].value == pytest.approx(known.values[1].value, abs=2e-3)
    assert found.parts[0].life == pytest.approx(known.parts[0].life, rel=2e-4)
    assert inside(found.values[1].interval, 0.7)
    assert inside(found.parts[0].interval, truth.hours)
    assert found.values[1].interval.known
    assert not any("band" in text for text in found.warnings)


@pytest.mark.parametrize(
    "slip", [0.98, *(pytest.param(slip, marks=pytest.mark.slow) for slip in (0.1, 1e-4))]
)
def test_slip_is_searched_up_to_its_ends(tmp_path, slip):
    truth = course(STRAND)
    rows = depths(truth, (4.0, 9.0), (0.3, 0.9), 0.001, np.random.default_rng(7))
    bench = Bench(tmp_path, {**STRAND, "mechanism": {"roller_slip_fraction": slip}})
    found = bench.fit(rows, CalibrationOptions(shapes=("mechanism.roller_slip_fraction",)))
    assert found.parts[0].life == pytest.approx(truth.hours, rel=0.02)
    assert any("apart" in text for text in found.warnings)
