"""Animations: stress on the moving cage, and the bearing's motion, as GIF or MP4."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.core.writing import written
from flexcage.geometry.bearing import Bearing
from flexcage.render import marks, sheet
from flexcage.render.bearing_pictures import (
    bearing_layers,
    bearing_title,
    bearing_view,
    cut_cages,
    instant,
    label_bearing,
    load_limit,
)
from flexcage.render.scene import ring_size, ring_view, surface_of
from flexcage.render.stage import shoot
from flexcage.render.stress_pictures import Field, field_layers, nice_scale
from flexcage.results.each_cage import cage_count

if TYPE_CHECKING:
    import xarray

FRAME = (900, 660)
BEARING_FRAME = (760, 700)
TOP, BELOW, EDGE = 92, 96, 20


def write_animation(frames: Iterable[np.ndarray], path: str | Path, *, fps: float = 20.0) -> Path:
    """Frames (height, width, 3) uint8 to a .gif, or to an .mp4 if imageio-ffmpeg is installed."""
    path = Path(path)
    kind = path.suffix.lower()
    if kind not in (".gif", ".mp4"):
        raise InputError(
            f"An animation is written as .gif or .mp4, not {kind or 'without a suffix'!r}: {path}.",
            where="path",
            value=str(path),
        )
    if kind == ".mp4" and importlib.util.find_spec("imageio_ffmpeg") is None:
        raise EnvironmentLacks(
            "Writing .mp4 needs the package imageio-ffmpeg, which is not installed here: "
            "pip install imageio-ffmpeg, or write a .gif."
        )
    import imageio.v2 as imageio

    path.parent.mkdir(parents=True, exist_ok=True)
    options: dict[str, Any] = {"duration": 1e3 / fps, "loop": 0}
    if kind == ".mp4":
        options = {"fps": fps, "macro_block_size": 2, "quality": 8}
    with written(path) as temporary:
        writer: Any = imageio.get_writer(str(temporary), **options)
        with writer:
            for frame in frames:
                even = frame[: frame.shape[0] // 2 * 2, : frame.shape[1] // 2 * 2]
                writer.append_data(np.ascontiguousarray(even))
    return path


def animate_stress(
    points: np.ndarray,
    tets: np.ndarray,
    displacements: Sequence[np.ndarray],
    von_mises: Sequence[np.ndarray],
    times: Sequence[float],
    path: str | Path,
    *,
    scale: float | None = None,
    limit: float | None = None,
    pocket_count: int = 0,
    azimuth: float = 0.0,
    fps: float = 20.0,
    title: str = "Equivalent stress on the deformed cage",
    note: str = "",
) -> Path:
    """Stress [Pa] on the deformed cage, one frame an entry; one scale and range for all frames."""
    if not len(displacements) == len(von_mises) == len(times) > 0:
        raise InputError("An animation needs as many displacements and stresses as times.")
    if scale is None:
        most = max(displacements, key=lambda u: float(np.abs(u).max()))
        scale = nice_scale(points, most)
    if limit is None:
        limit = sheet.rounded_up(max(float(s.max()) for s in von_mises) * 1e-6) * 1e6
    frames = _stress_frames(
        points, tets, displacements, von_mises, times, scale, limit, pocket_count, azimuth,
        title, note,
    )  # fmt: skip
    return write_animation(frames, path, fps=fps)


def _stress_frames(
    points, tets, displacements, von_mises, times, scale, limit, pocket_count, azimuth, title, note
) -> Iterator[np.ndarray]:
    surface, cmap = surface_of(tets), sheet.colour_map("viridis")
    radius, width = ring_size(points)
    view = ring_view(radius, width, aspect=FRAME[0] / FRAME[1], azimuth=azimuth)
    with sheet.style():
        for u, stress, time in zip(displacements, von_mises, times):
            field = Field(points, tets, u, stress * 1e-6, "equivalent stress", "MPa")
            layers = field_layers(field, surface, scale, cmap, limit * 1e-6)
            picture = shoot(layers, view, FRAME)
            figure = sheet.new_figure(FRAME[0] + 2 * EDGE, TOP + FRAME[1] + BELOW)
            facts = [f"t = {time * 1e3:7.3f} ms", f"deformation × {scale:g}"]
            peak = f"peak {field.values[surface.used].max():5.2f} MPa"
            sheet.heading(figure, title, sheet.join([note, *facts, peak]), left=EDGE)
            ax = sheet.image_at(figure, (EDGE, TOP, *FRAME), picture.pixels)
            marks.pocket_numbers(ax, picture, count=pocket_count, radius=radius, width=width)
            sheet.colour_bar(
                figure,
                (EDGE + 0.2 * FRAME[0], TOP + FRAME[1] + 16, 0.6 * FRAME[0], 20),
                cmap=cmap,
                limits=(0.0, limit * 1e-6),
                label="equivalent stress [MPa]",
            )
            yield sheet.pixels_of(figure)


def animate_bearing(
    ds: xarray.Dataset,
    bearing: Bearing,
    path: str | Path,
    *,
    frames: int = 60,
    span: tuple[float, float] | None = None,
    cage_points: np.ndarray | None = None,
    cage_tets: np.ndarray | None = None,
    loads: np.ndarray | None = None,
    limit: float | None = None,
    fps: float = 20.0,
    title: str = "",
    note: str = "",
) -> Path:
    """The bearing's motion over ``span`` [s] (the whole run if not given) in so many frames.

    ``loads`` (time, 3) [N] act on the inner ring.
    """
    t = ds["time"].values
    first, last = span if span is not None else (t[0], t[-1])
    at = np.unique(np.searchsorted(t, np.linspace(first, last, frames)).clip(0, len(t) - 1))
    top = limit if limit is not None else load_limit(ds)
    cage, title = (cage_points, cage_tets), title or bearing_title(ds)
    pictures = _bearing_frames(ds, bearing, at, cage, loads, top, title, note)
    return write_animation(pictures, path, fps=fps)


def _bearing_frames(ds, bearing, indices, cage, loads, top, title, note) -> Iterator[np.ndarray]:
    cut = cut_cages(cage[0], cage[1], cage_count(ds))
    view = bearing_view(bearing)
    with sheet.style():
        for index in indices:
            now = instant(ds, int(index))
            layers = bearing_layers(now, bearing, cut, top)
            picture = shoot(layers, view, BEARING_FRAME)
            figure = sheet.new_figure(BEARING_FRAME[0] + 2 * EDGE, TOP + BEARING_FRAME[1] + BELOW)
            when = f"t = {now.time * 1e3:7.3f} ms"
            sheet.heading(figure, title, sheet.join([note, when]), left=EDGE)
            ax = sheet.image_at(figure, (EDGE, TOP, *BEARING_FRAME), picture.pixels)
            load = (None, 0.0) if loads is None else (tuple(loads[index, 1:]), loads[index, 0])
            label_bearing(ax, picture, now, bearing, top, load)
            sheet.colour_bar(
                figure,
                (
                    EDGE + 0.15 * BEARING_FRAME[0],
                    TOP + BEARING_FRAME[1] + 16,
                    0.7 * BEARING_FRAME[0],
                    20,
                ),
                cmap=sheet.colour_map("viridis"),
                limits=(0.0, top),
                label="normal force of the inner race [N]   (grey: none)",
            )
            yield sheet.pixels_of(figure)
