"""``hertz-check --fem``: the contact by finite elements against Hertz. Takes scikit-fem."""

import math
from dataclasses import replace

import numpy as np
import pytest

from wearsim.contact.line_stress import axis_von_mises, greatest_von_mises
from wearsim.errors import ContactError
from wearsim.handbook.hertz_check.hertz_fem import hertz_fem
from wearsim.handbook.hertz_check.pitch_point_contact import PitchPointContact

pytestmark = pytest.mark.slow

BASE = PitchPointContact(240e3, 1.5, 76.0, 108.0, math.radians(20.0))


@pytest.fixture(scope="module")
def solve():
    pytest.importorskip("skfem", reason="scikit-fem is not installed")
    found = {}

    def solved(contact, elements):
        if (contact, elements) not in found:
            found[contact, elements] = hertz_fem(contact, elements)
        return found[contact, elements]

    return solved


def errors(contact, mesh):
    pressure = contact.peak_pressure
    return (
        mesh.peak_pressure / pressure - 1.0,
        mesh.surface_von_mises / (0.4 * pressure) - 1.0,
        mesh.depth_von_mises / (0.5575162166 * pressure) - 1.0,
        mesh.half_width / contact.half_width - 1.0,
    )


def test_a_coarse_mesh_meets_the_goals(solve):
    mesh = solve(BASE, 4)
    peak, surface, depth, width = map(abs, errors(BASE, mesh))
    assert peak < 0.03
    assert surface < 0.05
    assert depth < 0.05
    assert width < 0.05
    place = mesh.depth_of_greatest / BASE.half_width
    assert place == pytest.approx(greatest_von_mises(0.3).depth, abs=0.25)


def test_meshes_converge(solve):
    found = np.abs([errors(BASE, solve(BASE, elements)) for elements in (4, 8, 16)])
    assert found[1, 0] < 0.5 * found[0, 0]
    assert found[2, 0] < 0.5 * found[1, 0]
    assert found[1, 3] < 0.35 * found[0, 3]
    assert found[2, 3] < 0.35 * found[1, 3]
    assert found[2, 0] < 0.001
    assert max(found[2, 1:3]) < 0.007


def test_pressure_and_axis_follow_their_closed_forms(solve):
    mesh, a = solve(BASE, 16), BASE.half_width
    inside = mesh.place < 0.8 * a
    wanted = BASE.peak_pressure * np.sqrt(1.0 - (mesh.place[inside] / a) ** 2)
    np.testing.assert_allclose(mesh.pressure[inside], wanted, rtol=0.005)
    assert np.all(mesh.pressure[mesh.place > 1.01 * a] == 0.0)
    near = mesh.depth < 3.0 * a
    wanted = BASE.peak_pressure * axis_von_mises(mesh.depth[near] / a, 0.3)
    np.testing.assert_allclose(mesh.von_mises[near], wanted, rtol=0.02)


def test_load_is_carried(solve):
    mesh = solve(BASE, 8)
    assert 2.0 * np.trapezoid(mesh.pressure, mesh.place) == pytest.approx(BASE.load_per_width, rel=1e-6)


def test_what_is_left_of_the_error_is_that_of_bodies_of_some_size(solve):
    """Under a hundredth of the load the contact is ten times smaller against them."""
    light = replace(BASE, torque=2.4e3)
    small, large = errors(light, solve(light, 16)), errors(BASE, solve(BASE, 16))
    assert abs(small[1]) < 0.1 * abs(large[1])
    assert abs(small[2]) < 0.4 * abs(large[2])


def test_bodies_of_two_materials(solve):
    """The pressure follows from the contact modulus of both."""
    contact = replace(BASE, youngs_modulus=(2.1e5, 1.1e5), poissons_ratio=0.33)
    assert solve(contact, 8).peak_pressure == pytest.approx(contact.peak_pressure, rel=0.005)


def test_a_wide_contact_is_refused(solve):
    wide = replace(BASE, torque=2.4e9)
    with pytest.raises(ContactError, match="a tenth of the smaller radius"):
        solve(wide, 4)
