"""Defects of window cages on the mesh: smooth displacements of its vertices, and crossbeams that
are broken in two."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from flexcage.cages.window.defects import WindowDefect
from flexcage.cages.window.windowed import WindowedCage
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh, signed_volumes
from flexcage.mesh.doubling import doubled, opened_at
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.with_defects import add_defects

MOST_CHANGE = 1e-3  # of the volume, by one defect


def apply_defects(
    sound: CageMesh, cage: WindowedCage, defects: Sequence[WindowDefect], *, pitch_radius: float
) -> CageMesh:
    """The undamaged mesh with all defects, each measured as it is added; InputError if inverted."""

    def add(mesh: CageMesh, i: int) -> CageMesh:
        step = defects[i].displace(sound.points, cage, pocket_count=sound.pocket_count)
        every = np.append(np.arange(len(step)), np.array(doubled(mesh), int))
        return defects[i].opened(sound, replace(mesh, points=mesh.points + step[every]), cage)

    mesh = add_defects(sound, cage, defects, pitch_radius=pitch_radius, add=add)
    report: Sequence[Mapping[str, Any]] = mesh.info["defects"]  # type: ignore[assignment]
    _refuse_inverted(mesh, report)
    _refuse_swollen(report, defects)
    return mesh


def _refuse_inverted(mesh: CageMesh, report: Sequence[Mapping[str, Any]]) -> None:
    inverted = int((signed_volumes(mesh.points, mesh.tets) <= 0.0).sum())
    if inverted:
        worst = max((row["asked"] for row in report), key=abs, default=None)
        largest = "" if worst is None else f"; the largest displacement, {worst * 1e3:g} mm,"
        raise InputError(
            f"the defects invert {inverted} elements{largest or ', which'} is too much for this "
            "cage",
            where="defects",
            value=worst,
        )


def _refuse_swollen(report: Sequence[Mapping[str, Any]], defects: Sequence[WindowDefect]) -> None:
    for found in report:
        change = found["volume_change"]
        if abs(change) >= MOST_CHANGE:
            i = next(i for i, defect in enumerate(defects) if defect is found["defect"])
            raise InputError(
                f"defects.{i} of {found['asked'] * 1e3:g} mm changes the cage's volume by "
                f"{change:+.2%}, where deforming it should keep it within {MOST_CHANGE:.1%}; it is "
                "too large for this cage",
                where=f"defects.{i}.displacement",
                value=found["asked"],
            )


def break_crossbeam(
    sound: CageMesh, mesh: CageMesh, crossbeam: int, cage: WindowedCage
) -> CageMesh:
    """``mesh``, numbered as ``sound`` but for copies, with a crossbeam cut across its middle."""
    x, count = cage.along_crossbeams(sound.points), sound.pocket_count
    tiny = 1e-6 * np.ptp(x)
    cut = np.flatnonzero(_near(sound.points, crossbeam, count) & (np.abs(x) < tiny))

    def behind(centres: np.ndarray) -> np.ndarray:
        return _near(centres, crossbeam, count) & (cage.along_crossbeams(centres) > 0.0)

    return opened_at(sound, mesh, cut, behind)


def cut_height(mesh: CageMesh, crossbeam: int, cage: WindowedCage) -> float:
    """Height [m] of the cut through a crossbeam's middle, of vertices that are there twice; 0
    without any."""
    places = mesh.points[list(doubled(mesh))]
    if not len(places):
        return 0.0
    heights = cage.heights(places[_near(places, crossbeam, mesh.pocket_count)])
    return float(np.ptp(heights)) if len(heights) else 0.0


def _near(points: np.ndarray, crossbeam: int, count: int) -> np.ndarray:
    """Which points (n, 3) are nearer to this crossbeam than to any other."""
    _, radial, tangential = in_pocket_frame(points, crossbeam - 0.5, count).T
    return np.abs(np.arctan2(tangential, radial)) < np.pi / count
