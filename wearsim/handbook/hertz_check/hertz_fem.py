"""A contact at the pitch point by finite elements: two elastic bodies, frictionless, in plane strain.

Each body is half of a block (the axis of the contact is a symmetry), fixed at its base, free at
its side, with a cylinder for its top. Displacements are biquadratic on quadrilaterals that grow
with the distance from the contact. The contact pressure p is a Lagrange multiplier, continuous
and linear along the edges that may touch; with hat functions psi_j of its nodes the contact
conditions are

    p_j >= 0,  g_j = int psi_j (gap + both displacements) dx >= 0,  p_j g_j = 0.

Without the inner unknowns they read g_j = (C p)_j + g0_j - w_j delta, C the compliance of both
bodies, delta their approach: the optimum of a convex quadratic in p >= 0, which scipy's
non-negative least squares solves exactly. The approach follows from the load.
"""

import math
import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import brentq, nnls
from scipy.sparse.linalg import splu

from wearsim.errors import ContactError
from wearsim.extras import library
from wearsim.geometry.profile_points import Vector
from wearsim.handbook.hertz_check.pitch_point_contact import PitchPointContact

_SIDE, _HEIGHT = 0.5, 1.0
"""Half the width and the height of a block, in radii of its top."""

_FINE, _GROWTH = 1.5, 1.3
"""Half-widths of the contact up to which elements are equal, and by how much they grow beyond."""

_WIDEST = 0.1
"""Most that the half-width may be of a radius: displacements are small against the geometry."""


@dataclass(frozen=True, eq=False)
class FemContact:
    """A contact as one mesh has it."""

    elements: int  # elements along Hertz' half-width
    unknowns: int  # displacements of both bodies
    seconds: float  # that it took
    # place, pressure: nodes from the middle of the contact [mm], and the pressure there [MPa]
    place: Vector
    pressure: Vector
    # depth, von_mises: nodes on the axis of the pinion from its surface [mm], and von Mises' stress there
    # [MPa]
    depth: Vector
    von_mises: Vector

    @property
    def peak_pressure(self) -> float:
        """Return the pressure in the middle [MPa]."""
        return float(self.pressure[0])

    @property
    def half_width(self) -> float:
        """Return the half-width of the half-ellipse with the same second moment [mm]."""
        moment = np.trapezoid(self.pressure * self.place**2, self.place)
        return float(2.0 * math.sqrt(moment / np.trapezoid(self.pressure, self.place)))

    @property
    def surface_von_mises(self) -> float:
        """Return von Mises' stress on the surface [MPa]."""
        return float(self.von_mises[0])

    @property
    def depth_von_mises(self) -> float:
        """Return the greatest von Mises stress on the axis [MPa]."""
        return float(self.von_mises.max())

    @property
    def depth_of_greatest(self) -> float:
        """Return the depth of the node with that stress [mm]."""
        return float(self.depth[self.von_mises.argmax()])


def hertz_fem(contact: PitchPointContact, elements: int) -> FemContact:
    """Solve a contact at the pitch point on a mesh.

    Equation hertz-check.md (5).

    Parameters
    ----------
    contact : PitchPointContact
        The contact.
    elements : int
        Equal elements along Hertz' half-width, at least 2.

    Returns
    -------
    FemContact
        Pressures, and stresses below them.

    Raises
    ------
    CaseError
        scikit-fem is not installed.
    ContactError
        The contact is too wide for small displacements.
    """
    fem = library("skfem", "fem", "--fem")
    start = time.perf_counter()
    narrow = _WIDEST * min(contact.flank_radii)
    if not contact.half_width <= narrow:
        raise ContactError(
            f"finite elements: half the width of the contact must be at most {narrow:.4g} mm, a tenth "
            f"of the smaller radius, but is {contact.half_width:.4g} mm: lower torque_N_m or raise "
            "face_width_mm"
        )
    pinion, wheel = (
        _body(fem, radius, modulus, contact, elements)
        for radius, modulus in zip(contact.flank_radii, contact.youngs_modulus, strict=True)
    )
    pressure = _pressure(
        pinion.compliance + wheel.compliance,
        pinion.gap + wheel.gap,
        pinion.width,
        0.5 * contact.load_per_width,
    )
    depth, von_mises = _axis_von_mises(fem, pinion, pressure)
    return FemContact(
        elements,
        pinion.response.shape[0] + wheel.response.shape[0],
        time.perf_counter() - start,
        pinion.place,
        pressure,
        depth,
        von_mises,
    )


@dataclass(frozen=True, eq=False)
class _Body:
    """A body: its basis, Lame's constants, and what unit pressures at the nodes do to it.

    ``response`` holds the displacements by each of them, ``compliance`` the weighted inward
    displacements; ``gap`` and ``width`` are the integrals of its sagitta and of 1, weighted.
    """

    basis: Any
    elastic: tuple[float, float]
    place: Vector
    response: Vector
    compliance: Vector
    gap: Vector
    width: Vector


def _graded(step: float, equal: int, length: float) -> Vector:
    """Nodes from 0 to a length: a number of equal steps, then growing ones."""
    near = step * np.arange(equal + 1)
    rest = length - near[-1]
    count = math.ceil(math.log1p(rest / step * (1.0 - 1.0 / _GROWTH)) / math.log(_GROWTH))
    far = np.cumsum(step * _GROWTH ** np.arange(1, count + 1))
    return np.append(near, near[-1] + far * (rest / far[-1]))


def _sagitta(radius: float, place: Vector) -> Vector:
    """How far a cylinder's top lies below its highest line."""
    return place**2 / (radius + np.sqrt(radius**2 - place**2))


def _mesh(fem: Any, radius: float, half_width: float, elements: int) -> Any:
    """Mesh of half a block; its boundaries are ``axis``, ``base`` and ``contact``."""
    step, equal, height = half_width / elements, math.ceil(_FINE * elements), _HEIGHT * radius
    across = _graded(step, equal, _SIDE * radius)
    down = _graded(step, equal, height)
    flat = fem.MeshQuad.init_tensor(across, -down[::-1])
    x, y = flat.p
    tagged = flat.with_boundaries(
        {
            "axis": lambda p: p[0] < 0.1 * step,
            "base": lambda p: p[1] < -height + 0.1 * step,
            "contact": lambda p: (p[1] > -0.1 * step) & (p[0] < equal * step),
        }
    )
    bent = np.array([x, y - _sagitta(radius, x) * (1.0 + y / height)])
    return fem.MeshQuad(bent, flat.t).with_boundaries(tagged.boundaries)


def _body(fem: Any, radius: float, modulus: float, contact: PitchPointContact, elements: int) -> _Body:
    from skfem.models.elasticity import lame_parameters, linear_elasticity

    mesh = _mesh(fem, radius, contact.half_width, elements)
    biquadratic = fem.ElementVector(fem.ElementQuad2())
    basis = fem.Basis(mesh, biquadratic)
    elastic = lame_parameters(modulus, contact.poissons_ratio)
    stiffness = linear_elasticity(*elastic).assemble(basis)
    edges = fem.FacetBasis(mesh, biquadratic, facets="contact", intorder=4)
    multiplier = fem.FacetBasis(mesh, fem.ElementQuad1(), facets="contact", intorder=4)
    nodes = multiplier.get_dofs("contact").all()
    nodes = nodes[np.argsort(multiplier.doflocs[0, nodes])]

    # Integrals are over the tangent plane of the contact: ds |n_y| = dx.
    def work(p: Any, v: Any, w: Any) -> Any:
        return -p * v[1] * abs(w.n[1])

    def weighted(function: Any) -> Vector:
        form = fem.LinearForm(lambda p, w: function(w.x[0]) * p * abs(w.n[1]))
        return np.asarray(form.assemble(multiplier)[nodes])

    loads = fem.BilinearForm(work).assemble(multiplier, edges)[:, nodes]
    held = np.append(basis.get_dofs("axis").all("u^1"), basis.get_dofs("base").all())
    free = basis.complement_dofs(held)
    factors = splu(
        stiffness[free][:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}
    )
    response = np.zeros((basis.N, nodes.size))
    response[free] = factors.solve(loads[free].toarray())
    return _Body(
        basis,
        elastic,
        place=multiplier.doflocs[0, nodes],
        response=response,
        compliance=loads.T @ response,
        gap=weighted(lambda x: _sagitta(radius, x)),
        width=weighted(np.ones_like),
    )


def _pressure(compliance: Vector, gap: Vector, width: Vector, load: float) -> Vector:
    """Return the pressures under a load on half of the contact."""
    root = cholesky(0.5 * (compliance + compliance.T), lower=True)

    def pressed(approach: float) -> Vector:
        return nnls(root.T, solve_triangular(root, approach * width - gap, lower=True))[0]

    def excess(approach: float) -> float:
        return float(width @ pressed(approach)) - load

    greatest = float(gap[1] / width[1])
    while excess(greatest) < 0.0:
        greatest *= 2.0
    return pressed(float(brentq(excess, 0.0, greatest, rtol=1e-12)))


def _axis_von_mises(fem: Any, body: _Body, pressure: Vector) -> tuple[Vector, Vector]:
    """Return depths and von Mises' stress on the axis, from stresses projected to the nodes."""
    first, shear = body.elastic
    gradient = body.basis.interpolate(body.response @ pressure).grad
    nodal = body.basis.with_element(fem.ElementQuad1())
    volume = first * (gradient[0, 0] + gradient[1, 1])
    along, across, sheared = (
        nodal.project(stress)
        for stress in (
            volume + 2.0 * shear * gradient[0, 0],
            volume + 2.0 * shear * gradient[1, 1],
            shear * (gradient[0, 1] + gradient[1, 0]),
        )
    )
    out_of_plane = 0.5 * first / (first + shear) * (along + across)
    square = 0.5 * ((along - across) ** 2 + (across - out_of_plane) ** 2 + (out_of_plane - along) ** 2)
    axis = nodal.get_dofs("axis").all()
    axis = axis[np.argsort(-nodal.doflocs[1, axis])]
    return np.abs(nodal.doflocs[1, axis]), np.sqrt(square + 3.0 * sheared**2)[axis]
