"""The mesh of a cage with round pockets and its defects, and that of machined ones."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from functools import partial

from flexcage.cages.machined.sector import mesh_ball_quarter
from flexcage.cages.round_pocket.build import build_round_pockets, measure_ball_file
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import BallCageDefect
from flexcage.cages.round_pocket.morph import make_spherical
from flexcage.cages.round_pocket.shapes import is_sphere
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.sector import Quarter

log = logging.getLogger(__name__)


def build_ball_cage_mesh(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
    *,
    joint: bool = False,
) -> CageMesh:
    """Mesh of a machined cage with its defects, or the user's own file checked against both."""
    return build_round_pockets(
        cage, pocket_count, pitch_diameter, defects, options,
        quarter_of=partial(machined_quarter, joint=joint), measure=measure_ball_file,
    )  # fmt: skip


def machined_quarter(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
    *,
    joint: bool = False,
) -> Quarter:
    """Quarter sector of a sound machined cage, with edges where the tips of cracks will be."""
    quarter = mesh_ball_quarter(
        cage, pocket_count=pocket_count, options=options, tips=_tips(cage, defects), joint=joint
    )
    if is_sphere(cage):
        quarter = make_spherical(quarter, cage, pitch_radius=0.5 * pitch_diameter)
    return quarter


def _tips(cage: BallCage, defects: Sequence[BallCageDefect]) -> tuple[float, ...]:
    """Distances [m] of cracks' tips from the cage's middle, where edges must be; each once."""
    tips = {tip for defect in defects for tip in defect.tips(cage)}
    return tuple(tip for tip in sorted(tips) if tip > 1e-6 * cage.width)
