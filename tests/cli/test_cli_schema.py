"""``wearsim schema --of COMMAND``: valid, described, and true of the shipped cases."""

import json
import tomllib
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from wearsim.cli.main import wearsim_command
from wearsim.command.registry import CALCULATIONS

CASES = sorted((Path(__file__).parents[2] / "cases" / "sizing").glob("*.toml"))


def cases_of(command):
    """Files whose name starts with the command, of all commands the longest that fits."""
    found = []
    for path in CASES:
        fitting = [name for name in CALCULATIONS if path.stem.startswith(name)]
        if fitting and max(fitting, key=len) == command:
            found.append(path)
    return found


@pytest.fixture(params=CALCULATIONS)
def schema(request, cli):
    done = cli("schema", "--of", request.param)
    assert (done.code, done.err) == (0, "")
    return request.param, json.loads(done.out)


def test_schema_is_valid_and_every_key_is_described(schema):
    command, content = schema
    Draft202012Validator.check_schema(content)
    assert content["title"] == f"wearsim handbook {command}"
    for table in (content, *content.get("$defs", {}).values()):
        if "properties" not in table:
            continue
        assert table["additionalProperties"] is False
        for name, entry in table["properties"].items():
            assert entry.get("description") or "$ref" in str(entry), name


def test_shipped_cases_are_valid_and_faults_are_not(schema):
    command, content = schema
    validator = Draft202012Validator(content)
    assert cases_of(command), f"cases/sizing must hold {command}-*.toml"
    for path in cases_of(command):
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
        assert list(validator.iter_errors(tables)) == [], path
        assert not validator.is_valid({**tables, "format_version": 2})
        assert not validator.is_valid({**tables, "no_such_table": {}})


def test_every_file_belongs_to_a_calculation_and_every_calculation_is_a_command():
    assert sorted(path for command in CALCULATIONS for path in cases_of(command)) == CASES
    assert set(CALCULATIONS) <= set(wearsim_command.commands["handbook"].commands)


def test_unknown_command_is_named(cli):
    done = cli("schema", "--of", "wave-drives")
    assert done.code == 2
    assert "must be one of " in done.err
    assert "wave-drive" in done.err


def test_one_schema_at_a_time(cli):
    assert cli("schema", "--result", "--of", "wave-drive").code == 2


def described(cli, *of):
    """Descriptions of all keys of a schema by table and key."""
    content = json.loads(cli("schema", *of).out)
    return {
        (name, key): entry.get("description", "")
        for name, table in {"": content, **content["$defs"]}.items()
        for key, entry in table.get("properties", {}).items()
    }


@pytest.mark.parametrize(
    ("of", "table", "key", "says"),
    [
        (["--of", "strength"], "StrengthDriveTable", "life_hours", "required"),
        (["--of", "wave-drive"], "WaveDriveTable", "life_hours", "required"),
        (["--of", "hertz-check"], "ContactTable", "torque_N_m", "pinion"),
        ([], "SprocketTable", "seat_radius_mm", "radius of the roller's seat"),
        ([], "SprocketTable", "flank_radius_mm", "above the seat"),
        ([], "LubricationTable", "environment", "surroundings of the drive"),
    ],
)
def test_key_that_is_a_column_too_is_described_as_a_key(cli, of, table, key, says):
    assert says in described(cli, *of)[table, key]


def test_no_input_is_described_as_an_output(schema, cli):
    """A key is given: words for a value that may be missing are those of a column, as are a table's."""
    found = described(cli, "--of", schema[0])
    assert [key for key, text in found.items() if "empty where" in text or "that is drawn" in text] == []
