"""The mesh of a ribbon cage with its defects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from flexcage.cages.machined.build import build_round_pockets
from flexcage.cages.machined.defects import BallCageDefect
from flexcage.cages.machined.measure import ENOUGH, measure_ball_file
from flexcage.cages.machined.morph import with_doubled
from flexcage.cages.ribbon.cage import RibbonCage
from flexcage.cages.ribbon.defects import MissingRivet
from flexcage.cages.ribbon.sector import mesh_ribbon_quarter
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.halves import joined_vertices
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.sector import Quarter


def build_ribbon_mesh(
    cage: RibbonCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> CageMesh:
    """Mesh of a ribbon cage with its defects, or the user's own file checked against both."""
    return build_round_pockets(
        cage, pocket_count, pitch_diameter, defects, options, quarter_of=_quarter,
        measure=measure_ribbon_file,
    )  # fmt: skip


def _quarter(
    cage: RibbonCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> Quarter:
    return mesh_ribbon_quarter(
        cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter, options=options
    )


def measure_ribbon_file(
    mesh: CageMesh,
    cage: RibbonCage,
    defects: Sequence[BallCageDefect],
    *,
    pitch_radius: float,
    source: str,
) -> CageMesh:
    """A user's mesh with its defects measured; refused with other pockets, another width, or other
    rivets, than the case says."""
    measured = measure_ball_file(mesh, cage, defects, pitch_radius=pitch_radius, source=source)
    missing = {d.web for d in defects if isinstance(d, MissingRivet)}
    high = 2.0 * float(np.abs(mesh.points[:, 0]).max())
    sizes = [("The cage", "wide", high, cage.axial_width)]
    for web in range(mesh.pocket_count):
        (free,) = MissingRivet(web=web).readings(mesh, cage, pitch_radius=pitch_radius)
        held = 0.0 if web in missing else free.asked
        sizes.append((f"web {web}", "held together over", free.asked - free.measured[0], held))
    for what, how, found, said in sizes:
        if abs(found - said) > ENOUGH:
            raise InputError(
                f"{source}: {what} is {how} {found * 1e3:.3f} mm, but the case says "
                f"{said * 1e3:.3f} mm; give the cage and the defects that the file contains",
                where="mesh.file",
                value=found,
            )
    return measured


def without_rivet(mesh: CageMesh, web: int, gap: float) -> CageMesh:
    """``mesh`` of a ribbon cage whose halves are free of each other at one web, ``gap`` [m] off the
    middle plane each."""
    old = joined_vertices(mesh, web)
    copy = np.arange(len(mesh.points))
    copy[old] = len(copy) + np.arange(len(old))
    under = mesh.points[mesh.tets].mean(axis=1)[:, 0] < 0.0
    tets = np.where(under[:, None], copy[mesh.tets], mesh.tets)
    points = np.vstack([mesh.points, mesh.points[old]])
    points[old, 0], points[len(copy) :, 0] = gap, -gap
    info = with_doubled(mesh, old)
    return replace(mesh, points=points, tets=tets, info=info)  # no group has a face on that plane
