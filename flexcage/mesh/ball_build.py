"""The mesh of a ball cage with its defects."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from functools import singledispatch

from flexcage.core.errors import InputError
from flexcage.geometry.ball_cage_defects import (
    BallCageDefect,
    check_ball_cage,
    is_sphere,
)
from flexcage.geometry.ball_cages import BallCage
from flexcage.geometry.ribbon_cage import RibbonCage
from flexcage.mesh.ball_morph import apply_ball_defects, make_spherical
from flexcage.mesh.ball_sector import mesh_ball_quarter
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.ribbon_sector import mesh_ribbon_quarter
from flexcage.mesh.ring import ring_of
from flexcage.mesh.sector import Quarter

log = logging.getLogger(__name__)


def build_ball_cage_mesh(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> CageMesh:
    """Mesh of a ball cage with its defects, or the user's own file checked against both."""
    check_ball_cage(cage, pocket_count=pocket_count)
    cage.check_defects(defects, pocket_count=pocket_count, pitch_diameter=pitch_diameter)
    if options.file:
        return _from_file(cage, pocket_count, pitch_diameter, defects, options)
    if options.fillet_size is not None:
        raise InputError(
            "mesh.fillet_size is of window cages; round pockets have no fillets: give mesh.size.",
            where="mesh.fillet_size",
            value=options.fillet_size,
        )
    quarter = quarter_of(cage, pocket_count, pitch_diameter, defects, options)
    mesh = ring_of(quarter, pocket_count)
    log.debug("%r from %d tetrahedra in a quarter sector", mesh, len(quarter.tets))
    return apply_ball_defects(mesh, cage, defects, pitch_radius=0.5 * pitch_diameter)


@singledispatch
def quarter_of(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> Quarter:
    """Quarter sector of a sound ball cage, with edges where the tips of cracks will be."""
    quarter = mesh_ball_quarter(
        cage, pocket_count=pocket_count, options=options, tips=_tips(cage, defects)
    )
    if is_sphere(cage):
        quarter = make_spherical(quarter, cage, pitch_radius=0.5 * pitch_diameter)
    return quarter


@quarter_of.register
def _(
    cage: RibbonCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> Quarter:
    return mesh_ribbon_quarter(
        cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter, options=options
    )


def _tips(cage: BallCage, defects: Sequence[BallCageDefect]) -> tuple[float, ...]:
    """Distances [m] of cracks' tips from the cage's middle, where edges must be; each once."""
    tips = {tip for defect in defects for tip in defect.tips(cage)}
    return tuple(tip for tip in sorted(tips) if tip > 1e-6 * cage.width)


def _from_file(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> CageMesh:
    from flexcage.mesh.ball_measure import measure_ball_file
    from flexcage.mesh.io import read_mesh

    mesh = read_mesh(options.file, pocket_count=pocket_count, unit=options.file_unit)
    return measure_ball_file(
        mesh, cage, defects, pitch_radius=0.5 * pitch_diameter, source=options.file
    )
