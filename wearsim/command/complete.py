"""What the shell is offered when it completes a word of a command line."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from wearsim.catalogue.shipped_cases import place_of_case, place_of_readings, shipped_cases
from wearsim.files import given_text

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

    from wearsim.case.keys import Table

_OF_DRIVES = ("life", "check", "compare", "loads", "maintain", "profile", "remaining")


def _items(values: Iterator[str]) -> "list[CompletionItem[str]]":
    from click.shell_completion import CompletionItem

    return [CompletionItem(value) for value in values]


class _OfferedPath(click.Path):
    """A path of which only those of some kind are offered, else all."""

    def offered(self, path: Path) -> bool:
        """Tell whether a path is of the kind."""
        return path.suffix == ".toml" and not path.name.endswith(".lock.toml")

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> "list[CompletionItem[str]]":
        """Offer what lies in the folder that is being typed and one below, then the shipped cases."""
        paths = [path for path in _below(incomplete) if self.offered(Path(path))]
        shipped = [name for name in shipped_cases() if incomplete and name.startswith(incomplete)]
        return _items(iter([*paths, *shipped])) or super().shell_complete(ctx, param, incomplete)


class CasePath(_OfferedPath):
    """A case: ``.toml``, - for one on stdin, or the name of a shipped one."""


class RunPath(_OfferedPath):
    """A case, or the folder of a run."""

    def offered(self, path: Path) -> bool:
        """Tell whether a path is a case or the folder of a run."""
        return super().offered(path) or (path / "result.json").is_file()


class ReadingsPath(click.Path):
    """A table of readings: ``.csv``, or the name of a shipped one."""

    def __init__(self) -> None:
        super().__init__(exists=True, dir_okay=False, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the place of the table, which must be there."""
        return super().convert(str(place_of_readings(Path(value))), param, ctx)


def _below(incomplete: str) -> Iterator[str]:
    """Give the paths that begin as typed, and what lies in the folders among them."""
    lead, _, start = incomplete.rpartition("/")
    folder = Path(f"{lead}/") if "/" in incomplete else Path()
    for path in _listed(folder):
        if path.name.startswith(start) and (start or not path.name.startswith(".")):
            name = f"{lead}/{path.name}" if "/" in incomplete else path.name
            yield name
            yield from (f"{name}/{inner.name}" for inner in _listed(path))


def _listed(folder: Path) -> list[Path]:
    try:
        return sorted(folder.iterdir())
    except OSError:
        return []


def complete_chain(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> "list[CompletionItem[str]]":
    """Offer the chains of the catalogue."""
    return _items(name for name in _chains() if name.startswith(incomplete.upper()))


def _chains() -> list[str]:
    from wearsim.catalogue.catalogues import chains

    return [name for name in chains() if " " not in name]


def complete_kind(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> "list[CompletionItem[str]]":
    """Offer the kinds of input files beside that of a chain drive."""
    from wearsim.command.registry import OTHER_FILES

    return _items(name for name in OTHER_FILES if name.startswith(incomplete))


def complete_key(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> "list[CompletionItem[str]]":
    """Offer the dotted keys of the case on the line."""
    return _items(key for key in _keys(context) if key.startswith(incomplete))


def complete_setting(
    context: click.Context, parameter: click.Parameter, incomplete: str
) -> "list[CompletionItem[str]]":
    """Offer dotted keys with ``=``, and after it the words that the key may hold."""
    key, equals, typed = incomplete.partition("=")
    keys = _keys(context)
    if not equals:
        return _items(f"{name}=" for name in keys if name.startswith(key))
    values = keys[key]() if key in keys else []
    return _items(f"{key}={value}" for value in values if value.startswith(typed))


def _keys(context: click.Context) -> dict[str, Callable[[], list[str]]]:
    """Return every key of the kind of case on the line, with what gives its words."""
    from functools import partial

    from wearsim.input.keys import schema_fields, words

    found: dict[str, Callable[[], list[str]]] = {
        key: partial(_plain_words, words(field))
        for key, field in schema_fields(_model(context))
        if "[]" not in key
    }
    catalogues = {"chain.designation": _chains}
    catalogues |= {key: _materials for key in found if _names_material(key)}
    return found | {key: words for key, words in catalogues.items() if key in found}


def _names_material(key: str) -> bool:
    return key.startswith("material.") and key.endswith(".name")


def _plain_words(values: tuple[str, ...]) -> list[str]:
    return list(values)


def _materials() -> list[str]:
    from wearsim.catalogue.catalogues import materials

    return [name for name in materials() if " " not in name]


def _model(context: click.Context) -> "type[Table]":
    """Return the schema of the command or, of drives, of the case on the line."""
    if context.info_name not in _OF_DRIVES:
        # Models of tables take time to build, and a shell waits for them.
        from wearsim.command.registry import CALCULATIONS, tables_of

        if context.info_name in CALCULATIONS:
            return tables_of(context.info_name)
    from wearsim.input.keys import schema_of

    return schema_of({"gear": {}} if any(map(_is_gear, _cases(context))) else {})


def _cases(context: click.Context) -> list[Path]:
    """Places of the words of the line that are cases: half a line is not yet sorted into arguments."""
    case = context.params.get("case")
    words = [*context.args, *([str(case)] if case else [])]
    return [path for path in map(place_of_case, map(Path, words)) if path.suffix == ".toml"]


def _is_gear(path: Path) -> bool:
    import tomllib

    try:
        return "gear" in tomllib.loads(given_text(path))
    except (OSError, ValueError):
        return False
