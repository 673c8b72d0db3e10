"""The runner of studies: the same numbers wherever they run, and nothing lost."""

import errno
import hashlib
import os
from concurrent.futures import Future
from contextlib import contextmanager
from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import pytest

import wearsim
from wearsim.errors import CaseError, Fault, OutputError, StudyError
from wearsim.input.document import read_document
from wearsim.runner import design as design_module
from wearsim.runner import run_study as run_module
from wearsim.runner.design import Engine, content_hash, design, replaced
from wearsim.runner.run_study import run_study
from wearsim.runner.shard import run_shard, shards
from wearsim.runner.workers import SharedWorkers, Threads

CASE = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute", "nodes": 51},
    "load": {"tension_N": 3000.0, "speed_rpm": 100},
    "wear": {"specific_wear_rate_mm2_per_N": 5e-11},
    "stop": {"critical_depth_mm": 0.05},
}


@pytest.fixture
def cases(monkeypatch):
    """Ten cases in shards of three; the last one cannot be run."""
    monkeypatch.setattr(design_module, "MANY", 3)
    tensions = [*np.linspace(2000.0, 4000.0, 9).tolist(), -1.0]
    return design(read_document(CASE, []), ["load.tension_N"], [(t,) for t in tensions], "test")


def test_what_takes_longer_goes_in_smaller_parts():
    def size(tables, key="load.tension_N", value=1.0):
        return design(read_document(tables, []), [key], [(value,)], "test").cases_per_shard

    fatigue = {"sprocket": {"treatment": "quenched_and_tempered", "hardness_HB": 250.0}}
    sizes = (size({**CASE, "mechanism": {"kind": "wrap"}}), size({**CASE, "fatigue": fatigue}), size(CASE))
    assert sizes == (design_module.FEW, design_module.SOME, design_module.MANY)
    assert size(CASE, "fatigue.load_factor") == design_module.SOME


def same(first, second):
    return first.to_csv(index=False) == second.to_csv(index=False)


def test_lives_are_those_of_single_runs_to_the_bit(cases):
    table = run_study(cases, Threads(2))
    assert table["case_index"].tolist() == list(range(10))
    for index in (0, 8):
        case = wearsim.load_case(cases.tables_of(index))
        assert table["life_hours"][index] == wearsim.simulate(case).life.hours
    assert table["error"][9].startswith("load.tension_N: must be greater than 0")
    assert np.isnan(table["life_hours"][9])
    assert (table["error"][:9] == "").all()


def test_neither_order_nor_number_of_workers_matters(cases):
    table = run_study(cases, Threads(1))
    assert same(table, run_study(cases, Threads(3)))
    backwards = [run_shard(shard) for shard in reversed(list(shards(cases)))]
    hours = [value for rows in reversed(backwards) for value in rows["life_hours"]]
    assert hours[:9] == table["life_hours"][:9].tolist()


def test_bound_where_no_limit_is_met(cases):
    tables = {**CASE, "run": {"horizon_hours": 10.0}}
    table = run_study(replace(cases, tables=tables), Threads(1))
    assert table["life_hours"].isna().all()
    assert (table["hours_run"][:9] == 10.0).all()
    assert (table["stop"][:9] == "horizon_hours").all()


def test_other_engine_is_refused_with_both_versions(cases):
    shard = next(shards(cases))
    with pytest.raises(StudyError, match=r"wearsim .* the study 9\.9 \(abc\)"):
        run_shard(replace(shard, engine=Engine("9.9", "abc")))


class Dying:
    """Workers of which every other one dies at its shard."""

    losses = (ConnectionError,)

    def __init__(self, most_deaths):
        self.most_deaths, self.deaths, self.opened, self.shards = most_deaths, 0, 0, []

    @contextmanager
    def open(self):
        self.opened += 1
        yield self, 2

    def submit(self, function, shard):
        future = Future()
        if self.deaths < self.most_deaths and shard.first % 2:
            self.deaths += 1
            future.set_exception(ConnectionError())
        else:
            self.shards.append(shard.first)
            future.set_result(function(shard))
        return future


def test_death_of_workers_loses_and_repeats_nothing(cases):
    workers = Dying(most_deaths=3)
    assert same(run_study(cases, workers), run_study(cases, Threads(1)))
    assert workers.deaths == 3
    assert sorted(workers.shards) == [0, 3, 6, 9]


class DyingEarly(Dying):
    """Workers that are found dead when one of the first shards is given to them."""

    def submit(self, function, shard):
        if self.deaths < self.most_deaths and shard.first == 6:
            self.deaths += 1
            raise ConnectionError
        self.shards.append(shard.first)
        future = Future()
        future.set_result(function(shard))
        return future


def test_death_before_a_shard_is_given_loses_and_repeats_nothing(cases):
    workers = DyingEarly(most_deaths=1)
    assert same(run_study(cases, workers), run_study(cases, Threads(1)))
    assert (workers.deaths, workers.opened) == (1, 2)
    assert sorted(workers.shards) == [0, 3, 6, 9]


def test_workers_stay_open_until_one_dies(cases):
    workers = Dying(most_deaths=2)
    kept = SharedWorkers(workers)
    assert same(run_study(cases, kept), run_study(cases, Threads(1)))
    assert (workers.deaths, workers.opened) == (2, 2)
    assert same(run_study(cases, kept), run_study(cases, Threads(1)))
    assert workers.opened == 2
    kept.close()
    assert same(run_study(cases, kept), run_study(cases, Threads(1)))
    assert workers.opened == 3


def test_study_ends_when_all_workers_die(cases):
    with pytest.raises(StudyError, match="workers died 3 times"):
        run_study(cases, Dying(most_deaths=99))


def test_dates_of_a_case_have_a_hash():
    hashes = [content_hash({"start_date": date(2026, 1, day)}) for day in (1, 2)]
    assert hashes[0] != hashes[1]


def test_key_that_is_none_is_named():
    with pytest.raises(CaseError, match=r'test: "sprocket.teth": must be a key of a case; did you'):
        design(read_document(CASE, []), ["sprocket.teth"], [(17,)], "test")


def test_key_of_a_list_of_tables():
    blocks = [{"share_of_time": 0.5, "power_kW": 3.0, "speed_rpm": n} for n in (100, 50)]
    document = read_document({**CASE, "load": {}, "duty": blocks}, [])
    cases = design(document, ["duty.2.speed_rpm"], [(80,)], "test")
    assert cases.tables_of(0)["duty"][1]["speed_rpm"] == 80
    assert cases.tables_of(0)["duty"][0] == blocks[0]
    for key in ("duty.3.speed_rpm", "format_version.x"):
        with pytest.raises(CaseError, match="must be a key of the case"):
            replaced(document.data, key.split("."), 1)


def test_files_go_with_the_study(tmp_path, monkeypatch):
    source = Path(__file__).parents[2] / "cases" / "hertz-arc-prescribed.toml"
    document = read_document(source, [])
    key = "wear.specific_wear_rate_mm2_per_N"
    cases = design(document, [key], [(1e-10,), (2e-10,)], "test")
    monkeypatch.chdir(tmp_path)
    table = run_study(cases, Threads(1))
    assert (table["error"] == "").all()
    one, two = table["cycles_run"]
    assert one == pytest.approx(2.0 * two, rel=1e-3)


def test_address_depends_on_all_that_lives_depend_on(cases):
    others = [
        replace(cases, tables={**CASE, "stop": {"critical_depth_mm": 0.06}}),
        replace(cases, rows=cases.rows[:-1]),
        replace(cases, keys=("load.speed_rpm",)),
        replace(cases, files={"a.csv": "1"}),
    ]
    assert len({case.address() for case in [cases, *others]}) == 5
    assert replace(cases, name="other").address() == cases.address()
    assert content_hash({"a": 1.0}) != content_hash({"a": 1.5})


@pytest.fixture
def store(cases, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    from wearsim.runner.store import open_store

    return open_store(tmp_path / "study", cases, {"study": "test"}, False)


def run_count(monkeypatch):
    """Shards that are run from here on."""
    seen = []

    def counted(shard):
        seen.append(shard.first)
        return run_shard(shard)

    monkeypatch.setattr(run_module, "run_shard", counted)
    return seen


def test_finished_shards_are_not_run_again(cases, store, monkeypatch):
    whole = run_study(cases, Threads(1), store)
    seen = run_count(monkeypatch)
    assert same(run_study(cases, Threads(1), store), whole)
    assert seen == []
    second, third = list(shards(cases))[1:3]
    store.path(second).write_bytes(store.path(second).read_bytes()[:-40])
    store.path(third).unlink()
    assert same(run_study(cases, Threads(1), store), whole)
    assert sorted(seen) == [3, 6]


def test_no_flipped_bit_is_taken_for_a_life(cases, store):
    whole = run_study(cases, Threads(1), store)
    (shard, *_) = shards(cases)
    path, rng = store.path(shard), np.random.default_rng(1)
    sound = path.read_bytes()
    right = store.finished(shard)
    for place in rng.integers(8 * len(sound), size=200):
        changed = bytearray(sound)
        changed[place // 8] ^= 1 << (place % 8)
        path.write_bytes(changed)
        assert store.finished(shard) in (None, right)
    path.write_bytes(sound)
    assert same(run_study(cases, Threads(1), store), whole)


@pytest.mark.parametrize("kind", ["rows", "text", "pipe", "device", "empty"])
def test_a_shard_that_would_fill_the_memory_is_run_again(cases, store, kind, not_for_ever, monkeypatch):
    """What is no file, has more rows than cases or longer texts than fit is never read."""
    import pyarrow
    from pyarrow import parquet

    whole = run_study(cases, Threads(1), store)
    (shard, *_) = shards(cases)
    path = store.path(shard)
    table = parquet.read_table(path)
    path.unlink()
    if kind == "rows":
        parquet.write_table(pyarrow.concat_tables([table] * 1000), path)
    elif kind == "text":
        place = table.column_names.index("warnings")
        texts = pyarrow.array([20_000_000 * "a"] * (table.num_rows - 1) + [40_000_000 * "b"])
        parquet.write_table(table.set_column(place, "warnings", texts), path, compression="zstd")
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    else:
        path.touch()
    read = []
    monkeypatch.setattr(parquet, "read_table", lambda path: read.append(path) or table)
    assert store.finished(shard) is None
    assert read == []
    monkeypatch.undo()
    assert same(run_study(cases, Threads(1), store), whole)


def test_manifest_without_end_is_not_read(cases, store):
    """A pipe in its place is not waited for, either."""
    from wearsim.runner.store import open_store

    run_study(cases, Threads(1), store)
    os.truncate(store.folder / "study.json", 3_000_000_000)
    with pytest.raises(OutputError, match="must be readable: it has"):
        open_store(store.folder, cases, {"study": "test"}, True)


def test_rows_of_other_cases_are_not_taken(cases, store):
    run_study(cases, Threads(1), store)
    first, second = list(shards(cases))[:2]
    store.path(first).write_bytes(store.path(second).read_bytes())
    assert store.finished(first) is None
    assert store.finished(second) is not None


def test_full_disk_keeps_what_is_finished(cases, store, monkeypatch):
    flushed, fsync = [], os.fsync

    def full(handle):
        flushed.append(handle)
        if len(flushed) > 2:
            raise OSError(errno.ENOSPC, "No space left on device")
        fsync(handle)

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError, match="No space left on device; what is finished is kept"):
        run_study(cases, Threads(1), store)
    monkeypatch.setattr(os, "fsync", fsync)
    assert len(list((store.folder / "shards").iterdir())) == 2
    seen = run_count(monkeypatch)
    run_study(cases, Threads(1), store)
    assert len(seen) == 2


def test_folder_of_another_study_is_refused(cases, store, tmp_path):
    from wearsim.runner.store import open_store

    other = replace(cases, rows=cases.rows[:-1])
    with pytest.raises(OutputError, match="must hold this study to go on"):
        open_store(store.folder, other, {"study": "test"}, False)
    assert open_store(store.folder, other, {"study": "test"}, True).folder == store.folder
    (store.folder / "study.json").write_bytes(b"\xff\xfe")
    with pytest.raises(OutputError, match="must hold this study to go on"):
        open_store(store.folder, cases, {"study": "test"}, False)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(OutputError, match="must be new or hold a study"):
        open_store(tmp_path / "mine", cases, {"study": "test"}, True)


@pytest.mark.parametrize("content", ["mine", '{"schema_version": 1}'])
def test_folder_of_a_stranger_is_never_taken(cases, tmp_path, content):
    from wearsim.runner.store import check_store, open_store

    (tmp_path / "study.json").write_text(content)
    for take in (open_store, check_store):
        with pytest.raises(OutputError, match="must be new or hold a study of wearsim"):
            take(tmp_path, cases, {"study": "test"}, True)
    assert [path.name for path in tmp_path.iterdir()] == ["study.json"]
    assert (tmp_path / "study.json").read_text() == content


def test_marker_of_a_study_names_its_files(cases, tmp_path):
    from wearsim.report.study_files import save_files
    from wearsim.runner.store import open_store

    folder = open_store(tmp_path / "study", cases, {"study": "test"}, False).folder

    def named():
        return (folder / ".wearsim").read_text().splitlines()[1:]

    assert named() == ["study.json"]
    save_files(folder, {"cases.csv": "ours"})
    assert named() == ["cases.csv", "study.json"]
    (folder / "summary.md").write_text("mine")
    with pytest.raises(OutputError, match=r"summary\.md: must be free for the study"):
        save_files(folder, {"cases.csv": "new", "summary.md": "new"})
    assert (folder / "summary.md").read_text() == "mine"
    assert (folder / "cases.csv").read_text() == "ours"
    other = replace(cases, rows=cases.rows[:-1])
    assert open_store(folder, other, {"study": "test"}, True).folder == folder
    assert named() == ["study.json"]
    assert sorted(path.name for path in folder.iterdir()) == [".wearsim", "study.json", "summary.md"]


def test_warnings_and_errors_stay_apart():
    from wearsim.runner import shard as shard_module

    found = shard_module.CaseLife("x", shard_module.Life(1.0, 1.0), "stop", 0.0, ("a; b", "c"))
    assert shard_module._row(found)[5] == "a; b\nc"
    error = CaseError([Fault("one", file="case"), Fault("two", file="case")])
    assert shard_module._row(error)[-1] == "one\ntwo"


@pytest.mark.parametrize("address", ["nonsense", "tcp://127.0.0.1:1", "tcp://127.0.0.1:99999"])
def test_scheduler_that_is_none(address):
    pytest.importorskip("distributed", reason="distributed is not installed")
    from wearsim.runner.workers import Cluster

    with pytest.raises(StudyError, match="must be a"), Cluster(address, None, {}).open():
        pass


@pytest.mark.parametrize("content", ["{", "{}", '{"address": 3}', "[]"])
def test_scheduler_file_that_is_none(content, tmp_path):
    pytest.importorskip("distributed", reason="distributed is not installed")
    from wearsim.runner.workers import Cluster

    place = tmp_path / "scheduler.json"
    place.write_text(content)
    with pytest.raises(StudyError, match="must be the file"), Cluster(None, place, {}).open():
        pass


@pytest.mark.parametrize("name", [".wearsim", "study.json"])
def test_a_folder_whose_maker_was_killed_is_taken(cases, tmp_path, name):
    """Nothing is there but what was written beside the marker or the manifest."""
    from wearsim.runner.store import open_store

    folder = tmp_path / "study"
    folder.mkdir()
    beside = hashlib.sha256(name.encode()).hexdigest()[:12]
    (folder / f".wearsim-{beside}-0a1b2c3d").write_bytes(b"half")
    opened = open_store(folder, cases, {"study": "test"}, False)
    assert {path.name for path in opened.folder.iterdir()} >= {".wearsim", "study.json"}
