"""``wearsim export --format step``: solids, read again. Takes build123d."""

from pathlib import Path

import pytest

import wearsim
from wearsim.case.load_case import load_case
from wearsim.export.step import step_bytes
from wearsim.report.worn_flank import wheel_shapes

pytestmark = pytest.mark.slow

CASES = Path(wearsim.__file__).parents[1] / "cases"


@pytest.mark.parametrize(
    ("name", "states"),
    [("16b-20t-oiled", ("new", "worn")), ("convex-concave-17t-mild", ("new",)), ("a40-19t-rating", ("new",))],
)
def test_volume_is_area_times_width(tmp_path, name, states):
    build123d = pytest.importorskip("build123d", reason="build123d is not installed")
    case = load_case(CASES / f"{name}.toml")
    shapes = wheel_shapes(case, wearsim.simulate(case) if "worn" in states else None)
    path = tmp_path / "wheel.step"
    path.write_bytes(step_bytes(shapes, states))
    solids = build123d.import_step(path).solids()
    expected = [shape.chains(state)[0].outline.area * shape.width for shape in shapes for state in states]
    assert all(one.is_valid for one in solids)
    assert [one.volume for one in solids] == pytest.approx(expected, rel=1e-6)
