"""A pocket of the cage with its rolling element, from outside: stress where an element presses."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.digits import number_text
from flexcage.geometry.bearing import Bearing
from flexcage.mesh.rows import pockets_at, row_frames
from flexcage.render import marks, sheet
from flexcage.render.bearing_pictures import IDLE, element_points
from flexcage.render.instant import Instant
from flexcage.render.scene import (
    View,
    body_layer,
    coloured_layer,
    outline_layer,
    ring_size,
    surface_of,
    surface_vertices,
)
from flexcage.render.shapes import shapes_of
from flexcage.render.solids import revolved, rotation
from flexcage.render.stage import Stage

if TYPE_CHECKING:
    import pyvista

SIZE = (900, 760)  # pixels of each of two views
TOP, GAP, EDGE, BAR = 96, 24, 36, 130
SEEN = 1.9  # seen width over the pitch of pockets
MPA = 1e-6  # per Pa
ELEVATION = 24.0  # [deg] of the second view above the plane of the ring


def pocket_picture(
    points: np.ndarray,
    tets: np.ndarray,
    displacement: np.ndarray,
    von_mises: np.ndarray,
    path: str | Path,
    *,
    shown: Instant,
    bearing: Bearing,
    pitch_radius: float,
    pocket: int,
    limit: float | None = None,
    note: str = "",
) -> Path:
    """Equivalent stress [Pa] of the cage about one pocket, and its element where it is in the
    cage's frame: from outside along the radius, the bearing's axis upwards, and from above.

    The cage is deformed in scale. ``pitch_radius`` [m] is that of the pockets' middles; ``limit``
    [Pa] fixes the colour range.
    """
    stress, surface, vertices = MPA * von_mises, surface_of(tets), surface_vertices(tets)
    near = stress[vertices[_near(points[vertices], pocket, bearing)]]
    top, over = sheet.robust_limit(near)
    if limit is not None:
        top, over = MPA * limit, bool(near.max() > MPA * limit)
    cmap = sheet.colour_map("viridis")
    moved = surface.polydata(points + displacement, stress)
    element = element_in_pocket(shown, bearing, pocket)
    layers = [
        coloured_layer(moved, cmap=cmap, limits=(0.0, top)),
        outline_layer(moved, colour="#101010", width=0.25, opacity=0.35),
        body_layer(element, colour=IDLE),
        outline_layer(element, colour="#30363c", width=0.3),
    ]
    with sheet.style():
        figure = sheet.new_figure(2 * SIZE[0] + GAP + 2 * EDGE, TOP + SIZE[1] + BAR)
        parts = [note, f"t = {shown.time * 1e3:.3f} ms", *_forces(shown, pocket)]
        title = f"Pocket {pocket} with its {shown.element}"
        sheet.heading(figure, title, sheet.join([*parts, "deformation in scale"]))
        with Stage(layers) as stage:
            for k, elevation in enumerate((0.0, ELEVATION)):
                shot = stage.shoot(_view(points, (bearing, pocket), pitch_radius, elevation), SIZE)
                place = (EDGE + k * (SIZE[0] + GAP), TOP, *SIZE)
                marks.length_bar(
                    sheet.image_at(figure, place, shot.pixels, frame=sheet.FAINT), shot
                )
        rect = (EDGE, TOP + SIZE[1] + 34, 2 * SIZE[0] + GAP, 26)
        label = "equivalent stress [MPa]"
        sheet.colour_bar(figure, rect, cmap=cmap, limits=(0.0, top), label=label, over=over)
        return sheet.save(figure, path)


def element_in_pocket(now: Instant, bearing: Bearing, pocket: int) -> pyvista.PolyData:
    """The rolling element of a pocket at its place in the cage's frame."""
    assert now.cage is not None, "a pocket is a cage's"
    body = revolved(shapes_of(bearing).element, segments=72)
    centre, quaternion = now.cage
    body.points = (element_points(body.points, now, pocket) - centre) @ rotation(quaternion)
    return body


def nearest_pocket(point: np.ndarray, bearing: Bearing) -> int:
    """The pocket of a bearing's cage whose middle is nearest to a point (3,) of it in azimuth, of
    the row that is nearest to it."""
    rows = row_frames(bearing.row_places, [1.0] * bearing.row_count)
    return int(pockets_at(point[None], bearing.element_count, rows)[0])


def _near(points: np.ndarray, pocket: int, bearing: Bearing) -> np.ndarray:
    """Which points lie within a pitch of the pocket's middle."""
    away = np.arctan2(points[:, 2], points[:, 1]) - bearing.element_azimuths[pocket]
    pitch: float = 2.0 * pi / bearing.element_count
    return np.abs((away + pi) % (2.0 * pi) - pi) < pitch


def _view(points: np.ndarray, which: tuple[Bearing, int], middle: float, elevation: float) -> View:
    """At a pocket of a bearing's cage from outside, the axis upwards; ``middle`` [m] is the radius
    of pockets' middles; ``elevation`` [deg] above the ring's plane."""
    bearing, pocket = which
    count, e = bearing.element_count, np.deg2rad(elevation)
    psi, place = bearing.element_azimuths[pocket], bearing.row_places[pocket // count].place
    radial = np.array([0.0, np.cos(psi), np.sin(psi)])
    direction = np.cos(e) * radial + np.array([np.sin(e), 0.0, 0.0])
    apart, (_, width) = 2.0 * np.sin(pi / count) * middle, ring_size(points)
    height = max(SEEN * apart * SIZE[1] / SIZE[0], 1.15 * width)
    return View(tuple(direction), (place, *(middle * radial)[1:]), float(height))


def _forces(shown: Instant, pocket: int) -> list[str]:
    """What presses in the pocket, in words."""
    forces = {name: float(found[pocket]) for name, found in shown.pocket.items()}
    pressed = [f"{name} {number_text(force)} N" for name, force in forces.items() if force > 0.0]
    return pressed or ["nothing presses in it"]
