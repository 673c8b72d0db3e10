"""Tutorial and how-tos run as they are printed, each in a folder, and answer what they show.

A block ``toml`` or ``none`` that begins with ``# NAME`` is the file of that name. The blocks ``text``
hold lines of the answer to the commands or the Python before them. A command that is refused
says so behind it: ``# exit code 2``.
"""

import contextlib
import io
import re
import shlex
import sys
from pathlib import Path

import pytest

import wearsim.cli

pytestmark = [pytest.mark.wide, pytest.mark.usefixtures("catalogue_as_before")]

DOCS = Path(__file__).parents[2] / "docs"
PAGES = (
    *("tutorial", "howto_chain", "howto_drive", "howto_select", "howto_profile", "howto_duty"),
    *("howto_lubrication", "tooth_forms"),
    *("howto_measured_sprocket", "judge", "python", "laboratory"),
)
LINKS = [
    (page, link)
    for page in PAGES
    for link in re.findall(r"\]\((\w[\w.-]*\.md)[)#]", (DOCS / f"{page}.md").read_text("utf-8"))
]


def blocks(text: str) -> list[tuple[str, str]]:
    """Language and text of every fenced block."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, flags=re.M | re.S)


def run_line(line: str, monkeypatch: pytest.MonkeyPatch) -> str:
    """Both streams of a command, run in this process; its exit code must be as printed."""
    monkeypatch.setattr(sys, "argv", ["wearsim", *shlex.split(line, comments=True)[1:]])
    printed = io.StringIO()
    with (
        contextlib.redirect_stdout(printed),
        contextlib.redirect_stderr(printed),
        pytest.raises(SystemExit) as ended,
    ):
        wearsim.cli.main()
    expected = int((re.findall(r"# exit code (\d)", line) or "0")[0])
    assert (ended.value.code or 0) == expected, f"{line}: {printed.getvalue()}"
    return printed.getvalue()


def run_python(text: str, page: str, names: dict[str, object]) -> str:
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(text, page, "exec"), names)  # noqa: S102
    return printed.getvalue()


@pytest.mark.slow
@pytest.mark.parametrize("name", PAGES)
def test_every_command_answers_as_printed(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    answer, checked = "", 0
    names: dict[str, object] = {}
    for language, text in blocks((DOCS / f"{name}.md").read_text("utf-8")):
        if language == "sh":
            answer = "".join(run_line(line, monkeypatch) for line in text.splitlines())
        elif language == "python":
            answer = run_python(text, name, names)
        elif language == "text":
            given = " ".join(answer.split())
            for line in text.splitlines():
                assert " ".join(line.split()) in given, f"not in the answer: {line}\n{answer}"
                checked += 1
        elif file := re.match(r"# ([\w.]+\.(?:toml|csv))\n", text):
            Path(file[1]).write_text(text, "utf-8")
    assert checked > 4


@pytest.mark.parametrize(("name", "link"), LINKS)
def test_links_lead_somewhere(name: str, link: str) -> None:
    assert (DOCS / link).exists(), name
