"""Links that lead nowhere, in built pages and in README.md: ``python .ci/links.py HTML_FOLDER``.

Only links within the project are followed: CI may have no network.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """Ids of a page and what it links to."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep ids, old names of anchors, and targets."""
        for name, value in attrs:
            if value and (name == "id" or (tag, name) == ("a", "name")):
                self.ids.add(value)
            elif value and name in ("href", "src"):
                self.links.append(value)


def broken(at: Path, link: str, pages: dict[Path, Page]) -> bool:
    """Whether a link on a page leads to no file, or to a page without that place."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return False
    target = (at.parent / unquote(parts.path)).resolve() if parts.path else at
    if target in pages and parts.fragment:
        return unquote(parts.fragment) not in pages[target].ids
    return not target.exists()


def of_readme(readme: Path, html: Path) -> list[tuple[str, str]]:
    """Links of README.md, and what they are on the site where they lead to a page of docs."""
    found = []
    for link in re.findall(r"\]\(([^)\s]+)\)", readme.read_text("utf-8")):
        page = re.fullmatch(r"docs/(.+)\.md(#.+)?", link)
        found.append((link, f"{html}/{page[1]}.html{page[2] or ''}" if page else link))
    return found


if __name__ == "__main__":
    html = Path(sys.argv[1]).resolve()
    # Frames of examples hold programs of their own.
    places = [path for path in html.rglob("*.html") if "_examples" not in path.parts]
    pages = {path: Page(path) for path in places}
    lost = [
        f"{at.relative_to(html)}: {link}"
        for at, page in pages.items()
        for link in page.links
        if broken(at, link, pages)
    ]
    readme = Path("README.md").resolve()
    lost += [
        f"README.md: {link}" for link, target in of_readme(readme, html) if broken(readme, target, pages)
    ]
    links = sum(len(page.links) for page in pages.values())
    print(f"{links} links of {len(pages)} pages, and those of README.md: {len(lost)} lead nowhere")
    sys.exit("\n".join(lost) or None)
