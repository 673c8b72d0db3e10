"""Cases that come with wearsim, by their names."""

import json

import pytest


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Work in a folder that holds nothing."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("command", "name", "word"),
    [
        ("check", "16b-20t-oiled", "16b-20t-oiled: ok"),
        ("check", "packaging-conveyor", "sprockets motor, conveyor"),
        ("life", "hertz-arc-prescribed", "2.61e+07 cycles"),
        ("handbook wave-drive", "wave-drive-100", "Wave gear, ratio 100"),
        ("sweep", "teeth-and-tension", "| 40 | 8000 |"),
    ],
)
def test_commands_take_names(cli, command, name, word):
    """The life is that of an independent program: 26 102 090 cycles."""
    done = cli(*command.split(), name)
    assert done.code == 0
    assert word in done.out


@pytest.mark.wide
def test_what_follows_names_the_case_as_it_was_typed(cli):
    shown = cli("life", "16b-20t-oiled").out
    assert "wearsim compare 16b-20t-oiled --out reports/16b-20t-oiled" in shown
    assert cli("compare", "16b-20t-oiled", "--out", "reports").code == 0


def test_own_file_comes_first(cli, drive, elsewhere):
    (elsewhere / "16b-20t-oiled").write_text(drive(title='"My own"').read_text())
    assert json.loads(cli("life", "16b-20t-oiled", "--json").out)["title"] == "My own"


def test_folder_of_that_name_is_not_in_the_way(cli, elsewhere):
    (elsewhere / "16b-20t-oiled").mkdir()
    assert cli("check", "16b-20t-oiled").code == 0


def test_misspelt_name(cli):
    done = cli("life", "packing-conveyor")
    assert done.code == 2
    assert done.err.endswith("did you mean the shipped case 'packaging-conveyor'?\n")
    assert "did you mean" not in cli("life", "other.toml").err


def test_fault_stands_in_the_shipped_file(cli):
    done = cli("check", "16b-20t-oiled", "--set", "wear.conditon=x")
    assert (done.code, done.err) == (2, "--set wear.conditon: unknown key; did you mean 'condition'?\n")
