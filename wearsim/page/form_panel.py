"""The form: a field for every key that the schema allows."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from nicegui import ui

from wearsim.errors import Fault
from wearsim.input.keys import schema_of
from wearsim.page.choice_lists import choice_list, fill_list
from wearsim.page.field_words import label
from wearsim.page.fields import Field, form_fields, owner, table_header, table_meaning, table_title, value_at

_LOOK = "outlined dense stack-label hide-bottom-space"


class FormPanel:
    """Fields by their tables, in the place where it is made."""

    def __init__(
        self,
        on_edit: Callable[[Field, str], None],
        on_complete: Callable[[], None],
        on_add: Callable[[str], None],
        on_remove: Callable[[str, int], None],
    ) -> None:
        self._on_edit, self._on_complete = on_edit, on_complete
        self._on_add, self._on_remove = on_add, on_remove
        self._values: Mapping[str, str] = {}
        self._fields: dict[str, Field] = {}
        self._inputs: dict[str, Any] = {}
        self._data: Mapping[str, Any] = {}
        self._tables: Mapping[str, Sequence[Field]] = {}
        self._groups: dict[str, list[Any]] = {}
        self._headed: dict[str, Any] = {}
        self._taken_inputs: Mapping[str, Any] = {}
        self._shape: object = None
        self._body = ui.column().classes("ws-form")
        self._broken = ui.label("This is not valid TOML yet; the form updates once it is.")
        self._broken.classes("ws-broken").set_visibility(False)

    def show(self, data: Mapping[str, Any] | None, values: Mapping[str, str], typing: str) -> None:
        """Show what an input file holds."""
        self._broken.set_visibility(data is None)
        self._body.set_visibility(data is not None)
        if data is None:
            return
        added = values.keys() - self._values.keys()
        self._values = values
        self._data, self._tables = data, form_fields(data)
        shape = (schema_of(data), tuple(self._tables))
        if shape != self._shape:
            self._shape = shape
            self._build()
            return
        for name, table in self._headed.items():
            table.text = table_title(data, name)
        for key in added & self._groups.keys():
            self._open(key)
        for key, element in self._inputs.items():
            if key != typing and (element.value or "") != values.get(key, ""):
                self._fill(element, self._fields[key], values.get(key, ""))

    def show_taken(self, inputs: Mapping[str, Any]) -> None:
        """Show in empty fields what a case takes there."""
        self._taken_inputs = inputs
        for key, element in self._inputs.items():
            taken = _taken(inputs, key) or self._fields[key].default
            if element.props.get("placeholder", "") != taken:
                element.props.set_optional("placeholder", taken or None)

    def show_faults(self, faults: Sequence[Fault]) -> None:
        """Show each fault beside its field."""
        texts: dict[str, str] = {}
        for fault in faults:
            key = self._nearest(fault.key)
            if key:
                texts.setdefault(key, str(fault))
        for key in texts:
            self._open(key)
        for key, element in self._inputs.items():
            if element.error != texts.get(key):
                element.error = texts.get(key)

    def _nearest(self, key: str) -> str:
        """Return the key of a field, of a table the first field; empty where the form has none."""
        while key and key not in self._fields:
            inner = next((one for one in self._fields if one.startswith(f"{key}.")), "")
            key = inner or key.rpartition(".")[0]
        return key

    def _open(self, key: str) -> None:
        """Open what a field is in: its table first, then the group of keys that are not in use."""
        groups = [group for group in self._groups.get(key, ()) if not group.value]
        for group in groups:
            group.open()
        if groups and key not in self._inputs:
            self._open(key)

    def _build(self) -> None:
        self._inputs, self._groups, self._headed = {}, {}, {}
        self._fields = {field.key: field for fields in self._tables.values() for field in fields}
        self._body.clear()
        with self._body:
            for name, fields in self._tables.items():
                if not name:
                    self._add_fields([field for field in fields if field.name != "format_version"])
                elif not owner(name):
                    self._add_group(name)
            self._add_fields([self._fields["format_version"]])

    def _add_group(self, name: str) -> None:
        """Add a table with all that stand in it."""
        inner = [one for one in self._tables if owner(one) == name]
        fields = [field for one in (name, *inner) for field in self._tables[one]]
        caption = f"{table_header(name)} {table_meaning(self._data, name)}"
        table = ui.expansion(table_title(self._data, name), caption=caption)
        table.value = self._is_open(name)
        self._headed[name] = table.classes("ws-table")

        def _fill() -> None:
            self._add_table(self._tables[name])
            for one in inner:
                self._add_group(one)
            self._add_buttons(name)

        self._fill_when_open(table, fields, _fill)

    def _is_open(self, name: str) -> bool:
        """Whether a table is seen at first: one that is used; of a list in a table, one that is not done."""
        given = [field.key in self._values for field in self._tables[name] if field.required]
        one_of_list = name.rpartition(".")[2].isdigit()
        if one_of_list and owner(name):
            return not all(given)
        return one_of_list or any(field.key in self._values for field in self._tables[name])

    def _fill_when_open(self, group: Any, fields: Sequence[Field], fill: Callable[[], None]) -> None:
        """Make the fields of a group when they are first seen: most never are, and all cost time."""
        for field in fields:
            self._groups.setdefault(field.key, []).append(group)
        filled: list[bool] = []

        def _fill() -> None:
            if group.value and not filled:
                filled.append(True)
                with group:
                    fill()

        group.on_value_change(_fill)
        _fill()

    def _add_table(self, fields: Sequence[Field]) -> None:
        """Show what a table holds or must hold; the rest on demand, where there is both."""
        first = [field for field in fields if field.required or field.key in self._values]
        more = [field for field in fields if field not in first]
        if not first or not more:
            self._add_fields(fields)
        else:
            self._add_fields(first)
            names = ", ".join(label(field.name) for field in more)
            rest = ui.expansion(f"{len(more)} more", caption=names).classes("ws-more")
            self._fill_when_open(rest, more, partial(self._add_fields, more))

    def _add_fields(self, fields: Sequence[Field]) -> None:
        with ui.element("div").classes("ws-fields"):
            for field in fields:
                self._inputs[field.key] = self._input(field)

    def _add_buttons(self, name: str) -> None:
        if name.endswith("[]"):
            text = f"Add a table {table_header(name)}"
            ui.button(text, icon="add", on_click=lambda: self._on_add(name[:-2])).props("flat")
        head, _, number = name.rpartition(".")
        if number.isdigit():
            ui.button(
                "Remove this table", icon="delete", on_click=lambda: self._on_remove(head, int(number))
            ).props("flat")

    def _input(self, field: Field) -> Any:
        value = self._values.get(field.key, "")
        words = label(field.name)
        shown = f"{words} *" if field.required else words
        element: Any
        if _choices(field):
            element = choice_list(field.name, _choices(field), value, shown)
        else:
            element = ui.input(shown, value=value).props("autocomplete=off spellcheck=false")
            element.props.set_optional("suffix", field.unit or None)
            element.on("keydown.enter", self._on_complete)
            element.on("blur", self._on_complete)
        element.classes("ws-field").props(_LOOK)
        element.props["hint"] = f"{field.name}: {field.meaning}"
        element.props["data-key"] = field.key
        element.props["aria-label"] = " ".join(filter(None, (f"{words}, {field.key}", field.unit)))
        taken = _taken(self._taken_inputs, field.key) or field.default
        element.props.set_optional("placeholder", taken or None)
        element.on_value_change(lambda event: self._edited(field, event.value))
        return element

    def _edited(self, field: Field, value: str | None) -> None:
        if (value or "") == self._values.get(field.key, ""):
            return
        self._on_edit(field, value or "")
        if _choices(field):
            self._on_complete()

    def _fill(self, element: Any, field: Field, value: str) -> None:
        if _choices(field):
            fill_list(element, field.name, _choices(field), value)
        else:
            element.value = value


def _choices(field: Field) -> tuple[str, ...]:
    return field.choices or field.proposals


def _taken(inputs: Mapping[str, Any], key: str) -> str:
    value = value_at(inputs, key)
    if value is None or value == "":
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.6g}" if isinstance(value, float) else str(value)
