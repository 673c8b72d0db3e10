"""Pictures: what must be seen lies inside the frames, and panels are alike."""

import copy
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgba

import wearsim
from tests import drives
from wearsim.report.figures import flanks_figure
from wearsim.report.study_files import save_figures
from wearsim.result import Life, LowerBound
from wearsim.study.maintain.figure import maintenance_figure
from wearsim.study.maintain.model import MaintenancePlan, ReplacementPolicy
from wearsim.study.maintain.sheet import maintenance_text
from wearsim.study.sweep.figure import sweep_figures

STRAND = drives.changed(drives.STRAND, {"run": {"horizon_hours": 100, "life_tolerance": 0.1}})


def wrap(profile):
    tables = copy.deepcopy(STRAND)
    tables["sprocket"]["profile"] = profile
    tables["sprocket"]["nodes"] = 51
    tables["mechanism"] = {"kind": "wrap", "phases": 2}
    tables["run"] = {"life_tolerance": 0.1}
    return tables


@pytest.fixture(scope="module")
def results():
    cases = (STRAND, wrap("iso606"), wrap("evolute"))
    return [wearsim.simulate(wearsim.load_case(tables)) for tables in cases]


@pytest.mark.wide
@pytest.mark.parametrize("count", [1, 3, 5])
def test_flanks_lie_inside_panels_of_one_size(results, count):
    shown = (results * 2)[:count]
    figure = flanks_figure(shown)
    figure.draw_without_rendering()
    panels = [panel for panel in figure.axes if panel.get_visible()]
    sizes = [panel.get_window_extent().size for panel in panels]
    assert np.ptp(sizes) < 1e-6 * np.max(sizes)
    for panel, result in zip(panels, shown, strict=True):
        frame = panel.get_window_extent()
        points = np.column_stack([result.flank_columns["x_mm"], result.flank_columns["y_mm"]])
        pixels = panel.transData.transform(points)
        legend = panel.get_legend().get_window_extent()
        assert (pixels > frame.min).all() and (pixels < frame.max).all()
        assert pixels[:, 1].min() > legend.y1
        assert all(frame.contains(*corner) for corner in legend.corners())


def sweep_of(table, *keys):
    """Pictures of the cases of a grid."""
    table = table.assign(hours_run=table["life_hours"], error="")
    return sweep_figures(
        SimpleNamespace(axes=[(key,) for key in keys], design=SimpleNamespace(keys=list(keys))), table
    )


def drawn_texts(panel):
    panel.figure.draw_without_rendering()
    return [text.get_text() for text in panel.texts]


GRID = pd.DataFrame(
    {
        "sprocket.teeth": [20, 20, 40, 40],
        "load.tension_N": [2000.0, 8000.0, 2000.0, 8000.0],
        "life_hours": [6000.0, 1500.0, 9000.0, 2000.0],
    }
)


def test_curves_and_axes_of_a_sweep_are_named_as_people_write():
    (panel, *_) = sweep_of(GRID, "sprocket.teeth", "load.tension_N")["curves"].axes
    assert [text.get_text() for text in panel.get_legend().get_texts()] == [
        "tension 2 000 N",
        "tension 8 000 N",
    ]
    assert panel.get_xlabel() == "teeth"
    assert [tick.get_text() for tick in panel.get_xticklabels()] == ["20", "40"]
    assert panel.get_ylim()[1] > 9000.0
    heat = sweep_of(GRID, "sprocket.teeth", "load.tension_N")["heat_map"].axes[0]
    assert (heat.get_xlabel(), heat.get_ylabel()) == ("teeth", "tension, N")


def rates_of(tensions):
    """Lives over wear rates that are a decade apart, which they divide."""
    rows = [(1e-11 * 10.0**power, tension) for power in range(4) for tension in tensions]
    table = pd.DataFrame(rows, columns=["wear.specific_wear_rate_mm2_per_N", "load.tension_N"])
    table["life_hours"] = 1e-3 / table["wear.specific_wear_rate_mm2_per_N"] / table["load.tension_N"]
    return sweep_of(table, *table.columns[:2])


def test_values_spaced_by_a_factor_have_axes_of_logarithms_and_raised_exponents():
    (panel, *_) = rates_of([7000.0, 4000.0])["curves"].axes
    assert (panel.get_xscale(), panel.get_yscale()) == ("log", "log")
    assert panel.get_xlabel() == "specific wear rate, mm\u00b2/N"
    labels = [tick.get_text() for tick in panel.get_xticklabels()]
    assert labels == [f"10\u207b{digits}" for digits in ("\u00b9\u00b9", "\u00b9\u2070", "\u2079", "\u2078")]
    (steps, *_) = sweep_of(GRID, "sprocket.teeth", "load.tension_N")["curves"].axes
    assert (steps.get_xscale(), steps.get_yscale()) == ("linear", "linear")


def test_scales_of_parallel_coordinates_are_logarithms_too():
    (panel, *_) = rates_of([7000.0, 4000.0])["parallel"].axes
    heights = sorted(
        {round(float(line.get_ydata()[0]), 6) for line in panel.get_lines() if len(line.get_xdata()) == 3}
    )
    np.testing.assert_allclose(heights, [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0], atol=1e-6)


def test_colours_of_curves_go_with_a_number_and_tell_words_apart():
    (panel, *_) = rates_of([7000.0, 4000.0, 5000.0])["curves"].axes
    lines = [line for line in panel.get_lines() if len(line.get_xdata()) > 1]
    assert [line.get_label() for line in lines] == [f"tension {n} 000 N" for n in (4, 5, 7)]
    light = [
        0.2126 * red + 0.7152 * green + 0.0722 * blue
        for red, green, blue, _ in map(to_rgba, [line.get_color() for line in lines])
    ]
    assert light == sorted(light)
    words = GRID.assign(**{"wear.condition": ["oiled", "dry", "oiled", "dry"]}).drop(columns="load.tension_N")
    (panel, *_) = sweep_of(words, "sprocket.teeth", "wear.condition")["curves"].axes
    assert [line.get_color() for line in panel.get_lines() if len(line.get_xdata()) > 1] == ["C0", "C1"]


@pytest.mark.parametrize("count", [3, 60])
def test_numbers_of_parallel_coordinates_stand_in_front_of_the_lines(count):
    """On white, above all lines, none over another; of whole numbers whole ones."""
    teeth = np.arange(20, 20 + count)
    table = pd.DataFrame(
        {
            "sprocket.teeth": teeth,
            "wear.condition": ["oiled", "dry", "wet"] * (count // 3),
            "life_hours": 100.0 * teeth,
        }
    )
    (panel, *_) = sweep_of(table, "sprocket.teeth", "wear.condition")["parallel"].axes
    shown = drawn_texts(panel)
    assert shown[: len(shown) // 3] == [str(int(text)) for text in shown[: len(shown) // 3]]
    assert {"oiled", "dry", "wet"} < set(shown)
    boxes = [text.get_window_extent() for text in panel.texts]
    assert not any(one.overlaps(two) for at, one in enumerate(boxes) for two in boxes[:at])
    lines = max(line.get_zorder() for line in panel.get_lines())
    for text in panel.texts:
        assert text.get_zorder() > lines
        assert text.get_bbox_patch().get_facecolor() == (1.0, 1.0, 1.0, 1.0)
    names = [tick.get_text() for tick in panel.get_xticklabels()]
    assert names == ["teeth", "condition", "life, h"]


def test_a_long_title_stays_inside_its_picture(tmp_path):
    figure = sweep_of(GRID, "sprocket.teeth", "load.tension_N")["curves"]
    save_figures(
        tmp_path, "A drive with a title that is far longer than a picture is wide, " * 3, {"a": figure}
    )
    figure.draw_without_rendering()
    box = figure.get_suptitle() and figure._suptitle.get_window_extent()
    assert box.x0 > 0.0 and box.x1 < figure.bbox.width


def plan(*policies):
    return MaintenancePlan("case", "Title", policies, (), 0.03, (), (), ())


@pytest.mark.parametrize("last", [Life(1e9, 60_000.0), LowerBound(1e9, 50_000.0)])
def test_a_single_elongation_of_maintenance(last):
    """A turned sprocket whose limit was not reached has no cost."""
    straight = ReplacementPolicy(0.01, False, 7000.0, Life(1e9, 30_000.0), 0.01, 12.0)
    turned = ReplacementPolicy(0.01, True, 7000.0, last, 0.01, 9.0 if isinstance(last, Life) else None)
    figure = maintenance_figure(plan(straight, turned))
    figure.draw_without_rendering()
    for panel in figure.axes:
        assert panel.get_xlim()[0] == panel.get_ylim()[0] == 0.0
        assert panel.get_xlim()[1] > 1.0
        assert panel.get_ylim()[1] > panel.dataLim.y1
    words = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert words[0] == "sprocket not turned"
    assert ("limit not reached" in words[1]) == isinstance(last, LowerBound)
    mark = figure.axes[0].get_lines()[-1]
    assert mark.get_ydata() == [last.hours_run]
    shape = ("o", "tab:orange") if isinstance(last, Life) else ("^", "white")
    assert (mark.get_marker(), mark.get_markerfacecolor()) == shape


def test_maintenance_names_no_cheapest_among_costs_that_are_not_known():
    """The cost of a sprocket whose limit was not reached may be less than any."""
    straight = ReplacementPolicy(0.01, False, 7000.0, Life(1e9, 30_000.0), 0.01, 12.0)
    open_ = ReplacementPolicy(0.005, False, 3500.0, LowerBound(1e9, 50_000.0), 0.01, None)
    assert "cheapest: a new chain at 1 %" in maintenance_text(plan(straight))
    assert "cheapest of those whose cost is known: a new chain at 1 %" in maintenance_text(
        plan(open_, straight)
    )


def test_bounds_of_a_sweep_are_open_arrows_with_their_sign():
    """Of 2 x 2 lives one is a bound: no curve passes it, and its cell has a sign."""
    table = pd.DataFrame(
        {
            "load.tension_N": [1.0, 1.0, 2.0, 2.0],
            "load.speed_rpm": [1.0, 2.0, 1.0, 2.0],
            "life_hours": [np.nan, 40.0, 30.0, 20.0],
            "hours_run": [50.0, 40.0, 30.0, 20.0],
            "error": "",
        }
    )
    tables = {"load.tension_N": [1.0, 2.0], "load.speed_rpm": [1.0, 2.0]}
    axes = [("load.tension_N",), ("load.speed_rpm",)]
    sweep = SimpleNamespace(axes=axes, design=SimpleNamespace(keys=list(tables)))
    figures = sweep_figures(sweep, table)
    lines = figures["curves"].axes[0].get_lines()
    curves = [line for line in lines if line.get_marker() == "o"]
    arrows = [line for line in lines if line.get_marker() == "^" and len(line.get_ydata())]
    assert 50.0 not in np.concatenate([line.get_ydata() for line in curves])
    assert [list(line.get_ydata()) for line in arrows] == [[50.0]]
    cells = [text.get_text() for text in figures["heat_map"].axes[0].texts]
    assert sorted(cells) == ["20", "30", "40", "> 50"]
    marks = [line for line in figures["parallel"].axes[0].get_lines() if line.get_marker() == "^"]
    assert marks[0].get_markerfacecolor() == "white" and len(marks) == 2  # and in the legend
