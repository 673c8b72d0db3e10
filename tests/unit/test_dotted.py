"""Tables by dotted names, and keys that take a table or a list."""

import pytest
from pydantic import ValidationError

import wearsim
from wearsim.errors import CaseError
from wearsim.input.table import dotted
from wearsim.study.sweep.keys import SweepTables

CASE = {
    "format_version": 1,
    "chain": {"designation": "16B-1"},
    "sprocket": {"teeth": 20, "profile": "evolute"},
    "load": {"power_kW": 3, "speed_rpm": 100},
    "wear": {"condition": "hardened, oiled"},
}


def test_both_ways_to_write_names_are_one():
    nested = {"load": {"power_kW": {"low": 1, "high": 2}}}
    quoted = {"load.power_kW": {"low": 1, "high": 2}}
    assert dotted(nested, "low") == dotted(quoted, "low") == quoted


def test_a_table_whose_keys_are_misspelt_is_still_a_value():
    assert dotted({"load.power_kW": {"lo": 1}}, "low") == {"load.power_kW": {"lo": 1}}
    assert dotted({"load": {"power_kW": 1}}) == {"load.power_kW": 1}


@pytest.mark.parametrize(
    ("table", "told"),
    [
        (
            {"uncertainty": {"load.power_kW": {"distributio": "normal"}}},
            [
                "uncertainty.load.power_kW.distribution: this key is required and missing",
                "uncertainty.load.power_kW.distributio: unknown key",
            ],
        ),
        (
            {"optimise": {"parameters": {"load.power_kW": {"low": 1.0, "hihg": 2.0}}}},
            [
                "optimise.parameters.load.power_kW.high: this key is required and missing",
                "optimise.parameters.load.power_kW.hihg: unknown key",
            ],
        ),
        ({"optimise": {"parameters": {"load.power_kW": [1.0]}}}, ["optimise.parameters.load.power_kW: "]),
    ],
)
def test_faults_name_the_key_and_nothing_of_the_library(table, told):
    with pytest.raises(CaseError) as caught:
        wearsim.load_case({**CASE, **table})
    text = str(caught.value)
    assert all(message in text for message in told), text
    assert "function" not in text and "union" not in text
    assert len(text.splitlines()) == len(told)


def test_numbers_of_entries_are_counted_without_zeros():
    assert dotted({"duty": {"01": {"speed_rpm": 3}}}) == {"duty.1.speed_rpm": 3}
    assert dotted({"duty.².speed_rpm": 3}) == {"duty.².speed_rpm": 3}
    with pytest.raises(ValueError, match="given twice"):
        dotted({"duty.1.speed_rpm": 3, "duty.01.speed_rpm": 4})


def test_a_sweep_tells_its_own_words_of_values():
    with pytest.raises(ValidationError, match=r"must be a range \{from, to, count\} or a list"):
        SweepTables.model_validate({"format_version": 1, "case": "a", "grid": {"load.power_kW": 3}})
