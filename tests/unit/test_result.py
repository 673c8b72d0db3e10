"""A result is complete, says when a life is only bounded, and comes back as it was saved."""

import dataclasses
import json
import shutil

import jsonschema
import numpy as np
import pandas as pd
import pytest

import wearsim
from tests import damage, drives
from wearsim.cli.schema import result_schema
from wearsim.drive.load_case import load_case
from wearsim.errors import LimitNotReachedError, OutputError
from wearsim.report.flank_view import profile_table
from wearsim.result import Life, LowerBound, WearResult

STRAND = drives.changed(
    drives.STRAND,
    {
        "title": 'Title with "quotes", ü and | signs',
        "sprocket.evolute_offset_mm": 5.6,
        "stop.critical_depth_mm": 0.05,
    },
)


def mapping(kind, folder):
    """Tables of one kind of case; its CSV file carries a name that a run folder uses itself."""
    if kind == "points":
        flank = profile_table(load_case(STRAND))
        flank.to_csv(folder / "flank.csv", columns=["x_mm", "y_mm"], index=False)
        sprocket = {**STRAND["sprocket"], "profile": "points", "points_file": "flank.csv"}
        return {**STRAND, "sprocket": sprocket}
    if kind == "prescribed":
        arc = np.linspace(0.0, 5.0, 31)
        table = {
            "arc_length_mm": arc,
            "load_per_width_N_per_mm": 100.0 + arc,
            "flank_curvature_per_mm": np.full(31, -0.01),
            "slip_ratio": np.full(31, 0.5),
        }
        pd.DataFrame(table).to_csv(folder / "history.csv", index=False)
        mechanism = {"kind": "prescribed", "table_file": "history.csv"}
        tables = {**STRAND, "mechanism": mechanism, "load": {"speed_rpm": 100}}
        del tables["sprocket"]
        return tables
    if kind == "per_cycle":
        wear = {"law": "power", "coefficient": 1e-11, "pressure_exponent": 2.0}
        return {**STRAND, "wear": wear, "run": {"method": "per_cycle"}}
    if kind == "bound":
        return {**STRAND, "run": {"horizon_hours": 100}}
    return STRAND


KINDS = ["strand", "points", "prescribed", "per_cycle", "bound"]


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Result of each kind, and the folder that it was saved in."""
    made = {}

    def get(kind):
        if kind not in made:
            folder = tmp_path_factory.mktemp(kind)
            with pytest.MonkeyPatch.context() as patch:
                patch.chdir(folder)
                result = wearsim.simulate(load_case(mapping(kind, folder)))
            result.save(folder / "run")
            made[kind] = result, folder / "run"
        return made[kind]

    return get


def assert_equal_columns(one, other):
    assert list(one) == list(other)
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


@pytest.mark.wide
@pytest.mark.parametrize("kind", KINDS)
def test_load_gives_back_what_was_saved(results, kind):
    result, folder = results(kind)
    loaded = WearResult.load(folder)
    for field in dataclasses.fields(WearResult):
        one, other = getattr(result, field.name), getattr(loaded, field.name)
        if field.name.endswith("_columns"):
            assert_equal_columns(one, other)
        else:
            assert one == other, field.name
    pd.testing.assert_frame_equal(result.history, loaded.history, check_exact=True)
    pd.testing.assert_frame_equal(result.flank, loaded.flank, check_exact=True)
    assert loaded.summary() == result.summary()


@pytest.mark.wide
@pytest.mark.parametrize("kind", KINDS)
def test_lock_runs_again_to_the_same_numbers_anywhere(results, kind, tmp_path):
    result, folder = results(kind)
    moved = tmp_path / "moved"
    shutil.copytree(folder, moved)
    again = wearsim.simulate(load_case(moved / "case.lock.toml"))
    assert again.life == result.life
    assert (again.life_low, again.life_high) == (result.life_low, result.life_high)
    assert_equal_columns(again.history_columns, result.history_columns)
    assert_equal_columns(again.flank_columns, result.flank_columns)
    again.save(tmp_path / "again")
    once_more = wearsim.simulate(load_case(tmp_path / "again" / "case.lock.toml"))
    assert once_more.life == result.life


@pytest.mark.parametrize("kind", KINDS)
def test_summary_conforms_to_its_schema(results, kind):
    result, _ = results(kind)
    line = json.loads(json.dumps(result.summary(), allow_nan=False))
    jsonschema.Draft202012Validator.check_schema(result_schema())
    jsonschema.Draft202012Validator(result_schema()).validate(line)
    assert next(iter(line)) == "schema_version"


def test_files_and_columns(results):
    """Names and order of the columns as the file format promises them."""
    _, folder = results("points")
    names = sorted(str(path.relative_to(folder)) for path in folder.rglob("*"))
    assert names == [
        ".wearsim",
        "case.lock.toml",
        "environment.json",
        "flank.csv",
        "history.csv",
        "inputs",
        "inputs/flank.csv",
        "result.json",
    ]
    assert (folder / "history.csv").read_text().splitlines()[0] == (
        "cycles,time_hours,max_depth_mm,peak_pressure_MPa,max_sliding_speed_mm_per_s,"
        "removed_area_mm2,worn_contact_ratio"
    )
    assert (folder / "flank.csv").read_text().splitlines()[0] == (
        "cycles,node,arc_length_mm,x_mm,y_mm,depth_mm,pressure_MPa,sliding_speed_mm_per_s,"
        "load_per_width_N_per_mm,relative_curvature_per_mm"
    )


def test_snapshots_are_about_two_hundred_at_most(results):
    for kind in ("strand", "per_cycle"):
        result, _ = results(kind)
        assert 20 <= len(result.history) <= 220
        points = result.flank["node"].max()
        assert points >= 51 and len(result.flank) == points * len(result.history)


def test_history_ends_at_the_life(results):
    result, _ = results("strand")
    last = result.history.iloc[-1]
    assert last["cycles"] == result.life.cycles == result.cycles
    assert last["time_hours"] == pytest.approx(result.life.hours, rel=1e-14)
    assert last["max_depth_mm"] == result.max_depth == pytest.approx(0.05, rel=1e-9)
    assert result.flank["depth_mm"].iloc[-51:].max() == result.max_depth


def test_bound_has_no_hours(results):
    result, _ = results("bound")
    assert isinstance(result.life, LowerBound)
    assert result.life.hours_run == pytest.approx(100.0, rel=1e-12)
    assert result.stop == "horizon_hours"
    for name in ("hours", "cycles"):
        with pytest.raises(LimitNotReachedError, match=r"within 100 h .*raise run.horizon_hours"):
            getattr(result.life, name)
    with pytest.raises(LimitNotReachedError):
        _ = result.cycles
    summary = result.summary()
    assert summary["life_reached"] is False
    assert summary["life_hours"] is None and summary["cycles"] is None


def test_low_and_high_lives_scale_with_the_coefficient(results):
    """Wear of a law is linear in its coefficient: 5e-11 against 1.7e-11 and 1.5e-10."""
    result, _ = results("strand")
    assert result.life_high.hours == pytest.approx(result.life.hours * 5 / 1.7, rel=1e-12)
    assert result.life_low.hours == pytest.approx(result.life.hours / 3, rel=1e-12)


def test_result_cannot_be_changed(results):
    result, _ = results("strand")
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.life = Life(1.0, 1.0)


def test_save_refuses_a_folder_that_is_there(results, tmp_path):
    result, _ = results("strand")
    with pytest.raises(OutputError, match="must not exist yet"):
        result.save(tmp_path)
    result.save(tmp_path / "a" / "b")
    result.save(tmp_path / "a" / "b", force=True)
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b"]


@pytest.mark.parametrize("force", [True, False])
def test_failed_save_leaves_the_old_or_nothing(results, tmp_path, monkeypatch, force):
    result, _ = results("strand")
    if force:
        results("bound")[0].save(tmp_path / "run")

    def full(*args, **options):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(pd.DataFrame, "to_csv", full)
    with pytest.raises(OutputError, match="No space left on device"):
        result.save(tmp_path / "run", force=force)
    assert [path.name for path in tmp_path.iterdir()] == (["run"] if force else [])
    if force:
        assert isinstance(WearResult.load(tmp_path / "run").life, LowerBound)


def without(name):
    return lambda folder: (folder / name).unlink()


def replaced(name, old, new):
    def change(folder):
        text = (folder / name).read_text(encoding="utf-8")
        assert old in text
        (folder / name).write_text(text.replace(old, new), encoding="utf-8")

    return change


def content(name, text):
    return lambda folder: (folder / name).write_text(text, encoding="utf-8")


BROKEN = {
    "no result": without("result.json"),
    "no lock": without("case.lock.toml"),
    "no environment": without("environment.json"),
    "no history": without("history.csv"),
    "no flank": without("flank.csv"),
    "no points": without("inputs/flank.csv"),
    "other version": replaced("result.json", '"schema_version": 1', '"schema_version": 2'),
    "no version": replaced("result.json", '"schema_version": 1,', ""),
    "key missing": replaced("result.json", '"updates"', '"update"'),
    "lives missing": replaced("result.json", '"lives"', '"live"'),
    "life of nothing": replaced("result.json", '"hours":', '"days":'),
    "no JSON": content("result.json", "{"),
    "a list": content("result.json", "[]"),
    "no TOML": content("case.lock.toml", "a ="),
    "empty history": content("history.csv", ""),
    "head only": content("history.csv", "cycles\n"),
    "other column": replaced("flank.csv", "depth_mm", "depth_um"),
    "cut flank": content("flank.csv", "cycles,node\n1,2\n"),
}


@pytest.mark.parametrize("how", BROKEN)
def test_broken_folder(results, tmp_path, how):
    _, folder = results("points")
    copy = tmp_path / "run"
    shutil.copytree(folder, copy)
    BROKEN[how](copy)
    with pytest.raises(OutputError, match="run: "):
        WearResult.load(copy)


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("result.json", '"warnings": [', '"warnings": ["of mine", '),
        ("case.lock.toml", "nodes = 51", "nodes = 61"),
        ("environment.json", '"wearsim": "', '"wearsim": "9.'),
        ("history.csv", "\n0.0,0.0,0.0,", "\n0.0,0.0,1e-9,"),
        ("flank.csv", "\n0.0,1,0.0,", "\n0.0,1,1e-9,"),
        ("inputs/flank.csv", "\n", "\n\n"),
    ],
)
def test_folder_that_was_changed(results, tmp_path, name, old, new):
    """Values that could be right all the same; without digests, as in folders of before, they are."""
    copy = shutil.copytree(results("points")[1], tmp_path / "run")
    replaced(name, old, new)(copy)
    with pytest.raises(OutputError, match=f": {name} must be as wearsim wrote it .*: run its case again"):
        WearResult.load(copy)
    damage.without_digests(copy)
    WearResult.load(copy)


def test_folder_with_a_file_of_another_run(results, tmp_path):
    copy = shutil.copytree(results("strand")[1], tmp_path / "run")
    shutil.copy(results("per_cycle")[1] / "result.json", copy)
    with pytest.raises(OutputError, match="is changed or of another run"):
        WearResult.load(copy)


def test_folder_keeps_its_digests_under_other_line_ends(results, tmp_path):
    """As a checkout on Windows has them, or an editor that lays out JSON otherwise."""
    result, folder = results("points")
    copy = shutil.copytree(folder, tmp_path / "run")
    for path in [path for path in copy.rglob("*.*") if path.is_file()]:
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    (copy / "result.json").write_text(json.dumps(json.loads((copy / "result.json").read_text("utf-8"))))
    assert WearResult.load(copy).life == result.life


@pytest.mark.parametrize(
    "name", ["result.json", "case.lock.toml", "history.csv", "inputs/flank.csv", "inputs"]
)
def test_folder_with_a_link_out_of_it(results, tmp_path, name):
    """What it leads to is not read, nor quoted; links within the folder are as good as files."""
    copy = shutil.copytree(results("points")[1], tmp_path / "run")
    (copy / name).rename(tmp_path / "elsewhere")
    (copy / name).symlink_to(tmp_path / "elsewhere")
    with pytest.raises(OutputError, match=f": {name}.* must lie in this folder, but is a link out of it"):
        WearResult.load(copy)
    with wearsim.allow_outside():
        WearResult.load(copy)
    (copy / name).unlink()
    (tmp_path / "elsewhere").rename(copy / "elsewhere")
    (copy / name).symlink_to(copy / "elsewhere")
    WearResult.load(copy)


def test_no_folder(tmp_path):
    with pytest.raises(OutputError, match="must be the folder of a result"):
        WearResult.load(tmp_path / "none")


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("[]", "result.json must hold one JSON object"),
        ("{", "result.json is not readable JSON"),
        ('{"schema_version": 1}', "case.lock.toml: No such file or directory"),
    ],
)
def test_folder_that_is_no_result_is_told_in_plain_words(tmp_path, content, told):
    (tmp_path / "result.json").write_text(content)
    with pytest.raises(OutputError, match=told) as caught:
        wearsim.WearResult.load(tmp_path)
    assert "Error" not in str(caught.value)
