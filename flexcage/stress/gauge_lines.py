"""Lines on a cage's surface along which strain gauges lie, and the strain along them.

The strain of a gauge is the change of its line's length over that length, so the mean of the normal
strain along it. The line is sought on the mesh by rays, radial ones on the outside and inside,
axial ones on the ends; displacements are those of the surface's elements, without any smoothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.units import describe
from flexcage.fem.model import FEModel, triangle_shapes
from flexcage.fem.submodel import row_of
from flexcage.mesh.rows import RowFrame, rows_in
from flexcage.modes.pockets import frames_at
from flexcage.results.signals.spec import ENDS, StrainGauge

PIECES = 16  # of a line
_CLOSE = 1e-9  # of a triangle, by which a ray may miss it: two share each edge
_STEEP = 1.0  # rise over run from point to point of a line, above which the surface has a step


@dataclass(frozen=True)
class GaugeLine:
    """Points (n, 3) [m] of a gauge on boundary triangles (n,) of a model, with barycentric
    coordinates (n, 3) there."""

    points: np.ndarray
    triangles: np.ndarray
    barycentric: np.ndarray

    def row(self, model: FEModel) -> np.ndarray:
        """What each displacement of a node (3N,) adds to the strain [1/m]."""
        steps = np.diff(self.points, axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        pull = steps / lengths[:, None] / lengths.sum()
        ends = np.zeros_like(self.points)
        ends[1:] += pull
        ends[:-1] -= pull
        nodes = model.face_nodes(model.surface[self.triangles])
        shapes = triangle_shapes(self.barycentric.T[1:], model.order).T
        row = np.zeros((len(model.nodes), 3))
        np.add.at(row, nodes, shapes[:, :, None] * ends[:, None, :])
        return row.ravel()


def gauge_rows(
    model: FEModel, gauges: Sequence[StrainGauge], pocket_count: int, radius: float
) -> np.ndarray:
    """Strains per displacement of nodes (n_gauges, 3N); ``radius`` [m] of the middle of the cage's
    wall. InputError for a gauge that does not lie on the cage's surface."""
    return np.stack([gauge_line(model, g, pocket_count, radius).row(model) for g in gauges])


def gauge_line(model: FEModel, gauge: StrainGauge, pocket_count: int, radius: float) -> GaugeLine:
    """The line of a gauge; arguments as in ``gauge_rows``."""
    azimuth = gauge.azimuth
    if gauge.crossbeam is not None:
        azimuth += _azimuth_of(model, gauge.crossbeam, pocket_count)
    s = gauge.grid * (np.arange(PIECES + 1) / PIECES - 0.5)
    end = gauge.side in ENDS
    place = (gauge.radius or radius) if end else gauge.plane
    around = np.full(len(s), azimuth)
    along = np.full(len(s), place)
    if gauge.along == "circumferential":
        middle = place if end else _radius(model, gauge, place, azimuth)
        around = around + s / middle
    else:
        along = along + s
    line = _found(model, gauge, *_rays(gauge.side, around, along))
    _check(model, gauge, line)
    return line


def _azimuth_of(model: FEModel, crossbeam: int, pocket_count: int) -> float:
    """Azimuth [rad] of the middle of a crossbeam of a cage with so many pockets in all rows."""
    rows = rows_in(model.info) or (RowFrame(),)
    row, own = divmod(crossbeam, pocket_count // len(rows))
    return rows[row].turned + 2.0 * pi * (own - 0.5) / (pocket_count // len(rows))


def _rays(side: str, azimuth: np.ndarray, place: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Origins and directions (n, 3): from the axis outwards, or towards +x at a radius."""
    x, r, _ = np.moveaxis(frames_at(azimuth), -2, 0)
    return (place[:, None] * r, x) if side in ENDS else (place[:, None] * x, r)


def _radius(model: FEModel, gauge: StrainGauge, plane: float, azimuth: float) -> float:
    middle = _found(model, gauge, *_rays(gauge.side, np.array([azimuth]), np.array([plane])))
    return float(np.hypot(*middle.points[0, 1:]))


def _found(
    model: FEModel, gauge: StrainGauge, origin: np.ndarray, direction: np.ndarray
) -> GaugeLine:
    """The first or the last point of the surface along each ray."""
    corners = model.points[model.surface]
    hits = [_hit(corners, *ray, gauge.side) for ray in zip(origin, direction)]
    if any(hit is None for hit in hits):
        raise _nowhere(gauge, "the cage has a pocket or ends there")
    far, triangle, barycentric = zip(*(hit for hit in hits if hit is not None))
    points = origin + np.array(far)[:, None] * direction
    return GaugeLine(points, np.array(triangle), np.array(barycentric))


def _hit(
    corners: np.ndarray, origin: np.ndarray, direction: np.ndarray, side: str
) -> tuple[float, int, np.ndarray] | None:
    """Distance along a ray, triangle and barycentric coordinates (3,) where it meets a side, of
    triangles (n, 3, 3); None where it does not (Moller and Trumbore, J. Graphics Tools 2 (1997)
    21)."""
    first = corners[:, 0]
    one, two = corners[:, 1] - first, corners[:, 2] - first
    across = np.cross(direction, two)
    det = np.einsum("ij,ij->i", one, across)
    with np.errstate(divide="ignore", invalid="ignore"):
        back = origin - first
        u = np.einsum("ij,ij->i", back, across) / det
        turned = np.cross(back, one)
        v = turned @ direction / det
        t = np.einsum("ij,ij->i", two, turned) / det
        inside = (u >= -_CLOSE) & (v >= -_CLOSE) & (u + v <= 1.0 + _CLOSE)
    inside &= np.isfinite(t) & ((t > 0.0) | (side in ENDS))
    if not inside.any():
        return None
    hit = np.flatnonzero(inside)
    k = hit[np.argmax(t[hit]) if side in ("outside", "+x") else np.argmin(t[hit])]
    return float(t[k]), int(k), np.array([1.0 - u[k] - v[k], u[k], v[k]])


def _check(model: FEModel, gauge: StrainGauge, line: GaugeLine) -> None:
    """InputError for a line over a step of the surface, or in a pocket."""
    steps = np.diff(line.points, axis=0)
    rise = np.abs(steps[:, 0] if gauge.side in ENDS else np.diff(np.hypot(*line.points[:, 1:].T)))
    run = gauge.grid / PIECES
    if (rise > _STEEP * run).any():
        raise _nowhere(gauge, "the surface has an edge under its grid")
    walls = [t for name, t in model.groups.items() if name.startswith("pocket")]
    if walls:
        own = np.sort(model.surface[line.triangles], axis=1)
        every = np.sort(np.concatenate(walls), axis=1)
        if (row_of(every, own) >= 0).any():
            raise _nowhere(gauge, "the surface there is the wall of a pocket")


def _nowhere(gauge: StrainGauge, why: str) -> InputError:
    where = f"azimuth {describe(gauge.azimuth, 'deg')}"
    if gauge.crossbeam is not None:
        where += f" from crossbeam {gauge.crossbeam}"
    if gauge.side in ENDS:
        at = f"radius {describe(gauge.radius, 'mm')}" if gauge.radius else "the wall's middle"
    else:
        at = f"plane {describe(gauge.plane, 'mm')}"
    return InputError(
        f"The strain gauge '{gauge.name}' ({gauge.side}, {where}, {at}, grid "
        f"{describe(gauge.grid, 'mm')} {gauge.along}) does not lie on the cage's surface: {why}; "
        "give another place or a shorter grid.",
        where="sensors",
        value=gauge.name,
    )
