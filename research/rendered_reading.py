"""The first shared reading: a sprocket that wearsim wore, rendered, scanned, and marked as rendered.

python research/rendered_reading.py
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

import wearsim

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from photographs import Camera, picture, wheel  # noqa: E402

CASE = "08b-19t-wrap"
PLACE = ROOT / "docs" / "shared_readings" / "rendered-08b-19t.toml"
PART = 0.8
"""Of the life, after which the sprocket is photographed."""

CAMERA = Camera(size=(1600, 1200), tilt=0.05, blur=1.2, jpeg=90, uneven=0.2, distance=6.0)


def main() -> None:
    """Write the reading."""
    case = wearsim.load_case(CASE)
    flank = wearsim.simulate(case).flank_columns
    cycles = np.unique(flank["cycles"])
    rows = flank["cycles"] == cycles[np.abs(cycles - PART * cycles[-1]).argmin()]
    gap = np.column_stack([flank["x_mm"][rows], flank["y_mm"][rows]])
    hours = round(float(flank["cycles"][rows][0]) / case.cycles_per_hour, 1)
    with tempfile.TemporaryDirectory() as folder:
        photo = Path(folder) / "rendered.jpg"
        picture(wheel([gap] * case.sprocket.teeth), CAMERA).save(photo, quality=90)
        found = wearsim.scan(photo, case, hours=hours)
    text = found.shared_reading()
    for before, after in {
        'origin = "photograph"': 'origin = "rendered"',
        'contributor = "anonymous" # who measured it, as you want to be named': 'contributor = "wearsim"',
        f'title = "{case.title}"': f'title = "Rendered: {case.title}"',
    }.items():
        assert before in text, before
        text = text.replace(before, after)
    note = (
        "# Not a real sprocket: wearsim wore it, a program drew it, and wearsim scan measured the picture.\n"
        f"# The depth that was drawn: {flank['depth_mm'][rows].max():.4f} mm.\n"
    )
    PLACE.write_text(note + text.partition("\n")[2].partition("\n")[2], encoding="utf-8", newline="\n")
    print(found)


if __name__ == "__main__":
    main()
