"""The whole bearing at one instant: its elements coloured by load between translucent rings."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.geometry.bearing import Bearing
from flexcage.render import marks, sheet
from flexcage.render.damage import mark_spalls, mark_spots
from flexcage.render.elements import race_loads, shown_faces
from flexcage.render.instant import Instant
from flexcage.render.scene import (
    Layer,
    View,
    body_layer,
    load_pyvista,
    outline_layer,
    surface_of,
)
from flexcage.render.shapes import Shapes, shapes_of
from flexcage.render.solids import revolved, rotation
from flexcage.render.stage import Picture, shoot
from flexcage.results import metrics
from flexcage.results.each_cage import cage_count
from flexcage.results.registry import NEIGHBOURS
from flexcage.stress.mirrored import mirrored_solid

if TYPE_CHECKING:
    import pyvista
    import xarray

MAIN = (1080, 1000)
SIDE_WIDTH = 560
TOP, GAP, EDGE = 96, 84, 36
IDLE = "#c4c8ce"  # an element that the inner race does not load
RING, BRASS = "#8fa3b8", "#c9a253"
LOADED_SHARE = 0.01
_USUAL = 0.95  # share of the time in which loads lie within the colours
_FACE_COLOURS = (sheet.VERMILION, sheet.GREEN, sheet.PURPLE)


Loads = tuple[tuple[float, float] | None, float]  # (F_y, F_z), and F_x [N] on the inner ring


def bearing_picture(
    ds: xarray.Dataset,
    bearing: Bearing,
    index: int,
    path: str | Path,
    *,
    cage_points: np.ndarray | None = None,
    cage_tets: np.ndarray | None = None,
    load: tuple[float, float] | None = None,
    axial: float = 0.0,
    limit: float | None = None,
    title: str = "",
    note: str = "",
) -> Path:
    """Sample ``index`` of a run: elements by the inner race's normal force, and bars of forces.

    ``cage_points`` (n, 3) [m] and ``cage_tets`` draw the cage where it is; ``load`` (F_y, F_z) [N]
    draws the load on the inner ring, and ``axial`` [N] names what acts along x; ``limit`` [N] fixes
    the colour range.
    """
    now = instant(ds, index)
    top = limit if limit is not None else load_limit(ds)
    title = title or bearing_title(ds)
    cage = cut_cages(cage_points, cage_tets, cage_count(ds))
    layers = bearing_layers(now, bearing, cage, top)
    picture = shoot(layers, bearing_view(bearing), MAIN)
    with sheet.style():
        figure = sheet.new_figure(EDGE + MAIN[0] + GAP + SIDE_WIDTH + EDGE, TOP + MAIN[1] + EDGE)
        compose(figure, picture, now, bearing, top, load=(load, axial), title=title, note=note)
        return sheet.save(figure, path)


def bearing_title(ds: xarray.Dataset) -> str:
    return f"The bearing, {metrics.element(ds)}s coloured by load"


def load_limit(ds: xarray.Dataset) -> float:
    """Upper end of the colours of a run's loads [N]: what blows do not exceed for more than a
    twentieth of the time, such as those of a spall."""
    loads = race_loads(ds)
    largest = loads.reshape(len(loads), -1).max(axis=1)
    return sheet.rounded_up(float(np.quantile(largest, _USUAL)))


def instant(ds: xarray.Dataset, index: int) -> Instant:
    """Values of sample ``index`` of a run; a negative one counts from the end."""
    n = ds.sizes["time"]
    if not -n <= index < n:
        raise InputError(f"The run has {n} samples; there is no sample {index}.", value=index)
    at = ds.isel(time=index)
    position = at["element_position"].transpose("element", "cyl").values
    tilt = np.zeros((len(position), 2))
    if "element_tilt" in ds:
        tilt = at["element_tilt"].transpose("element", "tilt").values
    force, caged = race_loads(at), metrics.caged(ds)
    return Instant(
        float(at["time"]),
        metrics.element(ds),
        position,
        tilt,
        force[:, 0],
        force[:, 1],
        _neighbour_forces(at),
        (at["cage_position"].values, at["cage_quaternion"].values) if caged else None,
        at["inner_position"].values,
        float(at["inner_angle"]),
        float(at["inner_speed"]),
        metrics.carrier(ds),
        float(metrics.carrier_speed(at)),
        _spots_of(at),
    )


def _neighbour_forces(at: xarray.Dataset) -> dict[str, np.ndarray]:
    """Forces of one instant on the faces of pockets, or without a cage between neighbours."""
    if not metrics.caged(at):
        return {f"next {metrics.element(at)}": at[NEIGHBOURS].values}
    pocket = at["pocket_force"].transpose("pocket", "face")
    return {
        name: pocket.sel(face=faces).sum("face").values for name, faces in shown_faces(at).items()
    }


def _spots_of(at: xarray.Dataset) -> dict[int, np.ndarray]:
    """Directions of spots of one instant by the numbers of their elements."""
    if "spot_direction" not in at:
        return {}
    direction = at["spot_direction"].transpose("spotted", "axis")
    return {int(k): d for k, d in zip(at["spotted"].values, direction.values, strict=True)}


def bearing_view(bearing: Bearing) -> View:
    """Nearly along the axis: y upwards, psi counter-clockwise."""
    direction = np.array([1.0, 0.36, 0.0])
    return View(
        tuple(direction / np.linalg.norm(direction)),
        (0.0, 0.0, 0.0),
        1.13 * bearing.outside_diameter,
        up=(0.0, 1.0, 0.0),
    )


def bearing_layers(
    now: Instant, bearing: Bearing, cages: Sequence[pyvista.PolyData], top: float
) -> list[Layer]:
    """Rings and cages cut at mid-width, so that the elements stand free; the rings translucent.

    ``cages`` are the cut cages at rest, each in its own frame.
    """
    shapes = shapes_of(bearing)
    inner, outer = revolved(shapes.inner), revolved(shapes.outer)
    inner.points = inner.points + now.inner_position
    rings = load_pyvista().merge([inner, outer])
    loaded = now.inner_load > LOADED_SHARE * top
    cmap = sheet.colour_map("viridis")
    layers = [
        body_layer(rings, colour=RING, opacity=0.34),
        outline_layer(rings, colour="#4a545f", width=0.275),
    ]
    for chosen, style in (
        (loaded, {"values": "load", "cmap": cmap, "limits": (0.0, top), "ambient": 0.62}),
        (~loaded, {"colour": IDLE}),
    ):
        if chosen.any():
            elements = _elements(now, shapes, chosen)
            layers.append(body_layer(elements, **style))
            layers.append(outline_layer(elements, colour="#30363c", width=0.225))
    for cage, place, quaternion in zip(cages, *now.cages):  # none without a mesh
        moved = cage.copy()
        moved.points = cage.points @ rotation(quaternion).T + place
        layers.append(body_layer(moved, colour=BRASS))
        layers.append(outline_layer(moved, colour="#6b5320", width=0.225, opacity=0.8))
    return layers


def element_points(points: np.ndarray, now: Instant, k: int) -> np.ndarray:
    """Points (n, 3) of an element about its centre, where element ``k`` is in space."""
    x, radius, psi = now.position[k]
    skew, tilt = now.tilt[k]
    radial = np.array([0.0, np.cos(psi), np.sin(psi)])
    around = np.array([0.0, -np.sin(psi), np.cos(psi)])
    axis = np.array([1.0, 0.0, 0.0]) + tilt * radial + skew * around
    axis /= np.linalg.norm(axis)
    up = radial - (radial @ axis) * axis
    up /= np.linalg.norm(up)
    frame = np.column_stack([axis, up, np.cross(axis, up)])
    placed: np.ndarray = points @ frame.T + x * np.array([1.0, 0.0, 0.0]) + radius * radial
    return placed


def _elements(now: Instant, shapes: Shapes, chosen: np.ndarray) -> pyvista.PolyData:
    pv = load_pyvista()
    one, parts = revolved(shapes.element, segments=48), []
    for k in np.flatnonzero(chosen):
        part = one.copy()
        part.points = element_points(one.points, now, int(k))
        part.point_data["load"] = np.full(part.n_points, float(now.inner_load[k]))
        parts.append(part)
    return pv.merge(parts) if len(parts) > 1 else parts[0]


def cut_cages(
    points: np.ndarray | None, tets: np.ndarray | None, count: int
) -> list[pyvista.PolyData]:
    """Surfaces of a cage, or of ``count`` cages, cut at mid-width; none without a mesh."""
    normal = (-1.0, 0.0, 0.0)
    return [
        whole.clip_closed_surface(normal=normal, origin=(0.0, 0.0, 0.0))
        for whole in whole_cages(points, tets, count)
    ]


def whole_cages(
    points: np.ndarray | None, tets: np.ndarray | None, count: int
) -> list[pyvista.PolyData]:
    """Surfaces of a cage, or of ``count`` cages of which the second is the mirror image; none
    without a mesh."""
    if points is None or tets is None:
        return []
    first = points, tets[:, :4]
    solids = [first, mirrored_solid(*first)][:count]
    return [surface_of(own).polydata(at).triangulate() for at, own in solids]


def compose(
    figure: Any,
    picture: Picture,
    now: Instant,
    bearing: Bearing,
    top: float,
    *,
    load: Loads,
    title: str,
    note: str,
) -> None:
    """Lay the picture, its labels and the bars of forces out on a figure."""
    most = int(np.argmax(now.inner_load))
    head = f"t = {now.time * 1e3:.3f} ms"
    peak = f"most loaded: {now.element} {most}, {now.inner_load[most]:.0f} N"
    sheet.heading(figure, title, sheet.join([note, head, peak, "cut at mid-width"]))
    ax = sheet.image_at(figure, (EDGE, TOP, *MAIN), picture.pixels)
    label_bearing(ax, picture, now, bearing, top, load)
    left = EDGE + MAIN[0] + GAP
    _bars(figure, left, now, top)
    sheet.colour_bar(
        figure,
        (left, TOP + MAIN[1] - 78, SIDE_WIDTH, 26),
        cmap=sheet.colour_map("viridis"),
        limits=(0.0, top),
        label=f"normal force of the inner race on a {now.element.split()[-1]} [N]   (grey: none)",
        over=bool(now.inner_load.max() > top * 1.0001),
    )


def label_bearing(
    ax: Any,
    picture: Picture,
    now: Instant,
    bearing: Bearing,
    top: float,
    load: Loads,
) -> None:
    """Axes, numbers, spalls, spots, loads and speeds on a picture of the bearing."""
    marks.triad(ax, picture)
    mark_spalls(ax, picture, now, bearing)
    mark_spots(ax, picture, now, bearing)
    _load_labels(ax, picture, now, bearing, top)
    _middle(ax, picture, now, bearing, load)


def _load_labels(ax: Any, picture: Picture, now: Instant, b: Bearing, top: float) -> None:
    """Number of every element on its end, and the load of the loaded ones outside the ring."""
    end = np.array([shapes_of(b).end, 0.0, 0.0])
    for k, (_, r, psi) in enumerate(now.position):
        radial = np.array([0.0, np.cos(psi), np.sin(psi)])
        x, y = picture.place(r * radial + end)[0]
        text = ax.text(x, y, str(k), ha="center", va="center", fontsize=9, weight="bold")
        loaded = now.inner_load[k] > LOADED_SHARE * top
        if loaded and now.inner_load[k] < 0.6 * top:
            text.set_color("white")
        if loaded:
            x, y = picture.place(0.5 * 1.09 * b.outside_diameter * radial)[0]
            load = f"{now.inner_load[k]:.0f} N"
            ax.text(x, y, load, ha="center", va="center", fontsize=9.5, weight="bold")


def _middle(
    ax: Any,
    picture: Picture,
    now: Instant,
    b: Bearing,
    load: Loads,
) -> None:
    """Speeds in the bore, and the load's arrow."""
    half = np.array([0.5 * b.width, 0.0, 0.0])
    x, y = picture.place(half)[0]
    turn = "↺" if now.inner_speed > 0.0 else "↻"
    rpm = 30.0 / pi
    lines = (
        f"{turn} inner ring {now.inner_speed * rpm:.0f} rpm\n"
        f"{now.carrier} {now.carrier_speed * rpm:.0f} rpm"
    )
    radial, axial = load
    if axial:
        lines += f"\naxial load {axial:+.0f} N".replace("-", "−")
    shift = 0.0
    if radial is not None and np.hypot(*radial) > 0.0:
        way = np.array([0.0, *radial]) / np.hypot(*radial)
        a, tip = picture.place(np.array([half - 0.002 * way, half + 0.30 * b.bore * way]))
        ax.annotate(
            "",
            xy=tip,
            xytext=a,
            arrowprops={
                "arrowstyle": "simple,head_width=1.1,head_length=1.0,tail_width=0.35",
                "facecolor": sheet.INK,
                "edgecolor": "none",
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
        side = np.array([1.0, 0.0]) if abs(tip[1] - a[1]) > abs(tip[0] - a[0]) else np.array([0, 1])
        mx, my = 0.5 * (a + tip) + 18.0 * side
        ax.text(
            mx,
            my,
            f"{'radial' if axial else 'load'} {np.hypot(*radial):.0f} N",
            va="center",
            ha="left",
            fontsize=10,
            color=sheet.INK,
            weight="bold",
        )
        shift = -70.0 if tip[1] >= a[1] else 70.0
    ax.text(x, y + shift, lines, ha="center", va="center", fontsize=10, linespacing=1.5)


def _bars(figure: Any, left: float, now: Instant, top: float) -> None:
    """Race forces by element, pocket forces by pocket."""
    n = len(now.inner_load)
    height = 330
    ax = sheet.axes_at(figure, (left, TOP + 30, SIDE_WIDTH, height))
    k = np.arange(n)
    ax.bar(k - 0.21, now.inner_load, 0.4, color=sheet.BLUE, label="inner race")
    ax.bar(k + 0.21, now.outer_load, 0.4, color=sheet.SKY, label="outer race")
    ax.set(
        ylabel="race force [N]", xlabel=now.element, ylim=(0.0, 1.05 * max(top, *now.inner_load))
    )
    _bar_axis(ax, n)
    below = sheet.axes_at(figure, (left, TOP + 30 + height + 110, SIDE_WIDTH, height - 60))
    count = len(now.pocket)
    wide = min(0.5, 0.81 / count)
    for i, (name, values) in enumerate(now.pocket.items()):
        shift, label = (i - 0.5 * (count - 1)) * wide, name.removesuffix(" face")
        below.bar(k + shift, values, wide - 0.01, color=_FACE_COLOURS[i], label=label)
    most = max(float(values.max()) for values in now.pocket.values())
    what = "pocket" if now.cage is not None else now.element
    below.set(
        ylabel="pocket force [N]" if now.cage is not None else "force on the next [N]",
        xlabel=what,
        ylim=(0.0, sheet.rounded_up(1.02 * most)),
    )
    if not most:
        sheet.nothing(below, f"no {what} is touched")
    _bar_axis(below, n)


def _bar_axis(ax: Any, n: int) -> None:
    ax.set(xlim=(-0.6, n - 0.4), xticks=np.arange(0, n, 2 if n <= 30 else 5))
    ax.grid(axis="x", visible=False)
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderaxespad=0.2)
