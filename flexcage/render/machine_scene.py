"""A machine in three dimensions: the shaft, its discs and bearings, elements coloured by load."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.render import sheet
from flexcage.render.bearing_pictures import bearing_layers, instant, load_limit, whole_cages
from flexcage.render.scene import Layer, View, body_layer
from flexcage.render.solids import revolved
from flexcage.render.stage import shoot
from flexcage.results.each_cage import cage_count

if TYPE_CHECKING:
    import pyvista
    import xarray

SIZE = (1500, 720)
_TOP, _EDGE, _BAR = 96, 36, 120
_STEEL, _DISC = "#c3cad2", "#a9b4bf"
_LEAN = (0.42, 0.30, 1.0)  # from where it is seen: along z, a little from the right and above
_MARGIN = 1.12
_OTHER_WAY = np.array([-1.0, 1.0, -1.0])  # half a turn about y


@dataclass(frozen=True)
class BearingInPlace:
    """A bearing's run with its middle on the shaft [m], whether it faces the other way, and its
    cage's mesh, if it has one."""

    name: str
    data: xarray.Dataset
    bearing: Bearing
    place: float
    reversed: bool
    points: np.ndarray | None
    tets: np.ndarray | None


def machine_scene(
    bearings: Sequence[BearingInPlace], sections: np.ndarray, discs: np.ndarray,
    path: str | Path, *, index: int, title: str,
) -> Path:  # fmt: skip
    """Sample ``index`` of a machine's run. ``sections`` (k, 4) of begin, end, outside and inside
    diameter, ``discs`` (k, 3) of place, diameter and width [m]. The near half of cages is cut off.
    """
    top = max(load_limit(each.data) for each in bearings)
    layers = [_solid(begin, end, out, bore, _STEEL) for begin, end, out, bore in sections]
    layers += [_solid(x - 0.5 * w, x + 0.5 * w, d, 0.0, _DISC) for x, d, w in discs]
    for each in bearings:
        layers += _placed(each, index, top)
    ends = sections[:, :2]
    tall = max([b.bearing.outside_diameter for b in bearings] + [*discs[:, 1]])
    picture = shoot(layers, _view(float(ends.min()), float(ends.max()), float(tall)), SIZE)
    time = float(bearings[0].data["time"][index])
    with sheet.style():
        figure = sheet.new_figure(SIZE[0] + 2 * _EDGE, _TOP + SIZE[1] + _BAR)
        note = f"t = {time * 1e3:.3f} ms   ·   the near half of cages is cut off"
        sheet.heading(figure, sheet.label(title), note)
        ax = sheet.image_at(figure, (_EDGE, _TOP, *SIZE), picture.pixels)
        for k, each in enumerate(bearings):
            above = np.array([each.place, 0.58 * each.bearing.outside_diameter, 0.0])
            x, y = picture.place(above)[0] - np.array([0.0, 26.0 * (k % 2)])  # names side by side
            ax.text(x, y, each.name, ha="center", va="bottom", fontsize=11, weight="bold")
        sheet.colour_bar(
            figure, (_EDGE, _TOP + SIZE[1] + 18, SIZE[0], 24), cmap=sheet.colour_map("viridis"),
            limits=(0.0, top), label="normal force of the inner race on an element [N]",
        )  # fmt: skip
        return sheet.save(figure, path)


def _view(begin: float, end: float, tall: float) -> View:
    direction = np.array(_LEAN) / np.linalg.norm(_LEAN)
    across = (end - begin) * float(np.hypot(direction[1], direction[2])) + tall * direction[0]
    height = _MARGIN * max(across * SIZE[1] / SIZE[0], 1.25 * tall)
    return View(
        tuple(map(float, direction)), (0.5 * (begin + end), 0.0, 0.0), height, up=(0.0, 1.0, 0.0)
    )


def _solid(begin: float, end: float, outside: float, bore: float, colour: str) -> Layer:
    corners = ((begin, 0.5 * bore), (end, 0.5 * bore), (end, 0.5 * outside), (begin, 0.5 * outside))
    return body_layer(revolved([*corners]), colour=colour)


def _placed(each: BearingInPlace, index: int, top: float) -> list[Layer]:
    """Layers of a bearing's run where it stands on the shaft."""
    near = -1.0 if each.reversed else 1.0  # of its own z, what the viewer has before him
    cages = [
        whole.clip_closed_surface(normal=(0.0, 0.0, -near), origin=(0.0, 0.0, 0.0))
        for whole in whole_cages(each.points, each.tets, cage_count(each.data))
    ]
    found = bearing_layers(instant(each.data, index), each.bearing, cages, top)
    return [replace(layer, mesh=_moved(layer.mesh, each)) for layer in found]


def _moved(mesh: pyvista.PolyData, each: BearingInPlace) -> pyvista.PolyData:
    moved = mesh.copy()
    points = np.asarray(mesh.points) * (_OTHER_WAY if each.reversed else 1.0)
    moved.points = points + np.array([each.place, 0.0, 0.0])
    if "Normals" in moved.point_data and each.reversed:
        moved.point_data["Normals"] = np.asarray(mesh.point_data["Normals"]) * _OTHER_WAY
    return moved
