"""The whole ring from part of a sector: mirrored in its planes of symmetry, then turned Z times.

A quarter is mirrored in z = 0 and x = 0; a half, which has no ``cut_x``, in z = 0 alone.
"""

from __future__ import annotations

from dataclasses import replace
from math import pi
from types import MappingProxyType

import numpy as np

from flexcage.mesh.cage_mesh import RING_GROUPS, CageMesh, pocket_groups
from flexcage.mesh.sector import Quarter


def ring_of(quarter: Quarter, pocket_count: int) -> CageMesh:
    """The whole ring from a quarter or half of a sector, numbered sector by sector.

    A sector owns its vertices but for those on its +psi cut, which are the next one's on its
    -psi cut: so vertex and cell numbers of sector k are those of sector 0 plus k times a constant.
    """
    number, base = _sector_numbers(quarter)
    n_sector = len(base)
    turns = [turn_about_x(2.0 * pi * k / pocket_count) for k in range(pocket_count)]
    points = np.vstack([base @ turn.T for turn in turns])
    cells, groups = _sector_cells(quarter, number)
    total = n_sector * pocket_count
    shift = n_sector * np.arange(pocket_count)
    tets = (cells[None] + shift[:, None, None]).reshape(-1, 4) % total
    named: dict[str, np.ndarray] = {
        name: ((groups[name][None] + shift[:, None, None]) % total).reshape(-1, 3)
        for name in RING_GROUPS
    }
    for k in range(pocket_count):
        for part in pocket_groups(f"pocket{k}_{name}" for name in groups):
            named[f"pocket{k}_{part}"] = (groups[part] + shift[k]) % total
    plan = quarter.plan
    info = {
        "source": "built",
        "sector_points": n_sector,
        "sector_cells": len(cells),
        "altered_sectors": (),
        "size": plan.size,
        "fillet_edges": plan.arc_edges,
        "defects": [],
    }
    mesh = CageMesh(points, tets, MappingProxyType(named), pocket_count, MappingProxyType(info))
    return replace(mesh, info=MappingProxyType({**info, "undamaged_volume": mesh.volume}))


_CUTS = {"cut_x", "cut_z", "cut_psi"}
_MIRRORS = ((1, 1), (-1, 1), (1, -1), (-1, -1))  # signs of x and z of the four copies


def _copies(quarter: Quarter) -> tuple[int, ...]:
    """Which of the four copies there are, the -psi half first: it owns the shared cuts."""
    return (2, 3, 0, 1) if "cut_x" in quarter.surfaces else (2, 0)


def _sector_numbers(quarter: Quarter) -> tuple[np.ndarray, np.ndarray]:
    """number (4, n): vertex of each mirror copy in sector numbering; points (n_sector, 3).

    Vertices on the +psi cut get the number of their partner on the -psi cut plus n_sector.
    """
    n = len(quarter.points)
    on = {}
    for name in ("cut_x", "cut_z", "cut_psi"):
        on[name] = np.zeros(n, bool)
        on[name][np.unique(quarter.surfaces.get(name, np.empty(0, int)))] = True
    number = np.full((4, n), -1)
    points: list[np.ndarray] = []
    count = 0
    for copy in _copies(quarter):
        sx, sz = _MIRRORS[copy]
        own = np.ones(n, bool)
        if sx < 0:
            own &= ~on["cut_x"]
        if sz > 0:
            own &= ~on["cut_z"] & ~on["cut_psi"]
        number[copy, own] = count + np.arange(own.sum())
        count += int(own.sum())
        points.append(quarter.points[own] * (sx, 1.0, sz))
    number[3] = np.where(on["cut_x"], number[2], number[3])
    for copy, below in ((0, 2), (1, 3)):
        number[copy] = np.where(on["cut_z"], number[below], number[copy])
        number[copy] = np.where(on["cut_psi"], number[below] + count, number[copy])
    number[1] = np.where(on["cut_x"], number[0], number[1])
    return number, np.vstack(points)


def _sector_cells(quarter: Quarter, number: np.ndarray) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Cells (n, 4) and groups of sector 0; mirrored copies would be inside out, so are flipped."""
    cells: list[np.ndarray] = []
    parts: dict[str, list[np.ndarray]] = {}
    for copy in sorted(_copies(quarter)):
        sx, sz = _MIRRORS[copy]
        order = [0, 2, 1, 3] if sx * sz < 0 else [0, 1, 2, 3]
        cells.append(number[copy][quarter.tets[:, order]])
        names = {
            "end": "end+x" if sx > 0 else "end-x",
            "beam": "front" if sz > 0 else "rear",
            "side": "side+x" if sx > 0 else "side-x",
        }
        for surface in quarter.surfaces.keys() - _CUTS:
            triangles = quarter.surfaces[surface][:, order[:3]]
            parts.setdefault(names.get(surface, surface), []).append(number[copy][triangles])
    return np.vstack(cells), {name: np.vstack(list_) for name, list_ in parts.items()}


def turn_about_x(angle: float) -> np.ndarray:
    """Rotation matrix about x by an angle from y towards z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
