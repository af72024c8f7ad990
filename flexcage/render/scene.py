"""What 3D scenes are made of: surfaces of tetrahedra, layers, and fixed views.

Lengths in metres; a view is fixed by the ring's size and an azimuth, not by what is drawn, so
that two runs can be laid side by side.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import EnvironmentLacks

if TYPE_CHECKING:
    import pyvista

_FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))  # of a tetrahedron, outward if V > 0
_EDGES = {(0, 1): 4, (1, 2): 5, (0, 2): 6, (0, 3): 7, (1, 3): 8, (2, 3): 9}


def load_pyvista() -> Any:
    """pyvista; EnvironmentLacks where it cannot be loaded."""
    try:
        import pyvista
    except ImportError as exc:
        raise EnvironmentLacks(f"Pictures want pyvista, which cannot be loaded: {exc}.") from exc
    return pyvista


@dataclass(frozen=True)
class BodySurface:
    """Boundary of a tetrahedral body as linear triangles over the body's own nodes."""

    triangles: np.ndarray  # (n, 3) node numbers, outward orientation

    @cached_property
    def used(self) -> np.ndarray:
        """Node numbers that lie on the surface, ascending."""
        return np.unique(self.triangles)

    @cached_property
    def _faces(self) -> np.ndarray:
        """Triangles as pyvista takes them, numbered among the nodes on the surface."""
        local = np.searchsorted(self.used, self.triangles)
        return np.column_stack([np.full(len(local), 3), local]).ravel()

    def polydata(self, points: np.ndarray, values: np.ndarray | None = None) -> pyvista.PolyData:
        """Surface at ``points`` (n_nodes, 3) with nodal ``values`` (n_nodes,) as "values"."""
        pv = load_pyvista()
        mesh = pv.PolyData(np.asarray(points, float)[self.used], self._faces)
        if values is not None:
            mesh.point_data["values"] = np.asarray(values, float)[self.used]
        return mesh


def surface_vertices(tets: np.ndarray) -> np.ndarray:
    """Node numbers of the vertices on the boundary, without the middles of edges."""
    return surface_of(tets[:, :4]).used


def surface_of(
    tets: np.ndarray, values: np.ndarray | None = None, *, within: float = 0.0
) -> BodySurface:
    """Boundary of tetrahedra with 4 nodes, or 10 (vertices, then edges 01 12 02 03 13 23).

    A quadratic face becomes four linear triangles through its mid nodes. With nodal ``values`` it
    is divided only at the edges in whose middle the mean of the ends is off by more than
    ``within``.
    """
    tets = np.asarray(tets)
    corners = np.concatenate([tets[:, f] for f in _FACES])
    keys = np.sort(corners, axis=1)
    size = int(tets.max()) + 1
    code = (keys[:, 0].astype(np.int64) * size + keys[:, 1]) * size + keys[:, 2]
    _, first, count = np.unique(code, return_index=True, return_counts=True)
    outer = first[count == 1]
    if tets.shape[1] == 4:
        return BodySurface(corners[outer])
    corners = corners[outer]
    mids = np.concatenate([tets[:, _mid_nodes(f)] for f in _FACES])[outer]
    divided = np.ones(mids.shape, bool)
    if values is not None:
        ends = 0.5 * (values[corners] + values[np.roll(corners, -1, axis=1)])
        divided = np.abs(values[mids] - ends) > within
    return BodySurface(_divided(corners, mids, divided))


def _divided(corners: np.ndarray, mids: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Triangles (m, 3) of triangles (n, 3) divided ``at`` (n, 3) some of their edges, of which
    ``mids`` (n, 3) are the middles: those of 01, 12, 20."""
    number = at.sum(axis=1)
    parts = [corners[number == 0]]
    (a, b, c), (ab, bc, ca) = corners[number == 3].T, mids[number == 3].T
    parts += [np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
    for turn in range(3):  # every edge once as the first
        own, middle, divided = (np.roll(x, -turn, axis=1) for x in (corners, mids, at))
        here = (number == 1) & divided[:, 0]
        (a, b, c), ab = own[here].T, middle[here, 0]
        parts += [np.stack(t, axis=1) for t in ((a, ab, c), (ab, b, c))]
        here = (number == 2) & ~divided[:, 2]
        (a, b, c), (ab, bc, _) = own[here].T, middle[here].T
        parts += [np.stack(t, axis=1) for t in ((ab, b, bc), (a, ab, bc), (a, bc, c))]
    return np.concatenate(parts)


def _mid_nodes(face: tuple[int, int, int]) -> list[int]:
    a, b, c = face
    return [_EDGES[(min(p), max(p))] for p in ((a, b), (b, c), (c, a))]


@dataclass(frozen=True)
class Layer:
    """One thing in a scene: a mesh of pyvista, and how it is drawn."""

    mesh: Any
    colour: str = "#000000"
    opacity: float = 1.0
    values: str = ""  # name of the nodal values that colour it, over ``limits`` in ``cmap``
    cmap: Any = None
    limits: tuple[float, float] = (0.0, 1.0)
    ambient: float = 0.42
    diffuse: float = 0.68
    lit: bool = True
    edges: str = ""  # colour of the edges of its faces, if they are drawn
    width: float = 0.3  # of lines [pixels]
    closed: bool = False  # the outside of a body: what faces away is hidden, and not drawn


def body_layer(mesh: pyvista.PolyData, **style: Any) -> Layer:
    """A closed body with crisp edges: smooth shading, split where faces meet at an angle."""
    split = mesh.compute_normals(
        split_vertices=True, feature_angle=35.0, consistent_normals=False, cell_normals=False
    )
    return Layer(split, **{"closed": True, **style})


def coloured_layer(mesh: pyvista.PolyData, *, cmap: Any, limits: tuple[float, float]) -> Layer:
    """A body coloured by its ``values`` over ``limits``; light is kept weak so colours read."""
    return body_layer(
        mesh, values="values", cmap=cmap, limits=limits, ambient=0.66, diffuse=0.42
    )  # fmt: skip


def outline_layer(
    mesh: pyvista.PolyData, *, colour: str = "#222222", width: float = 0.3, opacity: float = 1.0
) -> Layer:
    """Sharp edges of a body as thin lines."""
    edges = mesh.extract_feature_edges(
        feature_angle=40.0, boundary_edges=False, manifold_edges=False, non_manifold_edges=False
    )
    return Layer(edges, colour, opacity, width=width, lit=False)


@dataclass(frozen=True)
class View:
    """A camera: looks along -``direction`` at ``focus``; ``height`` [m] of the scene is seen."""

    direction: tuple[float, ...]
    focus: tuple[float, ...]
    height: float
    up: tuple[float, ...] = (1.0, 0.0, 0.0)
    angle: float = 16.0  # opening angle [deg]: small, so that scale hardly varies with depth


def ring_view(
    radius: float,
    width: float,
    *,
    aspect: float,
    azimuth: float = 0.0,
    elevation: float = 34.0,
    margin: float = 1.15,
) -> View:
    """View that holds a whole ring of ``radius`` and axial ``width`` [m], axis upwards.

    ``azimuth`` [rad] is the place on the ring nearest to the viewer, ``elevation`` [deg] the
    angle above the ring's plane, ``aspect`` the picture's width over height.
    """
    e = np.deg2rad(elevation)
    across, upright = 2.0 * radius, 2.0 * radius * np.sin(e) + width * np.cos(e)
    height = margin * max(across / aspect, upright)
    radial = np.array([0.0, np.cos(azimuth), np.sin(azimuth)])
    axis = np.array([1.0, 0.0, 0.0])
    direction = np.sin(e) * axis + np.cos(e) * radial
    upwards = np.cos(e) * axis - np.sin(e) * radial
    focus = -0.022 * height * upwards  # the near half is drawn larger: keep the ring centred
    return View(tuple(map(float, direction)), tuple(map(float, focus)), float(height))


def ring_size(points: np.ndarray) -> tuple[float, float]:
    """Outer radius and axial width [m] of a ring's points, rounded up to half a millimetre."""
    radius = float(np.hypot(points[:, 1], points[:, 2]).max())
    width = 2.0 * float(np.abs(points[:, 0]).max())
    return float(np.ceil(radius * 2e3 - 0.05) / 2e3), float(np.ceil(width * 2e3 - 0.05) / 2e3)
