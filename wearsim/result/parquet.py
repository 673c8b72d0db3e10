"""Tables of a result as Parquet files: the same numbers in a fraction of the space."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from wearsim.extras import library
from wearsim.quantities import quantities


def pyarrow() -> Any:
    """Return the library that writes Parquet."""
    return library("pyarrow", "parquet", "--parquet")


def write_parquet(path: Path, columns: Mapping[str, Any]) -> None:
    """Write a table; the unit of each column stands in the metadata of its field."""
    arrow = pyarrow()
    from pyarrow import parquet

    arrays = [arrow.array(values) for values in columns.values()]
    fields = [
        arrow.field(name, array.type, metadata={"unit": _unit(name)})
        for name, array in zip(columns, arrays, strict=True)
    ]
    table = arrow.Table.from_arrays(arrays, schema=arrow.schema(fields))
    parquet.write_table(table, path, compression="zstd")


def _unit(name: str) -> str:
    return quantities()[name].unit
