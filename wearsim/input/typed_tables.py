"""Complete inputs for programs: attributes in the place of keys, which an editor and a notebook complete."""

from collections.abc import Mapping
from typing import Any

from wearsim.input.keys import is_dict, tables_in
from wearsim.input.table import Table


class ReadTable:
    """Values of a table of a complete input by their keys; None where a key has none."""

    # No model of pydantic: IPython completes nothing below one, as those answer for names of their own.

    def __init__(self, values: Mapping[str, Any]) -> None:
        self.__dict__.update(values)

    def __repr__(self) -> str:
        shown = (f"{key}={value!r}" for key, value in vars(self).items() if value is not None)
        return f"{type(self).__name__}({', '.join(shown)})"

    def __dir__(self) -> list[str]:
        return list(vars(self))

    def __setattr__(self, key: str, value: Any) -> None:
        text = "must not be set: case.with_({'table.key': value}) returns a case with another value"
        raise AttributeError(f"{key}: {text}")


def typed_tables(model: type[Table], values: Mapping[str, Any]) -> ReadTable:
    """Return complete values as attributes with the names of all keys of a table, and of those within it.

    Examples
    --------
    >>> from wearsim.case.keys import CaseTables
    >>> typed_tables(CaseTables, {"load": {"power_kW": 3.0, "speed_rpm": 100.0}}).load
    ReadTable(power_kW=3.0, speed_rpm=100.0)
    """
    return ReadTable(
        {name: _typed(field.annotation, values.get(name)) for name, field in model.model_fields.items()}
    )


def _typed(annotation: Any, value: Any) -> Any:
    model = next(tables_in(annotation), None)
    if model is None or is_dict(annotation):
        return value
    if isinstance(value, list):
        return [_typed(annotation, entry) for entry in value]
    return typed_tables(model, value) if isinstance(value, Mapping) else value
