"""The mesh of a cage with round pockets and its defects, and that of machined ones."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from typing import Any

from flexcage.cages.machined.cage import BallCage
from flexcage.cages.machined.defects import (
    BallCageDefect,
    is_sphere,
)
from flexcage.cages.machined.measure import measure_ball_file
from flexcage.cages.machined.morph import apply_ball_defects, make_spherical
from flexcage.cages.machined.sector import mesh_ball_quarter
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.compare import COARSE, check_place
from flexcage.mesh.files.frame import check_unit
from flexcage.mesh.io import read_mesh
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.ring import ring_of
from flexcage.mesh.sector import Quarter

log = logging.getLogger(__name__)


MakeQuarter = Callable[[Any, int, float, Sequence[Any], MeshOptions], Quarter]
MeasureFile = Callable[..., CageMesh]
ApplyDefects = Callable[..., CageMesh]


def build_ball_cage_mesh(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> CageMesh:
    """Mesh of a machined cage with its defects, or the user's own file checked against both."""
    return build_round_pockets(
        cage, pocket_count, pitch_diameter, defects, options, quarter_of=machined_quarter,
        measure=measure_ball_file,
    )  # fmt: skip


def build_round_pockets(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
    *,
    quarter_of: MakeQuarter,
    measure: MeasureFile,
    apply: ApplyDefects = apply_ball_defects,
) -> CageMesh:
    """Mesh of a cage with round pockets: ``quarter_of`` makes the quarter sector of a sound one,
    ``measure`` checks the user's own mesh against cage and defects, and ``apply`` adds these to a
    sound one."""
    cage.check(pocket_count)
    cage.check_defects(defects, pocket_count=pocket_count, pitch_diameter=pitch_diameter)
    pitch_radius = 0.5 * pitch_diameter

    def built(options: MeshOptions) -> CageMesh:
        quarter = quarter_of(cage, pocket_count, pitch_diameter, defects, options)
        mesh = ring_of(quarter, pocket_count)
        log.debug("%r from %d tetrahedra in a quarter sector", mesh, len(quarter.tets))
        return apply(mesh, cage, defects, pitch_radius=pitch_radius)

    if options.file:
        mesh = read_mesh(options.file, pocket_count=pocket_count, unit=options.file_unit)
        check_unit(mesh, 0.5 * cage.outside_diameter, options.file_unit, options.file)
        mesh = measure(mesh, cage, defects, pitch_radius=pitch_radius, source=options.file)
        check_place(mesh, lambda: built(COARSE), source=options.file)
        return mesh
    if options.fillet_size is not None:
        raise InputError(
            "mesh.fillet_size is of window cages; round pockets have no fillets: give mesh.size.",
            where="mesh.fillet_size",
            value=options.fillet_size,
        )
    return built(options)


def machined_quarter(
    cage: BallCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[BallCageDefect],
    options: MeshOptions,
) -> Quarter:
    """Quarter sector of a sound machined cage, with edges where the tips of cracks will be."""
    quarter = mesh_ball_quarter(
        cage, pocket_count=pocket_count, options=options, tips=_tips(cage, defects)
    )
    if is_sphere(cage):
        quarter = make_spherical(quarter, cage, pitch_radius=0.5 * pitch_diameter)
    return quarter


def _tips(cage: BallCage, defects: Sequence[BallCageDefect]) -> tuple[float, ...]:
    """Distances [m] of cracks' tips from the cage's middle, where edges must be; each once."""
    tips = {tip for defect in defects for tip in defect.tips(cage)}
    return tuple(tip for tip in sorted(tips) if tip > 1e-6 * cage.width)
