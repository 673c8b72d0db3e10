"""Redo what README.md and docs/output.md show of two shipped cases: answer, history and pictures.

Run it from a checkout with ``python docs/refresh.py`` after a change of the cases or of
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


def layout(sheet: str) -> str:
    """The drive to scale, the first drawing of a calculation sheet, in the sheet's light colours."""
    colours = re.search(r"^:root ({.*?^})", sheet, re.M | re.S)[1]
    rules = "\n".join(re.findall(r"^\.sketch .*", sheet, re.M))
    drawing = re.sub(r"<a .*?</a>\n", "", re.search(r"<svg .*?</svg>\n", sheet, re.S)[0])
    return drawing.replace(
        'role="group"', 'role="img" xmlns="http://www.w3.org/2000/svg" width="700"'
    ).replace(">\n", f">\n<style>\nsvg {colours}\nsvg {{ background: var(--page); }}\n{rules}\n</style>\n", 1)


def renew(page: str, start: str, text: str) -> None:
    """Replace a block of a page, which begins after what stands before it."""
    path = ROOT / page
    whole = re.sub(
        rf"({start}).*?(\n```)", lambda found: found[1] + text + found[2], path.read_text("utf-8"), flags=re.S
    )
    path.write_text(whole, "utf-8")


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        wearsim("-q", "life", CASE, "--out", f"{folder}/run")
        wearsim("-q", "compare", CASE, "--out", f"{folder}/compared")
        wearsim("-q", "report", "packaging-conveyor", "--out", f"{folder}/sheet.html")
        history = (Path(folder) / "run/history.csv").read_text("utf-8").splitlines()[:5]
        flank = (Path(folder) / "compared/flanks.svg").read_bytes()
        sheet = (Path(folder) / "sheet.html").read_text("utf-8")
    (ROOT / "docs/worn_flank.svg").write_bytes(flank)
    (ROOT / "docs/packaging_conveyor.svg").write_text(layout(sheet), "utf-8")
    renew("README.md", r"## The answer\n\n```text\n", wearsim("life", CASE).rstrip("\n"))
    renew("docs/output.md", r"```text\n(?=cycles,)", "\n".join(history))


if __name__ == "__main__":
    main()
