"""A command that holds others, and whose help shows an example of each."""

from collections.abc import Mapping
from typing import Any

import click


class ExampleGroup(click.Group):
    """A command whose help shows all others in their groups."""

    def __init__(
        self, *arguments: Any, groups: Mapping[str, Mapping[click.Command, str]], **others: Any
    ) -> None:
        super().__init__(*arguments, **others)
        self.groups = groups
        for commands in groups.values():
            for command, example in commands.items():
                command.epilog = f"\b\nExample:\n  {example}"
                self.add_command(command)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write what each command does, and beneath it the example, whose line is never broken."""
        for group, commands in self.groups.items():
            width = max(len(command.name or "") for command in commands)
            longest = max(map(len, commands.values()))
            with formatter.section(group):
                lead = max(0, min(formatter.current_indent + width + 2, formatter.width - longest))
                for command, example in commands.items():
                    formatter.write_dl([((command.name or "").ljust(width), command.short_help or "")])
                    formatter.write(f"{'':{lead}}{example}\n")
