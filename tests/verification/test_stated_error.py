"""The stated numerical error of a life is a bound.

Expected lives: reports/reference/stated_error.csv, extrapolated from far finer even grids (and of
wraps from far smaller steps) by research/stated_error.py. These drives are among the eight on which the
error stated before was too small by most, without a warning; all of them are judged by tests/slow.
"""

import pytest

import wearsim

SILENT = (40, 133, 206, 291)


@pytest.fixture(scope="module")
def rows(stated_error):
    return stated_error.read()


@pytest.mark.wide
def test_it_holds_where_it_did_not(stated_error, rows, tmp_path):
    references = {row.number: row.reference for row in rows if row.kind == "strand"}
    for number in SILENT:
        alone = wearsim.simulate(stated_error.drive("strand", number, tmp_path)[0])
        assert abs(alone.cycles / references[number] - 1.0) <= alone.numerical_error


def test_many_at_once_state_the_same(stated_error, tmp_path):
    cases = [stated_error.drive("strand", number, tmp_path)[0] for number in SILENT[:2]]
    for case, many in zip(cases, wearsim.simulate_many(cases), strict=True):
        alone = wearsim.simulate(case)
        assert many.life == alone.life
        assert many.numerical_error == pytest.approx(alone.numerical_error, rel=1e-6)


def test_page_shows_what_was_judged(stated_error, rows):
    text = (stated_error.ROOT / "docs" / "validation_head.md").read_text("utf-8")
    assert "\n".join(stated_error.table_of(rows)) in text


@pytest.mark.parametrize("kind", ["strand", "table", "pair", "wrap"])
def test_it_holds_for_98_of_100(stated_error, rows, kind):
    ratios = [row.ratio for row in rows if row.kind == kind]
    assert len(ratios) == stated_error.DRIVES[kind]
    assert sum(ratio <= 1.0 for ratio in ratios) >= 0.98 * len(ratios)
