"""``wearsim scan --sheet``: the page to print, and what does not go with it."""

import re

import pytest
from PIL import Image


@pytest.mark.parametrize(("paper", "size"), [("a4", (210.0, 297.0)), ("letter", (215.9, 279.4))])
def test_pages_have_the_size_of_their_paper(cli, tmp_path, paper, size):
    pages = {kind: tmp_path / f"sheet.{kind}" for kind in ("pdf", "svg", "png")}
    for page in pages.values():
        done = cli("scan", "--sheet", page, "--paper", paper)
        assert done.code == 0, done.err
    points = re.search(r'width="([\d.]+)pt" height="([\d.]+)pt"', pages["svg"].read_text()).groups()
    assert [25.4 / 72.0 * float(one) for one in points] == pytest.approx(size, abs=1e-3)
    box = pages["pdf"].read_bytes().partition(b"/MediaBox [")[2].partition(b"]")[0].split()
    assert [25.4 / 72.0 * float(one) for one in box[2:]] == pytest.approx(size, abs=1e-3)
    with Image.open(pages["png"]) as picture:
        assert [25.4 / 300.0 * one for one in picture.size] == pytest.approx(size, abs=0.1)


def test_a_page_is_the_same_each_time(cli, tmp_path):
    for name in ("one.pdf", "two.pdf"):
        assert cli("scan", "--sheet", tmp_path / name).code == 0
    assert (tmp_path / "one.pdf").read_bytes() == (tmp_path / "two.pdf").read_bytes()


def test_a_file_is_replaced_by_force_alone(cli, tmp_path):
    page = tmp_path / "sheet.svg"
    page.write_text("mine")
    done = cli("scan", "--sheet", page)
    assert done.code == 2
    assert "must not exist yet" in done.err
    assert page.read_text() == "mine"
    assert cli("scan", "--sheet", page, "--force").code == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--sheet", "sheet.jpg"), "must end in one of .pdf, .svg, .png"),
        (("photo.jpg", "--sheet", "sheet.pdf"), "without PHOTO"),
        (("--sheet", "sheet.pdf", "--ruler-mm", "99"), "--ruler-mm belongs to a PHOTO"),
        (("photo.jpg", "--chain", "08B", "--paper", "a4"), "--paper belongs to --sheet"),
        (("photo.jpg", "--chain", "08B", "--ruler-mm", "9.92"), "--ruler-mm"),
        (("--sheet", "sheet.pdf", "--paper", "a9"), "--paper"),
        (("--sheet", "sheet.pdf", "--chain", "08B"), "--chain belongs to a PHOTO"),
        (("--sheet", "sheet.pdf", "--out", "worn"), "--out belongs to a PHOTO"),
        ((), "give a PHOTO to measure, or --sheet FILE"),
    ],
)
def test_what_does_not_go_together(cli, words, message):
    done = cli("scan", *words)
    assert done.code == 2
    assert message in " ".join(done.err.split())
