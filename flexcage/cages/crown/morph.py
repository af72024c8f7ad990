"""Defects of crown cages on the mesh: claws bent, cracked off and taken away, walls worn.

Claws and bars part in the plane in which the bars end. Half of a sector above it is a claw. The
mesh has edges in that plane where a claw may break (``sector``).
"""

from __future__ import annotations

from dataclasses import replace
from math import pi
from types import MappingProxyType

import numpy as np

from flexcage.cages.crown.cage import CrownCage
from flexcage.geometry.defect import CageLine
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.doubling import opened_at
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.ring import turn_about_x
from flexcage.mesh.sector import orient_outward

_TINY = 1e-6  # over the cage's width
_LEVELS = 40  # steps, each of which gains a digit or nearly
_REACH = 0.8  # of the thinner one of claw and ring: how deep a worn wall draws the mesh along


def _on_side(points: np.ndarray, pocket: int, sign: float, count: int) -> np.ndarray:
    """Which of the points (n, 3) lie in the half of a sector in front of its pocket's middle
    (``sign`` 1) or behind it (-1)."""
    _, y, t = in_pocket_frame(points, pocket, count).T
    angle = sign * np.arctan2(t, y)
    return (angle > 0.0) & (angle < pi / count * (1.0 + 1e-9))


def _cells_of_claw(
    mesh: CageMesh, cells: np.ndarray, cage: CrownCage, pocket: int, sign: float
) -> np.ndarray:
    """Which cells (n, .) belong to a claw."""
    return _of_claw(mesh.points[cells].mean(axis=1), cage, pocket, sign, mesh.pocket_count)


def _of_claw(
    points: np.ndarray, cage: CrownCage, pocket: int, sign: float, count: int
) -> np.ndarray:
    """Which points (n, 3) are those of a claw."""
    return (points[:, 0] > cage.bar_height) & _on_side(points, pocket, sign, count)


def bent_share(x: np.ndarray, cage: CrownCage) -> np.ndarray:
    """Deflection at places x [m] over that of the tip: a cantilever's with a force at its tip."""
    along = np.clip((x - cage.bar_height) / (cage.tip - cage.bar_height), 0.0, 1.0)
    return 0.5 * along**2 * (3.0 - along)


def bend_claw(
    mesh: CageMesh, cage: CrownCage, pocket: int, sign: float, deflection: float
) -> CageMesh:
    """A mesh with a claw bent away from its ball by the deflection [m] of its tip."""
    count, points = mesh.pocket_count, np.array(mesh.points)
    own = _on_side(points, pocket, sign, count) & (points[:, 0] > cage.bar_height)
    step = sign * deflection * bent_share(points[own, 0], cage)
    way = np.array([0.0, 0.0, 1.0]) @ turn_about_x(2.0 * pi * pocket / count).T
    points[own] += step[:, None] * way
    return replace(mesh, points=points)


def tip_place(mesh: CageMesh, cage: CrownCage, pocket: int, sign: float) -> float:
    """Mean distance [m] of a tip's vertices from the pocket's middle plane less that of the sound
    tip; zero where there is none."""
    tips = mesh.points[np.unique(mesh.groups["end+x"])]
    own = tips[_on_side(tips, pocket, sign, mesh.pocket_count)]
    other = tips[_on_side(tips, pocket, -sign, mesh.pocket_count)]
    if not len(own) or len(own) != len(other):
        return 0.0
    middles = [
        float(np.mean(in_pocket_frame(p, pocket, mesh.pocket_count)[:, 2])) for p in (own, other)
    ]
    return sign * sum(middles)


def wear_pocket(mesh: CageMesh, cage: CrownCage, pocket: int, depth: float) -> CageMesh:
    """A mesh whose pocket's wall went outwards by ``depth`` [m], and what is beyond with it.

    Vertices keep their distance from the cage's axis; towards the opening those of the wall keep
    their height, so that tips stay where they are.
    """
    radius, count = 0.5 * cage.pocket_diameter, mesh.pocket_count
    x, y, t = in_pocket_frame(mesh.points, pocket, count).T
    pitch = _pitch(mesh, pocket)
    height = y - pitch
    away = np.sqrt(x**2 + height**2 + t**2)
    thick = _REACH * min(cage.claw_thickness, cage.ring_thickness)
    share = np.clip(1.0 - (away - radius) / thick, 0.0, 1.0)
    own = np.flatnonzero((share > 0.0) & (y > 0.0))
    on_wall = radius / away[own]
    wx, wh, wt = x[own] * on_wall, height[own] * on_wall, t[own] * on_wall
    level, reach, h = radius**2 - wh**2, np.hypot(pitch + wh, wt), wh
    for _ in range(_LEVELS):  # to where the worn wall is at that distance from the cage's axis
        worn = (radius + depth) ** 2 - h**2
        grown = np.sqrt(worn / level)
        new_x = np.where(wx > 0.0, wx, wx * grown)
        ahead = np.sign(wt) * np.sqrt(np.maximum(worn - wx**2, 0.0))
        new_t = np.where(wx > 0.0, ahead, wt * grown)
        h = np.sqrt(reach**2 - new_t**2) - pitch
    step_x, step_t = share[own] * (new_x - wx), share[own] * (new_t - wt)
    around = np.hypot(y[own], t[own])
    turn = np.arcsin((t[own] + step_t) / around) - np.arcsin(t[own] / around)
    points = np.array(mesh.points)
    c, s = np.cos(turn), np.sin(turn)
    _, py, pz = points[own].T
    points[own] = np.column_stack([x[own] + step_x, c * py - s * pz, s * py + c * pz])
    return replace(mesh, points=points)


def _pitch(mesh: CageMesh, pocket: int) -> float:
    """Radius [m] of the middle of a pocket's sphere, by its wall's lowest and widest vertices."""
    wall = mesh.points[np.unique(mesh.groups[f"pocket{pocket}_wall"])]
    at = in_pocket_frame(wall, pocket, mesh.pocket_count)
    system = np.column_stack([2.0 * at[:, 1], np.ones(len(at))])
    # x^2 + (y - p)^2 + t^2 = R^2 about (0, p, 0): linear in p and R^2 - p^2
    middle, _ = np.linalg.lstsq(system, (at**2).sum(axis=1), rcond=None)[0]
    return float(middle)


def pocket_radius(mesh: CageMesh, pocket: int, pitch_radius: float) -> float:
    """Mean radius [m] of a pocket's wall about the ball's middle."""
    wall = mesh.points[np.unique(mesh.groups[f"pocket{pocket}_wall"])]
    at = in_pocket_frame(wall, pocket, mesh.pocket_count) - (0.0, pitch_radius, 0.0)
    return float(np.linalg.norm(at, axis=1).mean())


def crack_claw(
    sound: CageMesh, mesh: CageMesh, cage: CrownCage, pocket: int, sign: float, front: float
) -> CageMesh:
    """``mesh``, numbered as ``sound`` but for earlier cracks, with a claw cracked as well, from the
    bore to the radius ``front`` [m]."""
    tiny = _TINY * cage.width
    claw = _cells_of_claw(sound, sound.tets, cage, pocket, sign)
    shared = np.intersect1d(sound.tets[claw], sound.tets[~claw])
    inside = np.hypot(*sound.points[shared, 1:].T) < front - tiny
    old = shared[inside & (np.abs(sound.points[shared, 0] - cage.bar_height) < tiny)]
    return opened_at(
        sound, mesh, old, lambda middles: _of_claw(middles, cage, pocket, sign, sound.pocket_count)
    )


def _doubled(points: np.ndarray, pocket: int, sign: float, count: int) -> np.ndarray:
    """Vertices (n,) beside a pocket that lie on another one."""
    own = np.flatnonzero(_on_side(points, pocket, sign, count))
    _, number, times = np.unique(
        np.round(points[own], 12), axis=0, return_inverse=True, return_counts=True
    )
    return own[times[number.ravel()] > 1]


def crack_depth(mesh: CageMesh, cage: CrownCage, pocket: int, sign: float) -> float:
    """Depth [m] of the crack under a claw from the bore: as far as faces in its plane are free."""
    doubled = _doubled(mesh.points, pocket, sign, mesh.pocket_count)
    if not len(doubled):
        return 0.0
    at_root = np.abs(mesh.points[:, 0] - cage.bar_height) < _TINY * cage.width
    near = np.isin(mesh.tets, doubled).any(axis=1)
    corners = mesh.tets[near]
    flat = at_root[corners] & (at_root[corners].sum(axis=1) == 3)[:, None]
    faces = corners[flat].reshape(-1, 3)
    faces = faces[np.isin(faces, doubled).any(axis=1)]
    radius = np.hypot(*mesh.points[np.unique(faces), 1:].T)
    return float(radius.max() - 0.5 * cage.bore)


def without_claw(mesh: CageMesh, cage: CrownCage, pocket: int, sign: float) -> CageMesh:
    """A mesh without a claw; its sectors are of no even numbering any more."""
    kept = mesh.tets[~_cells_of_claw(mesh, mesh.tets, cage, pocket, sign)]
    used = np.unique(kept)
    number = np.full(len(mesh.points), -1)
    number[used] = np.arange(len(used))
    points, tets = mesh.points[used], number[kept]
    groups = {}
    for name, part in mesh.groups.items():
        left = number[part]
        left = orient_outward(points, tets, left[(left >= 0).all(axis=1)])
        groups[name] = left[(left >= 0).all(axis=1)]
    uneven = ("sector_points", "sector_cells", "doubled")
    info = {key: value for key, value in mesh.info.items() if key not in uneven}
    return replace(
        mesh, points=points, tets=tets, groups=MappingProxyType(groups),
        info=MappingProxyType(info),
    )  # fmt: skip


def missing_height(mesh: CageMesh, cage: CrownCage, pocket: int, sign: float) -> float:
    """How much lower [m] than tips the mesh ends beside a pocket."""
    own = mesh.points[_on_side(mesh.points, pocket, sign, mesh.pocket_count)]
    return cage.tip - float(own[:, 0].max())


def doubled_line(points: np.ndarray, count: int, pocket: int, sign: float) -> list[CageLine]:
    """The mouth of a crack on the bore."""
    own = points[_doubled(points, pocket, sign, count)]
    return _line(own, pocket, count, inner=True)


def broken_line(points: np.ndarray, count: int, pocket: int, sign: float) -> list[CageLine]:
    """The edge of bar and broken claw on the cage's outside."""
    own = points[_on_side(points, pocket, sign, count)]
    top = own[own[:, 0] > own[:, 0].max() - _TINY * np.ptp(points[:, 0])]
    return _line(top, pocket, count, inner=False)


def _line(own: np.ndarray, pocket: int, count: int, *, inner: bool) -> list[CageLine]:
    """Through those points that lie innermost or outermost, along the circumference."""
    if len(own) < 2:
        return []
    radius = np.hypot(own[:, 1], own[:, 2])
    edge = radius.min() if inner else radius.max()
    on = own[np.abs(radius - edge) < 1e-4 * edge]
    on = on[np.argsort(in_pocket_frame(on, pocket, count)[:, 2])]
    return [CageLine(on, on[len(on) // 2])]
