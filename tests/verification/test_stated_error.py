"""The stated numerical error of a life is a bound.

Expected lives: reports/reference/stated_error.csv, extrapolated from far finer even grids (and of
wraps from far smaller steps) by research/stated_error.py. These drives are among the eight on which the
error stated before was too small by most, without a warning; all of them are judged by tests/slow.
"""

import functools

import pytest

import wearsim

SILENT = (40, 133, 206, 291)


@pytest.fixture(scope="module")
def rows(stated_error):
    return stated_error.read()


@pytest.fixture(scope="module")
def alone(stated_error, tmp_path_factory):
    """Function that gives the case of a number and its run alone."""
    folder = tmp_path_factory.mktemp("drives")

    @functools.cache
    def found(number):
        case = stated_error.drive("strand", number, folder)[0]
        return case, wearsim.simulate(case)

    return found


@pytest.mark.slow
def test_it_holds_where_it_did_not(rows, alone):
    references = {row.number: row.reference for row in rows if row.kind == "strand"}
    for number in SILENT:
        _, result = alone(number)
        assert abs(result.cycles / references[number] - 1.0) <= result.numerical_error


def test_many_at_once_state_the_same(alone):
    cases, results = zip(*map(alone, SILENT[:2]), strict=True)
    for result, many in zip(results, wearsim.simulate_many(cases), strict=True):
        assert many.life == result.life
        assert many.numerical_error == pytest.approx(result.numerical_error, rel=1e-6)


def test_page_shows_what_was_judged(stated_error, rows):
    text = (stated_error.ROOT / "docs" / "validation_head.md").read_text("utf-8")
    assert "\n".join(stated_error.table_of(rows)) in text


@pytest.mark.parametrize("kind", ["strand", "table", "pair", "wrap"])
def test_it_holds_for_98_of_100(stated_error, rows, kind):
    ratios = [row.ratio for row in rows if row.kind == kind]
    assert len(ratios) == stated_error.DRIVES[kind]
    assert sum(ratio <= 1.0 for ratio in ratios) >= 0.98 * len(ratios)
