"""The file that ``wearsim ui`` edits."""

import pytest

from wearsim.errors import CaseError, OutputError
from wearsim.page.case_file import named_beside, new_file, read_file


def test_saved_as_typed_and_nothing_beside(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b"old = 1\n")
    file = read_file(path)
    assert (file.text, file.changed) == ("old = 1\n", False)
    saved = file.saved("new = 1\n")
    assert path.read_bytes() == b"new = 1\n"
    assert not saved.changed and file.changed
    assert list(tmp_path.iterdir()) == [path]


def test_line_ends_and_mark_of_windows(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b"\xef\xbb\xbfa = 1\r\nb = 2\r\n")
    file = read_file(path)
    assert file.text == "a = 1\nb = 2\n"
    file.saved("a = 3\nb = 2\n")
    assert path.read_bytes() == b"a = 3\r\nb = 2\r\n"


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
@pytest.mark.parametrize("end", [b"\n", b"\r\n"])
@pytest.mark.parametrize("taken", [None, b"x = 1\n", b"\xef\xbb\xbfx = 1\r\n"])
def test_another_name_makes_no_other_file(tmp_path, mark, end, taken):
    """Saved and saved as, then saved again: the same bytes, whatever the new name held before."""
    path, other = tmp_path / "a.toml", tmp_path / "b.toml"
    path.write_bytes(mark + b"a = 1" + end + b"b = 2" + end)
    if taken is not None:
        other.write_bytes(taken)
    file = read_file(path)
    renamed = file.renamed(other)
    assert renamed.changed == (taken is not None)
    saved = renamed.saved(file.text)
    assert other.read_bytes() == b"a = 1" + end + b"b = 2" + end
    assert (saved.path, saved.changed) == (other, False)
    file.saved("a = 3\nb = 2\n")
    saved.saved("a = 3\nb = 2\n")
    assert other.read_bytes() == path.read_bytes() == b"a = 3" + end + b"b = 2" + end


@pytest.mark.parametrize("other", [b"x", None])
def test_a_change_on_disk_is_seen(tmp_path, other):
    path = tmp_path / "a.toml"
    path.write_bytes(b"a = 1\n")
    file = read_file(path)
    path.unlink()
    if other:
        path.write_bytes(other)
    assert file.changed


def test_a_new_file_has_changed_where_one_is_there(tmp_path):
    path = tmp_path / "a.toml"
    assert not new_file(path).changed
    path.write_bytes(b"")
    assert new_file(path).changed


def test_a_link_stays_a_link(tmp_path):
    path, link = tmp_path / "a.toml", tmp_path / "b.toml"
    path.write_bytes(b"a = 1\n")
    link.symlink_to(path)
    read_file(link).saved("a = 2\n")
    assert link.is_symlink() and path.read_bytes() == b"a = 2\n"


def test_what_cannot_be_read_or_written(tmp_path):
    with pytest.raises(CaseError, match="must be a readable file"):
        read_file(tmp_path / "none.toml")
    (tmp_path / "latin.toml").write_bytes(b"a = '\xe9'")
    with pytest.raises(CaseError, match="must be UTF-8 text"):
        read_file(tmp_path / "latin.toml")
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(OutputError, match="must be a file"):
        new_file(tmp_path / "folder.toml").saved("a = 1\n")


@pytest.mark.parametrize(("name", "found"), [("b", "b.toml"), (" b.toml ", "b.toml"), ("ä b", "ä b.toml")])
def test_names_in_the_folder(tmp_path, name, found):
    assert named_beside(tmp_path / "a.toml", name) == tmp_path / found


@pytest.mark.parametrize("name", ["", " ", ".", "..", ".toml", "a/b", "../b", "a\\b", "c:b", "a\0", "/b"])
def test_names_of_elsewhere_are_refused(tmp_path, name):
    with pytest.raises(OutputError, match="must be the name of a file"):
        named_beside(tmp_path / "a.toml", name)
