"""The directive ``{thumbnails}``: a card for every page of the gallery, with its first picture."""

import re
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx


class Thumbnails(nodes.General, nodes.Element):
    """Where the cards go; they are made once every page has been read."""


class ThumbnailsDirective(Directive):
    """Cards of all pages in the table of contents of this one."""

    def run(self) -> list[nodes.Node]:
        """Return the place of the cards."""
        return [Thumbnails()]


_SIDES = re.compile(r'viewBox="\S+ \S+ (\S+) (\S+)"')


def _is_tall(picture: Path) -> bool:
    """Whether a drawing is higher than a card."""
    width, height = map(float, _SIDES.search(picture.read_text("utf-8")).groups())
    return height > 0.75 * width


def _card(app: Sphinx, page: str, seen_from: str) -> nodes.paragraph:
    picture = next(app.env.get_doctree(page).findall(nodes.image)).deepcopy()
    picture["alt"] = ""  # the title beside it says what it is
    if _is_tall(Path(app.srcdir, picture["uri"])):
        picture["classes"].append("tall")
    link = nodes.reference(
        "", "", picture, internal=True, refuri=app.builder.get_relative_uri(seen_from, page)
    )
    link += nodes.inline(text=app.env.titles[page].astext())
    return nodes.paragraph("", "", link)


def _fill(app: Sphinx, document: nodes.document, name: str) -> None:
    """Put the cards in their place."""
    for place in list(document.findall(Thumbnails)):
        cards = [_card(app, page, name) for page in app.env.toctree_includes[name]]
        place.replace_self(nodes.container("", *cards, classes=["thumbnails"]))


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the directive."""
    app.add_node(Thumbnails)
    app.add_directive("thumbnails", ThumbnailsDirective)
    app.connect("doctree-resolved", _fill)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
