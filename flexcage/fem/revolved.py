"""A solid of revolution by finite elements in its section and Fourier series around its axis.

Displacements of harmonic n are u_x = U_x cos n psi, u_r = U_r cos n psi, u_psi = U_psi sin n psi,
or the same turned by a quarter of a wave, which has the same matrices. Harmonics do not couple, so
a series of plane problems is the three-dimensional solution: O. C. Zienkiewicz and R. L. Taylor,
The Finite Element Method, volume 1, "Semi-analytical finite element processes". A solid mesh of
the ring would need a hundred times the unknowns, would have to be turned or interpolated under
every load that travels, and is only as round as its facets.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.fem.model import lame
from flexcage.geometry.materials import Material
from flexcage.mesh.section import SectionMesh

X, R, PSI = range(3)
Density = Callable[[np.ndarray, np.ndarray], np.ndarray]  # of places (x, r) on an edge


@dataclass(frozen=True, eq=False)
class Revolved:
    """Quadratic triangles in the section (x, r) of a ring, in SI.

    Degrees of freedom: 3 node + component (x, r, psi). Energies are integrals around the whole
    ring, for harmonics from 1; those of harmonic 0 are twice as large (``turn``).
    """

    mesh: SectionMesh
    material: Material

    @cached_property
    def basis(self) -> Any:
        """scikit-fem's basis of three components on the section."""
        import skfem

        mesh = skfem.MeshTri(self.mesh.points.T.copy(), self.mesh.triangles.T.copy())
        return skfem.Basis(mesh, _element(), intorder=4)

    @cached_property
    def nodes(self) -> np.ndarray:
        """Places (N, 2) of the nodes: corners, then middles of edges."""
        first = np.concatenate([self.basis.nodal_dofs[0], self.basis.facet_dofs[0]])
        return self.basis.doflocs[:, first].T

    @cached_property
    def _order(self) -> np.ndarray:
        """scikit-fem's number (3N,) of degree of freedom 3 node + component."""
        return np.hstack([self.basis.nodal_dofs, self.basis.facet_dofs]).T.ravel()

    @property
    def n_dof(self) -> int:
        return 3 * len(self.nodes)

    @cached_property
    def cells(self) -> np.ndarray:
        """Nodes (m, 6) of every triangle: corners, then the middles of 01, 12, 02."""
        number = np.empty(self.n_dof, np.int64)
        number[self._order] = np.arange(self.n_dof)
        return number[self.basis.element_dofs[::3].T] // 3

    @cached_property
    def border(self) -> np.ndarray:
        """Pairs of nodes (k, 2) of the section's outline, halves of edges, each with the ring to
        its left."""
        pairs = np.array([[0, 3, 1], [1, 4, 2], [2, 5, 0]])
        sides = self.cells[:, pairs].reshape(-1, 3)
        _, first, count = np.unique(
            np.sort(sides[:, [0, 2]], axis=1), axis=0, return_index=True, return_counts=True
        )
        a, b, c = np.moveaxis(self.nodes[self.cells[:, :3]], 1, 0)
        left = (b - a)[:, 0] * (c - a)[:, 1] > (b - a)[:, 1] * (c - a)[:, 0]
        sides = np.where(np.repeat(left, 3)[:, None], sides, sides[:, ::-1])
        outer = sides[first[count == 1]]
        return np.concatenate([outer[:, :2], outer[:, 1:]])

    @cached_property
    def nodal_gradients(self) -> tuple[sp.csr_matrix, sp.csr_matrix]:
        """Derivatives (N, N) along x and r at nodes: the mean over the triangles there."""
        # shape functions of a quadratic triangle, differentiated by its two coordinates, at nodes
        u = np.array([0.0, 1.0, 0.0, 0.5, 0.5, 0.0])
        v = np.array([0.0, 0.0, 1.0, 0.0, 0.5, 0.5])
        w, zero = 1.0 - u - v, 0.0 * u
        by_u = np.stack([1 - 4 * w, 4 * u - 1, zero, 4 * (w - u), 4 * v, -4 * v], axis=1)
        by_v = np.stack([1 - 4 * w, zero, 4 * v - 1, -4 * u, 4 * u, 4 * (w - v)], axis=1)
        corners = self.nodes[self.cells[:, :3]]
        slope = np.linalg.inv((corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1))
        count = len(self.nodes)
        share = 1.0 / np.bincount(self.cells.ravel(), minlength=count)
        rows = np.repeat(self.cells, 6, axis=1).ravel()
        columns = np.tile(self.cells, (1, 6)).ravel()
        found = []
        for k in range(2):
            local = slope[:, 0, k, None, None] * by_u + slope[:, 1, k, None, None] * by_v
            whole = sp.coo_matrix((local.ravel(), (rows, columns)), (count, count)).tocsr()
            found.append(sp.diags(share) @ whole)
        return found[0].tocsr(), found[1].tocsr()

    @cached_property
    def _stiffness(self) -> tuple[sp.csc_matrix, sp.csc_matrix, sp.csc_matrix]:
        """A, B and C of K_n = A + n B + n^2 C."""
        import skfem

        form = skfem.BilinearForm(_stiffness_density)
        first, second = lame(self.material)
        at = [self._sorted(form.assemble(self.basis, n=n, l=first, g=second)) for n in (0, 1, -1)]
        return at[0], 0.5 * (at[1] - at[2]), 0.5 * (at[1] + at[2]) - at[0]

    def stiffness(self, n: int) -> sp.csc_matrix:
        """K (3N, 3N) of harmonic n [N/m]."""
        a, b, c = self._stiffness
        return turn(n) * (a + n * b + n**2 * c)

    @cached_property
    def _mass(self) -> sp.csc_matrix:
        import skfem

        form = skfem.BilinearForm(lambda u, v, w: pi * w.x[1] * _dot(u, v))
        return self.material.density * self._sorted(form.assemble(self.basis))

    def mass(self, n: int) -> sp.csc_matrix:
        """Consistent mass (3N, 3N) of harmonic n [kg]."""
        return turn(n) * self._mass

    def foundation(self, edge: str, n: int) -> sp.csc_matrix:
        """Stiffness (3N, 3N) [m^2] of a foundation of 1 N/m^3, alike in all directions, under the
        surface that an edge of the section sweeps."""
        import skfem

        form = skfem.BilinearForm(lambda u, v, w: pi * w.x[1] * _dot(u, v))
        return turn(n) * self._sorted(form.assemble(self._on(edge)))

    def line_load(self, edge: str, direction: tuple[float, float], density: Density) -> np.ndarray:
        """Nodal loads (3N,) of a force along ``direction`` (x, r) that is spread over an edge with
        ``density`` [1/m], and around the ring so that its n-th Fourier coefficient is 1."""
        import skfem

        def form(v: Any, w: Any) -> np.ndarray:
            along = direction[0] * v.value[X] + direction[1] * v.value[R]
            return density(w.x[0], w.x[1]) * along

        return skfem.LinearForm(form).assemble(self._on(edge))[self._order]

    def edge_length(self, edge: str, density: Density) -> float:
        """Integral of ``density`` along an edge."""
        import skfem

        basis = self._on(edge)
        return float(skfem.Functional(lambda w: density(w.x[0], w.x[1])).assemble(basis))

    def edge_nodes(self, edge: str) -> np.ndarray:
        """Nodes of an edge."""
        found = self.basis.get_dofs(self._facets(edge)).flatten()
        number = np.empty(self.n_dof, np.int64)
        number[self._order] = np.arange(self.n_dof)
        return np.unique(number[found] // 3)

    def rigid_motions(self, n: int) -> np.ndarray:
        """Rigid motions (3N, k) of harmonic n: along the axis and about it; across it and tilt."""
        x, r = self.nodes.T
        none, ones = np.zeros_like(x), np.ones_like(x)
        motions = {
            0: [(ones, none, none), (none, none, r)],
            1: [(none, ones, -ones), (-r, x, -x)],
        }.get(n, [])
        return np.array([np.stack(m, axis=1).ravel() for m in motions]).reshape(-1, self.n_dof).T

    def _facets(self, edge: str) -> np.ndarray:
        """scikit-fem's facets of a named edge."""
        facets = np.sort(self.basis.mesh.facets.T, axis=1)
        count = len(self.mesh.points)
        keys = facets[:, 0] * count + facets[:, 1]
        wanted = np.sort(self.mesh.edges[edge], axis=1)
        return np.flatnonzero(np.isin(keys, wanted[:, 0] * count + wanted[:, 1]))

    def _on(self, edge: str) -> Any:
        import skfem

        return skfem.FacetBasis(self.basis.mesh, _element(), facets=self._facets(edge), intorder=6)

    def _sorted(self, matrix: Any) -> sp.csc_matrix:
        return matrix.tocsr()[self._order][:, self._order].tocsc()


def turn(n: int) -> float:
    """Integral of cos^2 n psi around a ring over that of harmonics from 1: 2 for harmonic 0."""
    return 2.0 if n == 0 else 1.0


def _element() -> Any:
    import skfem

    return skfem.ElementVector(skfem.ElementTriP2(), 3)


def _dot(u: Any, v: Any) -> Any:
    return (u.value * v.value).sum(axis=0)


def _strain(u: Any, r: np.ndarray, n: float) -> tuple[Any, ...]:
    """Strains xx, rr, psi psi, xr (cos n psi), r psi, x psi (sin n psi); shear is engineering's."""
    value, slope = u.value, u.grad
    return (
        slope[X, 0],
        slope[R, 1],
        (value[R] + n * value[PSI]) / r,
        slope[X, 1] + slope[R, 0],
        slope[PSI, 1] - (n * value[R] + value[PSI]) / r,
        slope[PSI, 0] - n * value[X] / r,
    )


def _stiffness_density(u: Any, v: Any, w: Any) -> Any:
    r = w.x[1]
    e, d = _strain(u, r, w.n), _strain(v, r, w.n)
    volume = (e[0] + e[1] + e[2]) * (d[0] + d[1] + d[2])
    normal = sum(a * b for a, b in zip(e[:3], d[:3]))
    shear = sum(a * b for a, b in zip(e[3:], d[3:]))
    return pi * r * (w.l * volume + w.g * (2.0 * normal + shear))
