"""Kill commands while they write: what is there afterwards is nothing, the old file or the new one, whole.

``python research/kills.py`` (twenty minutes) kills every command that writes nine times, with and
without an old output in its place, half of them at once when something appears beside the output.
The command then runs again: its output must be equal to that of a run that nobody killed, but for bytes
that differ between two of those, and nothing may lie beside it. ``--kills 3`` tries fewer.
"""

import argparse
import hashlib
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import wearsim

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from photographs import Camera, picture, wheel  # noqa: E402

REPORT = ROOT / "reports" / "reference" / "kills.md"

COMMANDS = {
    "life": "life 16b-20t-oiled --force --out {}",
    "life, a drive": "life packaging-conveyor --force --out {}",
    "life --xlsx": "life 16b-20t-oiled --force --xlsx {}/life.xlsx",
    "animate": "animate 16b-20t-oiled --force --out {}/wear.gif",
    "compare": "compare 16b-20t-oiled 16b-20t-lightest --force --out {}",
    "report": "report packaging-conveyor --force --out {}/sheet.html",
    "report, a workbook": "report packaging-conveyor --force --out {}/sheet.xlsx",
    "maintain": "maintain packaging-conveyor --force --out {}",
    "lubricate": "lubricate bicycle-17t-lubricants --force --out {}",
    "remaining": "remaining 08b-19t-wrap {log} --force --out {}",
    "scan": "scan {photo} --chain 08B --force --out {}",
    "scan --sheet": "scan --force --sheet {}/sheet.pdf",
    "calibrate": "calibrate 16b-20t-oiled 16b-20t-readings --force --out {}",
    "judge": "judge metal-wear --force --out {}",
    "export": "export 16b-20t-oiled --force --out {}/wheel.dxf",
    "export --template": "export 16b-20t-oiled --force --template {}/gauge.pdf",
    "profile": "profile 16b-20t-oiled --force --out {}/flank.csv",
    "init": "init --kind wrap --chain 12B-1 --teeth 21 --force --out {}/case.toml",
    "select": "select --power 3 --rpm 120 --ratio 2.7 --hours 15000 --force --csv {}/drives.csv",
    "handbook strength": "handbook strength strength-a-tempered --force --out {}",
    "handbook synthesise": "handbook synthesise synthesise-constant-stress --force --out {}",
    "sweep": "sweep teeth-and-tension --out {}",
    "uncertainty": "uncertainty 16b-20t-oiled --samples 64 --out {}",
    "sensitivity": "sensitivity 16b-20t-oiled --samples 8 --out {}",
    "optimise": "optimise 16b-20t-lightest --out {}",
}
"""Command lines; ``{}`` is the folder that they write to, or into, ``{log}`` and ``{photo}`` are inputs."""

LOG = (
    "time_hours,quantity,value,error\n2000,elongation_percent,0.15,0.05\n4000,elongation_percent,0.31,0.05\n"
)

RESUMED = ("sweep", "uncertainty", "sensitivity", "optimise")
"""Commands whose folder may be partly done: a further run goes on with it."""

Files = dict[str, str]


@dataclass
class Tally:
    """What became of the kills of a command."""

    kills: int = 0
    ends: dict[str, int] = field(default_factory=lambda: dict.fromkeys(("absent", "old", "new", "partly"), 0))
    broken: list[str] = field(default_factory=list)


def files_in(folder: Path) -> Files:
    """Return the digests of all files below a folder, but for what a later run clears away."""
    found = {path.relative_to(folder): path for path in sorted(folder.rglob("*")) if path.is_file()}
    return {
        str(name): hashlib.sha256(path.read_bytes()).hexdigest()
        for name, path in found.items()
        if not any(re.fullmatch(r"\..+\.[a-z0-9_]{8}", part) for part in name.parts)
    }


class Trial:
    """A command, what two undisturbed runs of it write, and how long one takes."""

    def __init__(self, name: str, line: str, folder: Path) -> None:
        self.name, self.line, self.folder = name, line, folder
        self.out = folder / "out"
        begun = time.monotonic()
        self.whole = self.run_to_its_end()
        self.seconds = time.monotonic() - begun
        again = self.run_to_its_end()
        self.varying = {file for file in again if self.whole.get(file) != again[file]}

    def prepare(self, old: bool) -> Files:
        """Leave nothing where the output goes, or an output with a line more in each file; return that."""
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()
        if "{}/" in self.line:
            self.out.mkdir()
        if not old:
            return {}
        for name in self.run_to_its_end(clear=False):
            with (self.out / name).open("ab") as file:
                file.write(b"\n")
        return files_in(self.out)

    def command(self) -> list[str]:
        outs = [self.out] * self.line.count("{}")
        inputs = {"log": self.folder.parent / "log.csv", "photo": self.folder.parent / "photo.png"}
        return [sys.executable, "-m", "wearsim", *self.line.format(*outs, **inputs).split()]

    def run_to_its_end(self, clear: bool = True) -> Files:
        if clear:
            self.prepare(old=False)
        done = subprocess.run(self.command(), capture_output=True, text=True, check=False)
        if done.returncode not in (0, 3):
            raise SystemExit(f"{self.name}: exit code {done.returncode}: {done.stderr}")
        return files_in(self.out)

    def is_whole(self, found: Files) -> bool:
        return found.keys() == self.whole.keys() and all(
            found[name] == self.whole[name] for name in found.keys() - self.varying
        )

    def kill(self, draw: random.Random, number: int) -> None:
        """Start the command and kill it: at a random time, or just when it begins to write."""
        process = subprocess.Popen(self.command(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        places = (self.folder, self.out) if self.out.exists() else (self.folder,)
        before = {place: set(place.iterdir()) for place in places}
        latest = time.monotonic() + (self.seconds * draw.random() if number % 4 < 2 else 60.0)
        while process.poll() is None and time.monotonic() < latest:
            if number % 4 >= 2 and any(set(place.iterdir()) - before[place] for place in places):
                time.sleep(draw.uniform(0.0, 0.02))
                break
            time.sleep(0.0002)
        process.kill()
        process.wait()

    def left_behind(self) -> list[str]:
        """Return what is there beside an output that is complete, but for files of the last ten seconds.

        Their writers may not have locked them yet.
        """
        beside = [path.name for path in self.folder.iterdir() if path != self.out]
        written = {Path(name).parts[0] for name in self.whole}
        within = [path.name for path in self.out.iterdir() if path.is_dir() and path.name not in written]
        return sorted([*beside, *within])

    def tried(self, draw: random.Random, number: int, tally: Tally) -> None:
        """Kill once, look at what is there, run again and look once more."""
        old = number % 2 == 1 and self.name not in RESUMED
        before = self.prepare(old)
        self.kill(draw, number)
        tally.kills += 1
        found = files_in(self.out) if self.out.exists() else {}
        if not found:
            tally.ends["absent"] += 1
            if old:
                tally.broken.append(f"{self.name}: the old output is gone")
        elif found == before:
            tally.ends["old"] += 1
        elif self.is_whole(found):
            tally.ends["new"] += 1
        elif self.name in RESUMED:
            tally.ends["partly"] += 1
        else:
            tally.broken.append(f"{self.name}: torn: {sorted(found)}")
        try:
            if not self.is_whole(self.run_to_its_end(clear=False)):
                tally.broken.append(f"{self.name}: the next run writes something else")
        except SystemExit as error:
            tally.broken.append(f"{self.name}: the next run: {error}")
        if beside := self.left_behind():
            tally.broken.append(f"{self.name}: left behind: {beside}")


def write_inputs(folder: Path) -> None:
    """Write a log of a chain and a picture of a new sprocket."""
    (folder / "log.csv").write_text(LOG, "utf-8")
    outline = wearsim.load_case("08b-19t-wrap").drive.outline
    gap = np.column_stack([outline.x, outline.y])
    picture(wheel([gap] * 19), Camera(size=(800, 600))).save(folder / "photo.png")


def report(tallies: dict[str, Tally]) -> str:
    """Return the page."""
    lines = [
        "# Killed while they write",
        "",
        "Written by `python research/kills.py`. *Old* is an output of other content that was there before,",
        "*partly* a folder of a study, which a further run completes.",
        "",
        "| command | kills | absent | old | new | partly | broken |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, one in tallies.items():
        lines.append(
            f"| {name} | {one.kills} | {' | '.join(map(str, one.ends.values()))} | {len(one.broken)} |"
        )
    broken = [f"- {fault}" for one in tallies.values() for fault in one.broken]
    total = sum(one.kills for one in tallies.values())
    return "\n".join([*lines, "", f"{total} kills, {len(broken)} broken.", "", *broken]).rstrip() + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--kills", type=int, default=9, help="of each command")
    parser.add_argument("--only", default="", help="commands whose names hold this")
    given = parser.parse_args()
    os.environ["SOURCE_DATE_EPOCH"] = "0"
    draw, tallies = random.Random(38), {}  # noqa: S311
    with tempfile.TemporaryDirectory() as folder:
        write_inputs(Path(folder))
        for name, line in COMMANDS.items():
            if given.only not in name:
                continue
            trial, tallies[name] = Trial(name, line, Path(folder) / "trial"), Tally()
            for number in range(given.kills):
                trial.tried(draw, number, tallies[name])
            print(name, tallies[name].ends, tallies[name].broken, file=sys.stderr)
    text = report(tallies)
    if not given.only:
        REPORT.write_text(text, "utf-8")
    print(text)
    sys.exit(any(one.broken for one in tallies.values()))


if __name__ == "__main__":
    main()
