"""What readings leave of a chain's life: closed forms, and how often intervals hold the truth."""

import copy
import math
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import norm, truncnorm

import wearsim
from tests.drives import FAST_WRAP, changed
from wearsim.readings.chain_readings import side_of_mark
from wearsim.readings.chain_state import chain_state
from wearsim.readings.posterior import LEVELS, FactorPrior, factor_posterior

WRAP = changed(FAST_WRAP, {"stop.elongation_percent": 3, "service": {"km_per_hour": 30, "hours_per_day": 8}})
CELLS = "quantity,value,links,result,error"
BAND = 3.0
"""Factor to either side, the default band: 90 % of a log-normal distribution."""

SIGMA = math.log(BAND) / norm.ppf(0.95)


def case(**tables):
    changed = copy.deepcopy(WRAP)
    for table, keys in tables.items():
        changed.setdefault(table, {}).update(keys)
    return wearsim.load_case(changed)


@pytest.fixture(scope="module")
def drive():
    """The case, and the hours in which its chain grows by 3 %."""
    loaded = case()
    return loaded, wearsim.remaining(loaded, 1.0, elongation_percent=3).found.model_hours


@pytest.fixture
def table(tmp_path):
    """Function that writes readings."""

    def write(*rows, head=f"time_hours,{CELLS}"):
        path = tmp_path / "readings.csv"
        path.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
        return path

    return write


def quantiles(found, name):
    return dict(zip(LEVELS, found.of(name).values, strict=True))


def test_one_sharp_reading_is_the_rule_of_three(drive, table):
    """0.6 % after 500 h is 3 % after 2500 h: 2000 h are left."""
    loaded, life = drive
    found = chain_state(loaded, table("500,elongation_percent,0.6,,,1e-6"))
    assert found.of("remaining_hours").middle == pytest.approx(2000.0, rel=1e-5)
    assert found.of("life_hours").middle == pytest.approx(2500.0, rel=1e-5)
    assert found.of("elongation_percent").middle == pytest.approx(0.6, rel=1e-5)
    assert found.of("coefficient_factor").middle == pytest.approx(life / 2500.0, rel=1e-5)
    assert found.of("remaining_km").middle == pytest.approx(60000.0, rel=1e-5)
    single = wearsim.remaining(loaded, 500, elongation_percent=0.6)
    assert found.of("remaining_hours").middle == pytest.approx(single.remaining.hours, rel=1e-5)


def test_a_length_over_links_is_an_elongation(drive, table):
    """100 links of 12.7 mm are 1270 mm; 1277.62 mm are 0.6 % more, and 0.0127 mm are 0.001 %."""
    loaded, _ = drive
    length = chain_state(loaded, table("500,chain_length_mm,1277.62,100,,0.0127"))
    percent = chain_state(loaded, table("500,elongation_percent,0.6,,,0.001"))
    for one, other in zip(length.quantiles, percent.quantiles, strict=True):
        assert one.values == pytest.approx(other.values, rel=1e-9)


def test_km_and_days_are_hours(drive, table):
    """30 km/h and 8 h a day: 500 h are 15 000 km; 62.5 days of 8 h end in the 63rd day."""
    loaded, _ = drive
    hours = chain_state(loaded, table("496,elongation_percent,0.6,,,0.03"))
    km = chain_state(loaded, table("14880,elongation_percent,0.6,,,0.03", head=f"distance_km,{CELLS}"))
    days = chain_state(
        loaded, table("2026-01-01,new,,,,", "2026-03-04,elongation_percent,0.6,,,0.03", head=f"date,{CELLS}")
    )
    assert km.of("life_hours").values == pytest.approx(hours.of("life_hours").values, rel=1e-12)
    assert days.of("life_hours").values == pytest.approx(hours.of("life_hours").values, rel=1e-12)
    lasting = [np.timedelta64(int(life / 8.0), "D") for life in hours.of("life_hours").values]
    ends = [np.datetime64("2026-01-01") + span for span in lasting]
    assert days.of("end_date").values == tuple(str(day) for day in ends)


def test_readings_without_a_band_are_least_squares():
    """v = f p with errors s: f is the weighted mean, its error 1/sqrt(sum(p/s)^2)."""
    values, at, errors = np.array([0.31, 0.58, 0.95]), np.array([0.3, 0.6, 0.9]), np.array([0.01, 0.02, 0.01])
    readings = [reading(value, error) for value, error in zip(values, errors, strict=True)]
    found = factor_posterior(readings, at, FactorPrior(1e-4, 1e4))
    information = float(((at / errors) ** 2).sum())
    factor = float((at * values / errors**2).sum()) / information
    # Of a density flat in the logarithm the middle is lower by (s/f)^2.
    error = 1.0 / math.sqrt(information)
    expected = norm.ppf(LEVELS, factor - error**2 / factor, error)
    assert found.quantiles == pytest.approx(expected, rel=2e-5)
    assert found.scale == 1.0


def reading(value, error):
    from wearsim.readings.chain_readings import ChainReading

    return ChainReading(2, 1.0, "elongation_percent", value, value, error)


@pytest.mark.parametrize(
    ("result", "cut"), [("go", (-math.inf, math.log(1.5))), ("no-go", (math.log(1.5), math.inf))]
)
def test_a_gauge_cuts_the_band_off_at_its_mark(result, cut):
    """A gauge of 0.75 % where 0.5 % was expected: what of the band lies below or above 1.5."""
    found = factor_posterior([side_of_mark(2, 1.0, 0.75, result, 1e-7)], [0.5], FactorPrior(1 / BAND, BAND))
    ends = [end / SIGMA for end in cut]
    expected = np.exp(truncnorm.ppf(LEVELS, *ends, scale=SIGMA))
    assert found.quantiles == pytest.approx(expected, rel=2e-3)


def test_a_gauge_on_its_own_leaves_a_wide_interval(drive, table):
    """Of the band of a factor of 9 more than a factor of 3 is left."""
    loaded, life = drive
    found = quantiles(chain_state(loaded, table(f"{0.2 * life},gauge_percent,0.75,,go,")), "life_hours")
    assert 3.0 < found[0.95] / found[0.05] < 9.0


def test_two_gauges_are_an_interval(drive, table):
    """Below 0.5 % after 1000 h, 0.75 % or more after 1600 h: 3 % after 6000 to 6400 h."""
    loaded, _ = drive
    found = chain_state(
        loaded, table("1000,gauge_percent,0.5,,go,1e-6", "1600,gauge_percent,0.75,,no-go,1e-6")
    )
    low, *_, high = found.of("life_hours").values
    assert 6000.0 < low < high < 6400.0


def drives(loaded, life, seed, write, times, reading_of):
    """How many of 200 random drives have a life in the intervals of 50 and 90 %."""
    random = np.random.default_rng(seed)
    inside = np.zeros(2)
    for _ in range(200):
        truth = life / math.exp(random.normal(0.0, SIGMA))
        rows = [reading_of(random, part * life, 3.0 * part * life / truth) for part in times]
        low, lower, _, upper, high = chain_state(loaded, write(*rows)).of("life_hours").values
        inside += lower < truth < upper, low < truth < high
    return inside


def measured(random, hours, percent):
    """A length over 40 links, read to 0.5 mm, and a reading in per cent, by turns."""
    if random.random() < 0.5:
        return f"{hours},chain_length_mm,{508.0 * (1.0 + 0.01 * percent) + random.normal(0.0, 0.5)},40,,0.5"
    return f"{hours},elongation_percent,{percent + random.normal(0.0, 0.1)},,,0.1"


def gauged(random, hours, percent):
    """A gauge of 0.5 or of 0.75 %, whose mark is off by 0.03 % at random."""
    mark = random.choice([0.5, 0.75])
    result = "no-go" if percent + random.normal(0.0, 0.03) >= mark else "go"
    return f"{hours},gauge_percent,{mark},,{result},0.03"


PAGE = Path(__file__).parents[2] / "docs/howto_measured_sprocket.md"
TOLD = r"(\d+) lives and\s+those of 50 % hold (\d+) where lengths.*?, (\d+) and (\d+) where gauges were"


@pytest.mark.wide
@pytest.mark.parametrize(
    ("reading_of", "seed", "told"), [(measured, 1, (0, 1)), (gauged, 2, (2, 3))], ids=["measured", "gauges"]
)
def test_intervals_hold_the_truth_as_often_as_they_say(drive, table, reading_of, seed, told):
    """200 drives whose coefficient scatters over the band of the case: 90 % of lives, within 85 to 95 %.

    The page has the same numbers, but for a life that lies on an end.
    """
    half, most = drives(*drive, seed, table, (0.05, 0.1, 0.15), reading_of)
    assert 170 <= most <= 190
    assert 80 <= half <= 120
    numbers = re.search(TOLD, PAGE.read_text("utf-8"), flags=re.S).groups()
    assert [most, half] == pytest.approx([float(numbers[i]) for i in told], abs=1)


def test_readings_off_one_line_widen_the_intervals(drive, table):
    """Three readings that jump by ten errors: errors are taken so much larger, and it is said."""
    loaded, _ = drive
    rows = [
        f"{hours},elongation_percent,{value},,,0.01"
        for hours, value in ((500, 0.5), (1000, 1.3), (1500, 1.5))
    ]
    found = chain_state(loaded, table(*rows))
    assert found.posterior.scale > 5.0
    assert any("as much as their errors say" in text for text in found.warnings)


def test_a_gauge_that_comes_out_again_is_named(drive, table):
    loaded, _ = drive
    found = chain_state(loaded, table("900,gauge_percent,0.75,,no-go,", "1000,gauge_percent,0.5,,go,"))
    (text,) = (text for text in found.warnings if "contradicts" in text)
    assert "line 3: go at 0.5 % contradicts no-go at 0.75 % in line 2" in text


def test_running_in_counts(table):
    """A factor of 3 over many cycles: the coefficient that explains a reading is a third, and then some."""
    slow = case(wear={"running_in_factor": 3.0, "running_in_distance_mm": 1e12})
    plain, running = (
        chain_state(one, table("500,elongation_percent,0.6,,,1e-6")).of("coefficient_factor").middle
        for one in (case(), slow)
    )
    assert running == pytest.approx(plain / 3.0, rel=1e-3)


OILED = {"lubrication": {"lasts_hours": 100.0, "dry_factor": 4.0}}
"""100 h at 1, then dry at 4 times that, at once."""


def test_relubrications_count_and_go_on(table):
    """Every 150 h: 100 + 50 times 4 are 300 steady hours. 0.6 % after two of these are 0.001 % an hour.

    The limit of 3 % is 3000 of them, ten intervals or 1500 h.
    """
    found = chain_state(
        case(**OILED),
        table("150,relubrication,,,,", "300,relubrication,,,,", "300,elongation_percent,0.6,,,1e-6"),
    )
    assert found.of("life_hours").middle == pytest.approx(1500.0, rel=1e-5)
    assert found.of("remaining_hours").middle == pytest.approx(1200.0, rel=1e-5)
    assert found.course[-1] > found.limit / found.posterior.quantiles[0]
    at = np.interp(300.0, found.course_hours, found.course) * found.posterior.quantiles[2]
    assert at == pytest.approx(0.6, rel=1e-2)


def test_an_overdue_relubrication_happens_on_the_day_of_the_last_row(table):
    """Once after 150 h, read after 400 h: 300 + 100 + 150 times 4 are 1000 steady hours for 1 %.

    2000 are left from fresh, in intervals of 200 h, two in these 400, with 100 + 400 each.
    """
    found = chain_state(case(**OILED), table("150,relubrication,,,,", "400,elongation_percent,1.0,,,1e-6"))
    assert found.of("remaining_hours").middle == pytest.approx(800.0, rel=1e-5)
    assert any("no relubrication was logged in the last 250 h" in text for text in found.warnings)


def test_two_relubrications_of_one_day_are_one(table):
    rows = "150,relubrication,,,,", "400,elongation_percent,1.0,,,1e-6"
    once, twice = (chain_state(case(**OILED), table(*of)) for of in (rows, (rows[0], *rows)))
    assert twice.of("remaining_hours") == once.of("remaining_hours")


def test_a_programme_beside_a_log_is_named(table):
    programme = {**OILED["lubrication"], "phase": [{"hours": 50, "contamination_factor": 3}]}
    with pytest.raises(wearsim.CaseError, match=r"programme of its own: remove \[\[lubrication.phase"):
        chain_state(
            case(lubrication=programme), table("150,relubrication,,,,", "400,elongation_percent,1.0,,,1e-6")
        )


def test_without_a_log_the_schedule_of_the_case_holds(table):
    """Never relubricated: 100 h, then four times as fast. 0.7 % after 250 h is 1 % after 325 h."""
    dry = case(**OILED, stop={"elongation_percent": 1})
    found = chain_state(dry, table("250,elongation_percent,0.7,,,1e-6"))
    assert found.of("life_hours").middle == pytest.approx(325.0, rel=1e-5)
    often = case(lubrication={**OILED["lubrication"], "interval_hours": 50})
    found = chain_state(often, table("500,elongation_percent,0.6,,,1e-6"))
    assert found.of("life_hours").middle == pytest.approx(2500.0, rel=1e-5)


H = "time_hours"

BAD = [
    (
        "time_hours",
        ["0,new,,,,", "-5,elongation_percent,1,,,"],
        ":3: time_hours: must be a number of at least 0",
    ),
    (
        "time_hours",
        ["500,elongation_percent,0.6,,,", "400,relubrication,,,,"],
        ":3: time_hours: must not go backw",
    ),
    (
        "time_hours",
        ["500,gauge_percent,0.75,,maybe,"],
        ":2: result: must be go (the gauge does not fall in) or no",
    ),
    (H, ["500,gauge_percent,,,go,"], ":2: value: must be the mark of the gauge"),
    (H, ["500,gauge,0.75,,go,"], ":2: quantity: must be one of new, chain_length_mm"),
    (H, ["500,max_depth_mm,0.1,,,"], "wearsim calibrate takes readings of the teeth"),
    (H, ["500,chain_length_mm,1280,100.5,,"], ":2: links: must be the number of links from pin to pin"),
    (H, ["500,chain_length_mm,50 ells,100,,"], ":2: value: must be a length in mm"),
    (H, ["0,new,,,go,"], ":2: result: must be empty for new (got 'go')"),
    ("distance_km", ["100 kg,elongation_percent,0.6,,,"], "must be a number of at least 0 (got '100 kg')"),
    (
        "time_hours",
        ["500,chain_length_mm,1260,100,,"],
        ":2: value: must not be more than 3 errors shorter than new",
    ),
    (H, ["500,gauge_percent,0.75,100,go,"], ":2: links: must be empty for gauge_percent"),
    (H, ["500,elongation_percent,0.6,,,0"], ":2: error: must be a number above 0"),
    (
        "time_hours",
        ["500,elongation_percent,3.2,,,"],
        ":2: value: 3.2 % says that the limit of stop.elongation",
    ),
    (H, ["500,gauge_percent,3,,no-go,"], ":2: value: no-go at 3 % says that the limit"),
    (
        "time_hours",
        ["0,elongation_percent,0.1,,,"],
        ":2: time_hours: must be later than 0, when the chain was new",
    ),
    (H, ["0,new,,,,"], "must hold at least one reading of the chain"),
    (
        "time_hours",
        ["500,elongation_percent,0.6,,,", "500,new,,,,"],
        ":3: quantity: new must be the first row",
    ),
    (
        "time_hours",
        ["500,relubrication,,,,", "600,elongation_percent,0.6,,,"],
        "needs [lubrication] in the case: add lubricant = 'manual'",
    ),
    ("date", ["2026-02-30,elongation_percent,0.6,,,"], ":2: date: must be a day such as 2026-03-31"),
    ("date", ["500,elongation_percent,0.6,,,"], ":2: date: must be a day such as 2026-03-31"),
    ("distance_km", ["2026-02-03,elongation_percent,0.6,,,"], ":2: distance_km: must be a number of"),
    ("time_hours,date", ["5,2026-02-03,elongation_percent,0.6,,,"], ":1: must give the time in one column"),
    ("time", ["500,elongation_percent,0.6,,,"], "column 'time_hours' is missing"),
]


@pytest.mark.parametrize(("time", "rows", "message"), BAD, ids=range(len(BAD)))
def test_bad_rows_are_named(table, time, rows, message):
    with pytest.raises(wearsim.CaseError) as caught:
        chain_state(case(), table(*rows, head=f"{time},{CELLS}"))
    assert message in str(caught.value)


@pytest.mark.parametrize(("time", "key"), [("distance_km", "km_per_hour"), ("date", "hours_per_day")])
def test_km_and_days_need_their_key_of_service(table, time, key):
    unknown = case().with_({"service": None})
    rows = table("2026-01-01,new,,,,", head=f"{time},{CELLS}")
    with pytest.raises(wearsim.CaseError, match=rf"csv:1: {time}: needs service\.{key} in the case"):
        chain_state(unknown, rows)


def test_days_before_the_chain_was_new_are_named(table):
    dated = case(service={"start_date": "2026-05-01"})
    rows = table("2026-04-30,elongation_percent,0.6,,,", head=f"date,{CELLS}")
    with pytest.raises(wearsim.CaseError, match=r"not before service\.start_date = 2026-05-01"):
        chain_state(dated, rows)


@pytest.mark.parametrize("name", ["drip", "dry"])
def test_a_log_of_a_lubricant_that_is_not_renewed_is_named(table, name):
    rows = table("150,relubrication,,,,", "400,elongation_percent,1.0,,,")
    with pytest.raises(
        wearsim.CaseError,
        match=f"readings.csv:2: quantity: .*not lubrication.lubricant = '{name}': make it 'manual'",
    ):
        chain_state(case(lubrication={"lubricant": name}), rows)


def test_a_log_of_a_lubricant_that_lasts_nobody_knows_how_long_changes_no_wear(table):
    """The case without a log takes it to last, too."""
    greased = case(lubrication={"lubricant": "greased"})
    reading = "400,elongation_percent,1.0,,,"
    never, logged = (
        chain_state(greased, table(reading)),
        chain_state(greased, table("150,relubrication,,,,", reading)),
    )
    assert logged.of("life_hours").values == never.of("life_hours").values
    said = [
        [text for text in one.warnings if "'greased' lasts is not known" in text] for one in (never, logged)
    ]
    assert list(map(len, said)) == [0, 1]


def test_a_strand_has_no_chain_to_read(table):
    strand = wearsim.load_case("16b-20t-oiled")
    with pytest.raises(wearsim.CaseError, match="set kind = 'wrap'"):
        chain_state(strand, table("500,elongation_percent,0.6,,,"))


def fitted(rows, **tables):
    """Coefficient of the joints over the case's, and the ends of its interval, by ``calibrate``."""
    pytest.importorskip("pandera", reason="pandera is not installed")
    (value,) = wearsim.calibrate(case(**tables), rows).found.values
    return np.array([value.value, value.interval.low, value.interval.high]) / value.in_case


def test_calibrate_takes_lengths_km_and_days(drive):
    """1277.62 mm over 100 links are 0.6 %, 0.127 mm 0.01 %, 15 000 km 500 h, 63 days 504 h."""
    _, life = drive
    at = {"quantity": "elongation_percent", "value": 0.6, "error": 0.01}
    length = {"quantity": "chain_length_mm", "value": 1277.62, "error": 0.127, "links": 100}
    percent = fitted([{"time_hours": 500, **at}])
    assert percent[0] == pytest.approx(life * 0.6 / 3.0 / 500.0, rel=1e-6)
    assert fitted([{"time_hours": 500, **length}]) == pytest.approx(percent, rel=1e-6)
    assert fitted([{"distance_km": 15000, **at}]) == pytest.approx(percent, rel=1e-9)
    days = fitted([{"date": "2026-03-05", **at}], service={"start_date": "2026-01-01"})
    assert days == pytest.approx(percent * 500.0 / 504.0, rel=1e-6)


def test_calibrate_counts_a_gauge_by_the_probability_of_its_side(drive):
    """0.6 % and no-go at 0.75 %: where -2 ln of the likelihood exceeds its least by the quantile of Wilks."""
    _, life = drive
    rows = [
        {"time_hours": 500, "quantity": "elongation_percent", "value": 0.6, "error": 0.1},
        {"time_hours": 600, "quantity": "gauge_percent", "value": 0.75, "error": 0.05, "result": "no-go"},
    ]
    rate = 3.0 / life

    def badness(factor):
        gauge = norm.logcdf((factor * rate * 600.0 - 0.75) / 0.05)
        return ((factor * rate * 500.0 - 0.6) / 0.1) ** 2 - 2.0 * gauge

    factors = np.linspace(0.3, 3.0, 400_001) * 0.6 / (rate * 500.0)
    values = badness(factors)
    inside = factors[values <= values.min() + norm.ppf(0.95) ** 2]
    expected = [factors[values.argmin()], inside[0], inside[-1]]
    assert fitted(rows) == pytest.approx(expected, rel=2e-3)


def test_calibrate_refuses_gauges_alone():
    pytest.importorskip("pandera", reason="pandera is not installed")
    rows = [{"time_hours": 600, "quantity": "gauge_percent", "value": 0.75, "error": 0.05, "result": "go"}]
    with pytest.raises(wearsim.CaseError, match="a gauge fixes no value, but wearsim remaining"):
        wearsim.calibrate(case(), rows)
    with pytest.raises(wearsim.CaseError, match=r"readings:2: result: must be go"):
        wearsim.calibrate(case(), [{**rows[0], "result": "yes"}])
    with pytest.raises(wearsim.CaseError, match=r"readings:2: gauge_percent needs a chain that wraps"):
        wearsim.calibrate(wearsim.load_case("16b-20t-oiled"), rows)


def test_a_case_without_a_band_is_believed():
    """A factor that is known to be 1 stays 1, whatever is read."""
    found = factor_posterior([reading(1.5, 0.1)], [1.0], FactorPrior(1.0, 1.0))
    assert found.quantiles == pytest.approx([1.0] * 5, abs=1e-4)
