"""Paper of every command on every shipped case: what words and files move when code moves.

``python tests/golden/paper.py`` runs all of it (minutes) and writes ``paper.csv``: run, file, bytes and hash.
With ``--check`` it names what differs and ends with 1; ``--keep DIR`` writes the texts, to compare two states
with ``diff -r``. Words pick the runs whose command line holds one of them.

It is scaffolding of a redesign, and goes when that is done. Numbers are held by ``net.py``: here lives are
coarse, by copies of the cases with few nodes and long steps.
"""

import argparse
import contextlib
import csv
import hashlib
import io
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from datetime import date
from pathlib import Path

os.environ |= {"SOURCE_DATE_EPOCH": "0", "TZ": "UTC", "COLUMNS": "100", "NO_COLOR": "1", "WEARSIM_RUNS": ""}

import openpyxl
import tomlkit
from net import CASES, machine

import wearsim
import wearsim.cli
from wearsim.cli.main import wearsim_command
from wearsim.command.registry import CALCULATIONS

FILE = Path(__file__).with_name("paper.csv")
RUNS = Path(__file__).with_name("paper_runs.txt")
Paper = dict[tuple[str, str], tuple[str, str]]
"""Number of bytes and hash by run and file."""

TEXTS = ("", ".csv", ".dxf", ".html", ".json", ".md", ".svg", ".toml", ".txt")
NAMES_ALONE = (".wearsim", "environment.json", "plotly.min.js")
"""What the machine decides. Of pictures, PDF, STL and Parquet the names alone count too."""

LEFT_OUT = {
    re.escape(str(Path(wearsim.__file__).parents[1])): "CHECKOUT",
    re.escape(wearsim.__version__): "VERSION",
    re.escape(date.today().isoformat()) + r"(T[\d:.+]+)?": "TODAY",
    r"(?m)^24\d{5}\.\d+$": "TODAY",
    r"\{[\dA-F-]{36}\}": "GUID",
    r'nonce(-|=")[0-9a-f]+': r"nonce\1",
    r'(?<=[\s"])(id|for|aria-labelledby)="[^"]*"': r"\1",
    r'(url\(|href=")#[^")]*': r"\1#",
    r"(?m)^(time +about |files +)[\d.e+]+": r"\1",
}
"""What folder, clock, chance, release and the order of drawing decide; days of a drawing are Julian."""

HORIZONS = {
    "bicycle-cassette": 10.0,
    "camshaft-loop": 300.0,
    "escalator-duplex": 3000.0,
    "motorcycle-520": 100.0,
    "packaging-conveyor": 3000.0,
}
"""Of drives whose lives take long [h]."""

TABLES = {
    "chain.csv": "time_hours,quantity,value,error\n"
    "20,elongation_percent,0.1,0.01\n50,elongation_percent,0.3,0.01\n",
    "depths.csv": "time_hours,quantity,value,error\n20,max_depth_mm,0.01,0.002\n50,max_depth_mm,0.02,0.002\n",
    "prices.csv": "designation,price_per_m,sprocket_price_per_kg\n16B,90,8\n12B,60,8\nANSI 50-3,30,8\n",
    "drive.toml": 'format_version = 1\ncase = "../cases/drives/packaging-conveyor.toml"\n'
    '[grid]\n"sprocket.2.teeth" = [57, 60]\n',
    "wrap.toml": 'format_version = 1\ncase = "../cases/08b-19t-wrap.toml"\n'
    '[grid]\n"sprocket.teeth" = [19, 21]\n',
    "gears.toml": 'format_version = 1\ncase = "../cases/fzg-c14-16t-mild.toml"\n'
    '[grid]\n"load.torque_N_m" = [200.0, 300.0]\n',
}
"""Readings, prices and sweeps that runs take from the folder ``tables``."""

KINDS = [
    *("cases/16b-20t-oiled.toml", "cases/08b-19t-wrap.toml", "cases/fzg-c14-16t-mild.toml"),
    *("cases/fzg-c14-16t-slow.toml", "cases/drives/packaging-conveyor.toml"),
    *("cases/sizing/strength-a-tempered.toml", "cases/studies/teeth-and-tension.toml"),
]
"""A case of each kind: strand, wrap, gears, prescribed, whole drive, calculation, sweep."""


def runs() -> list[str]:
    """Return the command line, or the Python expression, of each run."""
    cases = sorted(f"cases/{path.relative_to(CASES).as_posix()}" for path in CASES.rglob("*.toml"))
    places = {
        "{case}": cases,
        "{kind}": KINDS,
        "{run}": [f"runs/{Path(case).stem}" for case in KINDS[:5]],
        "{its}": [f"{name} {case}" for name in CALCULATIONS for case in cases if f"sizing/{name}" in case],
        "{calculation}": CALCULATIONS,
        "{command}": wearsim_command.commands,
        "{table}": wearsim_command.commands["list"].params[0].type.choices,
    }
    lines = [line for line in RUNS.read_text("utf-8").splitlines() if line and not line.startswith("#")]
    for place, words in places.items():
        several = [
            [line.replace(place, word) for word in words] if place in line else [line] for line in lines
        ]
        lines = [line for found in several for line in found]
    return list(dict.fromkeys(lines))


def lay_out() -> None:
    """Write coarse copies of the cases, and the tables, into the working folder."""
    shutil.copytree(CASES, "cases")
    for path in (*Path("cases").glob("*.toml"), *Path("cases/drives").glob("*.toml")):
        document = tomlkit.parse(path.read_text("utf-8"))
        sprocket, kind = document.get("sprocket"), document.get("mechanism", {}).get("kind")
        for one in sprocket if isinstance(sprocket, list) else [sprocket or {}]:
            one["nodes"] = 41
        if isinstance(sprocket, list) or kind == "wrap":
            document.setdefault("mechanism", {})["phases"] = 1
        if kind != "prescribed":
            document.setdefault("run", {})["life_tolerance"] = 0.1
        if path.stem in HORIZONS:
            document["run"]["horizon_hours"] = HORIZONS[path.stem]
        path.write_text(tomlkit.dumps(document), "utf-8")
    Path("tables").mkdir()
    for name, text in TABLES.items():
        Path("tables", name).write_text(text, "utf-8")


def streams(line: str) -> Iterator[tuple[str, str]]:
    """Run a command line or a Python expression; yield name and text of what it prints or answers."""
    if line.startswith("wearsim."):
        yield from answered(line)
        return
    words, _, source = line.partition(" < ")
    if source:  # a process reads its standard input once
        command = [sys.executable, "-m", "wearsim", *shlex.split(words)]
        done = subprocess.run(command, input=Path(source).read_bytes(), capture_output=True, check=False)
        yield from (("stdout", done.stdout.decode()), ("stderr", done.stderr.decode()))
        yield "exit", f"{done.returncode}" if done.returncode else ""
        return
    before = sys.argv
    sys.argv = ["wearsim", *shlex.split(words)]
    out, errors = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in range(2))
    code: object = 0
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            wearsim.cli.main()
    except SystemExit as end:
        code = end.code or 0
    finally:
        sys.argv = before
    for name, stream in (("stdout", out), ("stderr", errors)):
        stream.seek(0)
        yield name, stream.read()
    yield "exit", f"{code}" if code else ""


def answered(expression: str) -> Iterator[tuple[str, str]]:
    """Yield all that the answer of a public function shows."""
    try:
        answer = eval(expression, {"wearsim": wearsim})  # noqa: S307
    except Exception as error:
        yield "error", f"{type(error).__name__}: {error}"
        return
    yield "text", f"{answer!r}\n{answer}"
    if hasattr(answer, "_repr_html_"):
        yield "answer.html", answer._repr_html_()
    if hasattr(answer, "summary"):
        yield "summary.json", json.dumps(answer.summary(), indent=1)
    if hasattr(answer, "tables"):
        for name, table in answer.tables().items():
            yield f"{name} table", table.to_csv(index=False)


def written() -> Iterator[tuple[str, str | None]]:
    """Yield name and text of each file that a run wrote, None where the name alone counts."""
    for path in sorted(file for place in Path().glob("out*") for file in (place, *place.rglob("*"))):
        if path.suffix == ".xlsx":
            yield path.as_posix(), "\n".join(cells(path))
        elif path.is_file() and "shards" not in path.parts:
            holds_text = path.suffix in TEXTS and path.name not in NAMES_ALONE
            yield path.as_posix(), path.read_text("utf-8") if holds_text else None


def cells(path: Path) -> Iterator[str]:
    """Yield the cells of a workbook that hold something."""
    for sheet in openpyxl.load_workbook(path):
        title = sheet.title
        for row in sheet.iter_rows():
            yield from (f"{title} {cell.coordinate} {cell.value}" for cell in row if cell.value is not None)


def paper_of(line: str, keep: Path | None) -> Paper:
    """Return the hashes of a run in the working folder, and keep its texts where they are wanted."""
    for place in Path().glob("out*"):
        shutil.rmtree(place) if place.is_dir() else place.unlink()
    for stem in re.findall(r"runs/([\w-]+)", line):
        if not Path("runs", stem).exists():
            case = next(Path("cases").rglob(f"{stem}.toml"))
            list(streams(f"life {case} --out runs/{stem}"))
    found = {}
    for name, text in (*streams(line), *written()):
        if text is None:
            found[line, name] = "", ""
        elif text:
            for pattern, word in LEFT_OUT.items():
                text = re.sub(pattern, word, text)
            content = text.encode()
            found[line, name] = str(len(content)), hashlib.sha256(content).hexdigest()[:16]
            if keep:
                file = keep / re.sub(r"[^\w.=-]+", " ", line).strip() / name.replace("/", " ")
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content)
    return found


def run(lines: Iterable[str], keep: Path | None) -> Paper:
    """Run command lines in a folder of their own."""
    home = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            lay_out()
            list(streams("warm --quiet"))
            return {key: row for line in lines for key, row in paper_of(line, keep).items()}
        finally:
            os.chdir(home)


def read() -> tuple[str, Paper]:
    """Return the machine and the rows of the file."""
    if not FILE.exists():
        return "", {}
    with FILE.open(encoding="utf-8", newline="") as file:
        made_on = file.readline().removeprefix("# ").strip()
        return made_on, {(line, name): (size, bits) for line, name, size, bits in list(csv.reader(file))[1:]}


def write(paper: Paper) -> None:
    with FILE.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# {machine()}\n")
        rows = sorted((*key, *row) for key, row in paper.items())
        csv.writer(file, lineterminator="\n").writerows([("run", "file", "bytes", "hash"), *rows])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("words", nargs="*", help="of the runs to take; all without")
    parser.add_argument("--check", action="store_true", help="name what differs, in place of writing")
    parser.add_argument("--keep", type=lambda text: Path(text).resolve(), help="folder for the texts")
    wanted = parser.parse_args()
    known = runs()
    lines = [line for line in known if not wanted.words or any(word in line for word in wanted.words)]
    made_on, before = read()
    others = {key: row for key, row in before.items() if key[0] in set(known) - set(lines)}
    now = others | run(lines, wanted.keep)
    if not wanted.check:
        write(now)
        return 0
    if made_on != machine():
        print(f"made on another machine, where last digits may differ: {made_on}")
    moved = sorted(key for key in before.keys() | now.keys() if before.get(key) != now.get(key))
    for line, name in moved:
        state = "new" if (line, name) not in before else "gone" if (line, name) not in now else "moved"
        print(f"{state:5}  {name:24}  wearsim {line}".replace("wearsim wearsim.", "wearsim."))
    return 1 if moved else 0


if __name__ == "__main__":
    sys.exit(main())
