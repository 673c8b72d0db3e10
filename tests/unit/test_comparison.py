"""Several results side by side: told apart, at times that are named, drawn to one scale."""

import re

import pytest

import wearsim
from tests import drives
from wearsim.report.chain_first import chain_first_of
from wearsim.report.comparison import comparison_table, distinct_rows
from wearsim.report.drive.report_page import gap_scenes
from wearsim.report.figures import depth_figure, flanks_figure

WRAP = drives.changed(drives.FAST_WRAP, {"stop": {"critical_depth_mm": 0.1}, "run": {"life_tolerance": 0.1}})


def run(wear_rate, profile):
    values = {"wear.specific_wear_rate_mm2_per_N": wear_rate, "sprocket.profile": profile}
    tables = drives.changed(WRAP, values)
    return wearsim.simulate(wearsim.load_case(tables))


@pytest.fixture(scope="module")
def compared():
    """Two forms of one case, of which one wears four times as fast; the chain ends first in both."""
    results = [run(1e-9, "iso606"), run(0.25e-9, "ansi_b29")]
    assert len({one.case for one in results}) == 1
    return distinct_rows(results, ["runs/iso", "runs/ansi"])


def test_runs_of_one_case_keep_the_lives_of_their_sprockets_apart(compared):
    text = chain_first_of(compared)
    for result, name in zip(compared, ("runs/iso", "runs/ansi"), strict=True):
        assert result.parts["sprocket"].hours_run > result.life.hours
        assert f"h ({name})" in text


def test_depth_and_pressure_stand_beside_the_hours_they_are_of(compared):
    table = comparison_table(compared)
    places = [table.head.index(head) for head in ("chain", "sprocket", "end of run", "deepest by then, mm")]
    for result, cells in zip(compared, table.cells, strict=True):
        chain, sprocket, end, _ = (cells[place] for place in places)
        assert chain == cells[table.head.index("life")]
        assert sprocket == end != chain
        assert float(end.removesuffix(" h").replace(" ", "")) == pytest.approx(result.hours_run, rel=1e-3)
    record, _ = table.records()
    assert record["sprocket_life_hours"] == pytest.approx(compared[0].hours_run)
    assert record["chain_life_hours"] == record["life_hours"]


def test_all_flanks_of_a_figure_are_enlarged_alike(compared):
    deepest, factors = [], []
    for panel in flanks_figure(compared).axes:
        texts = " ".join(text.get_text() for text in panel.get_legend().get_texts())
        deepest.append(float(re.search(r"deepest, ([\d.]+) mm", texts)[1]))
        factors.append(int(re.search(r"depth x (\d+)", texts)[1]))
    assert deepest[0] > 2.0 * deepest[1]
    assert factors[0] == factors[1]


def test_a_sweep_of_wraps_has_the_lives_of_chain_and_sprocket(compared):
    found = wearsim.sweep(
        wearsim.load_case(WRAP), {"wear.specific_wear_rate_mm2_per_N": [1e-9], "sprocket.profile": ["iso606"]}
    )
    (row,) = found.cases.to_dict("records")
    expected = compared[0].parts
    assert row["chain_life_hours"] == row["life_hours"] == expected["chain"].hours
    assert row["sprocket_life_hours"] == expected["sprocket"].hours
    assert "| chain, h | sprocket, h |" in found.text
    assert "sprocket_life_hours" in " ".join(found.summary()["warnings"])


def test_pictures_say_on_which_teeth_and_why_a_depth_is_flat(compared):
    (panel,) = compared[0].plot_loads().axes
    assert panel.get_legend().get_title().get_text() == "on new teeth"
    assert compared[0].history_columns["chain"][-1] > 1
    assert "a new chain wears the teeth at other places first" in depth_figure(compared).axes[0].get_title(
        "left"
    )


def test_all_teeth_of_a_sheet_are_enlarged_alike(compared):
    tables = drives.changed(WRAP, {"run.horizon_hours": 20})
    little = wearsim.simulate(wearsim.load_case(tables))
    assert little.max_depth < 0.5 * compared[0].max_depth
    scenes = gap_scenes({"motor": compared[0], "pump": little}).values()
    assert len({re.search(r"drawn (\d+) times", scene.alt)[1] for scene in scenes}) == 1
