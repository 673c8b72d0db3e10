"""The evolute flank's construction and its errors; closed forms stand in tests/verification."""

import numpy as np
import pytest

from wearsim.errors import GeometryError
from wearsim.geometry.forms.evolute import Strand, contact_ratio, evolute_flank

STRAND = Strand(25.4 * 20 / (2.0 * np.pi), 7.94, 5.5)


def test_nodes_run_from_root_to_tip_at_equal_steps_of_the_roller() -> None:
    flank = evolute_flank(STRAND, 4.0, 30.67, 31)
    np.testing.assert_allclose(np.diff(flank.contact_distance), (30.67 - 4.0) / 30, rtol=1e-12)
    radius = np.hypot(flank.profile.x, flank.profile.y)
    assert (np.diff(radius) > 0.0).all()
    assert flank.profile.x.size == 31


def test_flank_is_concave_everywhere_with_the_gap_on_its_right() -> None:
    profile = evolute_flank(STRAND, 4.0, 30.67, 101).profile
    assert (profile.curvature < 0.0).all()
    assert (profile.x < 0.0).all()
    assert (profile.normal_x > 0.0).all()


def test_points_do_not_depend_on_the_number_of_nodes() -> None:
    few, many = (evolute_flank(STRAND, 4.0, 30.67, nodes).profile for nodes in (11, 201))
    np.testing.assert_allclose(few.x, many.x[::20], rtol=0, atol=1e-9)
    np.testing.assert_allclose(few.y, many.y[::20], rtol=0, atol=1e-9)


def test_roller_path_is_symmetric_about_the_gap() -> None:
    x = np.linspace(0.5, 40.0, 20)
    entry, leave = STRAND.roller_path(x), STRAND.roller_path(-x)
    np.testing.assert_allclose(leave, entry * [-1.0, 1.0], rtol=1e-14)
    np.testing.assert_allclose(np.hypot(*entry.T), np.hypot(x, STRAND.height), rtol=1e-14)


def test_roller_touches_the_flank_at_one_radius() -> None:
    x = np.linspace(4.0, 30.67, 20)
    way = STRAND.roller_path(x) - STRAND.conjugate_points(x)
    np.testing.assert_allclose(np.hypot(*way.T), 7.94, rtol=1e-13)


@pytest.mark.parametrize(("end", "start"), [(0.0, 30.0), (-1.0, 30.0), (30.0, 4.0), (4.0, 4.0)])
def test_empty_range_or_pitch_point_line_is_refused(end: float, start: float) -> None:
    with pytest.raises(GeometryError, match="0 < contact_end < contact_start must hold"):
        evolute_flank(STRAND, end, start, 11)


def test_contact_ratio_by_hand() -> None:
    assert contact_ratio(4.0, 30.67, 25.4) == pytest.approx(1.05, rel=1e-12)
