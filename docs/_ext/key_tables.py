"""Directive ``{key-tables} KIND``: every key of an input file, from its schema and the quantities."""

from typing import Any

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx

from wearsim.case.keys import CaseTables
from wearsim.command.registry import tables_of
from wearsim.quantities import input_quantities

_HEAD = ("key", "meaning", "unit", "default", "allowed")
_BOUNDS = {"exclusiveMinimum": "> {}", "minimum": "from {}", "exclusiveMaximum": "< {}", "maximum": "to {}"}


def _allowed(entry: dict[str, Any]) -> str:
    """Kind and range of a value as words."""
    if "enum" in entry:
        return ", ".join(map(str, entry["enum"]))
    if "const" in entry:
        return str(entry["const"])
    choices = [choice for choice in entry.get("anyOf", ()) if choice.get("type") != "string"]
    entry = {**entry, **(choices[0] if choices else {})}
    words = [text.format(entry[key]) for key, text in _BOUNDS.items() if key in entry]
    kinds = {"integer": "whole number", "string": "text", "array": "list", "boolean": "true, false"}
    kind = kinds.get(entry.get("type", ""), "" if words else "number")
    return " ".join(part for part in (kind, *words) if part)


def _rows(schema: dict[str, Any], place: str, table: dict[str, Any]) -> list[tuple[str, ...]]:
    """Rows of a table and of those in it; ``place`` is its dotted name and a dot."""
    rows = []
    for name, entry in table.get("properties", {}).items():
        inner = _inner(schema, entry)
        if inner is not None:
            rows += _rows(schema, f"{place}{name}.", inner)
            continue
        known = input_quantities().get(name)
        required = "required" if name in table.get("required", ()) else ""
        default = str(entry.get("default", required))
        meaning = entry.get("description", "")
        rows.append((f"{place}{name}", meaning, known.unit if known else "", default, _allowed(entry)))
    return rows


def _inner(schema: dict[str, Any], entry: dict[str, Any]) -> dict[str, Any] | None:
    """The table that an entry stands for, alone or in a list; None where it holds a value."""
    for found in (entry, entry.get("items", {}), *entry.get("anyOf", ()), *entry.get("allOf", ())):
        if "$ref" in found:
            inner: dict[str, Any] = schema["$defs"][found["$ref"].rpartition("/")[2]]
            return inner if "properties" in inner else None
    return None


def _table(rows: list[tuple[str, ...]]) -> nodes.table:
    group = nodes.tgroup(cols=len(_HEAD))
    group += [nodes.colspec(colwidth=width) for width in (3, 5, 1, 1, 2)]
    head, body = nodes.thead(), nodes.tbody()
    for part, lines in ((head, [_HEAD]), (body, rows)):
        for line in lines:
            row = nodes.row()
            for column, text in enumerate(line):
                paragraph = nodes.paragraph()
                paragraph += nodes.literal(text=text) if part is body and not column else nodes.Text(text)
                row += nodes.entry("", paragraph)
            part += row
    group += [head, body]
    return nodes.table("", group)


class KeyTables(Directive):
    """The table of all keys of a kind of file: ``drive``, or a name of OTHER_FILES."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        kind = self.arguments[0]
        model = CaseTables if kind == "drive" else tables_of(kind)
        schema = model.model_json_schema()
        return [_table(_rows(schema, "", schema))]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_directive("key-tables", KeyTables)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
