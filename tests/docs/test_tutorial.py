"""The tutorial runs as it is printed, in one folder, and its answers are those it shows."""

import contextlib
import io
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "tutorial.md"
WEARSIM = Path(sys.executable).with_name("wearsim")


def blocks(text: str) -> list[tuple[str, str]]:
    """Language and text of every fenced block."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, flags=re.M | re.S)


def run_line(line: str, folder: Path) -> str:
    command = [str(WEARSIM), *shlex.split(line)[1:]]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, f"{line}: {done.stderr}"
    return done.stdout


def run_python(text: str, folder: Path) -> str:
    printed = io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(printed):
        exec(compile(text, str(PAGE), "exec"), {})  # noqa: S102
    return printed.getvalue()


def test_every_command_answers_as_printed(tmp_path: Path) -> None:
    answer, seen = "", 0
    for language, text in blocks(PAGE.read_text("utf-8")):
        if language == "sh":
            answer = "".join(run_line(line, tmp_path) for line in text.splitlines())
            seen += 1
        elif language == "python":
            answer = run_python(text, tmp_path)
            assert "time_hours" in answer
        else:
            given = " ".join(answer.split())
            for line in text.splitlines():
                assert " ".join(line.split()) in given, f"not in the answer: {line}\n{answer}"
    assert seen == 6


@pytest.mark.parametrize("link", re.findall(r"\]\((\w[\w.-]*\.md)\)", PAGE.read_text("utf-8")))
def test_links_lead_somewhere(link: str) -> None:
    assert (PAGE.parent / link).exists()
