"""Examples that run when the pages are built: ``{run}``, ``{picture}`` and ``{live-page}``.

All blocks of a page run one after the other, in one folder that holds ``cases``; the first one that
fails ends the build. Answers and files are kept beside the doctrees as long as neither the page nor
wearsim changes.
"""

import contextlib
import hashlib
import html
import io
import json
import logging
import os
import re
import shlex
import shutil
import sys
from pathlib import Path
from typing import ClassVar
from unittest.mock import patch

from docutils import nodes
from docutils.parsers.rst import Directive, directives
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.errors import ExtensionError

import wearsim

_PACKAGE = Path(wearsim.__file__).parent


def _digest(page: Path, cases: Path) -> str:
    """Hash of a page, of the cases and of wearsim."""
    files = (path for root in (_PACKAGE, cases) for path in root.rglob("*.*"))
    found = hashlib.sha256(page.read_bytes())
    for path in sorted(path for path in files if path.suffix in (".py", ".csv", ".toml")):
        found.update(path.read_bytes())
    return found.hexdigest()[:16]


class _Folder:
    """Where the blocks of a page run, and what they have answered."""

    def __init__(self, env: BuildEnvironment) -> None:
        page = Path(env.doc2path(env.docname))
        cases = Path(env.srcdir).parent / "cases"
        self.path = Path(env.doctreedir) / "runs" / page.stem / _digest(page, cases)
        self._answers = self.path / "answers.json"
        self._known: list[str] = []
        self._next = 0
        if self._answers.exists():
            self._known = json.loads(self._answers.read_text("utf-8"))
        else:
            shutil.rmtree(self.path.parent, ignore_errors=True)
            shutil.copytree(cases, self.path / "cases")

    def answer(self, language: str, text: str) -> str:
        """What the next block of the page prints."""
        if self._next == len(self._known):
            self._answers.unlink(missing_ok=True)
            with contextlib.chdir(self.path):
                run = _python(text) if language == "python" else _commands(text)
            self._known.append(run)
            self._answers.write_text(json.dumps(self._known), "utf-8")
        self._next += 1
        return self._known[self._next - 1]


def _python(text: str) -> str:
    """What Python prints; its pictures are the same in every build."""
    import matplotlib as mpl  # takes a moment, and only the gallery draws

    mpl.use("Agg")
    printed = io.StringIO()
    same = (mpl.rc_context({"svg.hashsalt": "wearsim"}), patch.dict(os.environ, SOURCE_DATE_EPOCH="0"))
    try:
        with contextlib.redirect_stdout(printed), same[0], same[1]:
            exec(compile(text, "example", "exec"), {})  # noqa: S102
    except Exception as error:
        raise ExtensionError(f"an example fails:\n{text}", error) from error
    return printed.getvalue()


def _commands(text: str) -> str:
    """What commands print; that of one which ends with ``> FILE`` goes into the file."""
    answer = ""
    for line in text.splitlines():
        command, _, file = line.partition(" > ")
        said = _command(shlex.split(command, comments=True))
        if file:
            Path(file).write_text(said, "utf-8")
        else:
            answer += said
    return answer


def _command(words: list[str]) -> str:
    from wearsim.cli import main  # what the first example needs, other pages do not

    printed, told, before = io.StringIO(), io.StringIO(), sys.argv
    sys.argv = words
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(told):
            main()
    except SystemExit as ended:
        if ended.code:
            message = f"an example ends with {ended.code}: {' '.join(words)}\n{told.getvalue()}"
            raise ExtensionError(message) from ended
    finally:
        sys.argv = before
    return printed.getvalue()


def _folder(directive: Directive) -> _Folder:
    env: BuildEnvironment = directive.state.document.settings.env
    if "gallery" not in env.temp_data:
        env.temp_data["gallery"] = _Folder(env)
    folder: _Folder = env.temp_data["gallery"]
    return folder


def _rest(answer: str) -> nodes.raw:
    """The whole of an answer, folded."""
    whole = f"<details><summary>the whole answer</summary><pre>{html.escape(answer)}</pre></details>"
    return nodes.raw("", whole, format="html")


def _block(text: str, language: str) -> nodes.literal_block:
    """What is typed or printed, of a size at which 100 columns fit the page."""
    return nodes.literal_block(text, text, language=language, classes=["example"])


class Run(Directive):
    """Commands (``sh``) or Python, shown, run, and what they print: all or the first ``:shows:`` lines.

    What is printed as a table of Markdown becomes one.
    """

    required_arguments = 1
    option_spec: ClassVar = {"shows": directives.nonnegative_int}
    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return the block and its answer."""
        language, text = self.arguments[0], "\n".join(self.content)
        answer = _folder(self).answer(language, text)
        found: list[nodes.Node] = [_block(text, language)]
        lines = answer.splitlines()
        shown = "\n".join(lines[: self.options.get("shows", len(lines))])
        if shown.startswith("|"):
            table = nodes.container()
            whole = re.sub(r"(?<=\d) (?=\d|h\b|mm\b)", "\N{NO-BREAK SPACE}", shown)
            self.state.nested_parse(StringList(whole.splitlines()), self.content_offset, table)
            found.append(table)
        elif shown:
            found.append(_block(shown, "text"))
        if len(shown.splitlines()) < len(lines):
            found.append(_rest(answer))
        return found


class Picture(Directive):
    """A picture that a block before it has made; its content is said where it cannot be seen."""

    required_arguments = 1
    has_content = True

    def run(self) -> list[nodes.Node]:
        """Return the picture."""
        file = _folder(self).path / self.arguments[0]
        if not file.exists():
            raise ExtensionError(f"no example has made {self.arguments[0]}")
        env: BuildEnvironment = self.state.document.settings.env
        page = Path(env.doc2path(env.docname))
        uri = Path(os.path.relpath(file, page.parent)).as_posix()
        image = nodes.image(uri=uri, alt=" ".join(self.content), classes=["example"])
        return [nodes.container("", image, classes=["drawing"])]


class LivePage(Directive):
    """A page for a browser that a block before it has made, with its files, inside this one."""

    required_arguments = 1
    has_content = True

    def run(self) -> list[nodes.Node]:
        """Copy the page's folder and return a frame that shows it."""
        env: BuildEnvironment = self.state.document.settings.env
        made = (_folder(self).path / self.arguments[0]).parent
        shutil.copytree(made, Path(env.app.outdir) / "_examples" / made.name, dirs_exist_ok=True)
        up = "../" * env.docname.count("/")
        place = f"{up}_examples/{self.arguments[0]}"
        title = html.escape(" ".join(self.content), quote=True)
        frame = f'<iframe class="example" src="{place}" title="{title}" loading="lazy"></iframe>'
        link = f'<p><a href="{place}">Open the page</a></p>'
        return [nodes.raw("", frame + link, format="html")]


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directives."""
    logging.getLogger("ezdxf").setLevel(logging.WARNING)  # sphinx shows what it tells
    app.add_directive("run", Run)
    app.add_directive("picture", Picture)
    app.add_directive("live-page", LivePage)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
