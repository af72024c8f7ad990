"""The mesh of a crown cage with its defects."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.crown.defects import CrownDefect
from flexcage.cages.crown.sector import mesh_crown_half
from flexcage.cages.round_pocket.build import build_round_pockets, measure_ball_file
from flexcage.cages.round_pocket.measure import ENOUGH
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh, signed_volumes
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.sector import Quarter
from flexcage.mesh.with_defects import add_defects


def build_crown_mesh(
    cage: CrownCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[CrownDefect],
    options: MeshOptions,
    *,
    joint: bool = False,
) -> CageMesh:
    """Mesh of a crown cage with its defects, or the user's own file checked against both."""
    return build_round_pockets(
        cage, pocket_count, pitch_diameter, defects, options,
        quarter_of=partial(_half, joint=joint), measure=measure_crown_file,
        apply=apply_crown_defects,
    )  # fmt: skip


def _half(
    cage: CrownCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[CrownDefect],
    options: MeshOptions,
    *,
    joint: bool = False,
) -> Quarter:
    fronts = {radius for defect in defects for radius in defect.fronts(cage)}
    return mesh_crown_half(
        cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter, options=options,
        breaks=any(defect.breaks for defect in defects), fronts=tuple(sorted(fronts)), joint=joint,
    )  # fmt: skip


def measure_crown_file(
    mesh: CageMesh,
    cage: CrownCage,
    defects: Sequence[CrownDefect],
    *,
    pitch_radius: float,
    source: str,
) -> CageMesh:
    """A user's mesh with its defects measured; refused with other pockets, tips or another ring
    than the case says."""
    measured = measure_ball_file(mesh, cage, defects, pitch_radius=pitch_radius, source=source)
    x = mesh.points[:, 0]
    for what, found, said in (
        ("claws' tips are", float(x.max()), cage.tip),
        ("ring's back is", float(x.min()), cage.back),
    ):
        if abs(found - said) > ENOUGH:
            raise InputError(
                f"{source}: the {what} at x = {found * 1e3:.3f} mm, but the case says "
                f"{said * 1e3:.3f} mm; give the cage that the file contains",
                where="mesh.file",
                value=found,
            )
    return measured


def apply_crown_defects(
    mesh: CageMesh, cage: CrownCage, defects: Sequence[CrownDefect], *, pitch_radius: float
) -> CageMesh:
    """The undamaged mesh with all defects, each measured as it is added; InputError if inverted."""

    def add(_: CageMesh, i: int) -> CageMesh:
        made = mesh
        for defect in sorted(defects[: i + 1], key=lambda defect: defect.removes):
            made = defect.opened(mesh, made, cage)
        inverted = int((signed_volumes(made.points, made.tets) <= 0.0).sum())
        if inverted:
            raise InputError(
                f"the defects invert {inverted} elements of the cage's mesh; make them smaller, or "
                "the mesh finer",
                where="defects",
                value=inverted,
            )
        return made

    return add_defects(mesh, cage, defects, pitch_radius=pitch_radius, add=add)
