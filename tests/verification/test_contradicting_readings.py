"""Readings that exclude each other, or the band of their case: named by how many standard errors."""

import math
import re

import pytest
from scipy.stats import norm

import wearsim
from tests.drives import ROAD_BICYCLE, changed
from wearsim.readings.chain_readings import ChainReading, side_of_mark
from wearsim.readings.contradictions import CHAIN, WearReading, contradictions
from wearsim.readings.posterior import LEVELS, FactorPrior, factor_posterior

ROAD = changed(ROAD_BICYCLE, {"title": "Road bicycle, 50 to 17 teeth", "stop.elongation_percent": 1.5})
TAKE_OFF = {
    "format_version": 1,
    "title": "Take-off roll",
    "chain": {"designation": "ANSI 80"},
    "sprocket": [
        {"name": "motor", "role": "driver", "teeth": 17, "profile": "ansi_b29", "nodes": 51},
        {"name": "roll", "teeth": 34, "profile": "ansi_b29", "nodes": 51},
    ],
    "drive": {"links": 100},
    "load": {"power_kW": 8, "speed_rpm": 200},
    "wear": {"condition": "hardened, oiled"},
}
JOINT = "joint.specific_wear_rate_mm2_per_N"


def ruler(km, value, error=0.1):
    """Length over 24 links, 304.8 mm when new; 0.1 mm are 0.0328 %."""
    cells = {"quantity": "chain_length_mm", "value": value, "links": 24, "result": "", "error": error}
    return {"distance_km": km, **cells}


def gauge(km, mark, result, error=0.02):
    return {"distance_km": km, "quantity": "gauge_percent", "value": mark, "result": result, "error": error}


def percent(value):
    return 100.0 * (value / 304.8 - 1.0)


ONE, MARK = 100.0 * 0.1 / 304.8, 0.02
"""Errors of a ruler and of a gauge [%]."""

PAIRS = {
    "ruler above go": ([ruler(2000, 309.0), gauge(2000, 0.75, "go")], (percent(309.0) - 0.75, ONE, MARK)),
    "ruler below no-go": (
        [gauge(2000, 0.75, "no-go"), ruler(2000, 306.0)],
        (0.75 - percent(306.0), ONE, MARK),
    ),
    "two rulers": ([ruler(2000, 307.0), ruler(2000, 306.0)], (100.0 / 304.8, ONE, ONE)),
    # Twice the way is twice the wear.
    "go later": (
        [ruler(1000, 307.0), gauge(2000, 0.75, "go")],
        (2.0 * percent(307.0) - 0.75, 2.0 * ONE, MARK),
    ),
    "no-go before": (
        [gauge(1000, 0.75, "no-go"), ruler(2000, 308.0)],
        (1.5 - percent(308.0), ONE, 2.0 * MARK),
    ),
    "shorter": (
        [ruler(1000, 307.0), ruler(2000, 306.0)],
        (2.0 * percent(307.0) - percent(306.0), 2.0 * ONE, ONE),
    ),
    "too fast": (
        [ruler(1000, 305.0), ruler(2000, 307.0)],
        (percent(307.0) - 2.0 * percent(305.0), ONE, 2.0 * ONE),
    ),
    "gauge comes out": ([gauge(1000, 0.75, "no-go"), gauge(2000, 0.5, "go")], (1.0, 2.0 * MARK, MARK)),
}
AGREEING = {
    "within three errors": [ruler(2000, 307.0), ruler(2000, 306.7)],
    "gauge says no more": [ruler(2000, 307.0), gauge(2000, 0.75, "go"), gauge(2000, 0.5, "no-go")],
    "go and later no-go": [gauge(1000, 0.5, "go"), gauge(2000, 0.75, "no-go")],
    "wide error of a gauge": [ruler(2000, 309.0), gauge(2000, 0.75, "go", 0.25)],
    "growth": [ruler(1000, 305.6), ruler(2000, 306.4)],
}


def named(found):
    """Lines and standard errors of the warnings that name two readings."""
    form = r"line (\d+): .* contradicts .* in line (\d+).* by ([\d.]+) standard errors"
    matches = [re.match(form, text) for text in found.warnings]
    return [(int(one[1]), int(one[2]), float(one[3])) for one in matches if one]


@pytest.mark.parametrize(("rows", "apart"), PAIRS.values(), ids=PAIRS)
def test_two_readings_that_exclude_each_other_are_named(rows, apart):
    gap, *errors = apart
    found = wearsim.remaining(ROAD, readings=rows).found
    assert named(found) == [(3, 2, pytest.approx(gap / math.hypot(*errors), rel=5e-3))]


@pytest.mark.parametrize("rows", AGREEING.values(), ids=AGREEING)
def test_readings_that_agree_are_not(rows):
    found = wearsim.remaining(ROAD, readings=rows).found
    assert named(found) == []
    assert found.posterior.scale == 1.0


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("ruler above go", "go at 0.75 % contradicts 1.378 % in line 2: they exclude"),
        ("shorter", "chains do not become shorter"),
        ("gauge comes out", "chains do not become shorter"),
        ("too fast", "at one rate of wear, and the fit misses them by"),
    ],
)
def test_the_warning_says_what_is_wrong(name, words):
    found = wearsim.remaining(ROAD, readings=PAIRS[name][0]).found
    assert any(words in text for text in found.warnings)


def test_the_fit_misses_ruler_and_gauge_by_14_and_8_errors():
    """Weights of 1/0.0328^2 and 1/0.02^2 give 0.92 %: 0.458/0.0328 = 14.0 and 0.170/0.02 = 8.5."""
    (text, *_) = wearsim.remaining(ROAD, readings=PAIRS["ruler above go"][0]).found.warnings
    assert "the fit misses them by 8.51 and 14:" in text


@pytest.mark.parametrize("name", ["ruler above go", "two rulers"])
def test_the_interval_holds_both_readings(name):
    rows, _ = PAIRS[name]
    found = wearsim.remaining(ROAD, readings=rows).found
    low, *_, high = found.of("elongation_percent").values
    values = [row["value"] if row["quantity"] == "gauge_percent" else percent(row["value"]) for row in rows]
    assert low < min(values) < max(values) < high


def test_errors_that_are_too_small_make_a_log_normal_factor():
    """Of 1.0 and 0.6 with errors of 0.04 and 0.03: mean 0.744, error 0.024, apart by 8 = 0.4/0.05."""
    readings = [
        ChainReading(2, 1.0, "elongation_percent", 1.0, 1.0, 0.04),
        side_of_mark(3, 1.0, 0.6, "go", 0.03),
    ]
    found = factor_posterior(readings, [1.0, 1.0], FactorPrior(1e-6, 1e6))
    mean, error = (1.0 / 0.04**2 + 0.6 / 0.03**2) / (1.0 / 0.04**2 + 1.0 / 0.03**2), 0.024
    assert (found.nearest, found.scale) == pytest.approx((mean, 8.0), rel=1e-9)
    logs = norm.ppf(LEVELS, math.log(mean), 8.0 * error / mean)
    assert found.quantiles == pytest.approx([math.exp(one) for one in logs], rel=5e-3)


def test_more_readings_are_held_against_more_chance():
    """One pair counts from 3 errors on, each of ten from 3.64 on: to chance both leave 0.27 %."""

    def reading(line, value):
        return WearReading(line, 100.0, CHAIN, value, value, 0.01 / math.sqrt(2.0), 1.0, "")

    alone = [reading(1, 1.0), reading(2, 1.032)]
    assert [one.errors for one in contradictions(alone)] == [pytest.approx(3.2)]
    between = [reading(line, 1.016) for line in (3, 4, 5)]
    assert contradictions(alone + between) == []
    assert len(contradictions([reading(1, 1.0), reading(2, 1.037), *between])) == 1


def test_one_slip_among_many_readings_does_not_fill_the_page():
    rows = [ruler(500 * i, 304.8 + 0.4 * i) for i in range(1, 7)]
    rows[3] = ruler(2000, 309.0)
    found = wearsim.remaining(ROAD, readings=rows).found
    assert len(named(found)) == 3
    assert {5} < {line for pair in named(found) for line in pair[:2]}
    assert any(re.match(r"\d more pairs of readings exclude each other, by ", one) for one in found.warnings)


@pytest.mark.parametrize("limit", [0.75, 1.5])
def test_a_gauge_beyond_the_limit_does_not_overrule_a_ruler(limit):
    """0.36 % by a ruler, no-go at 0.8 %: both weigh, as named; the middle lies between them."""
    tables = {**ROAD, "stop": {"elongation_percent": limit}}
    found = wearsim.remaining(tables, readings=[ruler(2500, 305.9), gauge(2500, 0.8, "no-go", 0.05)]).found
    assert percent(305.9) < found.of("elongation_percent").middle < 0.8
    assert found.of("remaining_hours").middle > 0.0
    assert named(found) == [(3, 2, pytest.approx((0.8 - percent(305.9)) / math.hypot(ONE, 0.05), rel=5e-3))]


def test_the_error_of_a_gauge_beyond_the_limit_counts():
    tables = {**ROAD, "stop": {"elongation_percent": 0.75}}
    rows = [ruler(2500, 306.7), gauge(2500, 0.8, "no-go", 0.2)]
    found = wearsim.remaining(tables, readings=rows).found
    assert named(found) == []
    assert found.of("elongation_percent").middle == pytest.approx(percent(306.7), abs=0.02)


def test_a_gauge_beyond_the_limit_that_nothing_denies_ends_the_life():
    tables = {**ROAD, "stop": {"elongation_percent": 0.75}}
    rows = [ruler(1000, 305.8), gauge(2500, 0.8, "no-go")]
    with pytest.raises(wearsim.CaseError, match=r"3: value: no-go at 0.8 % says that the limit"):
        wearsim.remaining(tables, readings=rows)


def test_calibrate_names_them_too():
    pytest.importorskip("pandera", reason="pandera is not installed")
    for rows, (gap, *errors) in (PAIRS["ruler above go"], PAIRS["two rulers"], PAIRS["shorter"]):
        found = wearsim.calibrate(ROAD, rows).found
        assert named(found) == [(3, 2, pytest.approx(gap / math.hypot(*errors), rel=5e-3))]
        assert found.scale > 3.0
        assert found.freedom == 1


STRAND = {
    "format_version": 1,
    "title": "strand",
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 41},
    "load": {"tension_N": 5000, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
    "stop": {"critical_depth_mm": 0.3},
}


def depth(hours, value, quantity="max_depth_mm"):
    return {"time_hours": hours, "quantity": quantity, "value": value, "error": 0.004}


def test_calibrate_names_readings_of_teeth_that_exclude_each_other():
    """0.12 and 0.06 mm at one time, with errors of 0.004 mm: 0.06/(0.004 sqrt 2) = 10.6."""
    pytest.importorskip("pandera", reason="pandera is not installed")
    found = wearsim.calibrate(STRAND, [depth(900, 0.12), depth(900, 0.06)]).found
    assert named(found) == [(3, 2, 10.6)]
    again = wearsim.calibrate(STRAND, [depth(900, 0.12), depth(1800, 0.06)]).found
    assert any("wear does not grow back" in text for text in again.warnings)
    sound = wearsim.calibrate(STRAND, [depth(900, 0.06), depth(1800, 0.12)]).found
    assert named(sound) == []


ELONGATED = {"time_hours": 900, "quantity": "elongation_percent", "value": 2.9, "error": 0.1}


def asked(texts):
    form = r"the readings imply ([\d.]+) times the joints' wear coefficient of the case, outside its band of"
    return [float(one[1]) for one in (re.match(form, text) for text in texts) if one]


def test_a_rate_outside_the_band_is_warned_of_on_every_way_in():
    drive = wearsim.load_case(TAKE_OFF)
    single = wearsim.remaining(drive, 900, elongation_percent=2.9, error=0.1).found
    several = wearsim.remaining(drive, readings=[ELONGATED]).found
    assert single.factor > 3.0
    assert asked(single.warnings) == asked(several.warnings) == [pytest.approx(single.factor, rel=5e-3)]
    pytest.importorskip("pandera", reason="pandera is not installed")
    fitted = wearsim.calibrate(drive, [ELONGATED])
    assert asked(fitted.found.warnings) == [pytest.approx(single.factor, rel=5e-3)]
    assert asked(fitted.summary()["warnings"]) == asked(fitted.found.warnings)


def test_a_rate_inside_the_band_is_not():
    factor = wearsim.remaining(TAKE_OFF, 900, elongation_percent=2.9, error=0.1).found.factor
    usual = {**ELONGATED, "value": 2.9 / factor, "error": 0.1 / factor}
    assert asked(wearsim.remaining(TAKE_OFF, readings=[usual]).found.warnings) == []
    pytest.importorskip("pandera", reason="pandera is not installed")
    assert asked(wearsim.calibrate(TAKE_OFF, [usual]).found.warnings) == []


def test_a_calibrated_case_is_believed():
    """Of a whole drive, whose teeth keep their condition: no doubt, the life that was told, its interval."""
    pytest.importorskip("pandera", reason="pandera is not installed")
    fitted = wearsim.calibrate(TAKE_OFF, [ELONGATED])
    (part,), (value,) = fitted.found.parts, fitted.found.values
    case = fitted.case
    assert not any("contradicts" in text for text in case.warnings)
    again = wearsim.remaining(case, 900, elongation_percent=2.9, error=0.1).found
    assert again.factor == pytest.approx(1.0, rel=1e-6)
    assert asked(again.warnings) == []
    assert again.model_hours * 3.0 / 2.9 == pytest.approx(part.life, rel=1e-6)
    band = max(value.interval.high / value.value, value.value / value.interval.low)
    assert fitted.found.tables["joint"]["band_factor"] == pytest.approx(band)
    typed = case.with_({JOINT: 30.0 * value.value})
    assert any("contradicts" in text for text in typed.warnings)


@pytest.mark.parametrize("tables", [ROAD, TAKE_OFF], ids=["one sprocket", "drive"])
def test_before_any_reading_the_band_is_that_of_the_life(tables):
    """A gauge of 10 % that does not fall in after an hour says nothing."""
    row = {"time_hours": 1, "quantity": "gauge_percent", "value": 10, "result": "go"}
    found = wearsim.remaining(tables, readings=[row]).found
    band = found.case.drive.wear_band("chain", found.case.wear)
    low, *_, high = found.of("coefficient_factor").values
    assert (low, high) == pytest.approx((band.low, band.high), rel=2e-3)
