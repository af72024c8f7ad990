"""A window cage of structured 27-node hexahedra, without fillets: another mesh, another element.

Nothing of flexcage is in it but the factorization of a matrix. Matrices are scikit-fem's own, with
its quadrature loops; rigid motions, supports and inertia relief are written here again.
"""

from __future__ import annotations

import numpy as np
import skfem
from skfem.models.elasticity import lame_parameters, linear_elasticity

from flexcage.fem.linear import linear_solver

DIVISIONS = (2, 4, 4, 2, 1)  # axial: side beam, pocket; around: pocket, crossbeam; radial


def hex_mesh(cage, pockets, divisions=DIVISIONS):
    """Ring of hexahedra; columns of nodes follow the parallel walls of the pockets."""
    side, long, across, beam, radial = divisions
    end, inside = 0.5 * cage.width, 0.5 * cage.pocket_length
    axial = np.concatenate(
        [np.linspace(-end, -inside, side + 1), np.linspace(-inside, inside, long + 1)[1:-1],
         np.linspace(inside, end, side + 1)]
    )  # fmt: skip
    radii = np.linspace(0.5 * cage.bore, 0.5 * cage.outside_diameter, radial + 1)
    wall = np.arcsin(0.5 * cage.pocket_width / radii)
    tangential = 0.5 * cage.pocket_width * np.linspace(-1.0, 1.0, across + 1)
    share = np.linspace(0.0, 1.0, beam + 1)[1:-1, None]
    sector = np.concatenate(
        [np.arcsin(tangential[:, None] / radii), wall + share * (2 * np.pi / pockets - 2 * wall)]
    )  # azimuths (columns, radii)
    per = len(sector)
    azimuth = np.concatenate([sector + 2 * np.pi * k / pockets for k in range(pockets)])
    x, psi = axial[:, None, None], azimuth[None]
    parts = (x + 0 * psi, radii * np.cos(psi) + 0 * x, radii * np.sin(psi) + 0 * x)
    points = np.stack(parts, axis=-1)
    number = np.arange(points[..., 0].size).reshape(points.shape[:3])
    ahead = np.roll(number, -1, axis=1)
    corners = [
        [n[a : len(axial) - 1 + a, :, b : radial + b] for b in (0, 1)]
        for a in (0, 1) for n in (number, ahead)
    ]  # fmt: skip
    (a0, a1), (b0, b1), (c0, c1), (d0, d1) = corners
    cells = np.stack([a0, a1, b0, c0, b1, c1, d0, d1], axis=-1)
    solid = np.ones(cells.shape[:3], bool)
    empty = np.arange(pockets * per) % per < across
    solid[side : side + long, empty] = False
    used, cells = np.unique(cells[solid], return_inverse=True)
    return skfem.MeshHex(points.reshape(-1, 3)[used].T.copy(), cells.reshape(-1, 8).T.copy())


class HexCage:
    """Statics of the free cage; ``faces`` are facets of pocket 0's walls by name."""

    def __init__(self, cage, pockets, material, divisions=DIVISIONS):
        self.mesh = hex_mesh(cage, pockets, divisions)
        self.element = skfem.ElementVector(skfem.ElementHex2())
        basis = skfem.Basis(self.mesh, self.element, intorder=4)
        lame = lame_parameters(material.youngs_modulus, material.poisson_ratio)
        stiffness = linear_elasticity(*lame).assemble(basis).tocsr()
        density = material.density
        mass = skfem.BilinearForm(lambda u, v, w: density * sum(u[i] * v[i] for i in range(3)))
        where, component = basis.doflocs.T, _components(basis)
        row = np.arange(basis.N)
        shifts = (component[:, None] == np.arange(3)).astype(float)
        turns = np.stack([np.cross(axis, where)[row, component] for axis in np.eye(3)], axis=1)
        self.rigid = np.concatenate([shifts, turns], axis=1)
        self.mass_rigid = mass.assemble(basis) @ self.rigid
        self.mass = self.rigid[:, 0] @ self.mass_rigid[:, 0]
        held = _supports(where, component, 0.5 * cage.width, 0.5 * cage.bore)
        self.free = np.setdiff1d(row, held)
        self.solver = linear_solver(stiffness[self.free][:, self.free])
        self.faces = self._walls(cage)

    def load(self, face, direction, width):
        """A unit force on a wall along ``direction``, as a bump of ``width`` [m] in x or t."""
        facets = skfem.FacetBasis(self.mesh, self.element, facets=self.faces[face], intorder=8)
        axis = 2 if face.startswith("side") else 0

        def bump(w):
            return np.exp(-((w.x[axis] / width) ** 2))

        form = skfem.LinearForm(lambda v, w: bump(w) * sum(direction[i] * v[i] for i in range(3)))
        return form.assemble(facets) / skfem.Functional(bump).assemble(facets)

    def solve(self, load):
        """Displacements of a load less the inertia of the rigid motion that it causes."""
        gram = np.linalg.inv(self.rigid.T @ self.mass_rigid)
        balanced = load - self.mass_rigid @ (gram @ (self.rigid.T @ load))
        moved = np.zeros(len(load))
        moved[self.free] = self.solver.solve(balanced[self.free])
        return moved - self.rigid @ (gram @ (self.mass_rigid.T @ moved))

    def _walls(self, cage):
        boundary = self.mesh.boundary_facets()
        x, y, t = self.mesh.p[:, self.mesh.facets[:, boundary]]
        walls = {
            "front": (t - 0.5 * cage.pocket_width, x, 0.5 * cage.pocket_length),
            "rear": (t + 0.5 * cage.pocket_width, x, 0.5 * cage.pocket_length),
            "side+x": (x - 0.5 * cage.pocket_length, t, 0.5 * cage.pocket_width),
            "side-x": (x + 0.5 * cage.pocket_length, t, 0.5 * cage.pocket_width),
        }
        on = {}
        for name, (distance, along, reach) in walls.items():
            here = (np.abs(distance) < 1e-9) & (np.abs(along) < reach + 1e-9) & (y > 0.0)
            on[name] = boundary[here.all(axis=0)]
        return on


def _components(basis):
    component = np.zeros(basis.N, int)
    dofs = basis.dofs
    for table in (dofs.nodal_dofs, dofs.edge_dofs, dofs.facet_dofs, dofs.interior_dofs):
        for axis in range(3):
            component[table[axis::3]] = axis
    return component


def _supports(where, component, end, radius):
    """Six dofs at three vertices of crossbeam-free ends: 3-2-1."""
    held = []
    for point, axes in (
        ((-end, radius), (0, 1, 2)),
        ((-end, -radius), (0, 2)),
        ((end, radius), (2,)),
    ):
        distance = np.linalg.norm(where - [point[0], point[1], 0.0], axis=1)
        near = np.flatnonzero(distance < distance.min() + 1e-9)
        held += [near[component[near] == axis][0] for axis in axes]
    return held
