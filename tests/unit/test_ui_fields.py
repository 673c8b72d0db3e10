"""The form of ``wearsim ui`` follows from the schema."""

import pytest

from wearsim.input.keys import schema_fields
from wearsim.input.schema import CaseTables
from wearsim.mechanisms.gear_pair.keys import GearTables
from wearsim.page.fields import form_fields, table_meaning
from wearsim.quantities import quantities


@pytest.mark.parametrize(("data", "model"), [({"duty": [{}]}, CaseTables), ({"gear": {}}, GearTables)])
def test_every_key_has_one_field_with_unit_and_meaning(data, model):
    fields = [field for table in form_fields(data).values() for field in table]
    keys = [key.replace("[]", ".1") for key, _ in schema_fields(model)]
    assert sorted(field.key for field in fields) == sorted(keys)
    for field in fields:
        assert field.unit == quantities()[field.name].unit
        assert field.meaning == quantities()[field.name].meaning != ""


@pytest.mark.parametrize("data", [{}, {"gear": {}}, {"duty": [{}, {}]}])
def test_every_table_has_a_meaning(data):
    for name in form_fields(data):
        assert bool(table_meaning(data, name)) == bool(name)


def test_lists_of_tables_have_as_many_as_there_are():
    assert [name for name in form_fields({}) if "duty" in name] == ["duty[]"]
    assert form_fields({})["duty[]"] == []
    tables = form_fields({"duty": [{}, {}]})
    assert tables["duty.2"][0].key == "duty.2.share_of_time"
    assert "duty.1" not in form_fields({"duty": 3})


def test_kinds_of_fields():
    fields = {field.key: field for table in form_fields({}).values() for field in table}
    assert fields["sprocket.form"].choices == ("min", "max")
    assert fields["optimise.objectives"].choices == ()
    assert not fields["optimise.objectives"].is_text
    assert not [key for key in fields if key.startswith(("uncertainty", "optimise.parameters"))]
    assert fields["sprocket.displaced"].choices == ("true", "false")
    assert not fields["sprocket.displaced"].is_text
    assert fields["load.regime"].is_text and "0" in fields["load.regime"].choices
    assert fields["title"].is_text and fields["chain.designation"].is_text
    assert not fields["load.power_kW"].is_text and not fields["load.duty_bins"].is_text
    assert "16B-1" in fields["chain.designation"].proposals
    assert "hardened, oiled" in fields["wear.condition"].proposals
    assert fields["sprocket.teeth"].required and not fields["sprocket.nodes"].required
    assert fields["run.horizon_hours"].default == "1e+06"
    assert fields["wear.law"].default == "archard"
    assert fields["maintenance.turn_sprocket"].default == "false"
