"""The mesh of a ribbon cage with its defects."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from flexcage.cages.ribbon.cage import RibbonCage
from flexcage.cages.ribbon.defects import MissingRivet
from flexcage.cages.ribbon.sector import mesh_ribbon_quarter
from flexcage.cages.round_pocket.build import build_round_pockets, measure_ball_file
from flexcage.cages.round_pocket.defects import BallCageDefect
from flexcage.cages.round_pocket.measure import ENOUGH
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh
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
