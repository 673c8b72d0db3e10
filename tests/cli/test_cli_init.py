"""``wearsim init``: a commented case that works."""

import tomllib

import pytest


@pytest.mark.parametrize(
    ("chain", "teeth"),
    [("16B-1", 20), ("08B-1", 17), ("ANSI 40", 25), ("ПР-38,1-127", 18), ("72B-1", 60), ("05B-1", 40)],
)
def test_output_passes_check_and_lives(cli, tmp_path, chain, teeth):
    path = tmp_path / "drive.toml"
    done = cli("init", "--chain", chain, "--teeth", teeth, "--out", path)
    assert (done.code, done.out, done.err) == (0, "", "")
    text = path.read_text(encoding="utf-8")
    assert tomllib.loads(text)["sprocket"]["teeth"] == teeth
    assert tomllib.loads(text)["chain"]["designation"] == chain
    assert cli("check", path).code == 0
    assert cli("life", path).code == 0


def test_designation_is_written_as_in_the_catalogue(cli):
    text = cli("init", "--chain", "#40", "--kind", "wrap").out
    assert tomllib.loads(text)["chain"]["designation"] == "ANSI 40"
    assert tomllib.loads(text)["sprocket"]["profile"] == "ansi_b29"


def test_commented_keys_are_the_defaults(cli, tmp_path):
    """With every comment of a key taken away the case is still good, and its flank the same."""
    path, bare = tmp_path / "drive.toml", tmp_path / "bare.toml"
    cli("init", "--out", path)
    lines = path.read_text().splitlines()
    keys = [line.removeprefix("# ") if line.startswith("# ") and " = " in line else line for line in lines]
    assert len([line for line in lines if line.startswith("# ") and " = " in line]) >= 6
    bare.write_text("\n".join(keys))
    assert cli("check", bare).code == 0
    assert cli("profile", bare).out == cli("profile", path).out


def test_stdout_by_default(cli, tmp_path):
    done = cli("init")
    assert done.code == 0
    path = tmp_path / "drive.toml"
    path.write_text(done.out)
    assert cli("check", path).code == 0


@pytest.mark.parametrize(
    ("options", "start", "words"),
    [
        (("--chain", "16Bx"), "--chain: no such chain", "did you mean '16B"),
        (("--teeth", "4"), "--teeth: must be ", "(got 4)"),
        (("--teeth", "7"), "--teeth: ", "try a shorter contact range"),
        (("--chain", "08B-1", "--teeth", "13"), "--teeth: ", "teeth = 14 will do"),
        (("--teeth", "many"), "Usage: ", "'--teeth'"),
    ],
)
def test_what_cannot_be(cli, options, start, words):
    done = cli("init", *options)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith(start)
    assert words in done.err


def test_file_in_the_way(cli, tmp_path):
    path = tmp_path / "drive.toml"
    path.write_text("mine")
    done = cli("init", "--out", path)
    assert done.code == 2
    assert "--force" in done.err
    assert path.read_text() == "mine"
    assert cli("init", "--out", path, "--force").code == 0
    assert "format_version = 1" in path.read_text()


@pytest.mark.parametrize(
    ("chain", "form"), [("16B-1", "iso606"), ("ANSI 40", "ansi_b29"), ("ПР-25,4-60", "gost591")]
)
def test_wrap_case_is_one_of_the_chains_standard_and_loads(cli, tmp_path, chain, form):
    path = tmp_path / "wrap.toml"
    options = ("--kind", "wrap", "--chain", chain, "--teeth", "21", "--out", path)
    assert cli("init", *options).code == 0
    case = tomllib.loads(path.read_text(encoding="utf-8"))
    assert (case["mechanism"]["kind"], case["sprocket"]["profile"]) == ("wrap", form)
    assert cli("check", path).code == 0
    assert cli("loads", path).code == 0


@pytest.mark.parametrize("chain", ["06B-1", "08B-2", "12B-1", "40", "16B-3"])
@pytest.mark.parametrize("teeth", ["17", "25"])
def test_a_wrap_to_start_from_is_within_its_ratings(cli, tmp_path, chain, teeth):
    path = tmp_path / "drive.toml"
    cli("init", "--kind", "wrap", "--chain", chain, "--teeth", teeth, "--out", path)
    assert "OUTSIDE" not in cli("check", path).out
