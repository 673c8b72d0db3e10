"""Labels in the drawing of a loop stand free of the chain and of each other."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from wearsim.drive.load_case import load_drive
from wearsim.geometry.scene import Label
from wearsim.mechanisms.wrap.loop_scene import FreePlaces, chain_path, label_box, loop_scene
from wearsim.quantities import grouped
from wearsim.report.drive.layout import drive_forces

DRIVES = sorted((Path(__file__).parents[2] / "cases" / "drives").glob("*.toml"))


def inside(points, box):
    left, bottom, width, height = box
    x, y = points.T
    return (x > left) & (x < left + width) & (y > bottom) & (y < bottom + height)


def boxes_of(scene):
    """Boxes of the labels; the middle of the letters lies a quarter of their height above the base line."""
    labels = [shape for shape in scene.shapes if isinstance(shape, Label)]
    return [
        label_box(one.text, (one.place[0], one.place[1] + 0.25 * one.height), one.height) for one in labels
    ]


@pytest.mark.parametrize("path", DRIVES, ids=lambda path: path.stem)
def test_labels_of_shipped_drives_stand_free(path):
    drive = load_drive(path)
    forces = drive_forces(drive)
    scene = loop_scene(forces, 0.5 * drive.driver.drive.chain.roller_diameter)
    texts = [shape.text for shape in scene.shapes if isinstance(shape, Label)]
    names = [f"{wheel.name}, {wheel.teeth}" for wheel in forces.loop.wheels]
    pulls = [f"{grouped(float(tension))} N" for tension in forces.tensions]
    assert texts[:-1] == [*names, *pulls] and texts[-1].endswith(" mm")
    assert {wheel.name for wheel in drive.wheels} == {wheel.name for wheel in forces.loop.wheels}
    boxes = boxes_of(scene)
    path_points = chain_path(forces.loop)
    ends = np.roll(path_points, -1, axis=0)
    parts = np.linspace(0.0, 1.0, 200)[:, None, None]
    dense = (path_points + parts * (ends - path_points)).reshape(-1, 2)
    left, bottom, width, height = scene.box
    for box in boxes:
        assert not inside(dense, box).any()
        assert left <= box[0] and box[0] + box[2] <= left + width
        assert bottom <= box[1] and box[1] + box[3] <= bottom + height
    for one, other in combinations(boxes, 2):
        across = min(one[0] + one[2], other[0] + other[2]) - max(one[0], other[0])
        down = min(one[1] + one[3], other[1] + other[3]) - max(one[1], other[1])
        assert across <= 0.0 or down <= 0.0


def test_a_label_takes_the_first_place_that_is_free():
    free = FreePlaces([np.array([[-10.0, 0.0], [10.0, 0.0]])], 0.1, 0.1)
    places = [(0.0, 0.0), (0.0, 2.0), (0.0, 4.0)]
    assert free.set("one", places, 1.0).place[1] == pytest.approx(2.0 - 0.25)
    assert free.set("two", places, 1.0).place[1] == pytest.approx(4.0 - 0.25)
    # Where none is free, the line is covered rather than a label.
    assert free.set("three", places, 1.0).place[1] == pytest.approx(0.0 - 0.25)
