"""``wearsim schema`` and ``wearsim list``."""

import json
from pathlib import Path

import jsonschema
import pytest

from wearsim.catalogue.catalogues import chain_rows, chains


@pytest.mark.parametrize("option", [(), ("--result",)])
def test_schema_is_a_json_schema(cli, option):
    done = cli("schema", *option)
    assert done.code == 0
    schema = json.loads(done.out)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    jsonschema.Draft202012Validator.check_schema(schema)


def objects(schema):
    if isinstance(schema, dict):
        if "properties" in schema and schema.get("type") == "object":
            yield schema
        for part in schema.values():
            yield from objects(part)


OPTIONAL = (
    "chain_life_hours",
    "sprocket_life_hours",
    "service",
    "km",
    "tonnes",
    "days",
    "date",
    "grid",
    "solve_for",
    "pinion_fatigue_life_hours",
    "wheel_fatigue_life_hours",
    "sprocket_fatigue_life_hours",
    "governing_life",
    "governing_life_hours",
    "governing_life_hours_at_least",
    "chain_life_hours_at_least",
    "sprocket_life_hours_at_least",
    "chains_run",
    "service_at_least",
    "overloaded",
    "ratings",
    "events",
    "practice",
)


def test_result_schema_is_closed_and_described(cli):
    found = list(objects(json.loads(cli("schema", "--result").out)))
    assert len(found) == 13
    for part in found:
        assert part["additionalProperties"] is False
        always = [name for name in part["properties"] if name not in OPTIONAL]
        assert part.get("required", []) == always
        assert all(entry["description"] for entry in part["properties"].values())


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("chains", ["16B-1", "25.4", "ПР-25,4-60", "ISO 606:2015, 3.3", "minimum tensile strength"]),
        ("materials", ["steel", "2.1e5", "polyamide 6"]),
        ("wear-conditions", ["hardened, oiled", "5e-11", "order of magnitude"]),
        ("cases", ["16b-20t-oiled ", "Evolute sprocket, 16B chain, 20 teeth", "wave-drive-100"]),
        ("quantities", ["evolute_offset_mm", "N/mm", "Young's modulus"]),
    ],
)
def test_every_table(cli, table, words):
    done = cli("list", table)
    assert (done.code, done.err) == (0, "")
    for word in words:
        assert word in done.out
    found = json.loads(cli("list", table, "--json").out)
    lines = done.out.splitlines()
    assert max(map(len, lines)) <= 100
    assert all(any(line.startswith(next(iter(row.values()))) for line in lines) for row in found)


def test_doubtful_chains_are_flagged(cli):
    """Chain 082 has another tensile strength in GOST; of 08B-1 all numbers are those of the standard."""
    lines = {line.split(" ")[0]: line for line in cli("list", "chains").out.splitlines()}
    assert lines["082"].split()[-2:] == ["0.26", "?"]
    assert lines["08B-1"].split()[-2:] == ["17.8", "0.7"]
    assert lines["?"].startswith("?    has doubtful numbers")


def test_listed_chains_are_those_of_the_catalogue(cli):
    """Those of two and three strands too, and of the A series of four to six; a line each."""
    assert json.loads(cli("list", "chains", "--json").out) == list(chain_rows())
    lines = {line.split(" ")[0]: line.split() for line in cli("list", "chains").out.splitlines()}
    assert lines["16B-2"] == ["16B-2", "25.4", "15.88", "17.02", "8.28", "421.4", "31.88", "106.0", "5.36"]
    assert lines["16A-6"][:3] == ["16A-6", "(ANSI", "80-6)"]
    assert {chain.designation for chain in chains().values()} <= set(lines)


def test_rows_that_share_a_source_have_it_once(cli):
    out = " ".join(cli("list", "chains").out.split())
    assert "2ПР-12,7-31,8," in out
    assert out.count("GOST 13568-97, clause 3") == 1


def test_listed_cases_exist(cli):
    found = json.loads(cli("list", "cases", "--json").out)
    assert len(found) >= 6
    for row in found:
        assert Path(row["file"]).is_file()
        assert row["title"]
    assert "packaging-conveyor" in [Path(row["file"]).stem for row in found]


def test_unknown_table(cli):
    done = cli("list", "chain")
    assert (done.code, done.out) == (2, "")
    assert "chains" in done.err
