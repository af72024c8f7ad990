"""Defects as smooth displacements of the mesh's vertices; numbering and groups stay.

Crossbeam k is translated along its own tangent by -delta_q g / cos(pi/Z): the component along
the tangent of either neighbouring pocket, to which the pocket walls are normal, is delta_q g
exactly, so both walls stay parallel to themselves, the beam keeps its width and its radius, and
a section that only translates keeps its volume. g is the defect's shape over the pocket's length;
a shifted beam is blended to zero over the neighbouring half pockets and towards the end faces.

A side beam moves along x by +-delta_p times its shape over the pocket's width, the whole section
together with its end face: it keeps its width, as a bent beam does, and its volume exactly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import cos, pi, sin
from types import MappingProxyType
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.geometry.cages import (
    CrossbeamDefect,
    Defect,
    SideBeamDefect,
    WindowCage,
    crossbeam_shape,
    side_beam_shape,
)
from flexcage.mesh.cage_mesh import CageMesh, signed_volumes
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.window_measure import face_shifts

MOST_CHANGE = 1e-3  # of the volume, by one defect


def apply_defects(
    mesh: CageMesh, cage: WindowCage, defects: Sequence[Defect], *, pitch_radius: float
) -> CageMesh:
    """The undamaged mesh with all defects, each measured as it is added; InputError if inverted."""
    original, volume = mesh.points, mesh.volume
    moved = np.zeros(len(original), bool)
    report: list[dict[str, Any]] = []
    for defect in defects:
        before, v_before = face_shifts(mesh, cage, defect, pitch_radius), mesh.volume
        step = defect_displacement(original, defect, cage, pocket_count=mesh.pocket_count)
        mesh = replace(mesh, points=mesh.points + step)
        after = face_shifts(mesh, cage, defect, pitch_radius)
        moved |= (step != 0.0).any(axis=1)
        report.append(
            {
                "kind": defect.tag,
                "defect": defect,
                "asked": defect.displacement,
                "delivered": float(np.mean(np.subtract(after, before))),
                "volume_change": (mesh.volume - v_before) / volume,
            }
        )
    _refuse_inverted(mesh, defects)
    _refuse_swollen(report)
    info = {
        **mesh.info,
        "defects": report,
        "volume_change": mesh.volume / volume - 1.0,
        "altered_sectors": _altered(mesh, moved),
    }
    return replace(mesh, info=MappingProxyType(info))


def _altered(mesh: CageMesh, moved: np.ndarray) -> tuple[int, ...]:
    """Sectors that have a cell with a moved vertex."""
    per_sector = mesh.info.get("sector_cells")
    if not isinstance(per_sector, int):
        return ()
    cells = np.flatnonzero(moved[mesh.tets].any(axis=1))
    return tuple(int(k) for k in np.unique(cells // per_sector))


def _refuse_inverted(mesh: CageMesh, defects: Sequence[Defect]) -> None:
    inverted = int((signed_volumes(mesh.points, mesh.tets) <= 0.0).sum())
    if inverted:
        worst = max(defects, key=lambda d: abs(d.displacement))
        raise InputError(
            f"the defects invert {inverted} elements; the largest displacement, "
            f"{worst.displacement * 1e3:g} mm, is too much for this cage",
            where="defects",
            value=worst.displacement,
        )


def _refuse_swollen(report: Sequence[dict[str, Any]]) -> None:
    for i, found in enumerate(report):
        change = found["volume_change"]
        if abs(change) >= MOST_CHANGE:
            raise InputError(
                f"defects.{i} of {found['asked'] * 1e3:g} mm changes the cage's volume by "
                f"{change:+.2%}, where deforming it should keep it within {MOST_CHANGE:.1%}; it is "
                "too large for this cage",
                where=f"defects.{i}.displacement",
                value=found["asked"],
            )


def defect_displacement(
    points: np.ndarray, defect: Defect, cage: WindowCage, *, pocket_count: int
) -> np.ndarray:
    """Displacement (n, 3) [m] of points of the undamaged cage."""
    if isinstance(defect, CrossbeamDefect):
        return crossbeam_displacement(points, defect, cage, pocket_count=pocket_count)
    return side_beam_displacement(points, defect, cage, pocket_count=pocket_count)


def crossbeam_displacement(
    points: np.ndarray, defect: CrossbeamDefect, cage: WindowCage, *, pocket_count: int
) -> np.ndarray:
    """Translation of crossbeam k along its own tangent; > 0 towards pocket k-1."""
    k, half = defect.crossbeam, pi / pocket_count
    x, radial, tangential = in_pocket_frame(points, k - 0.5, pocket_count).T
    near = np.abs(np.arctan2(tangential, radial)) < half * (1.0 + 1e-9)  # up to mid-pockets
    field = near * crossbeam_field(points, defect, cage, pocket_count=pocket_count)
    angle = 2.0 * half * (k - 0.5)
    tangent = np.array([0.0, -sin(angle), cos(angle)])
    return np.multiply.outer(-defect.displacement / cos(half) * field, tangent)


def crossbeam_field(
    points: np.ndarray, defect: CrossbeamDefect, cage: WindowCage, *, pocket_count: int
) -> np.ndarray:
    """Share (n,) of the displacement near crossbeam k: 1 at the middle of its faces."""
    x = points[:, 0]
    if defect.shape == "bent":  # zero with zero slope where the side beams begin
        return crossbeam_shape(defect, x, cage.pocket_length)
    reach = 0.5 * cage.pocket_width - cage.fillet_radius  # the fillets move with the beam
    behind = in_pocket_frame(points, defect.crossbeam - 1, pocket_count)[:, 2]
    ahead = -in_pocket_frame(points, defect.crossbeam, pocket_count)[:, 2]
    into_side = (np.abs(x) - 0.5 * cage.pocket_length) / cage.side_beam_width
    return (
        _smooth(1.0 - into_side)
        * _smooth(behind / reach)
        * _smooth(ahead / reach)
        * crossbeam_shape(defect, x, cage.pocket_length)
    )


def side_beam_displacement(
    points: np.ndarray, defect: SideBeamDefect, cage: WindowCage, *, pocket_count: int
) -> np.ndarray:
    """Translation of one side beam of a pocket along x; > 0 away from the pocket's middle."""
    x, radial, tangential = in_pocket_frame(points, defect.pocket, pocket_count).T
    sign = 1.0 if defect.side == "+x" else -1.0
    here = (sign * x > 0.0) & (radial > 0.0)  # other pockets' beams have |t| > half a width
    shape = np.where(here, side_beam_shape(tangential, cage.pocket_width), 0.0)
    return np.multiply.outer(sign * defect.displacement * shape, np.array([1.0, 0.0, 0.0]))


def _smooth(s: np.ndarray) -> np.ndarray:
    """0 below 0, 1 above 1, and a cubic with flat ends between."""
    s = np.clip(s, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)
