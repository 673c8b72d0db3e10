"""What the input files of all calculations have in common."""

from typing import Annotated, Literal

from pydantic import BeforeValidator

from wearsim.input.schema.table import Table


def whole(value: object) -> object:
    """Return a version, or raise where it is no whole number."""
    if type(value) is not int:
        raise ValueError("must be 1")
    return value


FormatVersion = Annotated[Literal[1], BeforeValidator(whole)]


class CalculationTables(Table):
    """The tables of an input file that is about no drive."""

    format_version: FormatVersion
    title: str = ""
