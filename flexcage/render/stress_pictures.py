"""Equivalent stress, its envelope, and the deformation of a cage."""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees
from pathlib import Path

import numpy as np

from flexcage.core.errors import InputError
from flexcage.render import marks, sheet
from flexcage.render.scene import (
    BodySurface,
    Layer,
    View,
    coloured_layer,
    outline_layer,
    ring_size,
    ring_view,
    surface_of,
    surface_vertices,
)
from flexcage.render.stage import Picture, Stage

MAIN = (1180, 880)  # pixels of the whole cage
SIDE = (520, 520)  # pixels of the close-up
TOP, GAP, EDGE = 96, 30, 36
ZOOM = 0.17  # close-up: seen height over the ring's diameter


@dataclass(frozen=True)
class Field:
    """A nodal field on a deformed body: what is drawn, and how it is named."""

    points: np.ndarray  # (n, 3) m, undeformed
    tets: np.ndarray  # (m, 4 or 10)
    displacement: np.ndarray  # (n, 3) m
    values: np.ndarray  # (n,) in the unit of the label
    label: str
    unit: str
    cmap: str = "viridis"

    def __post_init__(self) -> None:
        n, used = len(self.points), int(np.max(self.tets, initial=-1)) + 1
        if used > n or len(self.displacement) != n or len(self.values) != n:
            raise InputError(
                f"The picture needs one displacement and one value per node: {n} points, "
                f"{len(self.displacement)} displacements, {len(self.values)} values of "
                f"{self.label}, and elements that name {used} nodes."
            )


@dataclass(frozen=True)
class Place:
    """What names the peak and turns the view."""

    label: str
    node: int | None
    pocket_count: int
    azimuth: float


def stress_picture(
    points: np.ndarray,
    tets: np.ndarray,
    displacement: np.ndarray,
    von_mises: np.ndarray,
    path: str | Path,
    *,
    scale: float | None = None,
    time: float | None = None,
    title: str = "Equivalent stress on the deformed cage",
    note: str = "",
    peak_label: str = "",
    peak_node: int | None = None,
    pocket_count: int = 0,
    azimuth: float = 0.0,
    limit: float | None = None,
) -> Path:
    """Equivalent (von Mises) stress [Pa] at nodes on the cage deformed ``scale`` times.

    Thin grey lines show the undeformed cage, a close-up the place of the peak (``peak_node``, or
    the largest value), which ``peak_label`` names. ``pocket_count`` numbers the pockets;
    ``azimuth`` [rad] turns the cage; ``limit`` [Pa] fixes the colour range, to compare pictures.
    ``scale`` is chosen if not given.
    """
    field = Field(points, tets, displacement, von_mises * 1e-6, "equivalent stress", "MPa")
    scale = nice_scale(points, displacement) if scale is None else scale
    parts = [note, _time(time), f"deformation × {scale:g}"]
    place = Place(peak_label, peak_node, pocket_count, azimuth)
    return _field_sheet(field, path, scale, title, parts, place, _mega(limit))


def envelope_picture(
    points: np.ndarray,
    tets: np.ndarray,
    envelope: np.ndarray,
    path: str | Path,
    *,
    span: tuple[float, float] | None = None,
    title: str = "Largest equivalent stress over the run",
    note: str = "",
    peak_label: str = "",
    peak_node: int | None = None,
    pocket_count: int = 0,
    azimuth: float = 0.0,
    limit: float | None = None,
) -> Path:
    """Largest equivalent stress [Pa] that every node saw during ``span`` (s, s), undeformed."""
    field = Field(
        points, tets, np.zeros_like(points), envelope * 1e-6, "largest equivalent stress", "MPa"
    )
    when = f"t = {span[0] * 1e3:.2f} … {span[1] * 1e3:.2f} ms" if span else ""
    parts = [note, when, "shape undeformed"]
    place = Place(peak_label, peak_node, pocket_count, azimuth)
    return _field_sheet(field, path, 0.0, title, parts, place, _mega(limit))


def deformation_picture(
    points: np.ndarray,
    tets: np.ndarray,
    displacement: np.ndarray,
    path: str | Path,
    *,
    scale: float | None = None,
    time: float | None = None,
    title: str = "Deformation of the cage",
    note: str = "",
    peak_label: str = "",
    pocket_count: int = 0,
    azimuth: float = 0.0,
    limit: float | None = None,
) -> Path:
    """Magnitude of the elastic displacement [m] on the cage deformed ``scale`` times."""
    size = np.linalg.norm(displacement, axis=1) * 1e6
    field = Field(points, tets, displacement, size, "displacement magnitude", "µm", "cividis")
    scale = nice_scale(points, displacement) if scale is None else scale
    parts = [note, _time(time), f"deformation × {scale:g}"]
    top = None if limit is None else limit * 1e6
    place = Place(peak_label, None, pocket_count, azimuth)
    return _field_sheet(field, path, scale, title, parts, place, top)


def nice_scale(points: np.ndarray, displacement: np.ndarray, *, share: float = 0.07) -> float:
    """A round factor that shows the largest displacement as about ``share`` of the radius."""
    largest = float(np.linalg.norm(displacement, axis=1).max())
    return sheet.rounded_down(share * ring_size(points)[0] / largest) if largest else 1.0


def _field_sheet(
    field: Field,
    path: str | Path,
    scale: float,
    title: str,
    parts: list[str],
    place: Place,
    limit: float | None,
) -> Path:
    surface = surface_of(field.tets)
    on_surface = field.values[surface.used]
    peak = int(surface.used[np.argmax(on_surface)]) if place.node is None else int(place.node)
    at_vertices = field.values[surface_vertices(field.tets)]
    top, over = sheet.robust_limit(at_vertices) if limit is None else (limit, False)
    over = over or bool(on_surface.max() > top * (1.0 + 1e-9))
    cmap = sheet.colour_map(field.cmap)
    layers = field_layers(field, surface, scale, cmap, top)
    deformed = field.points + scale * field.displacement
    radius, width = ring_size(field.points)
    whole = ring_view(radius, width, aspect=MAIN[0] / MAIN[1], azimuth=place.azimuth)
    with Stage(layers) as stage:
        main = stage.shoot(whole, MAIN)
        close = _close_up(stage, surface, deformed, peak, radius)
    at, left = deformed[peak], EDGE + MAIN[0] + GAP
    with sheet.style():
        figure = sheet.new_figure(left + SIDE[0] + EDGE, TOP + MAIN[1] + EDGE)
        value = f"peak {field.values[peak]:.3g} {field.unit}"
        sheet.heading(figure, title, sheet.join([*parts, value]))
        ax = sheet.image_at(figure, (EDGE, TOP, *MAIN), main.pixels)
        side = sheet.image_at(figure, (left, TOP, *SIDE), close.pixels, frame=sheet.FAINT)
        marks.place_mark(ax, main, at)
        marks.place_mark(side, close, at)
        marks.triad(ax, main)
        marks.pocket_numbers(ax, main, count=place.pocket_count, radius=radius, width=width)
        marks.length_bar(side, close)
        _captions(figure, left, field, peak, place)
        sheet.colour_bar(
            figure,
            (left, TOP + MAIN[1] - 92, SIDE[0], 30),
            cmap=cmap,
            limits=(0.0, top),
            label=f"{field.label} [{field.unit}]",
            over=over,
        )
        return sheet.save(figure, path)


def field_layers(
    field: Field, surface: BodySurface, scale: float, cmap: object, top: float
) -> list[Layer]:
    """The coloured deformed body with its edges, and the undeformed outline if it differs."""
    moved = surface.polydata(field.points + scale * field.displacement, field.values)
    layers = [
        coloured_layer(moved, cmap=cmap, limits=(0.0, top)),
        outline_layer(moved, colour="#101010", width=0.25, opacity=0.35),
    ]
    if scale and np.any(field.displacement):
        layers.append(outline_layer(surface.polydata(field.points), colour="#8a8a8a", width=0.25))
    return layers


def _close_up(
    stage: Stage,
    surface: BodySurface,
    points: np.ndarray,
    node: int,
    radius: float,
) -> Picture:
    """The place of a node from the direction that faces its surface best and is not blocked."""
    at = points[node]
    psi = float(np.arctan2(at[2], at[1]))
    radial = np.array([0.0, np.cos(psi), np.sin(psi)])
    around = np.array([0.0, -np.sin(psi), np.cos(psi)])
    normal = _normal(surface, points, node)
    ways = [
        r * radial + t * around + np.array([x, 0.0, 0.0])
        for r in (1.0, -1.0)
        for t in (0.5, -0.5)
        for x in (0.5, -0.5)
    ]
    ways = sorted((w / np.linalg.norm(w) for w in ways), key=lambda w: -float(w @ normal))
    for way in ways:
        view = View(tuple(way), tuple(at), 2.0 * ZOOM * radius)
        picture = stage.shoot(view, SIDE)
        if picture.shows(at):
            return picture
    return picture


def _normal(surface: BodySurface, points: np.ndarray, node: int) -> np.ndarray:
    """Outward normal at a node, from its triangles weighted by area; radial if it has none."""
    around = surface.triangles[(surface.triangles == node).any(axis=1)]
    a, b, c = (points[around[:, i]] for i in range(3))
    total = np.cross(b - a, c - a).sum(axis=0)
    size = np.linalg.norm(total)
    return total / size if size > 0.0 else np.array([0.0, *points[node][1:]])


def _captions(figure, left: float, field: Field, peak: int, place: Place) -> None:
    x, y, z = field.points[peak]
    psi = np.arctan2(z, y) % (2.0 * np.pi)
    where = f"x = {x * 1e3:+.2f} mm,  r = {np.hypot(y, z) * 1e3:.2f} mm,  ψ = {degrees(psi):.1f}°"
    name = place.label
    if not name and place.pocket_count:
        name = f"pocket {round(psi * place.pocket_count / (2.0 * np.pi)) % place.pocket_count}"
    value = f"Peak {field.values[peak]:.3g} {field.unit}"
    y0 = TOP + SIDE[1] + 18
    head = f"{value}: {name}" if name else value
    text = sheet.text_at(figure, left, y0, head, fontsize=10.5, weight="bold")
    sheet.fit_width(figure, text, SIDE[0])
    sheet.text_at(figure, left, y0 + 30, where, fontsize=9, color=sheet.FAINT)
    rows = [("ring", sheet.BLACK, "place of the peak, close up above (dotted: hidden)")]
    if np.any(field.displacement):
        rows.append(("line", "#8a8a8a", "undeformed cage"))
    marks.key(figure, (left, y0 + 70, SIDE[0], 0), rows)


def _time(time: float | None) -> str:
    return "" if time is None else f"t = {time * 1e3:.3f} ms"


def _mega(limit: float | None) -> float | None:
    return None if limit is None else limit * 1e-6
