"""``wearsim doctor``: whether this installation is in order."""

import importlib
import json
import os
import platform
import re
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from importlib import metadata
from pathlib import Path

import click

import wearsim
from wearsim._version import ANSWER_HEAD, __version__
from wearsim.catalogue.shipped_cases import shipped_cases
from wearsim.command.options import common_options
from wearsim.extras import Library, libraries

LOWEST_PYTHON, NEWEST_PYTHON = (3, 11), (3, 13)
"""Python that all quick tests have passed on."""

KNOWN_CYCLES = 26_102_090.0
"""Life of the case of the self-test by an independent program, to six digits."""

_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge")


@dataclass(frozen=True)
class InstallationCheck:
    """One thing that was looked at."""

    name: str  # what it is
    state: str  # `ok`; `note` for what works but should be known; `failed` for what must be mended
    found: str  # what was found
    advice: str = ""  # what to do, empty where there is nothing to do


def installation_checks(case: Path | None) -> list[InstallationCheck]:
    """Look at everything that wearsim needs or can use."""
    return [
        InstallationCheck("wearsim", "ok", f"{__version__} in {Path(wearsim.__file__).parent}"),
        _python(),
        InstallationCheck("platform", "ok", f"{platform.system()} {platform.release()} {platform.machine()}"),
        *(_version(known) for known in libraries() if not known.extra),
        _guarded("cache of kernels", _cache),
        _guarded("kept runs", _kept_runs),
        _guarded("self-test", lambda: _self_test(case)),
        _guarded("threads", _threads),
        _temporary_folder(),
        _working_folder(),
        *_extras(),
        _browser(),
    ]


def _guarded(name: str, look: Callable[[], InstallationCheck]) -> InstallationCheck:
    """Make a finding of whatever goes wrong while looking: a broken library raises anything."""
    try:
        return look()
    except Exception as error:
        text = f"{type(error).__name__}: {error}".splitlines()[0]
        return InstallationCheck(name, "failed", text, "reinstall wearsim in a new virtual environment")


def _python() -> InstallationCheck:
    version, found = sys.version_info[:2], f"{platform.python_version()} in {sys.executable}"
    if version < LOWEST_PYTHON:
        return InstallationCheck("Python", "failed", found, "install Python 3.11 or newer")
    if version > NEWEST_PYTHON:
        return InstallationCheck("Python", "note", found, "newer than tested (3.11 to 3.13)")
    return InstallationCheck("Python", "ok", found)


def _version(known: Library) -> InstallationCheck:
    wanted = f"{known.lowest} to {known.newest} are tested"
    try:
        version = metadata.version(known.name)
    except metadata.PackageNotFoundError:
        advice = f"pip install '{known.name}>={known.lowest}'"
        return InstallationCheck(known.name, "failed", "not installed", advice)
    if _numbers(version) < _numbers(known.lowest):
        advice = f"{wanted}: pip install '{known.name}>={known.lowest}'"
        return InstallationCheck(known.name, "failed", version, advice)
    if _numbers(version)[:2] > _numbers(known.newest)[:2]:
        return InstallationCheck(known.name, "note", version, f"newer than tested: {wanted}")
    return InstallationCheck(known.name, "ok", version)


def _numbers(version: str) -> tuple[int, ...]:
    """Return the numbers of a release, such as (2, 4, 6)."""
    head = re.match(r"\d+(?:\.\d+)*", version)
    return tuple(int(part) for part in head.group().split(".")) if head else (0,)


def _cache() -> InstallationCheck:
    from wearsim.jit.compiled import cache_folder

    name, folder = "cache of kernels", cache_folder()
    if folder is None:
        advice = "every start compiles again: set NUMBA_CACHE_DIR to a writable folder"
        return InstallationCheck(name, "failed", "no writable folder", advice)
    files = [path for path in folder.rglob("*") if path.is_file()]
    size = sum(path.stat().st_size for path in files) / 1e6
    found = f"{folder}: {len(files)} files, {size:.1f} MB"
    if folder.is_relative_to(tempfile.gettempdir()) and not os.environ.get("NUMBA_CACHE_DIR"):
        advice = "lost with the temporary folder: make the cache folder in your home directory writable"
        return InstallationCheck(name, "note", found, advice)
    return InstallationCheck(name, "ok", found)


def _kept_runs() -> InstallationCheck:
    from wearsim.result.kept_runs import FOLDER, kept_files, runs_folder

    name, folder = "kept runs", runs_folder()
    if folder is None:
        return InstallationCheck(name, "ok", f"none: {FOLDER} is empty, or this user has no home")
    sizes = [status.st_size for _, status in kept_files(folder)]
    return InstallationCheck(name, "ok", f"{folder}: {len(sizes)} files, {sum(sizes) / 1e6:.1f} MB")


def _self_test(case: Path | None) -> InstallationCheck:
    """Run the shipped benchmark and compare its life."""
    name = "self-test"
    if case is None:
        text = "the shipped case hertz-arc-prescribed.toml is missing"
        return InstallationCheck(name, "failed", text, "reinstall wearsim: files are missing")
    start = time.perf_counter()
    cycles = wearsim.simulate(wearsim.load_case(case)).cycles
    seconds = time.perf_counter() - start
    error = abs(cycles / KNOWN_CYCLES - 1.0)
    found = f"a life of {cycles:.0f} cycles in {seconds:.2g} s, {KNOWN_CYCLES:.0f} is right"
    if error > 1e-4:
        advice = "do not trust results of this machine: delete the cache of kernels and reinstall wearsim"
        return InstallationCheck(name, "failed", found, advice)
    return InstallationCheck(name, "ok", found)


def _threads() -> InstallationCheck:
    numba = importlib.import_module("numba")
    return InstallationCheck("threads", "ok", f"{numba.config.NUMBA_NUM_THREADS} of {os.cpu_count()} cores")


def _temporary_folder() -> InstallationCheck:
    advice = "set TMPDIR to a writable folder"
    try:
        return _writable("temporary folder", Path(tempfile.gettempdir()), advice)
    except OSError as error:
        return InstallationCheck("temporary folder", "failed", str(error), advice)


def _working_folder() -> InstallationCheck:
    return _writable("working folder", Path.cwd(), "change to a writable folder, or name one with --out")


def _writable(name: str, folder: Path, advice: str) -> InstallationCheck:
    try:
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(4096))
            file.flush()
    except OSError as error:
        return InstallationCheck(name, "failed", f"{folder}: {error.strerror or error}", advice)
    return InstallationCheck(name, "ok", str(folder))


def _extras() -> Iterator[InstallationCheck]:
    """Give each extra; what is not installed is only noted."""
    extras: dict[str, list[InstallationCheck]] = {}
    for known in libraries():
        if known.extra:
            extras.setdefault(known.extra, []).append(_version(known))
    for extra, found in extras.items():
        text = ", ".join(f"{one.name} {one.found}" for one in found)
        fine = all(one.state == "ok" for one in found)
        missing = any(one.state == "failed" for one in found)
        advice = f"pip install 'wearsim[{extra}]'" if missing else "newer than tested"
        yield InstallationCheck(f"extra {extra}", "ok" if fine else "note", text, "" if fine else advice)


def _browser() -> InstallationCheck:
    found = next((path for name in _BROWSERS if (path := shutil.which(name))), None)
    if found is None:
        advice = "install Chromium or Chrome to test pages of reports"
        return InstallationCheck("browser", "note", "none found", advice)
    return InstallationCheck("browser", "ok", found)


_NOT_IN_ORDER = 1
_SELF_TEST = "hertz-arc-prescribed"


@click.command(short_help="Check the installation and suggest fixes.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@common_options
def doctor(as_json: bool) -> int:
    """Check versions, kernels, cache, folders, extras and browser, and compute a life that is known.

    The exit code is 1 if something required has failed. Notes do not count.
    """
    found = installation_checks(shipped_cases().get(_SELF_TEST))
    failed = [one.name for one in found if one.state == "failed"]
    if as_json:
        content = {**ANSWER_HEAD, "in_order": not failed, "findings": [asdict(one) for one in found]}
        click.echo(json.dumps(content, ensure_ascii=False))
        return _NOT_IN_ORDER if failed else 0
    width = max(len(one.name) for one in found)
    for one in found:
        click.echo(f"{one.state:<6}  {one.name:<{width}}  {one.found}")
        if one.advice:
            click.echo(f"{'':<6}  {'':<{width}}  -> {one.advice}")
    click.echo(f"failed: {', '.join(failed)}" if failed else "all required components are working")
    return _NOT_IN_ORDER if failed else 0
