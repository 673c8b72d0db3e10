"""A picture shows once in a notebook, whether or not its line ends in a semicolon."""

import re
import subprocess
import sys

import pytest

CELLS = """
import sys
from IPython.core.displayhook import DisplayHook
from IPython.core.displaypub import CapturingDisplayPublisher
from IPython.core.interactiveshell import InteractiveShell
from matplotlib.figure import Figure

class Hook(DisplayHook):
    def write_format_data(self, format_dict, md_dict=None):
        shown.append(format_dict)

shown = []
InteractiveShell.displayhook_class = Hook
InteractiveShell.display_pub_class = CapturingDisplayPublisher
shell = InteractiveShell.instance()
shell.run_cell("from matplotlib.figure import Figure; from wearsim.report.result_pictures import shown")
for cell in sys.argv[1:]:
    shown.clear(), shell.display_pub.outputs.clear()
    found = shell.run_cell(cell)
    assert found.success
    pictures = [one for one in shown if "image/svg+xml" in one]
    pictures += [one for one in shell.display_pub.outputs if "image/svg+xml" in one["data"]]
    print("\\npictures", len(pictures))
"""


def test_a_picture_shows_once_with_and_without_a_semicolon():
    pytest.importorskip("IPython")
    cells = [
        "shown(Figure())",
        "shown(Figure());",
        "shown(Figure());  # drawn",
        "kept = shown(Figure())",
        "1 + 1;",
    ]
    done = subprocess.run([sys.executable, "-c", CELLS, *cells], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert re.findall(r"pictures (\d)", done.stdout) == ["1", "1", "1", "0", "0"]
