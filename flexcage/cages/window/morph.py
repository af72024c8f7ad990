"""Defects of window cages as smooth displacements of the mesh's vertices; numbering and groups
stay."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import WindowDefect
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh, signed_volumes
from flexcage.mesh.with_defects import add_defects

MOST_CHANGE = 1e-3  # of the volume, by one defect


def apply_defects(
    sound: CageMesh, cage: WindowCage, defects: Sequence[WindowDefect], *, pitch_radius: float
) -> CageMesh:
    """The undamaged mesh with all defects, each measured as it is added; InputError if inverted."""

    def add(mesh: CageMesh, i: int) -> CageMesh:
        step = defects[i].displace(sound.points, cage, pocket_count=sound.pocket_count)
        return replace(mesh, points=mesh.points + step)

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
