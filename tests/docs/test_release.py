"""What a release is made of agrees: version, changelog, man pages, workflow, recipe and container file."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name as canonical

import wearsim

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
VERSION = wearsim.__version__


def load(place):
    return yaml.safe_load((ROOT / place).read_text("utf-8"))


@pytest.mark.parametrize("page", ["CHANGELOG.md", "docs/release_notes.md"])
def test_page_has_a_section_of_the_version(page):
    sections = re.findall(r"^## (\S+)$", (ROOT / page).read_text("utf-8"), re.MULTILINE)
    assert sections[0] == VERSION


def test_changelog_begins_with_the_numbers_that_change():
    sections = re.findall(r"^## (.+)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    assert sections[:2] == ["Numbers that change", VERSION]


def test_man_pages_name_the_version():
    heads = {page.name: page.read_text("utf-8").split("\n")[0] for page in (ROOT / "docs/man").glob("*.1")}
    assert len(heads) > 30
    assert [name for name, head in heads.items() if f'"{VERSION}"' not in head] == []


def test_shared_files_of_the_wheel_exist():
    wheel = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]["build"]["targets"]
    shared = wheel["wheel"]["shared-data"]
    assert {place.split("/")[1] for place in shared.values()} == {"man", "bash-completion", "zsh", "fish"}
    assert [source for source in shared if not (ROOT / source).exists()] == []


def test_recipe_is_of_this_version_and_needs_what_the_project_needs():
    recipe = load("packaging/conda/recipe.yaml")
    assert recipe["context"]["version"] == VERSION
    stated = [
        need.replace(" ", "").replace("matplotlib-base", "matplotlib")
        for need in recipe["requirements"]["run"]
    ]
    assert stated == [f"python{PROJECT['requires-python']}", *PROJECT["dependencies"]]
    assert recipe["about"]["summary"] == PROJECT["description"]


def test_workflow_runs_every_gate_on_linux_and_the_quick_tests_elsewhere():
    jobs = load(".github/workflows/ci.yml")["jobs"]
    commands = {name: [step["run"] for step in job["steps"] if "run" in step] for name, job in jobs.items()}
    assert jobs["gates"]["runs-on"] == "ubuntu-latest"
    assert commands["gates"] == [".ci/run"]
    assert jobs["quick"]["strategy"]["matrix"]["os"] == ["windows-latest", "macos-latest"]
    assert commands["quick"][-1] == "python -m pytest"


@pytest.mark.parametrize(("lock", "extras"), [("container", ["report"]), ("ci", ["dev", "docs", "browser"])])
def test_lock_holds_what_is_needed_with_hashes(lock, extras):
    """Whoever adds or raises a dependency renews the locks: by packaging/lock."""
    text = (ROOT / f"packaging/{lock}.lock").read_text("utf-8").replace(" \\\n", " ")
    rows = [line for line in text.splitlines() if not line.startswith("#")]
    assert [row for row in rows if not re.search(r"( --hash=sha256:[0-9a-f]{64})+$", row)] == []
    locked = [Requirement(row.partition(" --hash")[0]) for row in rows]
    optional = PROJECT["optional-dependencies"]
    needs = [Requirement(text) for text in PROJECT["dependencies"]]
    while extras:
        of_extra = [Requirement(text) for text in optional[extras.pop()]]
        extras += [name for need in of_extra if need.name == "wearsim" for name in need.extras]
        needs += [need for need in of_extra if need.name != "wearsim"]
    for need in needs:
        versions = [str(one.specifier)[2:] for one in locked if canonical(one.name) == canonical(need.name)]
        assert versions and all(need.specifier.contains(version) for version in versions), need


def test_container_and_ci_install_by_hash():
    container = (ROOT / "packaging/Containerfile").read_text("utf-8")
    assert "pip install --no-cache-dir --require-hashes -r /source/packaging/container.lock" in container
    steps = [step.get("run") for step in load(".github/workflows/ci.yml")["jobs"]["locked"]["steps"]]
    assert "python -m pip install --require-hashes -r packaging/ci.lock" in steps
    assert any("pip-audit" in run for run in steps if run)


def test_container_runs_a_case_that_is_shipped():
    (command,) = re.findall(
        r'^CMD \["life", "(.+)"\]$', (ROOT / "packaging/Containerfile").read_text("utf-8"), re.M
    )
    assert (ROOT / "cases" / f"{command}.toml").exists()
