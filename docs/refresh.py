"""Redo what README.md shows of the 16B case: answer, history and picture.

Run it from a checkout with ``python docs/refresh.py`` after a change of the case or of
what wearsim prints; tests/cli/test_readme.py compares.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
CASE = "cases/16b-20t-oiled.toml"


def wearsim(*arguments: str) -> str:
    command = [str(Path(sys.executable).with_name("wearsim")), *arguments]
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        answer = wearsim("life", CASE).rstrip("\n")
        wearsim("-q", "life", CASE, "--out", f"{folder}/run")
        wearsim("-q", "compare", CASE, "--out", f"{folder}/compared")
        history = (Path(folder) / "run/history.csv").read_text("utf-8").splitlines()[:5]
        picture = (Path(folder) / "compared/flanks.svg").read_bytes()
    (ROOT / "docs/worn_flank.svg").write_bytes(picture)
    text = (ROOT / "README.md").read_text("utf-8")
    for start, new in (
        (r"## The answer\n\n```text\n", answer),
        (r"```text\n(?=cycles,)", "\n".join(history)),
    ):
        text = re.sub(
            rf"({start}).*?(\n```)", lambda found, new=new: found[1] + new + found[2], text, flags=re.S
        )
    (ROOT / "README.md").write_text(text, "utf-8")


if __name__ == "__main__":
    main()
