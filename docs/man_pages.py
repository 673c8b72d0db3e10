"""Write man pages: ``python docs/man_pages.py DIR``; the wheel holds those of docs/man."""

import sys
from inspect import cleandoc
from pathlib import Path

from click_man.core import write_man_pages

import wearsim
from wearsim.cli.command_groups import COMMAND_GROUPS
from wearsim.cli.handbook import HANDBOOK
from wearsim.cli.main import wearsim_command


def grouped(page: str) -> str:
    """Return the page of all commands with a heading above each group."""
    for group, commands in COMMAND_GROUPS.items():
        first = next(iter(commands)).name
        page = page.replace(f".PP\n\\fB{first}\\fP\n", f".SS {group}\n.PP\n\\fB{first}\\fP\n")
    return page


if __name__ == "__main__":
    folder = sys.argv[1]
    for commands in (*COMMAND_GROUPS.values(), HANDBOOK):
        for command, example in commands.items():
            command.help = f"{cleandoc(command.help)}\n\nExample:\n  {example}"
    write_man_pages("wearsim", wearsim_command, version=wearsim.__version__, target_dir=folder, date="")
    index = Path(folder, "wearsim.1")
    index.write_text(grouped(index.read_text()))
