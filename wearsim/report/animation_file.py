"""Moving pictures as files: GIF, WebP and animated PNG."""

import io
from collections.abc import Iterable
from itertools import pairwise
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from wearsim._version import __version__

_HOLD_MS = 2000
"""How much longer than the others the last frame stays."""

_COLOURS = 128
"""Of all frames together: few enough to be small, enough for smooth edges."""

_NEARLY_WHITE = 247
"""Colours of more than this in red, green and blue are means of white paper: white."""

_XMP = (
    '<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF '
    'xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description rdf:about="" '
    'xmlns:dc="http://purl.org/dc/elements/1.1/" xmlns:xmp="http://ns.adobe.com/xap/1.0/">'
    "<xmp:CreatorTool>{tool}</xmp:CreatorTool><dc:description><rdf:Alt>"
    '<rdf:li xml:lang="x-default">{text}</rdf:li></rdf:Alt></dc:description>'
    "</rdf:Description></rdf:RDF></x:xmpmeta>"
)


def encoded(frames: Iterable[Image.Image], form: str, seconds: float, text: str) -> bytes:
    """Return frames as a file that repeats for ever."""
    first, *rest = _few_colours(list(frames))
    stream = io.BytesIO()
    first.save(
        stream,
        format=form,
        save_all=True,
        append_images=rest,
        duration=durations(len(rest) + 1, seconds),
        loop=0,
        **_own(form, text),
    )
    return stream.getvalue()


def durations(frames: int, seconds: float) -> list[int]:
    """Return how long each frame stays, in whole hundredths of a second as GIF has them.

    Examples
    --------
    >>> durations(3, 1.0)
    [330, 340, 2330]
    """
    ends = np.round(100.0 * seconds * np.arange(frames + 1) / frames).astype(int).tolist()
    stays = [10 * (end - start) for start, end in pairwise(ends)]
    return [*stays[:-1], stays[-1] + _HOLD_MS]


def _few_colours(frames: list[Image.Image]) -> list[Image.Image]:
    """Frames in white and in colours of the last one, which shows all that any frame does."""
    colours = frames[-1].quantize(_COLOURS, method=Image.Quantize.MEDIANCUT)
    palette = np.reshape(colours.getpalette() or [], (-1, 3))
    palette[palette.min(axis=1) > _NEARLY_WHITE] = 255
    colours.putpalette(palette.ravel().tolist())
    return [frame.quantize(palette=colours, dither=Image.Dither.NONE) for frame in frames]


def _own(form: str, text: str) -> dict[str, Any]:
    """What a format takes beside what all take: the text, and that no detail is lost."""
    tool = f"wearsim {__version__}"
    if form == "gif":
        return {"comment": f"{text} ({tool})".encode()}
    if form == "webp":
        xmp = _XMP.format(tool=escape(tool), text=escape(text))
        return {"xmp": xmp.encode(), "lossless": True, "method": 4}
    info = PngInfo()
    info.add_itxt("Description", text)
    info.add_itxt("Software", tool)
    return {"pnginfo": info}
