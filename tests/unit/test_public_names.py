"""The names of wearsim: which there are, how one goes, and that a typed program can use them."""

import re
import runpy
import subprocess
import sys
import warnings
from pathlib import Path
from pkgutil import iter_modules

import pytest

import wearsim
from wearsim.lazy import lazy_names

NAMES = """
CalibrationResult Case CaseError ChainReadingsResult CheckResult ContactError ConvergenceError DriveCase
DriveLife ExportResult GeometryError JudgementResult Life LoadsResult LowerBound LubricationResult
MaintenanceResult OptimiseResult RemainingResult ScanResult SelectionResult SweepResult UncertaintyResult
WearResult WearsimError YearPlanResult
__version__ allow_outside calibrate check export judge load_case loads lubricant lubricate maintain optimise
progress_bar
remaining scan select simulate simulate_many sweep uncertainty wear_law
"""
"""What programs of users may name; one that goes stands in `_FORMER` first: CONTRIBUTING.md says how long."""

ONLY_WHEN_ASKED = """
import sys, wearsim
case = wearsim.load_case(sys.argv[1]).with_({"load.tension_N": 900})
found = wearsim.check(case), wearsim.loads(case)
shown = [repr(one) + str(one.summary()) for one in found]
assert not {"pandas", "matplotlib", "click", "rich", "pint", "scipy"} & sys.modules.keys(), sys.modules.keys()
"""


def test_public_names_are_these():
    assert sorted(wearsim.__all__) == sorted(NAMES.split())
    assert sorted([*wearsim._PUBLIC, "__version__"]) == sorted(NAMES.split())
    assert all(getattr(wearsim, name) is not None for name in wearsim.__all__)


def test_no_module_takes_a_public_name():
    modules = {module.name for module in iter_modules(wearsim.__path__)}
    assert not modules & set(NAMES.split())
    assert not modules & set(wearsim._FORMER)


def test_a_former_name_works_and_warns():
    getter, _ = lazy_names("shapes", {"tau": "math"}, {"turn": ("tau", "2.0")})
    with pytest.warns(
        DeprecationWarning, match=r"shapes\.turn is called shapes\.tau now and goes with version 2\.0"
    ):
        assert getter("turn") == getter("tau")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        getter("tau")
    with pytest.raises(AttributeError, match="no attribute 'pi'"):
        getter("pi")


def test_former_names_lead_to_public_ones_of_a_later_version():
    for name, (present, last) in wearsim._FORMER.items():
        assert name not in NAMES.split()
        assert present in NAMES.split()
        later, now = (list(map(int, re.findall(r"\d+", text))) for text in (last, wearsim.__version__))
        assert later > now


@pytest.mark.wide
def test_a_typed_program_runs():
    client = runpy.run_path(str(Path(__file__).parents[1] / "typed_client.py"))
    client["main"]()


def test_tables_and_pictures_are_loaded_when_they_are_asked_for(tmp_path):
    client = runpy.run_path(str(Path(__file__).parents[1] / "typed_client.py"))
    case = tmp_path / "case.toml"
    import tomlkit

    case.write_text(tomlkit.dumps(client["TABLES"]))
    warm = [sys.executable, "-W", "error", "-c", ONLY_WHEN_ASKED, str(case)]
    done = subprocess.run(warm, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
