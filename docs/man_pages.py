"""Write man pages: ``python docs/man_pages.py DIR``; the wheel holds those of docs/man."""

import sys

from click_man.core import write_man_pages

import wearsim
from wearsim.cli.main import wearsim_command

if __name__ == "__main__":
    write_man_pages("wearsim", wearsim_command, version=wearsim.__version__, target_dir=sys.argv[1], date="")
