"""Figures of the house, printed and not judged: what a change adds to lines, files and names.

``python .ci/house.py`` prints them all, ``python .ci/house.py life 16b-20t-oiled`` the files that a command
enters: those of wearsim in which a function runs while no module of wearsim is being imported. Kernels are
compiled before; what runs as machine code enters no file.
"""

import ast
import contextlib
import io
import os
import subprocess
import sys
import tempfile
import threading
from collections import Counter
from pathlib import Path
from types import FrameType

os.environ["WEARSIM_RUNS"] = ""  # a run that is kept enters fewer files

import wearsim
from wearsim.cli import main as run_command

ROOT = Path(wearsim.__file__).parent
MODULES = {
    ".".join(("wearsim", *path.relative_to(ROOT).with_suffix("").parts)).removesuffix(".__init__"): path
    for path in sorted(ROOT.rglob("*.py"))
}
FEATURE = ("__init__", "keys", "read", "law", "model", "answer", "command", "figure", "sheet")
MECHANISM = ("keys", "build", "drive", "contact", "scene")
"""Names of files that every feature folder, and every mechanism, may have; those of cli/ are commands."""

COARSE = "--set run.life_tolerance=0.1 --set mechanism.phases=1"
WALKS = {
    "strand life": "life 16b-20t-oiled",
    "wrap life": f"life a80-20t-oilbath {COARSE} --set sprocket.nodes=41",
    "whole drive": f"life packaging-conveyor {COARSE} --set sprocket.1.nodes=41 --set sprocket.2.nodes=41",
    "report": "report 16b-20t-oiled --out {folder}/page",
    "uncertainty": "uncertainty 16b-20t-oiled --samples 64",
    "lubricate": f"lubricate bicycle-17t-lubricants {COARSE} --set sprocket.nodes=41",
    "strength": "handbook strength strength-a-tempered",
}
LONGEST, FUNCTION, PARAMETERS, FILE = 10, 40, 6, 300
"""How many of the longest files are named, and what functions and files are counted past."""


def entered(words: list[str]) -> list[str]:
    """Run a command of wearsim in this process and name the files that it enters."""
    within, files = f"{ROOT}{os.sep}", set()

    def note(frame: FrameType, event: str, _: object) -> None:
        file = frame.f_code.co_filename
        if event != "call" or file in files or not file.startswith(within):
            return
        outer: FrameType | None = frame
        while outer:
            if outer.f_code.co_name == "<module>" and outer.f_code.co_filename.startswith(within):
                return
            outer = outer.f_back
        files.add(file)

    sys.argv = ["wearsim", *words]
    threading.setprofile(note)
    sys.setprofile(note)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            run_command()
    except SystemExit as end:
        if end.code:
            raise
    finally:
        sys.setprofile(None)
    return sorted(file.removeprefix(within) for file in files)


def has_fixed_name(path: Path) -> bool:
    """Whether a file has one of the names that stand for a role, or for a command."""
    role = path.parts[0] == "cli" or (path.parts[0] == "mechanisms" and path.stem in MECHANISM)
    return role or path.stem in FEATURE


def imports_of(source: str, for_types: bool = False) -> set[str]:
    """Modules of wearsim that a text imports, wherever in it, or for types only besides."""
    tree, imported = ast.parse(source), set()
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING" and not for_types:
            node.body = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            imported |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports are not followed"
            below = {f"{node.module}.{alias.name}" for alias in node.names}
            modules = below & MODULES.keys()
            imported |= modules if modules == below else {*modules, str(node.module)}
    return imported & MODULES.keys()


def circles(graph: dict[str, set[str]]) -> list[tuple[str, ...]]:
    """Modules that need each other, straight or through others: the strongly connected components."""
    needed: dict[str, set[str]] = {}
    for module, front in graph.items():
        needed[module] = set()
        while front := front - needed[module]:
            needed[module] |= front
            front = set().union(*(graph[other] for other in front))
    return sorted({tuple(sorted(b for b in needed[a] if a in needed[b])) for a in graph if a in needed[a]})


def walk(words: str) -> int:
    """Count the files that a command enters in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, __file__, *words.format(folder=folder).split(), "-q"]
        return len(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout.splitlines())


def length(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines of a function from its def on, without its docstring."""
    first = function.body[1 if ast.get_docstring(function) and function.body[1:] else 0]
    return int(function.end_lineno or 0) - first.lineno + 1 + function.body[0].lineno - function.lineno


def parameters(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Number of parameters, self and cls apart."""
    names = [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]
    return sum(name.arg not in ("self", "cls") for name in names)


def main() -> None:
    """Print all figures."""
    texts = {name: path.read_text("utf-8") for name, path in MODULES.items()}
    lines = Counter({name: len(text.splitlines()) for name, text in texts.items()})
    files_of: Counter[str] = Counter()
    lines_of: Counter[str] = Counter()
    for name, path in MODULES.items():
        package = path.relative_to(ROOT).parts[0]
        package = "(modules)" if package.endswith(".py") else package
        files_of[package] += 1
        lines_of[package] += lines[name]
    print("package       files   lines")
    for package, count in [*lines_of.most_common(), ("all", lines.total())]:
        print(f"{package:12} {files_of[package] or len(lines):6} {count:7}")

    subprocess.run([sys.executable, "-m", "wearsim", "warm", "-q"], check=True, stdout=subprocess.PIPE)
    print("\nwalk          files entered")
    for name, words in WALKS.items():
        print(f"{name:12} {walk(words):6}  {words.split(' --')[0]}", flush=True)

    names = Counter(path.stem for path in MODULES.values() if not has_fixed_name(path.relative_to(ROOT)))
    recurring = [f"{name} {count}" for name, count in names.most_common() if count > 1]
    print(f"\nrecurring file names: {len(recurring)} ({', '.join(recurring)})")
    run, typed = (
        len(circles({name: imports_of(text, for_types) - {name} for name, text in texts.items()}))
        for for_types in (False, True)
    )
    print(f"import circles: {run}; with imports for types only, {typed}")
    nodes = [node for text in texts.values() for node in ast.walk(ast.parse(text))]
    functions = [node for node in nodes if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    long, wide = (
        sum(size(function) > most for function in functions)
        for size, most in ((length, FUNCTION), (parameters, PARAMETERS))
    )
    print(
        f"of {len(functions)} functions over {FUNCTION} lines: {long}, over {PARAMETERS} parameters: {wide}"
    )
    past = sum(count > FILE for count in lines.values())
    print(f"of {len(lines)} files over {FILE} lines: {past}, the longest:")
    for name, count in lines.most_common(LONGEST):
        print(f"{count:7}  {MODULES[name].relative_to(ROOT)}")


if __name__ == "__main__":
    print(*entered(sys.argv[1:]), sep="\n") if sys.argv[1:] else main()
