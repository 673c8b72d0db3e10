"""Reading the input of a calculation that is no drive: its own tables, checked in one pass."""

from collections.abc import Sequence
from typing import TypeVar

from pydantic import ValidationError

from wearsim.input.document import CaseSource, Document, check_command, read_document
from wearsim.input.table import CalculationTables, Table

Tables = TypeVar("Tables", bound=CalculationTables)


def load_calculation(source: CaseSource, model: type[Tables], overrides: Sequence[str] = ()) -> Tables:
    """Return the tables of a calculation."""
    return calculation_tables(read_document(source, overrides), model)


def calculation_tables(document: Document, model: type[Tables]) -> Tables:
    """Return the tables of a calculation, or raise where the input is that of another command."""
    needed = {name for name, field in model.model_fields.items() if field.is_required()}
    if not needed - {"format_version"} <= document.data.keys():
        check_command(document.data, document.faults.file)
    document.data.setdefault("title", document.name)
    return checked(document, model)


def checked(document: Document, model: type[Tables]) -> Tables:
    """Return the tables of a document."""
    try:
        tables = model.model_validate(document.data)
    except ValidationError as error:
        document.faults.add_validation(error, model)
        document.faults.check()
        raise
    document.faults.check()
    return tables


def defaults_taken(tables: Table, prefix: str = "") -> tuple[str, ...]:
    """Return what a file left to its defaults, as an answer lists it under its assumptions."""
    taken: list[str] = []
    for key, value in tables:
        if isinstance(value, Table):
            taken += defaults_taken(value, f"{prefix}{key}.")
        elif prefix and key not in tables.model_fields_set and value is not None:
            shown = f"{value:g}" if isinstance(value, float) else value
            taken.append(f"{prefix}{key} = {shown} (default)")
    return tuple(taken)
