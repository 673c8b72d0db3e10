"""An input of another command is told by the name of that command."""

from pathlib import Path

import pytest

from wearsim.command.registry import CALCULATIONS, tables_of
from wearsim.drive.load_case import load_case
from wearsim.errors import CaseError
from wearsim.input.document import NEEDED, load_calculation

CASES = Path(__file__).parents[2] / "cases"
OTHERS = [*(CASES / "sizing").glob("*.toml"), *(CASES / "studies").glob("*.toml")]


def called(command):
    """The words that a command is run by."""
    return f"handbook {command}" if command in CALCULATIONS else command


@pytest.mark.parametrize("command", [*CALCULATIONS, "sweep"])
def test_what_a_file_must_hold_is_what_its_tables_need(command):
    fields = tables_of(command).model_fields
    assert NEEDED[called(command)] == {name for name in fields if fields[name].is_required()} - {
        "format_version"
    }


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.stem)
def test_file_of_another_command(path):
    command = next((name for name in CALCULATIONS if path.stem.startswith(name)), "sweep")
    for load in (load_case, lambda path: load_calculation(path, tables_of("gear"))):
        with pytest.raises(CaseError, match=f"but is one of wearsim {called(command)}: run that"):
            load(path)


def test_drive_of_another_command():
    with pytest.raises(CaseError, match="but is one of wearsim life: run that"):
        load_calculation(CASES / "08b-19t-wrap.toml", tables_of("strength"))
