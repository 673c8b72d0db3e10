"""``wearsim schema`` as an editor uses it: checked with taplo."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from wearsim.case.keys import CaseTablesOrDrive
from wearsim.catalogue.shipped_cases import shipped_cases

WITH_UNITS = """\
format_version = 1
[chain]
pitch_mm = "1 inch"
roller_diameter_mm = 15.88
inner_width_mm = "17.02 mm"
[sprocket]
teeth = 20
profile = "evolute"
evolute_offset_mm = ".55 cm"
[load]
torque_N_m = "20 Nm"
speed_rpm = "10 rad/s"
[wear]
specific_wear_rate_mm2_per_N = "5e-8 mm^3/(N*m)"
"""

FIVE_FAULTS = """\
format_version = 1
titel = "one: unknown key"
[chain]
designation = 16
[sprocket]
teeth = 20.5
profile = "evolvent"
[load]
power_kW = -3
speed_rpm = 100
[wear]
condition = "hardened, oiled"
"""


@pytest.fixture(scope="module")
def check(tmp_path_factory):
    """Run taplo on files; exit code and its different errors."""
    folder = tmp_path_factory.mktemp("schema")
    schema = folder / "case.schema.json"
    schema.write_text(json.dumps(CaseTablesOrDrive.model_json_schema()))
    beside = Path(sys.executable).with_name("taplo")
    taplo = str(beside) if beside.exists() else shutil.which("taplo")
    assert taplo, "taplo is one of the extra 'test'"

    def check(*files):
        done = subprocess.run(
            [taplo, "check", "--colors", "never", "--schema", schema.as_uri(), *map(str, files)],
            capture_output=True,
            text=True,
            cwd=folder,
        )
        errors = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
        return done.returncode, set(errors)

    return check


def test_shipped_cases_and_strings_with_units_pass(check, tmp_path):
    path = tmp_path / "units.toml"
    path.write_text(WITH_UNITS)
    of_chains = [path for path in shipped_cases().values() if path.parent.name in ("cases", "drives")]
    cases = [case for case in of_chains if "[gear]" not in Path(case).read_text("utf-8")]
    assert cases
    assert check(path, *cases)[0] == 0


def test_five_faults_are_found(check, tmp_path):
    """Those of the sprocket come as one, as it may be that of a case or of a whole drive."""
    path = tmp_path / "bad.toml"
    path.write_text(FIVE_FAULTS)
    code, errors = check(path)
    assert code != 0
    assert len(errors) == 4
    for wrong in ("'titel'", "16 is not of type", '{"teeth":20.5,"profile":"evolvent"}', "-3"):
        assert any(wrong in error for error in errors), wrong


def test_every_key_is_described():
    schema = CaseTablesOrDrive.model_json_schema()
    tables = [schema, *schema["$defs"].values()]
    for table in tables:
        for name, entry in table["properties"].items():
            assert entry.get("description") or "$ref" in str(entry), name
        assert table["additionalProperties"] is False
