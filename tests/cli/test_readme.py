"""README.md and docs/ are true: every expected value is what the document itself states."""

import contextlib
import csv
import io
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from pydantic import BaseModel

import wearsim
import wearsim.cli
from wearsim.case.keys import CaseTables
from wearsim.catalogue.catalogues import catalogue_rows
from wearsim.mechanisms.wrap.tooth_loads import tooth_loads
from wearsim.quantities import grouped
from wearsim.report.comparison import comparison_table
from wearsim.report.flank_view import profile_table
from wearsim.report.loads_table import loads_json

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
INPUT = (ROOT / "docs" / "input.md").read_text(encoding="utf-8")
OUTPUT = (ROOT / "docs" / "output.md").read_text(encoding="utf-8")
WEARSIM = str(Path(sys.executable).parent / "wearsim")
SET_UP = "python3 -m venv .venv && "
CASE = "cases/16b-20t-oiled.toml"


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```", text, flags=re.DOTALL | re.MULTILINE)


def lines_of_shell(text):
    return [line for block in blocks(text, "sh") for line in block.splitlines()]


def commands():
    """Those of README.md, then those of output.md."""
    return [line for line in lines_of_shell(README + OUTPUT) if re.match(r"(\.venv/bin/)?wearsim ", line)]


def run(line, folder):
    """The installed command in a process of its own."""
    _, *arguments = shlex.split(line, comments=True)
    return subprocess.run(
        [WEARSIM, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    )


def run_here(line, folder):
    """The same command in this process, which has loaded what every command needs."""
    out, err = io.StringIO(), io.StringIO()
    with (
        contextlib.chdir(folder),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
        pytest.MonkeyPatch.context() as patch,
    ):
        patch.setattr(sys, "argv", ["wearsim", *shlex.split(line, comments=True)[1:]])
        with pytest.raises(SystemExit) as ended:
            wearsim.cli.main()
    return subprocess.CompletedProcess(line, ended.value.code or 0, out.getvalue(), err.getvalue())


def documented(text, heading):
    """First column of the first table under a heading, without its backticks."""
    section = text.split(f"\n## {heading}\n", 1)[1].split("\n## ", 1)[0]
    table = re.search(r"^\|.*\n\|[-|: ]+\n((?:\|.*\n?)+)", section, flags=re.MULTILINE)[1]
    return [row.split("|")[1].strip().strip("`") for row in table.splitlines()]


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """A copy of what the commands read, after all of them have run in turn."""
    folder = tmp_path_factory.mktemp("checkout")
    shutil.copytree(ROOT / "cases", folder / "cases")
    return folder, {line: run_here(line, folder) for line in commands()}


@pytest.fixture(scope="module")
def result():
    return wearsim.simulate(wearsim.load_case(ROOT / CASE))


FATIGUE = "fatigue.sprocket={treatment='surface_hardened', hardness_HRC=45}"
WRAP = ["mechanism.kind=wrap", "mechanism.phases=2", "sprocket.nodes=101", "run.horizon_hours=50"]


@pytest.fixture(scope="module")
def wrapped():
    case = wearsim.load_case(ROOT / "cases" / "08b-19t-wrap.toml", [*WRAP, FATIGUE])
    return case, wearsim.simulate(case)


def test_exactly_two_set_up_lines_as_ci_reads_them():
    lines = [line for line in README.splitlines() if line.startswith(SET_UP)]
    assert len(lines) == 2
    assert lines[0].endswith(f".venv/bin/wearsim life {CASE}")
    assert lines[1].endswith(".venv/bin/python -m pytest")


def test_answer_is_what_the_first_set_up_line_prints():
    line = next(line for line in README.splitlines() if line.startswith(SET_UP))
    done = run(line.rsplit(" && ", 1)[1], ROOT)
    assert done.returncode == 0, done.stderr
    assert done.stdout in blocks(README, "text")


@pytest.mark.wide
def test_every_command_runs(checkout):
    assert len([line for line in commands() if line.startswith(".venv/")]) == 5
    failed = {line: done.stderr for line, done in checkout[1].items() if done.returncode != 0}
    assert not failed


def test_history_is_that_of_a_fresh_run(checkout):
    (shown,) = (block for block in blocks(OUTPUT, "text") if block.startswith("cycles,"))
    fresh = (checkout[0] / "out" / "16b" / "history.csv").read_text(encoding="utf-8")
    shown_rows, fresh_rows = list(csv.reader(shown.splitlines())), list(csv.reader(fresh.split()))
    assert len(shown_rows) == 5
    assert shown_rows[0] == fresh_rows[0]
    for shown_row, fresh_row in zip(shown_rows[1:], fresh_rows[1:5], strict=True):
        expected = [float(value) for value in shown_row]
        # The solver chooses its steps by the last digits, which differ between processors.
        assert [float(value) for value in fresh_row] == pytest.approx(expected, rel=1e-4)


@pytest.mark.wide
def test_plot_is_three_lines_and_runs(checkout):
    (code,) = blocks(OUTPUT, "python")
    assert len(code.splitlines()) == 3
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=checkout[0],
        capture_output=True,
        text=True,
        env={**os.environ, "MPLBACKEND": "Agg"},
    )
    assert done.returncode == 0, done.stderr
    assert (checkout[0] / "depth.png").read_bytes().startswith(b"\x89PNG")


def test_picture_is_of_the_life_in_the_answer(result):
    picture = (ROOT / "docs" / "worn_flank.svg").read_text(encoding="utf-8")
    assert f"after {grouped(result.life.hours)} h" in picture
    assert f"{grouped(result.life.hours)} h" in README


def test_picture_is_of_the_drive_as_it_is_checked():
    picture = (ROOT / "docs" / "packaging_conveyor.svg").read_text(encoding="utf-8")
    layout = json.loads(run("wearsim check packaging-conveyor --json", ROOT).stdout)["layout"]
    written = re.findall(r"<text .*>(.+)</text>", picture)
    assert written[:-1] == [
        *(f"{sprocket['name']}, {sprocket['teeth']}" for sprocket in layout["sprockets"]),
        *(f"{grouped(span['tension_N'])} N" for span in layout["spans"]),
    ]
    assert written[-1] == "200 mm"


PACKAGE = Path(wearsim.__file__).parent
DOCUMENTS = (
    *("README.md", "CHANGELOG.md", "CONTRIBUTING.md"),
    *(path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "docs").rglob("*.md"))),
)


@pytest.mark.parametrize("document", DOCUMENTS)
def test_links_lead_somewhere(document):
    path = ROOT / document
    text = path.read_text(encoding="utf-8")
    targets = [t for t in re.findall(r"\]\(([^)\s]+)\)", text) if "://" not in t]
    for target in targets:
        name, _, anchor = target.partition("#")
        place = path.parent / name if name else path
        if name.startswith("wearsim/"):
            place = PACKAGE.parent / name  # installed elsewhere where a wheel is tested
        assert place.exists(), f"{document}: {target}"
        if anchor:
            headings = re.findall(r"^#+ (.+)$", place.read_text(encoding="utf-8"), re.MULTILINE)
            slugs = [re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in headings]
            assert anchor in slugs, f"{document}: {target}"


def schema_keys(model, prefix=""):
    for name, field in model.model_fields.items():
        inner = (field.annotation, *getattr(field.annotation, "__args__", ()))
        table = next((t for t in inner if isinstance(t, type) and issubclass(t, BaseModel)), None)
        if table is None:
            yield prefix + name
        else:
            yield from schema_keys(table, f"{prefix}{name}.")


def test_input_md_has_every_key_of_the_schema_and_no_other():
    tables = [name for name in CaseTables.model_fields if f"\n## [{name}]\n" in INPUT]
    found = documented(INPUT, "Top of the file")
    # The first table of [wear] is of laws; its keys stand in the table that starts with law.
    wear = INPUT.split("\n## [wear]\n", 1)[1]
    laws = documented(INPUT, "[wear]")
    assert laws == [row["law"] for row in catalogue_rows("wear_laws")]
    wear = "\n## [wear]\n" + wear[wear.index("| key |") :]
    for table in tables:
        keys = documented(wear if table == "wear" else INPUT, f"[{table}]")
        found += [f"{table}.{key}" for key in keys]
    assert sorted(found) == sorted(schema_keys(CaseTables))


def test_input_md_has_the_registry_of_laws_as_it_is():
    for row in catalogue_rows("wear_laws"):
        name, *others = row.values()
        assert f"| `{name}` | {' | '.join(others)} |" in INPUT


@pytest.mark.parametrize("table", ["wear_conditions", "lubricants", "environments"])
def test_input_md_has_the_catalogues_as_they_are(table):
    for row in catalogue_rows(table):
        assert "| " + " | ".join(row.values()) + " |" in INPUT


@pytest.mark.parametrize("block", [b for b in blocks(INPUT, "toml") if "format_version" in b])
def test_whole_cases_of_input_md_are_complete(block):
    assert wearsim.load_case(tomllib.loads(block)).cycles_per_hour > 0.0


@pytest.mark.parametrize("block", [b for b in blocks(INPUT, "toml") if "format_version" not in b])
def test_pieces_of_input_md_hold_keys_that_exist(block):
    keys = set(schema_keys(CaseTables))

    def dotted(table, prefix=""):
        for name, value in table.items():
            if isinstance(value, dict):
                yield from dotted(value, f"{prefix}{name}.")
            else:
                yield prefix + name

    assert set(dotted(tomllib.loads(block))) <= keys


def test_output_md_has_every_key_and_column(result, wrapped):
    keys = documented(OUTPUT, "life --json")
    assert keys == list(wrapped[1].summary())
    assert [key for key in keys if key in result.summary()] == list(result.summary())
    assert documented(OUTPUT, "history.csv on a wrap") == list(wrapped[1].history)
    assert documented(OUTPUT, "flank.csv on a wrap") == list(wrapped[1].flank)
    assert documented(OUTPUT, "loads") == list(loads_json(tooth_loads(wrapped[0])))
    assert documented(OUTPUT, "history.csv") == list(result.history)
    assert documented(OUTPUT, "flank.csv") == list(result.flank)
    assert documented(OUTPUT, "profile") == list(profile_table(wearsim.load_case(ROOT / CASE)))
    assert documented(OUTPUT, "summary.csv") == list(comparison_table([result]).frame())


def test_output_md_has_every_file(checkout):
    run_files = {path.name for path in (checkout[0] / "out" / "16b").iterdir()}
    assert set(documented(OUTPUT, "Files of life --out DIR")) == run_files
    compared = {path.name for path in (checkout[0] / "reports" / "first").iterdir()}
    named = set(documented(OUTPUT, "compare"))
    pictures = {name.replace(".svg", ".png") for name in named if name.endswith(".svg")}
    assert named | pictures == compared


def test_failed_case_of_output_md(tmp_path):
    (tmp_path / "bad.toml").write_text("format_version = 1\n", encoding="utf-8")
    done = run("wearsim life bad.toml --json", tmp_path)
    assert done.returncode == 2
    failed = json.loads(done.stdout.splitlines()[0])
    assert set(failed) == {"schema_version", "case", "error"}
    assert set(failed["error"]) == {"kind", "message", "file", "line", "key"}
    for name in (*failed, *failed["error"]):
        assert f"`{name}`" in OUTPUT


def test_exit_codes_of_output_md_are_those_of_the_help():
    help_text = run("wearsim --help", ROOT).stdout
    listed = re.search(r"Exit codes:(.*?)\.\n", help_text, flags=re.DOTALL)[1]
    codes = re.findall(r"(?:^|,|\s)(\d+) [a-z-]", listed)
    assert documented(OUTPUT, "Exit codes") == codes
