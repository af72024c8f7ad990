"""A ring that bends: stress on its deformed shape, and how far its race yields."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from flexcage.render import marks, sheet
from flexcage.render.scene import (
    View,
    coloured_layer,
    load_pyvista,
    outline_layer,
    ring_size,
)
from flexcage.render.stage import Picture, shoot
from flexcage.render.stress_pictures import nice_scale

_SIZE, _PLOT = (760, 760), (430, 300)
_TOP, _EDGE, _GAP = 96, 36, 120
_ARROW = 90.0  # pixels of the largest force


def ring_picture(
    points: np.ndarray,
    displaced: np.ndarray,
    faces: np.ndarray,
    von_mises: np.ndarray,
    path: str | Path,
    *,
    azimuth: np.ndarray,
    force: np.ndarray,
    deflection: np.ndarray,
    support: np.ndarray | None = None,
    support_force: np.ndarray | None = None,
    title: str = "Ring",
    name: str = "",
    note: str = "",
    scale: float | None = None,
) -> Path:
    """Equivalent stress [Pa] at points (n, 3) of a ring's surface of quadrangles (k, 4), on the
    shape moved by ``displaced`` (n, 3) [m], and the race's radial ``deflection`` (Z,) [m] beside
    that which the contact law counts: inwards, where the ring is stiffer than a half-space.

    Arrows are the radial forces (Z,) [N] of elements at ``azimuth`` (Z,) on the ring, outwards, and
    the forces (S,) with which supports press on it; ``scale`` is chosen if not given.
    """
    scale = nice_scale(points, displaced) if scale is None else scale
    limit, over = sheet.robust_limit(1e-6 * von_mises)
    view = _view(points)
    cmap = sheet.colour_map("viridis")
    body = _mesh(points + scale * displaced, faces, 1e-6 * von_mises)
    layers = [
        coloured_layer(body, cmap=cmap, limits=(0.0, limit)),
        outline_layer(_mesh(points, faces), colour="#9a9a9a", width=0.4),
    ]
    picture = shoot(layers, view, _SIZE)
    with sheet.style():
        left = _EDGE + _SIZE[0] + _GAP
        figure = sheet.new_figure(left + _PLOT[0] + _EDGE, _TOP + _SIZE[1] + 110)
        sheet.heading(figure, title, sheet.join([name, note, f"deformation × {scale:g}"]))
        ax = sheet.image_at(figure, (_EDGE, _TOP, *_SIZE), picture.pixels)
        marks.triad(ax, picture)
        radius = float(np.hypot(points[:, 1], points[:, 2]).mean())
        _arrows(ax, picture, radius, azimuth, force, sheet.VERMILION)
        if support is not None and support_force is not None:
            outside = float(np.hypot(points[:, 1], points[:, 2]).max())
            _arrows(ax, picture, outside, support, -support_force, sheet.BLUE)
        sheet.colour_bar(
            figure, (_EDGE + 120, _TOP + _SIZE[1] + 30, _SIZE[0] - 240, 14), cmap=cmap,
            limits=(0.0, limit), label="equivalent stress, MPa", over=over,
        )  # fmt: skip
        _curve(figure, (left, _TOP + 30, *_PLOT), azimuth, 1e6 * deflection,
               "race outwards, beside Hertz, µm")  # fmt: skip
        _curve(figure, (left, _TOP + 130 + _PLOT[1], *_PLOT), azimuth, force,
               "radial force on the ring, N")  # fmt: skip
        return sheet.save(figure, path)


def _mesh(points: np.ndarray, faces: np.ndarray, values: np.ndarray | None = None) -> Any:
    used = np.unique(faces)
    local = np.searchsorted(used, faces)
    cells = np.column_stack([np.full(len(local), 4), local]).ravel()
    mesh = load_pyvista().PolyData(points[used], cells)
    if values is not None:
        mesh.point_data["values"] = values[used]
    return mesh


def _view(points: np.ndarray) -> View:
    """Against the bearing's axis, y upwards, from a little above."""
    radius, _ = ring_size(points)
    direction = np.array([0.93, 0.20, 0.30])
    unit = direction / np.linalg.norm(direction)
    return View(tuple(map(float, unit)), (0.0, 0.0, 0.0), 3.0 * radius, up=(0.0, 1.0, 0.0))


def _arrows(
    ax: Any, picture: Picture, radius: float, azimuth: np.ndarray, force: np.ndarray, colour: str
) -> None:
    """Radial forces on a ring; those that press inwards come from outside."""
    most = float(np.abs(force).max(initial=0.0))
    for psi, f in zip(azimuth, force):
        if abs(f) < 0.01 * most or most == 0.0:
            continue
        way = np.array([0.0, np.cos(psi), np.sin(psi)])
        tip, outer = picture.place(np.stack([radius * way, 1.05 * radius * way]))
        along = (outer - tip) / np.linalg.norm(outer - tip)
        tail = tip - np.sign(f) * _ARROW * abs(f) / most * along
        form = {"arrowstyle": "-|>", "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", tuple(tip), tuple(tail), arrowprops=form, annotation_clip=False)


def _curve(figure: Any, rect: Any, azimuth: np.ndarray, values: np.ndarray, label: str) -> None:
    """Values over the azimuth from -180 to 180 degrees."""
    ax = sheet.axes_at(figure, rect)
    turned = np.degrees((azimuth + np.pi) % (2.0 * np.pi) - np.pi)
    order = np.argsort(turned)
    ax.plot(turned[order], values[order], "o-", color=sheet.VERMILION, ms=4.0, lw=1.3)
    ax.axhline(0.0, color=sheet.HAIR, lw=0.8)
    ax.set(xlim=(-180.0, 180.0), xticks=np.arange(-180, 181, 60), xlabel="azimuth, °", title=label)
