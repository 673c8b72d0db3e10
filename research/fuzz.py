"""Mutations of shipped cases and of the corpus, given to ``wearsim check`` until the time is up.

``python research/fuzz.py --seconds 60 --out found``: an input that ends as a bug, a warning of Python
or after more than ten seconds is written to the folder, with what was said.
"""

import argparse
import contextlib
import io
import random
import sys
import tempfile
import time
import tomllib
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

import wearsim.cli

ROOT = Path(__file__).parents[1]
CASES = sorted((ROOT / "cases").glob("*.toml")) + sorted((ROOT / "cases" / "drives").glob("*.toml"))
CORPUS = sorted((ROOT / "tests" / "corpus" / "cases").iterdir())

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
        return self.code not in ENDS or "Warning:" in self.said or self.seconds > LONGEST_SECONDS


def checked(path: Path) -> End:
    """Run ``wearsim check`` in this process, with every warning of Python as an error."""
    said, begun = io.StringIO(), time.process_time()
    sys.argv = ["wearsim", "check", str(path), "--debug"]
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


def inputs(draw: random.Random) -> Iterator[bytes]:
    """Yield mutations for ever: two of shipped cases by their keys, then one of the corpus by its bytes."""
    from wearsim.case.keys import CaseTablesOrDrive

    names = names_of(CaseTablesOrDrive.model_json_schema())
    while True:
        for _ in range(2):
            yield mutated_keys(draw.choice(CASES).read_text("utf-8"), names, draw)
        yield mutated_bytes(draw.choice(CORPUS).read_bytes(), draw)


def main() -> None:
    """Draw until the time is up, and say how many inputs ended as a bug."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=Path("found"))
    given = parser.parse_args()
    until, drawn, found = time.monotonic() + given.seconds, 0, 0
    draw = random.Random(given.seed)  # noqa: S311
    with tempfile.TemporaryDirectory() as folder:
        for drawn, content in enumerate(inputs(draw), 1):
            path = Path(folder) / "case.toml"
            path.write_bytes(content)
            end = checked(path)
            if end.is_bug:
                found += 1
                given.out.mkdir(parents=True, exist_ok=True)
                (given.out / f"{given.seed}-{drawn}.toml").write_bytes(content)
                (given.out / f"{given.seed}-{drawn}.txt").write_text(f"{end.code}\n{end.said}", "utf-8")
            if time.monotonic() > until:
                break
    print(f"{drawn} inputs, {found} ended as a bug")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
