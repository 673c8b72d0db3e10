"""A drive to scale as a page holds it, in SVG."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from markupsafe import Markup

from wearsim.geometry.scene import Circle, Label, Scene, Stroke
from wearsim.report.text_lines import pages_kept

_FIGURE = Markup(
    '<figure class="panel">\n'
    '<svg class="sketch" viewBox="{:.2f} {:.2f} {:.2f} {:.2f}" role="{}" aria-label="{}">\n{}\n</svg>\n'
    '<figcaption><ul class="notes">{}</ul></figcaption>\n'
    "</figure>\n"
)

_LINK = Markup('<a href="#{}"><title>{}</title><circle class="link" cx="{:.2f}" cy="{:.2f}" r="{:.2f}"/></a>')


def sketch(scene: Scene | None, links: Sequence[tuple[str, Circle]] = ()) -> Markup:
    """Return a drawing with its notes, nothing of none; the looks of its lines follow from their classes.

    Links are circles of the drawing that lead to a place of the page.
    """
    if scene is None:
        return Markup()
    left, bottom, width, height = scene.box
    notes = Markup().join(Markup("<li>{}</li>").format(pages_kept(note)) for note in scene.notes)
    leading = (
        _LINK.format(place, circle.name, circle.centre[0], -circle.centre[1], circle.radius)
        for place, circle in links
    )
    drawn = Markup("\n").join([*_elements(scene), *leading])
    # What is inside of an image is no link to a screen reader.
    role = "group" if links else "img"
    return _FIGURE.format(left, -bottom - height, width, height, role, scene.alt, drawn, notes)


def _elements(scene: Scene) -> Iterator[Markup]:
    """Labels, and one path for lines of one role that follow one another."""
    for role, shapes in groupby(scene.shapes, lambda shape: shape.role):
        path = ""
        for shape in shapes:
            if isinstance(shape, Label):
                x, y = shape.place
                text = Markup('<text x="{:.2f}" y="{:.2f}" font-size="{:.2f}">{}</text>')
                yield text.format(x, -y, shape.height, shape.text)
            else:
                path += _path(shape)
        if path:
            yield Markup('<path class="{}" d="{}"/>').format(role, path)


def _path(shape: Stroke | Circle) -> str:
    """Path data, y downwards."""
    if isinstance(shape, Circle):
        (x, y), r = shape.centre, _short(shape.radius)
        half, width = f"a{r} {r} 0 1 0 ", _short(2.0 * shape.radius)
        return f"M{_short(x - shape.radius)} {_short(-y)}{half}{width} 0{half}-{width} 0"
    places = [f"{_short(x)} {_short(-y)}" for x, y in shape.vertices.tolist()]
    return f"M{'L'.join(places)}{'Z' if shape.closed else ''}"


def _short(value: float) -> str:
    """Two decimals, without a zero at the end or before the sign of nothing."""
    return f"{round(value, 2) + 0.0:.2f}".rstrip("0").rstrip(".")
