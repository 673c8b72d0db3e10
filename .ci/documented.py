"""Check by numpydoc the docstrings of what cites an equation and of the public names of wearsim.

All other functions have one good line, which ruff asks for; kernels are documented in their own form.
"""

import ast
import pkgutil
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

from numpydoc.hooks.validate_docstrings import parse_config, process_file

import wearsim
import wearsim.handbook

ROOT = Path(__file__).parents[1]
DEFINITIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)


def full(node: ast.AST, public: set[str], within: str, inherited: bool = False) -> Iterator[str]:
    """Yield the dotted names below a node whose docstrings must be full."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, DEFINITIONS):
            name, wanted = f"{within}.{child.name}", inherited or child.name in public
            if wanted or "Equation" in (ast.get_docstring(child) or ""):
                yield name
            yield from full(child, public, name, wanted)


def overloads(tree: ast.AST) -> set[int]:
    """Return the lines of signatures, whose one docstring stands at the function itself."""
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)]
    return {
        line
        for node in functions
        for mark in node.decorator_list
        if ast.unparse(mark) == "overload"
        for line in (mark.lineno, node.lineno)
    }


PUBLIC = [*wearsim._PUBLIC.items()]
"""Public names and where they stand: those of wearsim, and the functions of the calculations."""
for package in pkgutil.iter_modules(wearsim.handbook.__path__, "wearsim.handbook."):
    PUBLIC += [(name, package.name) for name in import_module(package.name).__all__ if name.islower()]

config, faults, count = parse_config(ROOT), [], 0
for path in sorted(set(ROOT.glob("wearsim/**/*.py")) - set(ROOT.glob("wearsim/kernels/*"))):
    module = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
    public = {name for name, place in PUBLIC if module.startswith(place)}
    tree = ast.parse(path.read_text("utf-8"))
    names, signatures = set(full(tree, public, path.stem)), overloads(tree)
    count += len(names)
    faults += [
        f"{place}: {name}: {check} {text}"
        for place, name, check, text in process_file(path, config)
        if name in names and int(place.rpartition(":")[2]) not in signatures
    ]
print(f"{count} full docstrings")
sys.exit("\n".join(faults) or 0)
