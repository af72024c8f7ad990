"""The face in which the two halves of a common cage hold together, meshed so that its nodes meet
those of the other half, in line with it or turned by half a pitch.

A regular grid with an even number of steps over half a sector, and diagonals that alternate, is
its own mirror image about a quarter of a pitch; sectors are mirror images about their middles. So a
turn by half a pitch takes the whole face into itself: half a sector of one row is meshed, as for a
single row, rather than a wedge of both, and rows in line and staggered ones are made alike.
"""

from __future__ import annotations

from math import ceil, pi
from typing import Any

import numpy as np

from flexcage.core.errors import RunFailed
from flexcage.mesh.sector import MM, SizePlan

_FLAT = 1e-3  # mm: extent of a plane face along x, in which boxes are rounded


def set_joint(gmsh: Any, plan: SizePlan, place: float) -> None:
    """Grid on the plane face at x = ``place`` [m] of a part of a sector, whose edges lie along the
    radius, in pieces maybe, or around."""
    tag, mesh = _face_at(gmsh, place / MM), gmsh.model.mesh
    edges = [t for _, t in gmsh.model.getBoundary([(2, tag)], combined=False, oriented=False)]
    length = {edge: gmsh.model.occ.getMass(1, edge) for edge in edges}
    arcs = [edge for edge in edges if _around(gmsh, edge)]
    around = 2 * max(1, ceil(0.5 * max(length[edge] for edge in arcs) * MM / plan.size))
    ends = set(_ends(gmsh, arcs))
    radial = [edge for edge in edges if edge not in arcs]
    whole = [edge for edge in radial if set(_ends(gmsh, [edge])) <= ends]
    up = max(len(radial) - len(whole), round(length[whole[0]] * MM * plan.stretch / plan.size), 1)
    for edge in edges:
        steps = around if edge in arcs else up
        mesh.setTransfiniteCurve(edge, 1 + steps)
    _share(gmsh, [edge for edge in radial if edge not in whole], length, up)
    mesh.setTransfiniteSurface(tag, "AlternateRight", sorted(ends))


def _share(gmsh: Any, pieces: list[int], length: dict[int, float], steps: int) -> None:
    """Steps of an edge in two pieces, in proportion to their lengths."""
    if not pieces:
        return
    first, second = pieces
    share = round(steps * length[first] / (length[first] + length[second]))
    share = min(max(share, 1), steps - 1)
    for edge, own in ((first, share), (second, steps - share)):
        gmsh.model.mesh.setTransfiniteCurve(edge, 1 + own)


def _ends(gmsh: Any, edges: list[int]) -> list[int]:
    found = gmsh.model.getBoundary([(1, e) for e in edges], combined=False, oriented=False)
    return [tag for _, tag in found]


def _around(gmsh: Any, edge: int) -> bool:
    return gmsh.model.getType(1, edge) != "Line" or _height(gmsh, edge) < _FLAT


def _height(gmsh: Any, edge: int) -> float:
    box = gmsh.model.getBoundingBox(1, edge)
    return float(box[4] - box[1])


def _face_at(gmsh: Any, place: float) -> int:
    """Tag of the one face in the plane x = place [mm]."""
    found = []
    for _, tag in gmsh.model.getEntities(2):
        box = gmsh.model.getBoundingBox(2, tag)
        if abs(box[0] - place) < _FLAT and abs(box[3] - place) < _FLAT:
            found.append(tag)
    if len(found) != 1:
        raise RunFailed(f"one face was expected where two halves meet, not {len(found)}")
    return found[0]


def spread_evenly(points: np.ndarray, face: np.ndarray, pocket_count: int) -> np.ndarray:
    """Points (n, 3) of a part of a sector with those of the ``face``, vertices (m,), at even steps
    of azimuth and of radius, at which they nearly are."""
    step, moved = pi / pocket_count, points.copy()
    radius = np.hypot(points[face, 1], points[face, 2])
    azimuth = np.arctan2(points[face, 2], points[face, 1])
    around = int((radius > radius.max() * (1.0 - 1e-9)).sum())
    up = len(face) // around
    ray = np.argsort(np.argsort(azimuth, kind="stable")) // up
    order = np.lexsort((radius, ray))
    grid = np.arange(len(face))
    azimuth = step * (grid // up) / (around - 1)
    radius = np.linspace(radius.min(), radius.max(), up)[grid % up]
    placed = face[order]
    moved[placed, 1], moved[placed, 2] = radius * np.cos(azimuth), radius * np.sin(azimuth)
    return moved
