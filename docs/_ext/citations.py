"""Numbered equations of the pages, and the docstrings that cite them as ``page.md (number)``."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_TAG = re.compile(r"\\tag\{(.*?)\}")
_CELL = re.compile(r"\$ \((\d+)\) \|")
CITATION = re.compile(r"\b([\w-]+)\.md((?:(?:,? | and | to | or | times |, with |, for m = 1 )\(\w+\))+)")
_PART = re.compile(r"(to )?\((\w+)\)")


class Equation(NamedTuple):
    """An equation of a page of docs/: its file without .md, and its number."""

    page: str
    number: str


def numbers(text: str) -> list[str]:
    """Numbers of the equations of a page, in their order; a cell of a table may hold one, too."""
    found = [*_TAG.finditer(text), *_CELL.finditer(text)]
    found.sort(key=lambda match: match.start())
    return [number for match in found for number in match[1].split(", ")]


def equations(docs: Path) -> list[Equation]:
    """All numbered equations of the pages of a folder."""
    pages = sorted(docs.glob("*.md"))
    return [Equation(page.stem, number) for page in pages for number in numbers(page.read_text("utf-8"))]


def cited(text: str) -> list[Equation]:
    """Equations that a text cites, those between the ends of a range included."""
    found: list[Equation] = []
    for match in CITATION.finditer(" ".join(text.split())):
        for part in _PART.finditer(match[2]):
            if part[1]:
                letter, first = re.fullmatch(r"(\D*)(\d+)", found[-1].number).groups()
                last = int(part[2].removeprefix(letter))
                found += [Equation(match[1], f"{letter}{n}") for n in range(int(first) + 1, last)]
            found.append(Equation(match[1], part[2]))
    return found


def _documented(node: ast.AST, name: str) -> Iterator[tuple[str, str]]:
    """Dotted name and docstring of a module or class and of all that it holds."""
    if text := ast.get_docstring(node):
        yield name, text
    for inner in getattr(node, "body", ()):
        if isinstance(inner, ast.ClassDef | ast.FunctionDef):
            yield from _documented(inner, f"{name}.{inner.name}")


def citations(package: Path) -> dict[Equation, list[str]]:
    """Names of what cites each equation in its docstring, in all modules of a package."""
    found: dict[Equation, list[str]] = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package.parent).with_suffix("").parts
        module = ".".join(part for part in parts if part != "__init__")
        for name, text in _documented(ast.parse(path.read_text("utf-8")), module):
            for equation in cited(text):
                if name not in found.setdefault(equation, []):
                    found[equation].append(name)
    return found
