"""The form of ``wearsim ui`` follows from the schema."""

import pytest

from wearsim.case.keys import CaseTables, DriveTables
from wearsim.catalogue.catalogues import wear_conditions
from wearsim.chain.service_conditions import LUBRICATIONS, SHOCKS
from wearsim.input.keys import schema_fields
from wearsim.mechanisms.gear_pair.keys import GearTables
from wearsim.page.field_words import choice_words, label
from wearsim.page.fields import form_fields, owner, table_meaning, table_title
from wearsim.quantities import input_quantities

LUBRICATION = {"lubrication": {"phase": [{}], "option": [{}]}}
DRIVE = {
    "sprocket": [{"name": "chainring", "teeth": 50}, {"cog": [{"teeth": 11}, {"teeth": 13}]}, {"teeth": 12}]
}


@pytest.mark.parametrize(
    ("data", "model"),
    [
        ({"duty": [{}], **LUBRICATION}, CaseTables),
        ({"gear": {}, **LUBRICATION}, GearTables),
        ({"duty": [{}], **LUBRICATION, "sprocket": [{"cog": [{}]}]}, DriveTables),
    ],
)
def test_every_key_has_one_field_with_unit_and_meaning(data, model):
    fields = [field for table in form_fields(data).values() for field in table]
    keys = [key.replace("[]", ".1") for key, _ in schema_fields(model)]
    keys.remove("wear.constants")  # of a law that only a program has
    assert sorted(field.key for field in fields) == sorted(keys)
    for field in fields:
        assert field.unit == input_quantities()[field.name].unit
        assert field.meaning == input_quantities()[field.name].meaning != ""


@pytest.mark.parametrize("data", [{}, {"gear": {}}, {"duty": [{}, {}]}, DRIVE])
def test_every_table_has_a_meaning(data):
    for name in form_fields(data):
        assert bool(table_meaning(data, name)) == bool(name)


def test_lists_of_tables_have_as_many_as_there_are():
    assert [name for name in form_fields({}) if "duty" in name] == ["duty[]"]
    assert form_fields({})["duty[]"] == []
    tables = form_fields({"duty": [{}, {}]})
    assert tables["duty.2"][0].key == "duty.2.share_of_time"
    assert "duty.1" not in form_fields({"duty": 3})


def test_every_sprocket_of_a_drive_is_a_group_of_its_own():
    tables = form_fields(DRIVE)
    of = [name for name in tables if name.startswith("sprocket.2")]
    assert of[0] == "sprocket.2" and set(of[1:]) == {
        "sprocket.2.take_up",
        "sprocket.2.cog.1",
        "sprocket.2.cog.2",
        "sprocket.2.cog[]",
        "sprocket.2.wear",
        "sprocket.2.material",
    }
    assert {owner(name) for name in of[1:]} == {"sprocket.2"} and owner("sprocket.2") == ""
    titles = [table_title(DRIVE, f"sprocket.{number}") for number in (1, 2, 3)]
    assert titles == ["Sprocket 1: chainring", "Sprocket 2", "Sprocket 3: 12 teeth"]
    assert table_title(DRIVE, "sprocket.2.cog.2") == "Cog 2: 13 teeth"
    names = [field.name for field in tables["sprocket.1"]]
    assert names[:3] == ["name", "role", "position_mm"] and {"teeth", "profile", "power_share"} <= {*names}
    fields = {field.key: field for field in tables["sprocket.1"]}
    assert fields["sprocket.1.role"].choices == ("driver", "driven", "idler")
    assert not fields["sprocket.1.teeth"].required
    assert "hardened, dry" in tables["sprocket.1.wear"][1].proposals


@pytest.mark.parametrize("odd", [{"sprocket": [3]}, {"sprocket": [{"cog": 3}]}, {"sprocket": []}])
def test_fields_of_odd_sprockets(odd):
    assert form_fields(odd)["sprocket[]"] == []
    for name in form_fields(odd):
        table_title(odd, name)


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
    assert "oil bath" in fields["lubrication.lubricant"].proposals
    assert "dust" in fields["lubrication.environment"].proposals
    assert fields["sprocket.teeth"].required and not fields["sprocket.nodes"].required
    assert fields["run.horizon_hours"].default == "1e+06"
    assert fields["wear.law"].default == "archard"
    assert fields["maintenance.turn_sprocket"].default == "false"


@pytest.mark.parametrize("data", [{}, {"gear": {}}, {"duty": [{}, {}]}, DRIVE])
def test_every_field_has_a_label_of_its_own_in_plain_words(data):
    for fields in form_fields(data).values():
        labels = [label(field.name) for field in fields]
        assert len({*labels}) == len(labels), labels
        for words in labels:
            assert words[0].isupper() and "_" not in words.replace("K_e", "")


def test_tables_have_plain_titles():
    titles = {name: table_title({}, name) for name in form_fields({})}
    assert titles["optimise.limits.peak_pressure_MPa"] == "Optimisation limit: peak pressure (MPa)"
    assert titles["mechanism"] == "Contact model" and titles["duty[]"] == "Load block: add one"
    assert not [title for title in titles.values() if "_" in title or ", " in title]


def test_conditions_of_wear_and_of_use_have_words():
    """Whoever adds a row to a catalogue says what it means."""
    for name, choices in (("condition", wear_conditions()), ("lubrication", LUBRICATIONS), ("shock", SHOCKS)):
        for choice in choices:
            assert choice_words(name, choice).startswith(f"{choice}: ")
