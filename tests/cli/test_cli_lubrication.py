"""[lubrication] as a user writes it: every key moves the life, or an error names it."""

import json
from pathlib import Path
from typing import Any

import pytest

import wearsim
from tests.drives import LIGHT_WRAP, changed
from wearsim.catalogue.catalogues import environments, lubricants
from wearsim.errors import CaseError
from wearsim.quantities import grouped

pytestmark = pytest.mark.wide

CASES = Path(__file__).parents[2] / "cases"
STRAND: dict[str, Any] = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 61},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "service": {"km_per_hour": 10},
    "run": {"life_tolerance": 0.1},
    "lubrication": {
        "lubricant": "manual",
        "interval_hours": 30.0,
        "lasts_hours": 12.0,
        "fades_over_hours": 8.0,
        "completeness": 0.9,
        "contamination_factor": 1.5,
    },
}
WRAP = changed(LIGHT_WRAP, {"run.life_tolerance": 0.1})


def hours(tables: dict[str, Any], *settings: str) -> float:
    return wearsim.simulate(wearsim.load_case(tables, settings)).life.hours_run


def faults(tables: dict[str, Any], *settings: str) -> str:
    with pytest.raises(CaseError) as caught:
        wearsim.load_case(tables, settings)
    return str(caught.value)


def _with(**changes: Any) -> dict[str, Any]:
    table = {key: value for key, value in STRAND["lubrication"].items() if changes.get(key, 0) is not None}
    return {**STRAND, "lubrication": {**table, **{k: v for k, v in changes.items() if v is not None}}}


@pytest.mark.parametrize(
    ("key", "other"),
    [
        ("interval_km", {"interval_hours": None, "interval_km": 300.0}),
        ("lasts_km", {"lasts_hours": None, "lasts_km": 120.0}),
        ("fades_over_km", {"fades_over_hours": None, "fades_over_km": 80.0}),
    ],
)
def test_km_are_hours_times_their_speed(key: str, other: dict[str, Any]) -> None:
    assert hours(_with(**other)) == pytest.approx(hours(STRAND), rel=1e-12)
    without = {name: table for name, table in _with(**other).items() if name != "service"}
    assert f"lubrication.{key}" in faults(without)
    assert "service.km_per_hour" in faults(without)


def test_relubrication_at_given_times() -> None:
    """The first two rounds of the interval, then never again."""
    at = hours(_with(interval_hours=None, at_hours=[30.0, 60.0]))
    assert at == pytest.approx(hours(_with(interval_hours=None, at_km=[300.0, 600.0])), rel=1e-12)
    assert at < hours(STRAND)


@pytest.mark.parametrize("times", [[30.0], [30.0, 60.0]])
def test_an_interval_beside_given_times_goes_on_from_the_last(times: list[float]) -> None:
    """Where these are its own first rounds, the life is that of the interval."""
    assert STRAND["lubrication"]["interval_hours"] == 30.0
    assert hours(_with(at_hours=times)) == pytest.approx(hours(STRAND), rel=1e-9)
    assert hours(_with(at_hours=times, interval_hours=40.0)) < hours(STRAND)


def test_threshold_is_the_interval_after_which_it_is_reached() -> None:
    """Twice the rate is at 1/38 of the ramp of 8 hours, after 12 hours."""
    tables = _with(completeness=1.0, contamination_factor=None, interval_hours=None, when_rate_exceeds=2.0)
    interval = 12.0 + 8.0 / 38.0
    by_interval = _with(completeness=1.0, contamination_factor=None, interval_hours=interval)
    assert hours(tables) == pytest.approx(hours(by_interval), rel=1e-9)


def test_sliding_way_of_flanks_moves_the_life() -> None:
    tables = _with(lasts_hours=None, lasts_sliding_m=10.0, interval_hours=None, interval_sliding_m=20.0)
    assert hours(tables) != pytest.approx(hours(STRAND), rel=1e-3)
    fading = _with(
        lasts_hours=None,
        lasts_sliding_m=10.0,
        interval_hours=None,
        interval_sliding_m=20.0,
        fades_over_hours=None,
        fades_over_sliding_m=8.0,
    )
    assert hours(fading) != pytest.approx(hours(tables), rel=1e-6)


@pytest.mark.parametrize("key", ["lasts_sliding_m", "interval_sliding_m"])
def test_flank_that_does_not_slide_is_named(tmp_path: Path, key: str) -> None:
    """As without a lubricant: nothing wears."""
    head = "arc_length_mm,load_per_width_N_per_mm,flank_curvature_per_mm,sliding_distance_mm"
    (tmp_path / "rows.csv").write_text("\n".join([head, *(f"{i},100,0.02,0" for i in range(6))]), "utf-8")
    tables = {
        "format_version": 1,
        "chain": {"designation": "16B-1"},
        "mechanism": {"kind": "prescribed", "table_file": str(tmp_path / "rows.csv")},
        "load": {"speed_rpm": 100},
        "wear": {"specific_wear_rate_mm2_per_N": 1e-9},
        "stop": {"critical_depth_mm": 0.05},
        "lubrication": {
            "dry_factor": 3.0,
            **({} if key.startswith("lasts") else {"lasts_hours": 3.0}),
            key: 2.0,
        },
    }
    with pytest.raises(wearsim.ContactError, match="slid"):
        wearsim.simulate(wearsim.load_case(tables))


def test_phase_in_km() -> None:
    in_km = [{"km": 200.0}, {**{key: PHASES[1][key] for key in PHASES[1] if key != "hours"}, "km": 200.0}]
    found = [hours(_with(interval_hours=None, phase=phase)) for phase in (PHASES, in_km)]
    assert found[1] == pytest.approx(found[0], rel=1e-12)


PHASES: list[dict[str, Any]] = [
    {"hours": 20.0},
    {"hours": 20.0, "contaminations": 7, "contamination_factor": 3.0, "relubrications": 2},
]


def test_dirt_that_stays_moves_the_life() -> None:
    phases = [PHASES[1], {"hours": 20.0, "relubrications": 3, "contamination_factor": 1.0}]
    lives = [
        hours(_with(interval_hours=None, phase=phases, contamination_removed=part)) for part in (0.2, 0.9)
    ]
    assert lives[0] < lives[1]


@pytest.mark.parametrize("name", list(lubricants()))
def test_lubricant_sets_teeth_and_joints(name: str) -> None:
    case = wearsim.load_case({**WRAP, "lubrication": {"lubricant": name}})
    row = lubricants()[name]
    by_condition = wearsim.load_case({**WRAP, "wear": {"condition": row.wear_condition}})
    assert case.wear.coefficient == by_condition.wear.coefficient
    assert case.drive.wear_coefficients == by_condition.drive.wear_coefficients
    assert case.inputs["wear"]["condition"] == row.wear_condition


@pytest.mark.parametrize("name", [name for name in environments() if name != "clean"])
def test_environment_multiplies_the_wear(name: str) -> None:
    clean = hours({**WRAP, "lubrication": {"lubricant": "drip", "environment": "clean"}})
    dirty = hours({**WRAP, "lubrication": {"lubricant": "drip", "environment": name}})
    assert dirty == pytest.approx(clean / environments()[name].factor, rel=1e-9)


def test_own_numbers_override_each() -> None:
    tables = {**WRAP, "lubrication": {"lubricant": "drip"}}
    joint = wearsim.load_case(tables, ["joint.specific_wear_rate_mm2_per_N=1.3e-10"])
    assert set(joint.drive.wear_coefficients.values()) == {1.3e-10}
    assert joint.wear.coefficient == 5e-11
    teeth = wearsim.load_case(tables, ["wear.specific_wear_rate_mm2_per_N=7e-11"])
    assert teeth.wear.coefficient == 7e-11


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (["lubrication.lubricant=drip", "wear.condition=hardened, dry"], "contradicts lubrication.lubricant"),
        (
            ["lubrication.lubricant=drip", "wear.condition=normalised, greased"],
            "the condition of lubrication",
        ),
        (
            ["lubrication.lubricant=dry", "wear.condition=hardened, oiled"],
            "contradicts lubrication.lubricant",
        ),
        (
            ["lubrication.lubricant=drip", "joint.specific_wear_rate_mm2_per_N=2e-8"],
            "contradicts joint.specific_wear_rate_mm2_per_N",
        ),
    ],
)
def test_contradiction_is_warned_of_by_name(settings: list[str], words: str) -> None:
    assert any(words in text for text in wearsim.load_case(WRAP, settings).warnings)


@pytest.mark.parametrize(
    ("settings", "key", "words"),
    [
        (["lubrication.lubricant=dripp"], "lubrication.lubricant", "did you mean 'drip'"),
        (["lubrication.environment=dusty"], "lubrication.environment", "did you mean 'dust'"),
        (["lubrication.interval_hours=-1"], "lubrication.interval_hours", "greater than 0"),
        (["lubrication.lasts_hours=-1"], "lubrication.lasts_hours", "0"),
        (["lubrication.interval_km=3"], "lubrication.interval_km", "interval_hours already gives this"),
        (["lubrication.lasts_km=3"], "lubrication.lasts_km", "lasts_hours already gives this"),
        (["lubrication.at_hours=[2,1]"], "lubrication.at_hours", "must rise"),
        (["lubrication.when_rate_exceeds=1"], "lubrication.when_rate_exceeds", "greater than 1"),
        (["lubrication.completeness=0"], "lubrication.completeness", "greater than 0"),
        (["lubrication.completeness=1.1"], "lubrication.completeness", "1"),
        (["lubrication.contamination_removed=1.1"], "lubrication.contamination_removed", "1"),
        (["lubrication.dry_factor=0.5"], "lubrication.dry_factor", "1"),
        (
            ["lubrication.minutes_per_application=3"],
            "lubrication.minutes_per_application",
            "labour_cost_per_hour",
        ),
        (
            ["lubrication.labour_cost_per_hour=3"],
            "lubrication.labour_cost_per_hour",
            "minutes_per_application",
        ),
        (
            ["lubrication.environment=clean"],
            "lubrication.contamination_factor",
            "a clean environment has none",
        ),
    ],
)
def test_bad_input_is_named(settings: list[str], key: str, words: str) -> None:
    text = faults(STRAND, *settings)
    assert key in text
    assert words in text


@pytest.mark.parametrize(
    ("table", "key", "words"),
    [
        ({"lubricant": "dry", "interval_hours": 10}, "interval_hours", "needs a lubricant"),
        ({"lubricant": "dry", "lasts_hours": 10}, "lasts_hours", "dry contacts have no lubricant"),
        ({"lubricant": "drip", "interval_hours": 10}, "interval_hours", "supplied continuously"),
        ({"lubricant": "manual", "when_rate_exceeds": 2}, "lasts_hours", "nothing is known about how long"),
        ({"lasts_hours": 10, "interval_hours": 10}, "dry_factor", "needed where a lubricant ages"),
        ({"lubricant": "manual", "fades_over_hours": 10}, "fades_over_hours", "needs lasts_hours"),
        (
            {"lubricant": "drip", "phase": [{"hours": 1, "km": 2}]},
            "phase.1.hours",
            "exactly one of hours and km",
        ),
        (
            {"lubricant": "drip", "phase": [{"hours": 1, "contaminations": 2}]},
            "phase.1.contaminations",
            "dirt",
        ),
        ({"lubricant": "dry", "phase": [{"hours": 1, "relubrications": 2}]}, "phase", "needs a lubricant"),
        (
            {"lubricant": "manual", "lasts_hours": 9, "environment": "wet", "when_rate_exceeds": 3},
            "when_rate_exceeds",
            "dirt alone",
        ),
    ],
)
def test_contradictory_table_is_named(table: dict[str, Any], key: str, words: str) -> None:
    text = faults({**STRAND, "lubrication": table})
    assert f"lubrication.{key}" in text
    assert words in text


def test_a_schedule_changes_nothing_where_nobody_knows_how_long_a_lubricant_lasts() -> None:
    by_hand = {**STRAND, "lubrication": {"lubricant": "manual"}}
    scheduled = {**STRAND, "lubrication": {"lubricant": "manual", "interval_hours": 10}}
    assert hours(scheduled) == hours(by_hand)
    (text,) = (text for text in wearsim.load_case(scheduled).warnings if "is not known" in text)
    assert "lubrication.interval_hours does not change the wear; give lubrication.lasts_hours" in text


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        (
            {"interval_hours": 2e6},
            "lubrication.interval_hours = 2e+06 is longer than the run, run.horizon_hours = 1e+06: contacts "
            "are never relubricated; the lubricant is gone from 20 h on",
        ),
        (
            {"interval_hours": None, "interval_km": 3e7},
            "lubrication.interval_km = 3e+07 is longer than the run, run.horizon_hours = 1e+06: contacts "
            "are never relubricated; the lubricant is gone from 20 h on",
        ),
        (
            {"interval_hours": None, "at_hours": [1.0, 2e6]},
            "lubrication.at_hours: 1 of 2 relubrications come after the run, run.horizon_hours = 1e+06",
        ),
    ],
)
def test_relubrication_after_the_run_is_warned_of(changes: dict[str, Any], expected: str) -> None:
    assert wearsim.load_case(_with(**changes)).warnings.count(expected) == 1


@pytest.mark.parametrize(
    ("changes", "key", "then"),
    [
        ({"interval_hours": 3000.0}, "interval_hours = 3000 is longer than", "is gone from 20 h on"),
        ({"interval_hours": None, "interval_km": 3e4}, "interval_km = 30000 is longer than", "from 20 h on"),
        (
            {"interval_hours": None, "interval_sliding_m": 9e5},
            "interval_sliding_m = 900000 is longer",
            "from 20 h on",
        ),
        (
            {"interval_hours": None, "at_hours": [3e3, 4e3]},
            "at_hours = 3000 comes after",
            "gone from 20 h on",
        ),
        (
            {"interval_hours": 9e3, "lasts_hours": 12.0, "fades_over_hours": 8e3},
            "= 9000",
            "fades from 12 h on",
        ),
        ({"interval_hours": 9e3, "lasts_hours": 8e3}, "= 9000", "lasts until then"),
    ],
)
def test_life_before_the_first_relubrication_is_warned_of(
    changes: dict[str, Any], key: str, then: str
) -> None:
    """The lubricant keeps its effect for 12 h and loses it over 8 h."""
    result = wearsim.simulate(wearsim.load_case(_with(**changes)))
    (text,) = (one for one in result.warnings if "never relubricated" in one)
    assert text.startswith("lubrication.")
    assert f"{key}" in text
    assert f"the life of the flank, {grouped(result.life.hours_run)} h: the flank is never" in text
    assert text.endswith(then)
    (batched,) = wearsim.simulate_many([wearsim.load_case(_with(**changes))])
    assert text in batched.warnings


def test_run_before_the_first_relubrication_is_warned_of() -> None:
    """A fixed horizon, with an interval that is known in hours only when the flank is."""
    case = wearsim.load_case(
        _with(interval_hours=None, interval_sliding_m=9e5, lasts_hours=None, lasts_sliding_m=1e5),
        ["run.horizon_hours=5"],
    )
    assert not any("relubricated" in text for text in case.warnings)
    (text,) = (one for one in wearsim.simulate(case).warnings if "never relubricated" in one)
    assert text.startswith("lubrication.interval_sliding_m = 900000 is longer than the run of the flank, 5 h")
    assert text.endswith("lasts until then")


def test_relubrication_in_time_is_not_warned_of() -> None:
    assert not any("relubricated" in text for text in wearsim.simulate(wearsim.load_case(STRAND)).warnings)


def test_parts_of_a_wrap_are_warned_of_each() -> None:
    """The interval lies between the lives of chain and sprocket, all dry from 30 h/2.4 of dusty oil on."""
    table = {"lubricant": "manual", "environment": "dust", "lasts_hours": 30.0, "interval_hours": 9e4}
    result = wearsim.simulate(wearsim.load_case({**WRAP, "lubrication": table}))
    texts = [one for one in result.warnings if "never relubricated" in one]
    assert texts == [
        f"lubrication.interval_hours = 90000 is longer than the life of the {part}, "
        f"{grouped(result.parts[part].hours_run)} h: the {part} is never relubricated; the lubricant "
        "is gone from 12.5 h on"
        for part in ("chain", "sprocket")
    ]
    between = {**table, "interval_hours": 1.001 * min(life.hours_run for life in result.parts.values())}
    again = wearsim.simulate(wearsim.load_case({**WRAP, "lubrication": between}))
    (text,) = (one for one in again.warnings if "never relubricated" in one)
    assert f"the {min(result.parts, key=lambda name: result.parts[name].hours_run)} is never" in text


def test_threshold_that_is_never_reached_is_warned_of() -> None:
    case = wearsim.load_case(_with(interval_hours=None, when_rate_exceeds=60.0))
    assert any("never reached" in text for text in case.warnings)


def dried_teeth(tables: dict[str, Any], *settings: str) -> list[str]:
    warnings = wearsim.load_case(tables, settings).warnings
    return [warning for warning in warnings if "teeth that have dried out" in warning]


@pytest.mark.parametrize(
    ("lubricant", "rates"),
    [
        # 39 * 5e-10 = 1.95e-8, over 1e-8: 1.95; 58 * 3.3e-10 = 1.914e-8.
        ("manual", ("39", "1.95e-08 mm2/N", "1e-08 mm2/N", "1.95 times too short")),
        ("drip", ("58", "1.91e-08 mm2/N", "1e-08 mm2/N", "1.91 times too short")),
    ],
)
def test_teeth_that_dry_out_beyond_dry_ones_are_warned_of(lubricant: str, rates: tuple[str, ...]) -> None:
    tables = {**STRAND, "lubrication": {"lubricant": lubricant, "lasts_hours": 12.0}}
    (warning,) = dried_teeth(tables, "wear.tooth_hardness=normalised")
    assert all(rate in warning for rate in ("'normalised, dry'", *rates))


@pytest.mark.parametrize(
    "settings",
    [
        ["wear.tooth_hardness=hardened"],  # 39 * 7.5e-11 = 2.9e-9, below 1e-8
        ["wear.tooth_hardness=normalised", "lubrication.dry_factor=19.9"],  # 9.95e-9
        ["wear.specific_wear_rate_mm2_per_N=5e-10"],
    ],
)
def test_other_teeth_that_dry_out_are_not_warned_of(settings: list[str]) -> None:
    assert not dried_teeth(STRAND, *settings)


def test_gears_take_their_own_numbers_only() -> None:
    case = CASES / "fzg-c14-16t-mild.toml"
    for setting, words in (
        ("lubricant=drip", "catalogue are for chains"),
        ("interval_km=3", "gears run no km"),
    ):
        with pytest.raises(CaseError, match=words):
            wearsim.load_case(case, [f"lubrication.{setting}"])


def test_lubricants_and_environments_are_listed() -> None:
    from click.testing import CliRunner

    from wearsim.cli.main import wearsim_command

    for table, names in (("lubricants", lubricants()), ("environments", environments())):
        text = CliRunner().invoke(wearsim_command, ["list", table]).output
        assert all(name in text for name in names)
        assert max(map(len, text.splitlines())) <= 100
        rows = json.loads(CliRunner().invoke(wearsim_command, ["list", table, "--json"]).output)
        assert len(rows) == len(names)
        assert all(row["source"] for row in rows)


@pytest.mark.parametrize("key", ["lubrication.lubricant", "wear.band_factor"])
def test_studies_take_a_case_without_wear(key: str) -> None:
    """The wear condition of each lubricant is its own."""
    case = {**WRAP, "lubrication": {"lubricant": "drip"}}
    values = ["drip", "dry"] if key.endswith("lubricant") else [2.0, 4.0]
    found = wearsim.sweep(case, {key: values}).cases
    lives = found["life_hours"].tolist()
    assert lives[0] == pytest.approx(hours(case), rel=1e-12)
    assert (lives[1] < 0.1 * lives[0]) == key.endswith("lubricant")


def test_uncertainty_of_a_case_without_wear() -> None:
    case = {**WRAP, "lubrication": {"lubricant": "drip", "environment": "dust"}}
    table = {"load.tension_N": {"distribution": "lognormal", "sigma_ln": 0.2}}
    found = wearsim.uncertainty(case, table, samples=2)
    assert found.summary()["samples"] == 2


def test_maintain_refuses_a_lubricant_that_changes() -> None:
    from wearsim.study.maintain.model import maintain

    dries = {"lubricant": "manual", "lasts_hours": 20, "interval_hours": 30}
    with pytest.raises(CaseError, match="wearsim lubricate"):
        maintain(wearsim.load_case({**WRAP, "lubrication": dries}))


def test_remaining_takes_dirt_that_stays() -> None:
    """Dust multiplies all wear by 3.6, so that a reading tells the same life in hours."""
    found = [
        wearsim.remaining(
            wearsim.load_case({**WRAP, "lubrication": {"lubricant": "drip", "environment": word}}),
            hours=100.0,
            elongation_percent=1.0,
        )
        for word in ("clean", "dust")
    ]
    assert found[1].found.life.hours == pytest.approx(found[0].found.life.hours, rel=1e-9)
    assert found[1].found.factor == pytest.approx(found[0].found.factor / 3.6, rel=1e-9)


@pytest.mark.parametrize("command", ["uncertainty", "sensitivity"])
def test_studies_take_a_case_with_a_hardness(cli, tmp_path, command):
    """As `init` writes it: the rate that a study gives takes the place of the hardness."""
    path = tmp_path / "strand.toml"
    path.write_text(
        'format_version = 1\n[chain]\ndesignation = "16B-1"\n[sprocket]\nteeth = 20\nprofile = "evolute"\n'
        "nodes = 51\n[load]\npower_kW = 3\nspeed_rpm = 100\n[run]\nlife_tolerance = 0.1\n"
        '[wear]\ntooth_hardness = "normalised"\n[lubrication]\nlubricant = "manual"\n'
    )
    more = ("--samples", 8) if command == "uncertainty" else ()
    done = cli(command, path, *more)
    assert done.code == 0, done.err
    assert "failed" not in done.out + done.err
