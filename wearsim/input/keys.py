"""The keys that an input file may hold, by their dotted names."""

from collections.abc import Iterator, Mapping
from typing import Any, Literal, get_args, get_origin

from pydantic.fields import FieldInfo

from wearsim.input.mechanism_registry import mechanism_of
from wearsim.input.table import Table


def schema_of(tables: Mapping[str, Any]) -> type[Table]:
    """Return the schema that a case is read by.

    Examples
    --------
    >>> schema_of({"chain": {}}).__name__, schema_of({"gear": {}}).__name__
    ('CaseTables', 'GearTables')
    >>> schema_of({"sprocket": [{"teeth": 21}, {"teeth": 57}]}).__name__
    'DriveTables'
    """
    # Models of tables take time to build: only those of one mechanism are.
    found: type[Table] = mechanism_of(tables).load("tables")
    return found


def schema_fields(model: type[Table], prefix: str = "") -> Iterator[tuple[str, FieldInfo]]:
    """Give every key of a schema but those of tables by the dotted names of other keys.

    Examples
    --------
    >>> from wearsim.case.keys import CaseTables
    >>> keys = dict(schema_fields(CaseTables))
    >>> "run.horizon_hours" in keys, "duty[].speed_rpm" in keys
    (True, True)
    """
    for name, field in model.model_fields.items():
        tables = list(tables_in(field.annotation))
        if tables and is_dict(field.annotation):
            continue
        many = "[]" if any(get_origin(part) is list for part in parts(field.annotation)) else ""
        for table in tables:
            yield from schema_fields(table, f"{prefix}{name}{many}.")
        if not tables:
            yield f"{prefix}{name}", field


def words(field: FieldInfo) -> tuple[str, ...]:
    """Return the words that a key may hold.

    Examples
    --------
    >>> from wearsim.case.keys import CaseTables
    >>> words(dict(schema_fields(CaseTables))["mechanism.kind"])
    ('strand', 'prescribed', 'wrap')
    """
    found: list[str] = []
    for part in parts(field.annotation):
        if get_origin(part) is Literal:
            found += [word for word in get_args(part) if isinstance(word, str)]
        if part is bool:
            found += ["true", "false"]
    return tuple(found)


def whole_number_keys(model: type[Table]) -> set[str]:
    """Return the keys that take nothing but whole numbers, lists of tables by their plain names.

    Examples
    --------
    >>> from wearsim.case.keys import CaseTables
    >>> keys = whole_number_keys(CaseTables)
    >>> "sprocket.teeth" in keys, "load.power_kW" in keys
    (True, False)
    """
    types = {key.replace("[]", ""): set(parts(field.annotation)) for key, field in schema_fields(model)}
    return {key for key, found in types.items() if int in found and not {float, str} & found}


def parts(annotation: Any) -> Iterator[Any]:
    """Give a type and all types that it is made of."""
    yield annotation
    if get_origin(annotation) is not Literal:
        for inner in get_args(annotation):
            yield from parts(inner)


def is_dict(annotation: Any) -> bool:
    """Tell whether a key holds names of its own, each with a value or a table."""
    return any(get_origin(part) is dict for part in parts(annotation))


def tables_in(annotation: Any) -> Iterator[type[Table]]:
    """Give the tables that a type is made of."""
    for part in parts(annotation):
        if isinstance(part, type) and issubclass(part, Table):
            yield part
