"""--force replaces what wearsim wrote, and nothing else."""

import os

from wearsim.command.options import BAD_INPUT


def test_a_result_is_replaced(cli, drive, tmp_path):
    path, out = drive(), tmp_path / "out"
    assert cli("life", path, "--out", out).code == 0
    assert cli("life", path, "--out", out, "--force").code == 0
    assert (out / "result.json").is_file()


def test_the_case_itself_is_not_replaced(cli, drive):
    path = drive()
    text = path.read_text("utf-8")
    for command in (("life",), ("compare",), ("profile",)):
        done = cli(*command, path, "--out", path, "--force")
        assert done.code == BAD_INPUT
        assert str(path) in done.err
        assert path.read_text("utf-8") == text


def test_a_folder_with_other_files_is_not_replaced(cli, drive, tmp_path):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "thesis.txt").write_text("years", "utf-8")
    done = cli("life", drive(), "--out", folder, "--force")
    assert done.code == BAD_INPUT
    assert "thesis.txt" in done.err
    assert (folder / "thesis.txt").read_text("utf-8") == "years"


def test_the_folder_one_is_in_is_not_replaced(cli, drive, tmp_path, monkeypatch):
    path, out = drive(), tmp_path / "out"
    assert cli("life", path, "--out", out).code == 0
    monkeypatch.chdir(out)
    done = cli("life", path, "--out", os.path.join("..", "out"), "--force")  # noqa: PTH118
    assert done.code == BAD_INPUT
    assert (out / "result.json").is_file()
