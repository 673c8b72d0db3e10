"""Print the files whose docstrings are full: formulas, and what `wearsim.*` names."""

from pathlib import Path

import wearsim

FORMULAS = ("geometry", "contact", "chain", "fatigue")
PRINTED = ("command", "sheet", "figure", "keys", "text", "__init__")
"""Of a calculation, what is no formula."""

package = Path(wearsim.__file__).parent
files = {path for folder in FORMULAS for path in (package / folder).rglob("*.py")}
files |= {path for path in package.glob("handbook/*/*.py") if path.stem not in PRINTED}
files |= {package / "wear" / "law.py"}
for module in set(wearsim._PUBLIC.values()):
    path = package.joinpath(*module.split(".")[1:])
    files.add(path / "__init__.py" if path.is_dir() else path.with_suffix(".py"))
print(*sorted(map(str, files)), sep="\n")
