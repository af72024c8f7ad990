"""The finite-element model of a body: nodes, stiffness and consistent mass."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from types import MappingProxyType

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.fem import elements
from flexcage.fem.assembly import ElementKind, Matrices, assemble_ring, assemble_whole
from flexcage.fem.blocked_products import inner_products, subtract_product
from flexcage.fem.sectors import Sectors, edge_keys, find_sectors
from flexcage.geometry.materials import Material
from flexcage.mesh.cage_mesh import signed_volumes

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class FEModel:
    """Straight tetrahedra with linear or quadratic displacement, in the mesh's frame, SI.

    ``nodes``: vertices first (order 1), then edge midpoints (order 2). ``K`` acts on dof
    3 node + component; the consistent mass is ``mass_scalar`` (kron) identity(3). Both are
    assembled when first asked for: a run with all on disk needs neither.
    """

    points: np.ndarray  # (n_points, 3)
    tets: np.ndarray  # (n_tets, 4) as scikit-fem orders them
    cells: np.ndarray  # (n_tets, 4 or 10) nodes of every element, scikit-fem's order
    nodes: np.ndarray  # (N, 3)
    edges: np.ndarray  # (n_edges, 2) sorted vertex pairs; empty for order 1
    form: ElementKind
    material: Material
    order: int
    groups: Mapping[str, np.ndarray] = field(default_factory=lambda: MappingProxyType({}))
    info: Mapping[str, object] = field(default_factory=lambda: MappingProxyType({}))

    def __repr__(self) -> str:
        return (
            f"FEModel({len(self.nodes):,} nodes, {len(self.tets):,} tetrahedra of order "
            f"{self.order}, {self.material.name})"
        )

    def __getstate__(self) -> dict:
        # a mapping proxy cannot be pickled, and workers receive models by pickle
        return {**self.__dict__, "groups": dict(self.groups), "info": dict(self.info)}

    def __setstate__(self, state: dict) -> None:
        self.__dict__.update(state)

    @cached_property
    def _matrices(self) -> Matrices:
        sectors = self.sectors
        if sectors is None or len(sectors.doubled):
            return assemble_whole(self.form, self.points, self.tets, self.cells, len(self.nodes))
        return assemble_ring(self.form, self.points, self.tets, self.cells, sectors)

    @property
    def K(self) -> sp.csr_matrix:
        """Stiffness (3N, 3N)."""
        return self._matrices[0]

    @property
    def mass_scalar(self) -> sp.csr_matrix:
        """Consistent mass (N, N) of one component."""
        return self._matrices[1]

    @property
    def couples_by_elements(self) -> bool:
        """Whether the stiffness couples the nodes of an element, and no others."""
        return True

    @property
    def n_dof(self) -> int:
        return 3 * len(self.nodes)

    @cached_property
    def nodal_mass(self) -> np.ndarray:
        """Row sums of the scalar mass (N,): the load of a unit acceleration."""
        return np.asarray(self.mass_scalar.sum(axis=1)).ravel()

    @cached_property
    def mass(self) -> float:
        return float(self.nodal_mass.sum())

    @cached_property
    def centre(self) -> np.ndarray:
        """Mass centre (3,) in the mesh's frame."""
        return self.nodal_mass @ self.nodes / self.mass

    @cached_property
    def inertia(self) -> np.ndarray:
        """Inertia tensor (3, 3) about the mass centre, by the consistent mass."""
        arm = self.nodes - self.centre
        second = arm.T @ (self.mass_scalar @ arm)
        return np.trace(second) * np.eye(3) - second

    @cached_property
    def rigid_modes(self) -> np.ndarray:
        """Mass-orthonormal rigid motions (3N, 6): translations, then rotations about the centre."""
        arm = self.nodes - self.centre
        modes = np.zeros((len(self.nodes), 3, 6))
        for axis in range(3):
            modes[:, axis, axis] = 1.0
            modes[:, :, 3 + axis] = np.cross(np.eye(3)[axis], arm)
        flat = modes.reshape(-1, 6)
        lower = np.linalg.cholesky(flat.T @ self.mass_times(flat))
        return flat @ np.linalg.inv(lower).T

    def mass_times(self, fields: np.ndarray) -> np.ndarray:
        """Consistent mass times (3N,) or (3N, m) fields."""
        n = len(self.nodes)
        return (self.mass_scalar @ fields.reshape(n, -1)).reshape(fields.shape)

    def remove_rigid(self, fields: np.ndarray) -> np.ndarray:
        """Displacements (3N, m) less their rigid part: orthogonal in mass to rigid motions."""
        elastic = np.array(fields, float)
        subtract_product(elastic, self.rigid_modes, self.rigid_part(fields))
        return elastic

    def rigid_part(self, fields: np.ndarray) -> np.ndarray:
        """Rigid motion (6, m) in displacements (3N, m)."""
        return inner_products(self._mass_rigid, fields)

    def balance(self, loads: np.ndarray) -> np.ndarray:
        """Nodal loads (3N, m) less the inertia of the rigid acceleration they cause."""
        return loads - self._mass_rigid @ (self.rigid_modes.T @ loads)

    @cached_property
    def _mass_rigid(self) -> np.ndarray:
        return self.mass_times(self.rigid_modes)

    @cached_property
    def sectors(self) -> Sectors | None:
        """How nodes repeat where the mesh was built of sectors, else None."""
        return find_sectors(self.info, self.tets, len(self.points), self.edges)

    @cached_property
    def element_geometry(self) -> tuple[np.ndarray, np.ndarray]:
        """Gradients of barycentric coordinates (n_tets, 4, 3) and volumes (n_tets,)."""
        return elements.barycentric_gradients(self.points, self.tets)

    @cached_property
    def surface_cells(self) -> tuple[np.ndarray, np.ndarray]:
        """Boundary triangles as (tetrahedron (n,), its three local corners (n, 3))."""
        return boundary_of(self.tets)

    @cached_property
    def surface(self) -> np.ndarray:
        """Triangles (n, 3) of the whole boundary, in no particular orientation."""
        cell, corners = self.surface_cells
        return self.tets[cell[:, None], corners]

    def face_nodes(self, triangles: np.ndarray) -> np.ndarray:
        """Nodes (n, 3 or 6) of boundary triangles: vertices, then midpoints of 01, 12, 02."""
        if self.order == 1:
            return triangles
        pairs = np.stack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [0, 2]]], axis=1)
        return np.concatenate([triangles, self.edge_nodes(pairs)], axis=1)

    def edge_nodes(self, pairs: np.ndarray) -> np.ndarray:
        """Nodes (...,) in the middle of edges (..., 2), pairs of vertices; order 2."""
        slot = np.searchsorted(self._sorted_keys, edge_keys(pairs, len(self.points)))
        return len(self.points) + self._key_order[slot]

    @cached_property
    def _key_order(self) -> np.ndarray:
        return np.argsort(edge_keys(self.edges, len(self.points)))

    @cached_property
    def _sorted_keys(self) -> np.ndarray:
        return edge_keys(self.edges, len(self.points))[self._key_order]

    def face_weights(
        self, triangles: np.ndarray, functions: Callable[[np.ndarray], np.ndarray]
    ) -> sp.csr_matrix:
        """Integrals over boundary triangles of f_m N_i: csr (m, N) [f m^2].

        ``functions`` maps points (n, 3) to values (m, n). A row dotted with nodal displacements
        is the integral of f_m u; its transpose spreads a pressure f_m consistently to the nodes.
        """
        rule_points, rule_weights = _triangle_rule()
        shapes = triangle_shapes(rule_points, self.order)  # (n_shape, q)
        corners = self.points[triangles]
        where = np.einsum("kq,tkd->tqd", triangle_shapes(rule_points, 1), corners)
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = 0.5 * np.linalg.norm(normal, axis=1)
        values = functions(where.reshape(-1, 3)).reshape(-1, *where.shape[:2])
        entries = values @ (shapes * rule_weights).T * area[:, None]
        function, triangle, corner = np.nonzero(entries)
        columns = self.face_nodes(triangles)[triangle, corner]
        shape = (len(values), len(self.nodes))
        return sp.coo_matrix((entries[entries != 0.0], (function, columns)), shape).tocsr()

    def group(self, name: str) -> np.ndarray:
        """Triangles (n, 3) of a named group."""
        if name not in self.groups:
            known = ", ".join(sorted(self.groups)[:6]) or "none"
            raise InputError(
                f"the mesh has no surface group {name!r}; it has {known} ...",
                where="mesh",
                value=name,
            )
        return self.groups[name]


def boundary_of(tets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Triangles that one tetrahedron alone has, of tetrahedra (m, 4): which (n,), and its three
    local corners there (n, 3)."""
    corners = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
    faces = np.sort(tets[:, corners].reshape(-1, 3), axis=1)
    _, first, count = np.unique(faces, axis=0, return_index=True, return_counts=True)
    cell, face = np.divmod(first[count == 1], 4)
    return cell, corners[face]


@cache
def _triangle_rule() -> tuple[np.ndarray, np.ndarray]:
    """Degree-6 rule on the reference triangle, weights summing to one (hats have kinks)."""
    from skfem.quadrature import get_quadrature
    from skfem.refdom import RefTri

    points, weights = get_quadrature(RefTri, 6)
    return points, weights / weights.sum()


def triangle_shapes(points: np.ndarray, order: int) -> np.ndarray:
    """Shape functions (3 or 6, n) of a triangle: vertices, midpoints of 01, 12, 02."""
    bary = np.stack([1.0 - points[0] - points[1], points[0], points[1]])
    if order == 1:
        return bary
    mids = [4.0 * bary[a] * bary[b] for a, b in ((0, 1), (1, 2), (0, 2))]
    return np.concatenate([bary * (2.0 * bary - 1.0), np.stack(mids)])


def assemble(mesh, material: Material, *, order: int = 2) -> FEModel:
    """The model of ``mesh`` (points, tets, groups) with scikit-fem's elements.

    Quadrature is exact for affine elements: degree 2 for K and 4 for M when quadratic.
    """
    import skfem

    if order not in (1, 2):
        raise InputError(f"element order {order} is not 1 or 2", where="order", value=order)
    _refuse_flat(mesh)
    element = skfem.ElementTetP1() if order == 1 else skfem.ElementTetP2()
    fe_mesh = skfem.MeshTet(mesh.points.T.copy(), mesh.tets.T.copy())
    basis = skfem.Basis(fe_mesh, element, intorder=2 * (order - 1) or 1)
    mass_rule = skfem.quadrature.get_quadrature(fe_mesh.refdom, 2 * order)
    cells = np.ascontiguousarray(basis.element_dofs.T)
    tets = np.ascontiguousarray(fe_mesh.t.T)
    nodes = np.ascontiguousarray(basis.doflocs.T)
    form = ElementKind(element, (basis.X, basis.W), mass_rule, lame(material), material.density)
    edges = np.empty((0, 2), np.int64)
    if order == 2:
        edges, cells, nodes = _by_vertices(np.sort(fe_mesh.edges.T, axis=1), cells, nodes)
    return FEModel(
        points=np.asarray(mesh.points),
        tets=tets,
        cells=cells,
        nodes=nodes,
        edges=edges,
        form=form,
        material=material,
        order=order,
        groups=mesh.groups,
        info=getattr(mesh, "info", MappingProxyType({})),
    )


def _by_vertices(
    edges: np.ndarray, cells: np.ndarray, nodes: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges (n, 2), cells and nodes with edges in rising order of their vertices, so that stored
    shapes fit whatever numbering a release of scikit-fem has."""
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    vertices = len(nodes) - len(edges)
    number = np.arange(len(nodes))
    number[vertices + order] = vertices + np.arange(len(edges))
    old = np.concatenate([np.arange(vertices), vertices + order])
    return edges[order], np.ascontiguousarray(number[cells]), np.ascontiguousarray(nodes[old])


def _refuse_flat(mesh) -> None:
    volumes = np.abs(signed_volumes(mesh.points, mesh.tets))
    worst = int(np.argmin(volumes))
    if not volumes[worst] > 1e-9 * volumes.mean():
        raise InputError(
            f"tetrahedron {worst} of the mesh is flat (volume {volumes[worst]:.2e} m^3)",
            where="mesh",
            value=worst,
        )


def lame(material: Material) -> tuple[float, float]:
    """Lame's first parameter and the shear modulus [Pa]."""
    modulus, nu = material.youngs_modulus, material.poisson_ratio
    return modulus * nu / ((1 + nu) * (1 - 2 * nu)), modulus / (2 * (1 + nu))
