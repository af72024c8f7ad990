"""Defects on a mesh: added one after another, each measured before and after."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from flexcage.geometry.defect import CageDefect, Reading
from flexcage.mesh.cage_mesh import CageMesh


def add_defects(
    sound: CageMesh,
    cage: Any,
    defects: Sequence[CageDefect],
    *,
    pitch_radius: float,
    add: Callable[[CageMesh, int], CageMesh],
) -> CageMesh:
    """The undamaged mesh with all defects; its ``info`` says what was asked and delivered.

    ``add(mesh, i)`` is a mesh that has the defects before i, with defect i as well.
    """
    mesh, volume = sound, sound.volume
    report: list[dict[str, Any]] = []
    for i, defect in enumerate(defects):
        before = defect.readings(mesh, cage, pitch_radius=pitch_radius)
        volume_before, mesh = mesh.volume, add(mesh, i)
        after = defect.readings(mesh, cage, pitch_radius=pitch_radius)
        change = (mesh.volume - volume_before) / volume
        for reading, was in zip(after, before, strict=True):
            moved = np.subtract(reading.measured, was.measured)
            row = _row(reading, float(np.mean(moved)), change)
            report.append({"kind": reading.kind, "defect": defect, **row})
    info = {
        **mesh.info,
        "defects": report,
        "volume_change": mesh.volume / volume - 1.0,
        "altered_sectors": _altered(sound, mesh),
    }
    return replace(mesh, info=MappingProxyType(info))


def with_measured(
    mesh: CageMesh, cage: Any, defects: Sequence[CageDefect], *, pitch_radius: float
) -> CageMesh:
    """A user's mesh whose ``info`` says what it has of the defects; there is no undamaged mesh to
    compare with."""
    readings = [r for d in defects for r in d.readings(mesh, cage, pitch_radius=pitch_radius)]
    rows = [_row(r, float(np.mean(r.measured)), float("nan")) for r in readings]
    return replace(mesh, info=MappingProxyType({**mesh.info, "defects": rows}))


def _row(reading: Reading, delivered: float, volume_change: float) -> dict[str, Any]:
    return {
        "kind": reading.kind,
        "asked": reading.asked,
        "delivered": delivered,
        "volume_change": volume_change,
    }


def _altered(sound: CageMesh, mesh: CageMesh) -> tuple[int, ...]:
    """Sectors that have a cell with a moved or doubled vertex; none of a mesh without sectors, or
    that lost cells."""
    per_sector = sound.info.get("sector_cells")
    if not isinstance(per_sector, int) or mesh.tets.shape != sound.tets.shape:
        return ()
    changed = (mesh.points[mesh.tets] != sound.points[sound.tets]).any(axis=(1, 2))
    changed |= (mesh.tets != sound.tets).any(axis=1)
    return tuple(int(k) for k in np.unique(np.flatnonzero(changed) // per_sector))
