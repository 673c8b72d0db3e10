"""Where the value of every key of a case comes from."""

from pathlib import Path

import pytest

from wearsim.drive.load_case import load_case
from wearsim.input.input_origins import input_rows

CASES = sorted((Path(__file__).parents[2] / "cases").glob("*.toml"))
CASE = {
    "format_version": 1,
    "chain": {"designation": "08B-2"},
    "sprocket": {"teeth": 20, "profile": "evolute", "engaged_every": 1},
    "duty": [
        {"share_of_time": 0.25, "power_kW": 3, "speed_rpm": 100},
        {"share_of_time": 0.75, "power_kW": 2, "speed_rpm": 90},
    ],
    "material": {"sprocket": {"name": "steel"}},
    "wear": {"condition": "hardened, oiled"},
}


def by_key(case):
    return {row.key: row for row in input_rows(case.inputs, case.assumptions)}


def test_given_taken_and_default():
    found = by_key(load_case(CASE))
    assert (found["sprocket.teeth"].origin, found["sprocket.teeth"].why) == ("given", "")
    assert found["sprocket.engaged_every"].origin == "default"
    assert found["sprocket.contact_end_mm"].origin == "taken"
    assert found["sprocket.contact_end_mm"].why == "0.16 pitch"
    assert found["duty.2.speed_rpm"].value == 90
    assert found["duty.2.speed_rpm"].unit == "rpm"
    assert found["wear.law"].origin == "taken"


def test_sources_of_catalogues():
    found = by_key(load_case(CASE))
    assert found["chain.designation"].why.startswith("ISO606-B: ISO 606:2015, 3.3")
    assert "2 times the single row" in found["chain.designation"].why
    assert "carbon" in found["material.sprocket.name"].why
    assert "order of magnitude" in found["wear.condition"].why


def test_gears_have_their_own_schema():
    (path,) = [path for path in CASES if path.stem == "involute-36t-mild"]
    found = by_key(load_case(path))
    assert found["gear.module_mm"].origin == "given"
    assert found["mechanism.pair_stiffness_N_per_mm_um"].origin == "taken"


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_every_default_told_is_found(path):
    """Every assumption of the form ``key = value (why)`` belongs to a key that is taken."""
    case = load_case(path)
    found = by_key(case)
    for text in case.assumptions:
        key, equals, _ = text.partition(" = ")
        if equals and key in found:
            assert found[key].origin == "taken", text
            assert text.endswith(f"({found[key].why})")
    assert all(row.origin in ("given", "taken", "default") for row in found.values())
    assert all(row.meaning for row in found.values())
