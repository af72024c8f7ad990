"""3D scenes off screen: surfaces of tetrahedra, layers, fixed views, and pictures with depth.

Everything 3D is drawn here and handed on as pixels; text, colour bars and arrows are set beside
it by matplotlib (``sheet``), so that nothing overlaps and fonts are one family everywhere.
Lengths in metres; a view is fixed by the ring's size and an azimuth, not by what is drawn, so
that two runs can be laid side by side.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.environment import prepare_offscreen

if TYPE_CHECKING:
    import pyvista

BACKGROUND = "white"
_FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))  # of a tetrahedron, outward if V > 0
_EDGES = {(0, 1): 4, (1, 2): 5, (0, 2): 6, (0, 3): 7, (1, 3): 8, (2, 3): 9}


def load_pyvista() -> Any:
    """pyvista, after making sure that this machine can draw: VTK would kill the process else."""
    prepare_offscreen()
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger

    pyvista.OFF_SCREEN = True
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # no word on a missing X server
    return pyvista


@dataclass(frozen=True)
class Surface:
    """Boundary of a tetrahedral body as linear triangles over the body's own nodes."""

    triangles: np.ndarray  # (n, 3) node numbers, outward orientation

    @cached_property
    def used(self) -> np.ndarray:
        """Node numbers that lie on the surface, ascending."""
        return np.unique(self.triangles)

    def polydata(self, points: np.ndarray, values: np.ndarray | None = None) -> pyvista.PolyData:
        """Surface at ``points`` (n_nodes, 3) with nodal ``values`` (n_nodes,) as "values"."""
        pv = load_pyvista()
        local = np.searchsorted(self.used, self.triangles)
        faces = np.column_stack([np.full(len(local), 3), local])
        mesh = pv.PolyData(np.asarray(points, float)[self.used], faces.ravel())
        if values is not None:
            mesh.point_data["values"] = np.asarray(values, float)[self.used]
        return mesh


def surface_vertices(tets: np.ndarray) -> np.ndarray:
    """Node numbers of the vertices on the boundary, without the middles of edges."""
    return surface_of(tets[:, :4]).used


def surface_of(
    tets: np.ndarray, values: np.ndarray | None = None, *, within: float = 0.0
) -> Surface:
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
        return Surface(corners[outer])
    corners = corners[outer]
    mids = np.concatenate([tets[:, _mid_nodes(f)] for f in _FACES])[outer]
    divided = np.ones(mids.shape, bool)
    if values is not None:
        ends = 0.5 * (values[corners] + values[np.roll(corners, -1, axis=1)])
        divided = np.abs(values[mids] - ends) > within
    return Surface(_divided(corners, mids, divided))


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
    """One thing in a scene: a mesh, and how it is drawn (keywords of pyvista's add_mesh)."""

    mesh: Any
    style: dict[str, Any] = field(default_factory=dict)


def body_layer(mesh: pyvista.PolyData, **style: Any) -> Layer:
    """A body with crisp edges: smooth shading, split where faces meet at an angle."""
    split = mesh.compute_normals(
        split_vertices=True, feature_angle=35.0, consistent_normals=False, cell_normals=False
    )
    base = {"smooth_shading": True, "ambient": 0.42, "diffuse": 0.68, "specular": 0.0}
    return Layer(split, {**base, "show_scalar_bar": False, **style})


def coloured_layer(mesh: pyvista.PolyData, *, cmap: Any, limits: tuple[float, float]) -> Layer:
    """A body coloured by its ``values`` over ``limits``; light is kept weak so colours read."""
    over = tuple(int(255 * c) for c in cmap.get_over()[:3])
    return body_layer(
        mesh,
        scalars="values",
        cmap=cmap,
        clim=limits,
        above_color=over,
        ambient=0.66,
        diffuse=0.42,
    )


def outline_layer(
    mesh: pyvista.PolyData, *, colour: str = "#222222", width: float = 1.2, opacity: float = 1.0
) -> Layer:
    """Sharp edges of a body as thin lines."""
    edges = mesh.extract_feature_edges(
        feature_angle=40.0, boundary_edges=False, manifold_edges=False, non_manifold_edges=False
    )
    style = {"color": colour, "line_width": width, "opacity": opacity, "lighting": False}
    return Layer(edges, {**style, "show_scalar_bar": False})


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


@dataclass(frozen=True)
class Picture:
    """Pixels of a scene, and where its points are in it."""

    pixels: np.ndarray  # (height, width, 3) uint8
    depth: np.ndarray  # (height, width) distance along the view [m], NaN: background
    matrix: np.ndarray  # (4, 4) world -> clip coordinates
    view: View
    distance: float

    def place(self, points: np.ndarray) -> np.ndarray:
        """Pixel coordinates (n, 2) of points (n, 3): x to the right, y downwards."""
        p = np.atleast_2d(points)
        clip = np.column_stack([p, np.ones(len(p))]) @ self.matrix.T
        ndc = clip[:, :2] / clip[:, 3:]
        h, w = self.pixels.shape[:2]
        return np.column_stack([(ndc[:, 0] + 1.0) * 0.5 * w, (1.0 - ndc[:, 1]) * 0.5 * h])

    def _gap(self, point: np.ndarray) -> np.ndarray:
        """Depth of the picture less that of a point, at the pixels round it; NaN: background."""
        x, y = np.round(self.place(point)[0]).astype(int)
        eye = np.asarray(self.view.focus) + self.distance * np.asarray(self.view.direction)
        patch = self.depth[max(y - 2, 0) : max(y + 3, 0), max(x - 2, 0) : max(x + 3, 0)]
        return patch - (eye - point) @ np.asarray(self.view.direction)

    def sees(self, point: np.ndarray, *, slack: float = 0.4e-3) -> bool:
        """Whether nothing opaque lies in front of a point (within ``slack`` [m])."""
        gap = self._gap(point)
        return bool(gap.size) and not bool((gap < -slack).all())

    def shows(self, point: np.ndarray, *, slack: float = 0.4e-3) -> bool:
        """Whether a point of a surface is what the picture has there, in all pixels near by."""
        gap = self._gap(point)
        return bool(gap.size) and bool((np.abs(np.where(np.isnan(gap), 9.9, gap)) < slack).all())


class Stage:
    """An off-screen window of one size, reused from picture to picture."""

    def __init__(self, width: int, height: int) -> None:
        pv = load_pyvista()
        self.size = (int(width), int(height))
        self._plotter = pv.Plotter(off_screen=True, window_size=self.size, lighting="light kit")
        self._plotter.set_background(BACKGROUND)
        self._plotter.enable_anti_aliasing("ssaa")

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *exc: object) -> None:
        self._plotter.close()

    def shoot(self, layers: Sequence[Layer], view: View, *, peel: bool = False) -> Picture:
        """Draw the layers; ``peel`` sorts translucent ones by depth."""
        plotter = self._plotter
        plotter.clear_actors()
        (plotter.enable_depth_peeling if peel else plotter.disable_depth_peeling)()
        for layer in layers:
            if layer.mesh.n_points:
                plotter.add_mesh(layer.mesh, **layer.style)
        distance = 0.5 * view.height / np.tan(np.deg2rad(0.5 * view.angle))
        focus, direction = np.asarray(view.focus), np.asarray(view.direction)
        direction = direction / np.linalg.norm(direction)
        camera = plotter.camera
        camera.focal_point, camera.position = focus, focus + distance * direction
        camera.up, camera.view_angle = view.up, view.angle
        plotter.renderer.ResetCameraClippingRange()
        window = plotter.render_window
        window.Render()
        w, h = self.size
        matrix = camera.GetCompositeProjectionTransformMatrix(w / h, -1.0, 1.0)
        clip = np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
        unit = View(tuple(direction), view.focus, view.height, view.up, view.angle)
        depth = _depth(window, self.size, *camera.clipping_range)
        return Picture(_pixels(window, self.size), depth, clip, unit, float(distance))


def _pixels(window: Any, size: tuple[int, int]) -> np.ndarray:
    """The window's picture, row 0 at the top."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

    data = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, data, 0)
    return vtk_to_numpy(data).reshape(size[1], size[0], 3)[::-1].copy()


def _depth(window: Any, size: tuple[int, int], near: float, far: float) -> np.ndarray:
    """Distance from the camera's plane [m] of what every pixel shows, NaN for the background."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkFloatArray

    data = vtkFloatArray()
    window.GetZbufferData(0, 0, size[0] - 1, size[1] - 1, data)
    z = vtk_to_numpy(data).reshape(size[1], size[0])[::-1].astype(float)
    depth = near * far / (far - z * (far - near))
    return np.where(z < 1.0, depth, np.nan)


def shoot(
    layers: Sequence[Layer], view: View, size: tuple[int, int], *, peel: bool = False
) -> Picture:
    """One picture of ``size`` (width, height) pixels."""
    with Stage(*size) as stage:
        return stage.shoot(layers, view, peel=peel)
