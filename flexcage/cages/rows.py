"""Cages for several rows of elements: where each row's half is, and the mesh of all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from flexcage.cages.cage_type import cage_type_of
from flexcage.cages.halves import is_one_piece, signs_of
from flexcage.geometry.bearing import RowPlace
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import in_row
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.joined import joined
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.quality import check_mesh
from flexcage.mesh.rows import RowFrame, in_rows, row_frames


def frames_of(cage: Cage, places: Sequence[RowPlace]) -> tuple[RowFrame, ...]:
    """Frames of the rows of a common cage at these places."""
    return row_frames(places, signs_of(cage, places))


def build_rows(
    cage: Cage, places: Sequence[RowPlace], *, pocket_count: int, pitch_diameter: float,
    defects: Sequence[Any], options: MeshOptions,
) -> CageMesh:  # fmt: skip
    """Mesh of the whole cage, checked: one body where the halves meet and gmsh makes them."""
    build, frames = cage_type_of(cage).mesh(), frames_of(cage, places)
    whole = is_one_piece(cage, places) and not options.file
    meet: dict[str, Any] = {"joint": True} if whole else {}

    def half(own: Sequence[Any]) -> CageMesh:
        made = build(cage, pocket_count, pitch_diameter, own, options, **meet)
        check_mesh(made, where=options.file or "mesh")
        return made

    sound = half(())
    halves = []
    for row in range(len(places)):
        own = in_row(defects, row, pocket_count)
        halves.append(_as_named(half(own), own, row) if own else sound)
    return joined(halves, sound, frames) if whole else in_rows(halves, frames)


def _as_named(half: CageMesh, defects: Sequence[Any], row: int) -> CageMesh:
    """A half whose report names pockets as the whole cage counts them."""
    shift = row * half.pocket_count
    reports = [
        {**report, "defect": report["defect"].moved_by(shift)}
        for report in half.info.get("defects", ())  # type: ignore[attr-defined]
    ]
    return replace(half, info=MappingProxyType({**half.info, "defects": reports}))
