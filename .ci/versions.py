"""Lowest versions of pyproject.toml as pip constraints, or what an environment holds, as a table."""

import platform
import re
import sys
import tomllib
from importlib.metadata import version
from pathlib import Path

project = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))["project"]
bounds = [re.split(r">=", text, maxsplit=1) for text in project["dependencies"]]
if sys.argv[1] == "--lowest":
    for name, lowest in bounds:
        print(f"{name}=={lowest}")
    sys.exit()
outcome = Path(sys.argv[1]).read_text(encoding="utf-8").strip().splitlines()[-1].strip("= ")
print("| | |\n|---|---|")
print(f"| result | {outcome} |")
print(f"| Python | {platform.python_version()} |")
for name, _ in bounds:
    print(f"| {name} | {version(name)} |")
