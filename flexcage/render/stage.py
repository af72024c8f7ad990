"""The stage: layers are drawn off screen, and handed on as pictures with depth.

Everything 3D is drawn here; text, colour bars and arrows are set beside it by matplotlib
(``sheet``), so that nothing overlaps and fonts are one family everywhere. VTK is used as it is:
pyvista's plotter takes longer to be imported than most pictures take.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.core.offscreen import opening_window
from flexcage.render.scene import Layer, View

SAMPLES = 2  # a side of a pixel: a picture is drawn so many times as large, and smoothed


@dataclass(frozen=True)
class Picture:
    """Pixels of a scene, and where its points are in it."""

    pixels: np.ndarray  # (height, width, 3) uint8
    buffer: np.ndarray  # (height, width) VTK's depth, 0 to 1 over ``clipping``; 1: background
    clipping: tuple[float, float]  # distances from the camera's plane [m]
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
        near, far = self.clipping
        z = self.buffer[max(y - 2, 0) : max(y + 3, 0), max(x - 2, 0) : max(x + 3, 0)].astype(float)
        patch = np.where(z < 1.0, near * far / (far - z * (far - near)), np.nan)
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
    """Layers in the off-screen window, which all stages of a thread share, one after the other."""

    def __init__(self, layers: Sequence[Layer]) -> None:
        self._window, self._renderer = _window()
        for layer in layers:
            if layer.mesh.n_points:
                self._renderer.AddActor(_actor(layer, self._renderer.GetActiveCamera()))

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *exc: object) -> None:
        self._renderer.RemoveAllViewProps()

    def shoot(self, view: View, size: tuple[int, int]) -> Picture:
        """What is seen, in ``size`` (width, height) pixels."""
        camera, (w, h) = self._renderer.GetActiveCamera(), size
        distance = 0.5 * view.height / np.tan(np.deg2rad(0.5 * view.angle))
        direction = np.asarray(view.direction) / np.linalg.norm(view.direction)
        camera.SetFocalPoint(view.focus)
        camera.SetPosition(view.focus + distance * direction)
        camera.SetViewUp(view.up)
        camera.SetViewAngle(view.angle)
        self._renderer.ResetCameraClippingRange()
        self._window.SetSize(SAMPLES * w, SAMPLES * h)
        self._window.Render()
        matrix = camera.GetCompositeProjectionTransformMatrix(w / h, -1.0, 1.0)
        clip = np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
        unit = View(tuple(direction), view.focus, view.height, view.up, view.angle)
        pixels, buffer = _pixels(self._window, size), _buffer(self._window)
        clipping = camera.GetClippingRange()
        return Picture(pixels, buffer, clipping, clip, unit, float(distance))


def shoot(layers: Sequence[Layer], view: View, size: tuple[int, int]) -> Picture:
    """One picture of ``size`` (width, height) pixels."""
    with Stage(layers) as stage:
        return stage.shoot(view, size)


_OF_THREAD = threading.local()  # what draws belongs to its thread


def _window() -> tuple[Any, Any]:
    """The window of this thread, and its renderer."""
    if not hasattr(_OF_THREAD, "window"):
        with opening_window():
            _OF_THREAD.window = _new_window()
    return _OF_THREAD.window


def _new_window() -> tuple[Any, Any]:
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (what VTK draws with)
    from vtkmodules.vtkCommonCore import vtkLogger
    from vtkmodules.vtkRenderingCore import vtkLightKit, vtkRenderer, vtkRenderWindow

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # no word on a missing X server
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.AddRenderer(renderer)
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.SetUseOIT(False)  # what is translucent is drawn from back to front
    vtkLightKit().AddLightsToRenderer(renderer)
    window.SetSize(32, 32)
    window.Render()
    return window, renderer


def _actor(layer: Layer, camera: Any) -> Any:
    """What draws a layer; the faces of a translucent one are sorted by depth."""
    from matplotlib.colors import to_rgb
    from vtkmodules.vtkFiltersHybrid import vtkDepthSortPolyData
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    mapper, actor = vtkPolyDataMapper(), vtkActor()
    if layer.opacity < 1.0:
        sort = vtkDepthSortPolyData()
        sort.SetInputData(layer.mesh)
        sort.SetCamera(camera)
        sort.SetDepthSortModeToBoundsCenter()
        mapper.SetInputConnection(sort.GetOutputPort())
    else:
        mapper.SetInputData(layer.mesh)
    mapper.SetScalarVisibility(bool(layer.values))
    if layer.values:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(layer.values)
        mapper.SetLookupTable(_table(layer.cmap, layer.limits))
        mapper.SetUseLookupTableScalarRange(True)
        mapper.SetInterpolateScalarsBeforeMapping(True)
    actor.SetMapper(mapper)
    drawn = actor.GetProperty()
    drawn.SetColor(*to_rgb(layer.colour))
    drawn.SetOpacity(layer.opacity)
    drawn.SetInterpolationToPhong()
    drawn.SetAmbient(layer.ambient)
    drawn.SetDiffuse(layer.diffuse)
    drawn.SetLighting(layer.lit)
    drawn.SetLineWidth(SAMPLES * layer.width)
    drawn.SetBackfaceCulling(layer.closed and layer.opacity == 1.0)
    if layer.edges:
        drawn.SetEdgeVisibility(True)
        drawn.SetEdgeColor(*to_rgb(layer.edges))
    return actor


def _table(cmap: Any, limits: tuple[float, float]) -> Any:
    """VTK's table of the colours of a map of matplotlib."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkLookupTable

    table = vtkLookupTable()
    table.SetTable(numpy_to_vtk(cmap(np.linspace(0.0, 1.0, 256), bytes=True), deep=True))
    table.SetTableRange(limits)
    table.SetUseAboveRangeColor(True)
    table.SetAboveRangeColor(cmap.get_over())
    return table


def _pixels(window: Any, size: tuple[int, int]) -> np.ndarray:
    """The window's picture smoothed to ``size``, row 0 at the top."""
    from PIL import Image
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

    data, (w, h) = vtkUnsignedCharArray(), window.GetSize()
    window.GetPixelData(0, 0, w - 1, h - 1, 0, data, 0)
    drawn = Image.fromarray(vtk_to_numpy(data).reshape(h, w, 3)[::-1])
    return np.asarray(drawn.resize(size, Image.Resampling.BILINEAR))


def _buffer(window: Any) -> np.ndarray:
    """The window's depth, one value a pixel of the picture, row 0 at the top."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkFloatArray

    data, (w, h) = vtkFloatArray(), window.GetSize()
    window.GetZbufferData(0, 0, w - 1, h - 1, data)
    return vtk_to_numpy(data).reshape(h, w)[::-SAMPLES, ::SAMPLES].copy()
