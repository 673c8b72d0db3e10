"""What commands do with an answer: print it in words or as JSON, and write it into a folder."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import click

from wearsim.command.options import error_json, explain_option, print_json, show, warn
from wearsim.errors import WearsimError

if TYPE_CHECKING:
    from wearsim.report.public_answer import Answer, DrawnAnswer

Function = TypeVar("Function", bound=Callable[..., Any])


class Shown(NamedTuple):
    """How an answer is shown."""

    out: Path | None  # folder that it is written into
    force: bool  # replace that folder
    as_json: bool
    explain: bool  # print every assumption

    def check(self, *inputs: Path) -> None:
        """Raise where the folder is there already, or holds what is read."""
        if self.out is None:
            return
        from wearsim.files import check_folder

        for path in inputs:
            if path.resolve().is_relative_to(self.out.resolve()):
                raise click.UsageError(
                    f"--out {self.out} must not be the folder of {path}: choose another place"
                )
        check_folder(self.out, self.force)

    @contextmanager
    def failing(self, name: str) -> Iterator[None]:
        """Print an error as JSON too, where that is asked for."""
        try:
            yield
        except WearsimError as error:
            if self.as_json:
                click.echo(error_json(name, error))
            raise

    def show(self, answer: "Answer", source: Path) -> None:
        """Print an answer."""
        if self.as_json:
            content = answer.summary()
            print_json(content, source, content["warnings"])
        else:
            show(answer.explained if self.explain else answer.text)

    def save(self, answer: "DrawnAnswer", source: Path) -> None:
        """Write an answer into its folder, and print it."""
        if self.out is not None:
            answer.save(self.out, self.force)
        self.show(answer, source)
        if self.out is not None:
            warn(f"written to {self.out}")


def shown_options(holds: str) -> Callable[[Function], Function]:
    """Add ``--out`` for what a folder holds, ``--force``, ``--json`` and ``--explain``, as ``shown``."""

    def added(function: Function) -> Function:
        @wraps(function)
        def command(
            *arguments: Any, out: Path | None, force: bool, as_json: bool, explain: bool, **others: Any
        ) -> Any:
            return function(*arguments, shown=Shown(out, force, as_json, explain), **others)

        for option in (
            explain_option,
            click.option("--json", "as_json", is_flag=True, help="Print one JSON object."),
            click.option("--force", is_flag=True, help="Replace an existing folder."),
            click.option("--out", type=click.Path(path_type=Path), help=f"New folder for {holds}."),
        ):
            command = option(command)
        return command  # type: ignore[return-value]

    return added
