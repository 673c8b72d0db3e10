"""Files that an input names lie in its folder, unless that is lifted."""

import shutil
from pathlib import Path

import pytest

import wearsim
from wearsim.case.keys import CaseTables, DriveTables
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError
from wearsim.handbook.hertz_check.keys import HertzCheckTables
from wearsim.handbook.hertz_check.published import load_hertz_check
from wearsim.input.document import CaseText, read_document
from wearsim.input.faults import known_keys
from wearsim.input.named_files import FILE_KEYS

CASES = Path(__file__).parents[2] / "cases"
POINTS = "beet-harvester-18t-soil.csv"
REFUSED = r"must name a file in the folder of the input or below it: .*--allow-outside.* \(got '"


@pytest.fixture
def case(tmp_path):
    """Function that writes a case whose points have a name; they lie above the folder of the case."""
    folder = tmp_path / "drives"
    (folder / "points").mkdir(parents=True)
    shutil.copy(CASES / POINTS, tmp_path / "flank.csv")

    def write(name):
        path = folder / "drive.toml"
        path.write_text((CASES / POINTS).with_suffix(".toml").read_text("utf-8").replace(POINTS, name))
        return path

    return write


@pytest.fixture
def secret(tmp_path):
    """A file of somebody whose lines nobody else is to see."""
    path = tmp_path / "secret"
    path.write_text("root:x:0:0\n")
    return path


def test_all_keys_of_files_are_known():
    """A key added later is checked too: its name ends as the others' do."""
    keys = [key for model in (CaseTables, DriveTables, HertzCheckTables) for key in known_keys(model)]
    assert {tuple(key.split(".")[-2:]) for key in keys if key.endswith("_file")} == set(FILE_KEYS)


@pytest.mark.parametrize("place", FILE_KEYS, ids=".".join)
@pytest.mark.parametrize("name", ["../other", "/other", "below/../../other"])
def test_every_key(tmp_path, place, name):
    table, key = place
    text = f"format_version = 1\n[{table}]\n{key} = {name!r}\n"
    with pytest.raises(CaseError, match=rf":3: {table}\.{key}: {REFUSED}{name}'\)$"):
        read_document(CaseText(tmp_path / "case.toml", text), ())
    # A file of a program or a person at the keyboard is theirs.
    changed = read_document(CaseText(tmp_path / "case.toml", text), [f"{table}.{key}=/other"])
    assert changed.data[table][key] == "/other"
    assert read_document({table: {key: name}}, ()).data[table][key] == name
    with wearsim.allow_outside():
        assert read_document(CaseText(tmp_path / "case.toml", text), ()).data[table][key] == name


def test_sprockets_of_a_whole_drive(tmp_path):
    text = '[[sprocket]]\nteeth = 17\n[[sprocket]]\nteeth = 19\npoints_file = "../gap.csv"\n'
    with pytest.raises(CaseError, match=rf":5: sprocket\.2\.points_file: {REFUSED}"):
        read_document(CaseText(tmp_path / "case.toml", text), ())


def test_files_below_the_folder(case, tmp_path):
    shutil.copy(tmp_path / "flank.csv", tmp_path / "drives" / "points")
    for name in ("points/flank.csv", "./points/../points/flank.csv"):
        assert load_case(case(name)).sprocket.teeth == 18


def test_nothing_of_a_file_outside_is_told(case, secret):
    """Neither by its path nor by a link to it; a folder that is itself a link is no reason to refuse."""
    link = case("").parent / "points" / "link.csv"
    link.symlink_to(secret)
    for name in ("../secret", str(secret), "points/link.csv"):
        with pytest.raises(CaseError, match=REFUSED) as caught:
            load_case(case(name))
        assert "x:0:0" not in str(caught.value)
    shutil.copy(CASES / POINTS, link.parent)
    folder = secret.parent / "by-link"
    folder.symlink_to(case(f"points/{POINTS}").parent)
    assert load_case(folder / "drive.toml").sprocket.teeth == 18


def test_a_link_in_a_loop_is_no_bug(case):
    path = case("loop.csv")
    (path.parent / "loop.csv").symlink_to("loop.csv")
    with pytest.raises(CaseError, match=r"sprocket\.points_file: "):
        load_case(path)


def test_allowed(case):
    path = case("../flank.csv")
    with wearsim.allow_outside():
        given = load_case(path)
        with wearsim.allow_outside():
            pass
        assert load_case(path).sprocket.teeth == 18
    assert wearsim.simulate(given).life == wearsim.simulate(CASES / f"{Path(POINTS).stem}.toml").life
    assert given.with_({"sprocket.nodes": 201}).sprocket.teeth == 18
    with pytest.raises(CaseError, match=REFUSED):
        load_case(path)


def test_stresses_of_a_hertz_check(tmp_path):
    name = "hertz-check-36-54"
    text = (CASES / "sizing" / f"{name}.toml").read_text("utf-8")
    path = tmp_path / "check.toml"
    path.write_text(text.replace(f'"{name}-axis.csv"', f'"{CASES}/sizing/{name}-axis.csv"'))
    with pytest.raises(CaseError, match=rf"finite_elements\.axis_file: {REFUSED}"):
        load_hertz_check(path)
    with wearsim.allow_outside():
        assert load_hertz_check(path)[1].depth.size > 2
