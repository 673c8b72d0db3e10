"""What stands at the foot of every printed page of a sheet."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date

from markupsafe import Markup

from wearsim.errors import CaseError, Fault
from wearsim.input.texts import line_fault

_FOOT = (
    "@page {{ @bottom-left {{ content: {text}; {look} }} "
    '@bottom-right {{ content: "page " counter(page) " of " counter(pages); white-space: nowrap; {look} }} }}'
)
_LOOK = "font: 7.5pt system-ui, sans-serif; color: #333333"


@dataclass(frozen=True)
class SheetHead:
    """Who made a sheet of what, and when."""

    on: date
    project: str = ""
    author: str = ""
    drawing: str = ""
    revision: str = ""
    checked_by: str = ""

    def __post_init__(self) -> None:
        """Raise for texts that do not fit into a row of a sheet."""
        faults = [
            Fault(wrong, "", f"--{label.replace(' ', '-')}")
            for label, text in self._named
            if (wrong := line_fault(text))
        ]
        if faults:
            raise CaseError(faults)

    @property
    def rows(self) -> list[tuple[str, str]]:
        """What is known of it, the date last."""
        return [*self._named, ("date", self.on.isoformat())]

    @property
    def says_something(self) -> bool:
        """Whether more is known than the date."""
        return bool(self._named)

    @property
    def _named(self) -> list[tuple[str, str]]:
        named: Mapping[str, str] = {
            "project": self.project,
            "drawing": self.drawing,
            "revision": self.revision,
            "author": self.author,
            "checked by": self.checked_by,
        }
        return [(label, text) for label, text in named.items() if text]


def foot(title: str, head: SheetHead | None) -> Markup:
    """Return the style of the foot of a page: title, drawing, revision and date, and the page of how many."""
    said = [title]
    if head is not None:
        said += [head.drawing, f"revision {head.revision}" if head.revision else "", head.on.isoformat()]
    return Markup(_FOOT.format(text=css_text(" | ".join(filter(None, said))), look=_LOOK))  # noqa: S704


def css_text(text: str) -> str:
    r"""Return a text as CSS takes it in quotes, every character that could end it by its number.

    Examples
    --------
    >>> print(css_text('no. 7 "x" <b>'))
    "no. 7 \22 x\22  \3c b\3e "
    """
    safe = "".join(one if one.isalnum() or one in " -.,:;|()+" else f"\\{ord(one):x} " for one in text)
    return f'"{safe}"'
