"""Defects of ball cages on the mesh: walls moved and the rest drawn along, cracks opened.

A vertex of a pocket's wall keeps its angle about the pocket's axis and its distance from the cage's
axis, and moves to where the altered wall is at that angle. Around it the axial and the angular
displacement are harmonic functions (the finite-element solution of Laplace's equation on the
sound mesh) between the walls, the ends and the next sectors but one; lands stay cylinders.

A crack's faces are those of the elements on the two sides of the web's middle: their common
vertices beyond its tip are doubled.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import pi

import numpy as np
import scipy.sparse as sp

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import BallCageDefect, pocket_shapes
from flexcage.cages.round_pocket.shapes import PocketShapes, is_sphere, level_radius, wall_reach
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh, signed_volumes
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.sector import Quarter
from flexcage.mesh.with_defects import add_defects

_LEVELS = 60  # steps to where a sphere is at a vertex' distance from the axis; each gains a digit


def apply_ball_defects(
    mesh: CageMesh, cage: BallCage, defects: Sequence[BallCageDefect], *, pitch_radius: float
) -> CageMesh:
    """The undamaged mesh with all defects, each measured as it is added; InputError if inverted."""

    def add(_: CageMesh, i: int) -> CageMesh:
        return _with_defects(mesh, cage, defects[: i + 1], pitch_radius)

    return add_defects(mesh, cage, defects, pitch_radius=pitch_radius, add=add)


def _with_defects(
    sound: CageMesh, cage: BallCage, defects: Sequence[BallCageDefect], pitch_radius: float
) -> CageMesh:
    shapes = pocket_shapes(cage, defects, pocket_count=sound.pocket_count)
    points = move_walls(sound, cage, shapes, pitch_radius=pitch_radius)
    inverted = int((signed_volumes(points, sound.tets) <= 0.0).sum())
    if inverted:
        raise InputError(
            f"the defects invert {inverted} elements of the cage's mesh; make them smaller, or the "
            "mesh finer",
            where="defects",
            value=inverted,
        )
    mesh = replace(sound, points=points)
    for defect in defects:
        mesh = defect.opened(sound, mesh, cage)
    return mesh


def move_walls(
    mesh: CageMesh, cage: BallCage, shapes: PocketShapes, *, pitch_radius: float
) -> np.ndarray:
    """Places (n, 3) [m] of the vertices of an undamaged mesh when its pockets have these shapes."""
    count = mesh.pocket_count
    change = np.column_stack(
        [shapes.radius - 0.5 * cage.pocket_diameter, shapes.slot, shapes.centre]
    )
    altered = np.flatnonzero(change.any(axis=1))
    if not len(altered):
        return mesh.points
    azimuth = np.arctan2(mesh.points[:, 2], mesh.points[:, 1])
    step = 2.0 * pi / count
    difference = (azimuth[:, None] - step * altered + pi) % (2.0 * pi) - pi
    far = np.abs(difference).min(axis=1) > 1.5 * step * (1.0 - 1e-9)
    held = np.column_stack([far, far])  # axial, angular
    for name in ("end+x", "end-x"):
        held[np.unique(mesh.groups[name]), 0] = True
    moved = np.zeros((len(azimuth), 2))
    for k in range(count):
        wall = np.unique(mesh.groups[f"pocket{k}_wall"])
        held[wall] = True
        if k in altered:
            moved[wall] = _wall_steps(mesh.points[wall], k, cage, shapes, pitch_radius)
    return _moved(mesh.points, _harmonic(mesh.points, mesh.tets, moved, held))


def make_spherical(quarter: Quarter, cage: BallCage, *, pitch_radius: float) -> Quarter:
    """A quarter sector with a cylindrical pocket drawn to its sphere; cuts and lands stay."""
    held = np.zeros((len(quarter.points), 2), bool)  # axial, angular
    for name, column in (("cut_x", 0), ("end", 0), ("cut_z", 1), ("cut_psi", 0), ("cut_psi", 1)):
        held[np.unique(quarter.surfaces[name]), column] = True
    wall = np.unique(quarter.surfaces["wall"])
    held[wall] = True
    moved = np.zeros(held.shape)
    shapes = pocket_shapes(cage, (), pocket_count=1)
    moved[wall] = _wall_steps(quarter.points[wall], 0, cage, shapes, pitch_radius)
    points = _moved(quarter.points, _harmonic(quarter.points, quarter.tets, moved, held))
    for name, axis in (("cut_x", 0), ("cut_z", 2)):
        points[np.unique(quarter.surfaces[name]), axis] = 0.0
    return replace(quarter, points=points)


def _moved(points: np.ndarray, steps: np.ndarray) -> np.ndarray:
    """Points (n, 3) after axial [m] and angular [rad] steps (n, 2)."""
    c, s = np.cos(steps[:, 1]), np.sin(steps[:, 1])
    x, y, z = points.T
    return np.column_stack([x + steps[:, 0], c * y - s * z, s * y + c * z])


def _wall_steps(
    points: np.ndarray, pocket: int, cage: BallCage, shapes: PocketShapes, pitch_radius: float
) -> np.ndarray:
    """Axial [m] and angular [rad] steps (n, 2) of vertices of a wall to the altered one."""
    shift, arc = shapes.centre[pocket]
    x, y, t = in_pocket_frame(points, pocket, len(shapes.radius)).T
    direction = np.column_stack([x, t]) / np.hypot(x, t)[:, None]
    height = y
    for _ in range(_LEVELS if is_sphere(cage) else 1):
        circle = level_radius(cage, shapes.radius[pocket], height, pitch_radius)
        reach = wall_reach(direction, circle, shapes.slot[pocket])
        new_x, new_t = (reach[:, None] * direction).T
        height = np.sqrt(y**2 + t**2 - new_t**2)
    turn = np.arcsin(new_t / np.hypot(y, t)) - np.arctan2(t, y)
    return np.column_stack([new_x + shift - x, turn + arc / pitch_radius])


def _harmonic(
    points: np.ndarray, every: np.ndarray, values: np.ndarray, held: np.ndarray
) -> np.ndarray:
    """Each column of ``values`` (n, 2) where it is ``held``, and harmonic between."""
    from scipy.sparse.linalg import splu

    loose = ~(held[:, 0] & held[:, 1])
    tets = every[loose[every].any(axis=1)]
    corners = points[tets]
    edges = corners[:, 1:] - corners[:, :1]
    inverse = np.linalg.inv(edges)  # columns: gradients of the corners 1 to 3
    gradients = np.concatenate([-inverse.sum(axis=2, keepdims=True), inverse], axis=2)
    volumes = np.abs(np.linalg.det(edges)) / 6.0
    blocks = np.einsum("n,nai,naj->nij", volumes, gradients, gradients)
    rows, columns = np.repeat(tets, 4, axis=1).ravel(), np.tile(tets, (1, 4)).ravel()
    shape = (len(values), len(values))
    laplace = sp.coo_matrix((blocks.ravel(), (rows, columns)), shape).tocsr()
    values = values.copy()
    for column in range(values.shape[1]):
        free = np.flatnonzero(~held[:, column])
        fixed = np.flatnonzero(held[:, column])
        inner = laplace[free]
        load = -inner[:, fixed] @ values[fixed, column]
        values[free, column] = splu(inner[:, free].tocsc()).solve(load)
    return values
