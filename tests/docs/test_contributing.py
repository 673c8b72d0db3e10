"""CONTRIBUTING.md is true: its table of places, its layers, its folders; and the hooks are gates of CI."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

import wearsim

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
PLACES = re.findall(
    r"^\| .+ \| \[.+\]\((.+)\).* \| (.+) \|$", PAGE.split("\n## To change this, open that\n")[1], re.MULTILINE
)


def place_of(name):
    """Where a file of the tree lies; the package may be installed elsewhere."""
    return (Path(wearsim.__file__).parents[1] if name.startswith("wearsim/") else ROOT) / name


def test_table_has_ten_places():
    rows = PAGE.split("| to change | open | look for |\n|---|---|---|\n")[1].split("\n\n")[0].splitlines()
    assert len(rows) == len(PLACES) == len(set(PLACES)) == 10


@pytest.mark.parametrize(("place", "names"), PLACES, ids=[place for place, _ in PLACES])
def test_place_holds_the_names(place, names):
    text = place_of(place).read_text("utf-8")
    found = re.findall(r"`([^`]+)`", names)
    assert found
    assert [name for name in found if not re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text)] == []


def test_layers_are_those_of_the_linter():
    line = PAGE.split("\n`cli` > ")[1].split("\n\n")[0]
    stated = [re.findall(r"`(\w+)`", layer) for layer in f"`cli` > {line}".split(">")]
    (contract,) = [c for c in PROJECT["tool"]["importlinter"]["contracts"] if c["type"] == "layers"]
    assert [sorted(layer) for layer in stated] == [sorted(row.split(" | ")) for row in contract["layers"]]


def test_the_engine_of_wear_says_no_chain():
    """A mechanism tells it what its mate is called; the engine wears gears and pins as well."""
    word = re.compile(
        r"(?<![a-z])(chain|roller|link|bush|joint|sprocket|tooth|teeth)(?![a-z])", re.IGNORECASE
    )
    files = sorted((Path(wearsim.__file__).parent / "wear").glob("*.py"))
    assert len(files) > 10
    said = {path.name: word.findall(re.sub(r"(?<=[a-z])s\b", "", path.read_text("utf-8"))) for path in files}
    assert {name: words for name, words in said.items() if words} == {}


def test_folders_of_tests_are_those_there_are():
    stated = re.findall(r"^\| `tests/(\w+)` \|", PAGE, re.MULTILINE)
    assert sorted(stated) == sorted(
        path.name for path in (ROOT / "tests").iterdir() if path.is_dir() and path.name != "__pycache__"
    )


def test_files_that_are_named_exist():
    named = re.findall(r"`((?:tests|docs|wearsim|reports|research|cases|\.ci)/[\w./-]*\w)`", PAGE)
    assert len(named) > 15
    assert [name for name in named if not place_of(name).exists()] == []


def test_hooks_are_gates_of_ci():
    """What a hook runs stands as a line in .ci/run, there with the tools of .venv."""
    gates = [
        line.removeprefix(".venv/bin/") for line in (ROOT / ".ci" / "run").read_text("utf-8").splitlines()
    ]
    (repository,) = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text("utf-8"))["repos"]
    entries = [hook["entry"] for hook in repository["hooks"]]
    assert [entry for entry in entries if entry not in gates] == []
    assert {entry.split()[0] for entry in entries} == {"ruff", "mypy", "lint-imports", "python"}
    assert {(hook["language"], hook["pass_filenames"]) for hook in repository["hooks"]} == {("system", False)}


DECISIONS = sorted((ROOT / "docs" / "decisions").glob("*.md"))


@pytest.mark.parametrize("page", DECISIONS, ids=[page.stem for page in DECISIONS])
def test_decision_names_what_there_is(page):
    text = page.read_text("utf-8")
    named = re.findall(r"`((?:tests|wearsim)/[\w./-]*\w)`", text)
    assert named
    assert [name for name in named if not place_of(name).exists()] == []
    pairs = re.findall(r"`(\w+)`\s+(?:in|\()\s*`(wearsim/[\w/]+\.py)`", text)
    assert [
        (name, file)
        for name, file in pairs
        if not re.search(rf"(?<!\w){name}(?!\w)", place_of(file).read_text("utf-8"))
    ] == []
