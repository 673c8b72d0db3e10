"""Mutated inputs, given to the command that reads them until the time is up.

``python research/fuzz.py --seconds 60 --out found`` takes cases, points, drawings, readings and the files of
a run by turns. An input that ends as a bug, as a warning of Python or after more than ten seconds is written
to the folder, with what was said: put it into tests/corpus once it is mended. Mutations are random, of keys
or of bytes; with ``--guided``, and atheris installed, they follow what the code that reads them has run.
"""

import argparse
import contextlib
import io
import random
import re
import subprocess
import sys
import tempfile
import time
import tomllib
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from damage import without_digests  # noqa: E402

CORPUS = ROOT / "tests" / "corpus"

VALUES = (
    *("nan", "inf", "-inf", "-1", "0", "-0.0", "0.5", "1e-30", "1e30", "1e300", "9223372036854775808"),
    *('""', '"text"', '"=1+1"', '"\\u0000"', "true", "[]", "[1, nan]", "{}", "{a = 1}", "2026-01-01"),
)
"""What a key is set to, as TOML."""

BYTES = (b"\0", b"\xff", b"\xef\xbb\xbf", b'"', b"[", b"]", b"=", b"\r", b"\n", b"1e999", b"nan", b"\\u0000")
LONGEST_SECONDS = 10.0
ENDS = (0, 2, 3)


@dataclass(frozen=True)
class End:
    """How a command ended."""

    code: Any
    said: str
    seconds: float

    @property
    def is_bug(self) -> bool:
        return (
            self.code not in ENDS
            or re.search("[a-z]Warning:", self.said) is not None
            or self.seconds > LONGEST_SECONDS
        )


def ended(words: list[str]) -> End:
    """Run a command in this process, with every warning of Python as an error."""
    import wearsim.cli

    said, begun = io.StringIO(), time.process_time()
    sys.argv = ["wearsim", *words, "--debug"]
    code: Any = 0
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said), warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            wearsim.cli.main()
        except SystemExit as end:
            code = end.code or 0
    return End(code, said.getvalue(), time.process_time() - begun)


def keys_of(table: Any, before: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yield the place of every key, those of tables in lists too."""
    pairs = table.items() if isinstance(table, dict) else enumerate(table)
    for key, value in pairs:
        yield (*before, key)
        if isinstance(value, dict | list):
            yield from keys_of(value, (*before, key))


def names_of(schema: dict[str, Any]) -> list[str]:
    """Return every name of a key in a JSON Schema."""
    tables = [schema, *schema.get("$defs", {}).values()]
    return sorted({name for table in tables for name in table.get("properties", {})})


def mutated_keys(text: str, names: list[str], draw: random.Random) -> bytes:
    """Return a case with one to three keys of another value, gone, misspelt, twice or added."""
    case = tomlkit.parse(text).unwrap()
    for _ in range(draw.randint(1, 3)):
        *above, key = draw.choice(list(keys_of(case)))
        table = case
        for name in above:
            table = table[name]
        value = tomllib.loads(f"value = {draw.choice(VALUES)}")["value"]
        change = draw.randrange(5)
        if change <= 1 or isinstance(table, list):
            table[key] = value
        elif change == 2:
            del table[key]
        elif change == 3:
            table[key[:-1] + key[:1]] = table.pop(key)
        else:
            table[draw.choice(names)] = value
        if not case:
            break
    written = tomlkit.dumps(case)
    if draw.random() < 0.1:
        line = draw.choice(written.splitlines() or [""])
        written = written.replace(line, f"{line}\n{line}", 1)
    return written.encode()


def mutated_bytes(content: bytes, draw: random.Random) -> bytes:
    """Return content with one to four places of another kind: put in, cut out or doubled."""
    for _ in range(draw.randint(1, 4)):
        first, last = sorted(draw.randint(0, len(content)) for _ in range(2))
        change = draw.randrange(3)
        if change == 0:
            content = content[:first] + draw.choice(BYTES) + content[first:]
        elif change == 1:
            content = content[:first] + content[min(last, first + 20) :]
        else:
            content = content[:last] + content[first : min(last, first + 200)] + content[last:]
    return content


STRAND = """format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
nodes = 21
[load]
tension_N = 5000
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 5e-11
[run]
life_tolerance = 0.1
"""

DRAWN = {
    "points": 'profile = "points"\nevolute_offset_mm = 5.5\npoints_file = "points.csv"',
    "dxf": 'profile = "dxf"\ndxf_file = "wheel.dxf"',
}
"""Lines of a sprocket whose flank is in a file."""


class Reader:
    """The command that reads a kind of input, in a folder of its own."""

    def __init__(self, kind: str, folder: Path) -> None:
        self.kind, self.folder = kind, folder
        self.case, self.run = folder / "strand.toml", folder / "run"
        self.case.write_text(STRAND)
        if kind == "run":
            ended(["life", str(self.case), "--out", str(self.run)])
            # Else every mutation is refused by its digest, and none is read value by value.
            without_digests(self.run)
        self.seeds = self._seeds()

    def _seeds(self) -> dict[str, list[bytes]]:
        """Return inputs to begin with, by the names of the files that they are written to."""
        match self.kind:
            case "case":
                shipped = [*(ROOT / "cases").glob("*.toml"), *(ROOT / "cases" / "drives").glob("*.toml")]
                return {"case.toml": _contents([*shipped, *(CORPUS / "cases").iterdir()])}
            case "points":
                return {"points.csv": _contents((CORPUS / "points").glob("*.csv"))}
            case "dxf":
                return {"wheel.dxf": _contents((CORPUS / "points").glob("*.dxf"))}
            case "readings":
                return {"readings.csv": _contents((CORPUS / "readings").iterdir())}
            case _:
                names = ("result.json", "history.csv", "flank.csv", "case.lock.toml")
                return {f"run/{name}": _contents([self.run / name]) for name in names}

    def read(self, name: str, content: bytes) -> End:
        """Write an input and run the command."""
        (self.folder / name).write_bytes(content)
        match self.kind:
            case "case":
                return ended(["check", str(self.folder / name)])
            case "points" | "dxf":
                self.case.write_text(STRAND.replace('profile = "evolute"\nnodes = 21', DRAWN[self.kind]))
                return ended(["check", str(self.case)])
            case "readings":
                return ended(["calibrate", str(self.case), str(self.folder / name)])
            case _:
                end = ended(["compare", str(self.run), "--json"])
                (self.folder / name).write_bytes(self.seeds[name][0])
                return end


KINDS = ("case", "points", "dxf", "readings", "run")


def _contents(paths: Any) -> list[bytes]:
    return [path.read_bytes() for path in sorted(paths)]


def mutations(reader: Reader, draw: random.Random) -> Iterator[tuple[str, bytes]]:
    """Yield mutated inputs for ever: of cases that can be read two by their keys, then one by its bytes."""
    from wearsim.case.keys import CaseTablesOrDrive

    names = names_of(CaseTablesOrDrive.model_json_schema())
    while True:
        for number in range(3):
            name = draw.choice(list(reader.seeds))
            seed = draw.choice(reader.seeds[name])
            if name.endswith(".toml") and number < 2:
                with contextlib.suppress(ValueError, LookupError, TypeError, RecursionError):
                    yield name, mutated_keys(seed.decode(), names, draw)
                    continue
            yield name, mutated_bytes(seed, draw)


class Finds:
    """The folder of what was found."""

    def __init__(self, folder: Path, stem: str) -> None:
        self.folder, self.stem = folder, stem
        self.number = self.answered = self.found = 0

    def take(self, reader: Reader, name: str, content: bytes) -> None:
        """Read an input, and keep it where it ends as a bug."""
        end, self.number = reader.read(name, content), self.number + 1
        self.answered += end.code == 0
        if end.is_bug:
            self.found += 1
            self.folder.mkdir(parents=True, exist_ok=True)
            stem = f"{self.stem}-{self.number}"
            (self.folder / f"{stem}{Path(name).suffix}").write_bytes(content)
            (self.folder / f"{stem}.txt").write_text(f"{name}\n{end.code}\n{end.said}", "utf-8")


def at_random(reader: Reader, finds: Finds, seconds: float, seed: int) -> None:
    """Take mutations until the time is up."""
    until = time.monotonic() + seconds
    for name, content in mutations(reader, random.Random(seed)):  # noqa: S311
        finds.take(reader, name, content)
        if time.monotonic() > until:
            return


def guided(reader: Reader, finds: Finds, seconds: float, seed: int) -> None:
    """Let atheris mutate the largest group of seeds; ends the process."""
    import atheris

    name = max(reader.seeds, key=lambda name: len(reader.seeds[name]))
    seeds = reader.folder / "seeds"
    seeds.mkdir()
    for number, content in enumerate(reader.seeds[name]):
        (seeds / str(number)).write_bytes(content)

    def one(content: bytes) -> None:
        finds.take(reader, name, content)

    finds.folder.mkdir(parents=True, exist_ok=True)
    options = (
        *(f"-artifact_prefix={finds.folder}/", f"-max_total_time={seconds:.0f}", f"-seed={seed}"),
        *("-timeout=60", "-rss_limit_mb=4096", "-print_final_stats=1"),
    )
    atheris.Setup([sys.argv[0], *options, str(seeds)], one)
    atheris.Fuzz()


def one_kind(given: argparse.Namespace) -> None:
    """Take one kind of input; where atheris guides, it watches what reads them, but no kernel."""
    watched: Any = contextlib.nullcontext()
    take: Callable[[Reader, Finds, float, int], None] = at_random
    if given.guided:
        import atheris

        watched = atheris.instrument_imports(include=["wearsim"], exclude=["wearsim.kernels", "wearsim.jit"])
        take = guided
    with tempfile.TemporaryDirectory() as folder:
        finds = Finds(given.out, f"{given.kind}-{given.seed}")
        with watched:
            reader = Reader(given.kind, Path(folder))
            for name, seeds in reader.seeds.items():
                reader.read(name, max(seeds, key=len))
        take(reader, finds, given.seconds / len(KINDS), given.seed)
        print(f"{given.kind}: {finds.number} inputs, {finds.answered} answered, {finds.found} a bug")


def main() -> None:
    """Give each kind of input its part of the time, in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("found"))
    parser.add_argument("--guided", action="store_true")
    parser.add_argument("--kind", choices=KINDS)
    given = parser.parse_args()
    if given.kind:
        one_kind(given)
        return
    for kind in KINDS:
        subprocess.run([sys.executable, *sys.argv, "--kind", kind], check=True)
    found = sorted(given.out.glob("*.txt"))
    print(f"{len(found)} ended as a bug: {given.out}")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
