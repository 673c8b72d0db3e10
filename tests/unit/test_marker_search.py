"""Dots in a photograph that are no marker sheet."""

import numpy as np
from PIL import Image, ImageDraw

from wearsim.scanning.marker_search import find_markers
from wearsim.scanning.photograph import Photograph


def test_a_perforated_plate_larger_than_any_sheet():
    picture = Image.new("L", (1600, 1600), 230)
    draw = ImageDraw.Draw(picture)
    for x, y in np.ndindex(46, 46):
        draw.ellipse((30 + 33 * x, 30 + 33 * y, 50 + 33 * x, 50 + 33 * y), fill=20)
    light = (np.asarray(picture) / 255.0).astype(np.float32)
    assert find_markers(Photograph("plate.png", light)) is None
