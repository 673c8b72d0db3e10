"""What the pages of a report are made of."""

import json
import math
import re
from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import plotly.graph_objects as go
import pytest
import shapely

import wearsim
from tests import drives
from wearsim.chain.drive_layout import DriveLayout, layout_with_links
from wearsim.errors import CaseError
from wearsim.files import file_names
from wearsim.geometry.scene import Circle, Label, Scene, line
from wearsim.mechanisms.wrap.scene import roller_places, wrap_scene
from wearsim.quantities import grouped
from wearsim.report.answer import answer, ending, limit_state
from wearsim.report.figures import flanks_figure
from wearsim.report.flank_view import case_of
from wearsim.report.html import page_content as page
from wearsim.report.html import page_writer
from wearsim.report.html.margins import margins
from wearsim.report.html.page_writer import save_report
from wearsim.report.html.paper import SheetHead
from wearsim.report.html.run_charts import along_chart, history_chart, lives_chart
from wearsim.report.html.sketch import sketch
from wearsim.report.html.tooth_chart import tooth_charts
from wearsim.result import LimitState, WearResult

STRAND = drives.changed(drives.STRAND, {"run": {"horizon_hours": 100, "life_tolerance": 0.1}})
WRAP = {
    **STRAND,
    "sprocket": {"teeth": 20, "profile": "iso606", "nodes": 601},
    "mechanism": {"kind": "wrap", "phases": 2},
}


def drawn(scene, role):
    return [shape for shape in scene.shapes if shape.role == role]


@pytest.mark.parametrize("teeth", [(19, 57), (57, 19), (20, 20)])
def test_rollers_are_a_pitch_apart_on_sprockets_and_spans(teeth):
    layout = layout_with_links(12.7, *teeth, 120)
    places = roller_places(layout)
    gaps = np.hypot(*(np.roll(places, -1, axis=0) - places).T)
    assert len(places) == 120
    assert gaps == pytest.approx(12.7, rel=2e-3)
    centres = ((0.0, layout.pitch_diameter_1), (layout.centre_distance, layout.pitch_diameter_2))
    least = [np.hypot(places[:, 0] - x, places[:, 1]).min() for x, _ in centres]
    assert least == pytest.approx([0.5 * diameter for _, diameter in centres])


@pytest.mark.parametrize("role", ["driver", "driven"])
def test_rollers_sit_in_the_gaps_of_the_drawn_wheel(role):
    tables = {**WRAP, "sprocket": {**WRAP["sprocket"], "role": role}}
    drive = wearsim.load_case(tables).drive
    layout = drive.layout
    (outline,) = drawn(wrap_scene(drive), "worn")
    wheel = shapely.Polygon(outline.vertices)
    assert wheel.is_valid
    clear = shapely.distance(shapely.points(roller_places(layout)), wheel)
    assert clear.min() > 0.5 * drive.chain.roller_diameter - 0.05
    seated = (clear < 0.5 * drive.chain.roller_diameter + 0.5).sum()
    wrap = layout.engaged_1 if role == "driver" else layout.engaged_2
    assert abs(seated - wrap) <= 1.5


def test_the_roller_of_a_strand_touches_the_drawn_flank():
    """The conjugate flank: touched by the roller one pitch before that of the pitch point, cut by none."""
    drive = wearsim.load_case(STRAND).drive
    (outline,) = drawn(drive.scene(1), "worn")
    wheel = shapely.Polygon(outline.vertices)
    pitch, height = drive.chain.pitch, drive.tooth.strand.height
    clear = [
        shapely.Point(place * pitch, height).distance(wheel) - drive.tooth.strand.roller_radius
        for place in (-1, 0, 1)
    ]
    fine = 5e-3 * pitch + 0.02
    assert abs(clear[0]) < fine
    assert min(clear) > -fine


def test_circles_of_gears_are_to_scale():
    scene = wearsim.load_case(drives.GEARS).drive.scene(1)
    assert [circle.radius for circle in drawn(scene, "pitch")] == [28.5, 91.5]
    (contact,) = drawn(scene, "contact")
    first, *_, last = contact.vertices
    (lean,) = np.degrees(np.arctan2([abs(last[0] - first[0])], [abs(last[1] - first[1])]))
    assert lean == pytest.approx(20.0, abs=0.1)  # the pressure angle to the common tangent


def test_a_sketch_is_its_scene_with_y_downwards():
    """Lines of one role that follow one another are one path; text is escaped."""
    shapes = (
        line("chain", [(0, 0), (10, 5.5)]),
        line("chain", [(1, 1), (2, 2), (3, 1)], closed=True),
        Circle("roller", (0.0, 0.0), 5.0),
        Label("text", "a < b", (1.0, 2.0), 3.0),
    )
    text = sketch(Scene((-5.0, -5.0, 15.0, 12.0), shapes, 'What "one" sees', ("a & b",)))
    assert 'viewBox="-5.00 -7.00 15.00 12.00"' in text
    assert '<path class="chain" d="M0 0L10 -5.5M1 -1L2 -2L3 -1Z"/>' in text
    assert '<path class="roller" d="M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0"/>' in text
    assert '<text x="1.00" y="-2.00" font-size="3.00">a &lt; b</text>' in text
    assert 'aria-label="What &#34;one&#34; sees"' in text and "<li>a &amp; b</li>" in text
    assert sketch(None) == ""


def test_the_bar_of_a_sketch_is_as_long_as_it_says():
    scene = Scene((0.0, 0.0, 240.0, 100.0), ()).with_scale()
    *_, bar = drawn(scene, "scale")
    (label,) = drawn(scene, "text")
    assert label.text == "50 mm"
    assert np.ptp(bar.vertices, axis=0).tolist() == [50.0, 0.0]
    left, bottom, width, height = scene.box
    assert left < 0.0 and bottom < bar.vertices[0, 1] and (left + width, bottom + height) > (240.0, 100.0)


@pytest.fixture(scope="module")
def strand():
    return wearsim.simulate(wearsim.load_case(STRAND, ["stop.min_tip_land_mm=1.0"]))


def test_margins_go_from_new_to_the_limit(strand):
    found = {margin.name: margin for margin in margins(strand, case_of(strand))}
    assert set(found) == {"critical depth", "min tip land"}
    depth, land = found["critical depth"], found["min tip land"]
    limits = {state.name: state for state in strand.limits}
    state = limits["critical_depth_mm"]
    assert depth.used == pytest.approx(state.value / state.limit)
    state, new = limits["min_tip_land_mm"], case_of(strand).drive.tip_land
    assert land.used == pytest.approx((new - state.value) / (new - 1.0))
    assert not depth.ended and not land.ended
    assert 0.0 < depth.used < 1.0


@pytest.mark.wide
def test_a_run_that_moved_still_has_its_case(tmp_path):
    source = Path(__file__).parents[2] / "cases" / "beet-harvester-18t-soil.toml"
    result = wearsim.simulate(wearsim.load_case(source, ["run.horizon_hours=5"]))
    result.save(tmp_path / "run")
    case = case_of(WearResult.load(tmp_path / "run"))
    assert case.drive.tooth.tip_radius == pytest.approx(
        wearsim.load_case(source).drive.tooth.tip_radius, rel=1e-12
    )


@pytest.fixture(scope="module")
def goes_on():
    """A wrap whose run goes on, with two more chains, after the life of the first."""
    tables = {
        "format_version": 1,
        "chain": {"designation": "ANSI 40"},
        "sprocket": {"teeth": 20, "profile": "ansi_b29", "nodes": 101},
        "mechanism": {"kind": "wrap", "phases": 2},
        "drive": {"mate_teeth": 20, "links": 114, "slack_tension_N": 50},
        "joint": {"pitch": "uniform", "specific_wear_rate_mm2_per_N": 5e-9},
        "load": {"tension_N": 1000, "speed_rpm": 100},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
        "stop": {"critical_depth_mm": 0.1, "elongation_percent": 1},
        "run": {"life_tolerance": 0.1},
    }
    return wearsim.simulate(wearsim.load_case(tables))


def test_the_tooth_is_drawn_at_the_life_that_is_stated(goes_on):
    """The run goes on after the chain's life: what is drawn is as deep as the history is then."""
    hours, columns = goes_on.life.hours, goes_on.history_columns
    assert goes_on.stop == "elongation_percent" and 2.0 * hours < goes_on.hours_run
    depth = float(np.interp(hours, columns["time_hours"], columns["max_depth_mm"]))
    assert depth < 0.7 * goes_on.max_depth
    stated = f"{grouped(hours)} h (life, ended by the chain)"
    (chart,) = tooth_charts(goes_on)
    assert chart.title == f"flank before and after {stated}"
    assert float(chart.slider["depth"].removesuffix(" mm")) == pytest.approx(depth, rel=0.02)
    moved = np.hypot(chart.slider["dx"], chart.slider["dy"])
    assert moved.max() == pytest.approx(depth, rel=0.02)
    along = along_chart([goes_on], ["x"]).figure.traces[0]
    assert max(along["y"]) == pytest.approx(depth, rel=0.02)
    (panel,) = flanks_figure([goes_on]).axes
    assert panel.get_title().endswith(f"after {stated}")
    label = panel.get_legend().get_texts()[-1].get_text()
    assert float(label.split()[1]) == pytest.approx(depth, rel=0.02)


def test_a_bound_is_an_open_arrow_with_its_sign(strand, gears):
    """The strand ends at its horizon of 100 h, the gears at their limit."""
    bound, life = (lives_chart([one], ["x"]).figure.traces[0] for one in (strand, gears))
    assert bound["marker"]["symbol"] == "triangle-right-open"
    assert (bound["mode"], bound["text"]) == ("markers+text", ["&gt; 100 h"])
    assert (life["marker"]["symbol"], life["mode"]) == ("circle", "markers")
    mark = history_chart([strand], ["x"]).figure.traces[-1]
    assert mark["marker"]["symbol"] == "triangle-right-open"


def test_jumping_reads_as_safe_or_not(goes_on):
    """Slack tension of 50 N: 2e-6, 10, 40 and 50 N needed."""
    case, found = case_of(goes_on), []
    for needed in (2e-6, 10.0, 40.0, 50.0):
        state = LimitState("min_slack_tension_N", 50.0, needed)
        told = replace(goes_on, limits=(goes_on.limits[0], state))
        assert limit_state(state, told.inputs) in " ".join(answer(told, "x.toml", explain=True).split())
        last = margins(told, case)[-1]
        found.append((last.name, last.value, last.limit, last.unit))
    assert found == [
        ("jumping: no risk", "below 0.5", "50", "N"),
        ("jumping: no risk", "10", "50", "N"),
        ("jumping: 25 % more than needed", "40", "50", "N"),
        ("jumping: no margin", "50", "50", "N"),
    ]
    own = {**goes_on.inputs, "stop": {"min_slack_tension_N": 50.0}}
    assert limit_state(state, own).endswith("(slack tension: 50 N needed, 50 N allowed)")


def test_a_life_that_the_wheel_ends_is_told():
    case = wearsim.load_case(drives.GEARS, ["wear.wheel_wear_ratio=20"])
    result = wearsim.simulate(case)
    assert result.stop == "wheel_critical_depth_mm"
    assert ending(result) == "until 0.02 mm is worn off the wheel"
    assert "worn off the wheel" in " ".join(answer(result, "x.toml").split())


@pytest.mark.wide
@pytest.mark.parametrize("single_file", [False, True])
def test_pages_are_the_same_for_the_same_run_and_small(strand, tmp_path, single_file):
    texts = []
    for name in "ab":
        save_report([strand], tmp_path / name, False, single_file, "full")
        texts.append((tmp_path / name / "index.html").read_bytes())
    assert texts[0] == texts[1]
    assert len(texts[0]) < (6_000_000 if single_file else 300_000)


@pytest.fixture(scope="module")
def gears():
    return wearsim.simulate(wearsim.load_case(drives.GEARS))


@pytest.fixture(scope="module")
def wrap():
    return wearsim.simulate(wearsim.load_case(WRAP, ["sprocket.nodes=301", "run.horizon_hours=1"]))


def test_legends_name_every_drive_once(strand, gears):
    def shown(*arguments):
        traces = along_chart(*arguments).figure.traces
        return [trace["name"] for trace in traces if trace["showlegend"]]

    traces = along_chart([strand, gears], ["first", "gears"]).figure.traces
    roles = {trace["name"]: trace["meta"]["role"] for trace in traces}
    assert roles["first"] == "series-1" and roles["gears"] == roles["gears, wheel"] == "series-2"
    assert shown([strand, gears, strand], ["first", "gears", "third"]) == ["first", "gears", "third"]
    assert shown([gears], ["gears"]) == ["pinion", "wheel"]
    assert shown([strand], ["x"]) == []


def test_plotly_knows_all_that_charts_say(strand, wrap, gears):
    """Its objects refuse keys and values that its script would leave out without a word."""
    several = ([strand, wrap, gears], ["first", "second", "third"])
    made = [along_chart(*several), history_chart(*several), lives_chart(*several)]
    for result in several[0]:
        made += [*tooth_charts(result), *page._charts(result, case_of(result))]
    for chart in made:
        content = chart.content
        figure = go.Figure(data=content["data"], layout=content["layout"])
        assert json.loads(figure.to_json())["data"] == content["data"]


def test_names_of_files_are_safe_and_different():
    assert file_names(["../x", "x", "X", "index", "привод", ""]) == [
        "_x",
        "x",
        "X-2",
        "index-2",
        "привод",
        "drive",
    ]


def palette():
    """Colours of the page in the light and in the dark."""
    text = Path(page_writer.__file__).with_name("style.css").read_text()
    light, dark = re.findall(r":root \{(.*?)\}", text, re.DOTALL)[:2]
    found = [dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", block)) for block in (light, dark)]
    assert found[0].keys() == found[1].keys()
    return found


def luminance(colour):
    """Relative luminance of WCAG 2."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_of_a_known_pair():
    assert contrast("#ffffff", "#767676") == pytest.approx(4.54, abs=0.01)  # WCAG's own example


@pytest.mark.parametrize("scheme", [0, 1])
def test_letters_and_lines_stand_out(scheme):
    colours = palette()[scheme]
    for ground in ("page", "panel"):
        for letters in ("text", "muted", "link"):
            assert contrast(colours[letters], colours[ground]) >= 4.5, (letters, ground)
        for mark in ("new", "worn", "mate", "limit", *(f"series-{n}" for n in range(1, 7))):
            assert contrast(colours[mark], colours[ground]) >= 3.0, (mark, ground)
    assert contrast(colours["warn"], colours["warn-page"]) >= 4.5


def test_a_slack_layout_is_drawn_closed():
    layout = DriveLayout(12.7, 17, 25, 80, 360.0)
    places = roller_places(layout)
    ends = math.dist(places[0], places[-1])
    assert ends == pytest.approx(12.7, rel=0.05)


@pytest.mark.parametrize(("key", "text"), [("author", "me\x1b"), ("checked_by", "x" * 201)])
def test_texts_of_a_head_are_short_lines(key, text):
    with pytest.raises(CaseError, match=f"--{key.replace('_', '-')}: must be one line of at most 200"):
        SheetHead(date(2026, 3, 31), **{key: text})
