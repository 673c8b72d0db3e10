"""Readings as people keep them give the same answer as by hours, millimetres and decimal points."""

from datetime import date, timedelta

import pytest

import wearsim
from tests.drives import FAST_WRAP, changed
from wearsim.readings.chain_readings import odd_error
from wearsim.readings.chain_state import chain_state

SERVICE = {"km_per_hour": 30, "hours_per_day": 8}
CASE = changed(FAST_WRAP, {"stop.elongation_percent": 3, "service": SERVICE})
PLAIN = "time_hours,quantity,value,links,error\n0,new,,,\n512,chain_length_mm,1277.62,100,0.5\n"
"""100 links of 12.7 mm are 1270 mm when new."""

HEAD = "distance_km,quantity,value,links,error\n"


OILED = {"lubrication": {"lasts_hours": 300, "dry_factor": 2}}


def case(**changes):
    return wearsim.load_case(changed(CASE, changes))


@pytest.fixture
def state(tmp_path):
    """Function that tells what a table says."""

    def read(text, given=None):
        path = tmp_path / "readings.csv"
        path.write_text(text, encoding="utf-8")
        return chain_state(given or case(), path)

    return read


def lives(found):
    return found.of("life_hours").values


KEPT = {
    "semicolons and commas": PLAIN.replace(",", ";").replace("1277.62", "1277,62").replace("0.5", "0,5"),
    "tabs": PLAIN.replace(",", "\t"),
    "inches": PLAIN.replace("1277.62", "50.3 inch").replace("0.5", "0.5 mm"),
    "inches by their name": PLAIN.replace("_mm,1277.62,100,0.5", "_inch,50.3,100,0.5 mm"),
    "a fraction": PLAIN.replace("1277.62", '"50 3/10"""'),
    "miles": f"{HEAD}{512 * 30 / 1.609344:.12g},chain_length_mm,1277.62,100,0.5\n".replace("km", "miles"),
    "miles as a unit": f"{HEAD}{512 * 30 / 1.609344:.12g} miles,chain_length_mm,1277.62,100,0.5\n",
    "an odometer": f"{HEAD}1000,new,,,\n16360,chain_length_mm,1277.62,100,0.5\n",
    "an hour meter": PLAIN.replace("\n0,", "\n1200,").replace("512", "1712"),
    "days with points": "date;quantity;value;links;error\n01.01.2026;new;;;\n"
    "06.03.2026;chain_length_mm;1277,62;100;0,5\n",
}


@pytest.mark.parametrize("text", KEPT.values(), ids=KEPT)
def test_a_table_as_it_is_kept_says_the_same(state, text):
    """1277.62 mm are 50.3 inch; 512 h are 64 days of 8 h or 15 360 km at 30 km/h."""
    assert lives(state(text)) == pytest.approx(lives(state(PLAIN)), rel=1e-9)


def test_days_are_read_in_the_form_that_fits_them_all(state):
    """26 is no month, so that 3/6 is the sixth of March too: 64 days after the first of January."""
    rows = "1/1/2026,new,,\n3/6/2026,elongation_percent,0.6,0.1\n3/26/2026,elongation_percent,0.75,0.1\n"
    found = state(f"date,quantity,value,error\n{rows}")
    assert [one.hours for one in found.log.readings] == [64 * 8, 84 * 8]


def test_a_day_that_may_be_two_is_not_guessed(state):
    with pytest.raises(
        wearsim.CaseError, match=r"2: date: may be day/month/year or month/day/year.*1/2/2026"
    ):
        state("date,quantity,value\n1/2/2026,new,\n3/4/2026,elongation_percent,0.6\n")


def test_days_of_other_forms_are_read_where_each_has_one_meaning(state):
    """59, 64 and 84 days after the first of January, as points, as year-month-day and as 26 March."""
    rows = "01.01.2026;new;\n01.03.2026;relubrication;\n2026-03-06;elongation_percent;0,6\n"
    found = state(f"date;quantity;value\n{rows}3/26/2026;elongation_percent;0,75\n", case(**OILED))
    assert [one.hours for one in found.log.readings] == [64 * 8, 84 * 8]
    assert found.log.relubrications.hours == (59 * 8,)


def test_the_days_of_a_log_come_back_as_they_were_given(state):
    """0.7 h a day are no round number of bits: days times hours over hours fall short of a day in ten."""
    days = [(date(2026, 1, 1) + timedelta(days=number)).isoformat() for number in range(1, 100)]
    rows = "\n".join(f"{day},gauge_percent,1,go" for day in days)
    found = state(
        f"date,quantity,value,result\n2026-01-01,new,,\n{rows}\n", case(service={"hours_per_day": 0.7})
    )
    assert [found.day(one.hours) for one in found.log.readings] == days


@pytest.mark.parametrize(
    ("odd", "wrong"),
    [
        ("31.04.2026", ["4: date: must be a day, day.month.year as others here or such as 2026-03-31"]),
        ("05/04/2026", []),
        ("05/06/2026", ["4: date: may be day/month/year or month/day/year: write year-month-day"]),
    ],
)
def test_only_the_odd_day_is_named(state, odd, wrong):
    """The fifth of April comes before the tenth, so 05/04 is May; 05/06 may be June or May, both after it."""
    rows = f"01.01.2026,new,\n10.04.2026,elongation_percent,0.6\n{odd},elongation_percent,0.7\n"
    try:
        state(f"date,quantity,value\n{rows}20.06.2026,elongation_percent,0.9\n")
        said = []
    except wearsim.CaseError as error:
        said = str(error).splitlines()
    assert len(said) == len(wrong)
    assert all(text in line for text, line in zip(wrong, said, strict=True))


def test_a_mark_of_thousands_is_not_taken_for_a_decimal_point(state):
    with pytest.raises(wearsim.CaseError, match=r"2: distance_km: may be 12345 or 12\.3450: write one"):
        state("distance_km;quantity;value\n12.345;elongation_percent;1\n")
    with pytest.raises(wearsim.CaseError, match=r":3: .*has both: others have commas \(got '12\.345'\)"):
        state("distance_km;quantity;value\n5000,5;elongation_percent;0,6\n12.345;elongation_percent;0,9\n")


def test_the_length_of_the_new_chain_is_the_baseline(state):
    """From 610 to 612.44 mm 48 links of 12.7 mm grow by 0.4 %; errors of 0.3 and 0.4 mm are one of 0.5 mm."""
    found = state(
        "time_hours,quantity,value,links,error\n0,new,610,48,0.3\n500,chain_length_mm,612.44,48,0.4\n"
    )
    (reading,) = found.log.readings
    assert reading.low == pytest.approx(0.4, rel=1e-9)
    assert reading.error == pytest.approx(100 * 0.5 / 610, rel=1e-9)
    assert any("length of the new chain, +0.066 % from nominal" in text for text in found.assumptions)


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("0,new,610,,", "2: links: must be the number of links"),
        ("0,new,,48,", "2: value: must be a length in mm"),
        ("0,new,620,48,", "620 mm over 48 new links differ by 1.71 % from a pitch of 12.7 mm"),
    ],
)
def test_a_length_of_the_new_chain_that_cannot_be_is_named(state, row, message):
    with pytest.raises(wearsim.CaseError, match=message):
        state(f"time_hours,quantity,value,links,error\n{row}\n500,chain_length_mm,612.44,48,0.4\n")


def test_an_odd_number_of_links_adds_what_its_ends_may_hide(state):
    """Of 5 links 3 or 2 are outer ones, each 2 e longer: 1.2 or 0.8 e in the mean."""
    assert odd_error(1.0, 5) == pytest.approx((3 * 2 / 5 - 2 * 2 / 5) / 2)
    found = state("time_hours,quantity,value,links,error\n500,elongation_percent,0.6,5,0.05\n")
    assert found.log.readings[0].error == pytest.approx((0.12**2 + 0.05**2) ** 0.5)
    assert any("an odd number of links" in text for text in found.assumptions)


def test_a_new_chain_on_an_older_machine_begins_its_own_days(state):
    dated = case(**{"service.start_date": "2025-01-01"})
    text = "date,quantity,value,error\n2026-01-01,new,,\n2026-03-06,elongation_percent,0.6,0.1\n"
    assert [one.hours for one in state(text, dated).log.readings] == [64 * 8]


def test_a_meter_that_no_row_begins_is_believed_aloud(state):
    """16 360 km at 30 km/h are 545.3 h; with the row 'new' 15 360 km are 512 h, and nothing is to be said."""
    read = f"{HEAD}16360,chain_length_mm,1277.62,100,0.5\n"
    (text,) = (one for one in state(read).warnings if "no row 'new'" in one)
    assert "distance_km was when the part was new" in text
    assert "to have run 545.3 h at the first reading" in text
    for told in (KEPT["an odometer"], KEPT["days with points"], PLAIN):
        assert not [one for one in state(told).warnings if "no row 'new'" in one]


def test_times_before_the_odometer_of_the_new_chain_are_named(state):
    with pytest.raises(wearsim.CaseError, match="must be a number of at least 1000, as in the row 'new'"):
        state("distance_km,quantity,value\n1000,new,\n900,elongation_percent,0.6\n")


LONG = PLAIN + "512,chain_length_mm,1277.62,100,0.5\n" * 999


def test_a_table_that_would_take_for_ever_is_refused(state):
    with pytest.raises(wearsim.CaseError, match="it has 1001 rows, 1000 are the most: give one mean"):
        state(LONG)


def test_comments_and_empty_lines_are_no_rows(state):
    assert lives(state("# by hand\n" * 999 + PLAIN + ",,,,\n\n" * 999)) == lives(state(PLAIN))


@pytest.mark.parametrize("name", ["a\x1b", "a" * 201])
def test_cells_are_short_lines(state, name):
    with pytest.raises(wearsim.CaseError, match=r"readings.csv:2: must be one line of at most 200 char"):
        state(f"time_hours,quantity,value,chain\n0,new,,{name}\n")


def test_calibrate_reads_the_same_tables(tmp_path):
    """Baseline, inches, an odometer and semicolons give the coefficient of the plain table."""
    pytest.importorskip("pandera", reason="pandera is not installed")
    plain, kept = tmp_path / "plain.csv", tmp_path / "kept.csv"
    plain.write_text(PLAIN)
    kept.write_text(
        f"distance_miles;quantity;value;links;error\n1000;new;;;\n{1000 + 512 * 30 / 1.609344:.12g}".replace(
            ".", ","
        )
        + ";chain_length_inch;50,3;100;0,5 mm\n"
    )
    (one,), (other,) = (wearsim.calibrate(case(), path).found.values for path in (plain, kept))
    kept.write_text("time_hours,quantity,value,error\n512,elongation_percent,0.6,0.1\n")
    (text,) = (text for text in wearsim.calibrate(case(), kept).found.warnings if "no row 'new'" in text)
    assert "to have run 512 h at the first reading" in text
    assert other.value == pytest.approx(one.value, rel=1e-9)
