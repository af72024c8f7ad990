"""The mesh of a cage with round pockets and its defects."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import BallCageDefect, pocket_shapes
from flexcage.cages.round_pocket.measure import ENOUGH, measure_pockets
from flexcage.cages.round_pocket.morph import apply_ball_defects
from flexcage.cages.round_pocket.shapes import is_sphere
from flexcage.core.errors import InputError
from flexcage.geometry.defect import defect_spec
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.compare import COARSE, check_place
from flexcage.mesh.files.frame import check_unit
from flexcage.mesh.io import read_mesh
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.ring import ring_of
from flexcage.mesh.sector import Quarter
from flexcage.mesh.with_defects import with_measured

log = logging.getLogger(__name__)

MakeQuarter = Callable[[Any, int, float, Sequence[Any], MeshOptions], Quarter]
MeasureFile = Callable[..., CageMesh]
ApplyDefects = Callable[..., CageMesh]


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
    defect_spec(cage).check_all(
        defects, cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter
    )
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


def measure_ball_file(
    mesh: CageMesh,
    cage: BallCage,
    defects: Sequence[BallCageDefect],
    *,
    pitch_radius: float,
    source: str,
) -> CageMesh:
    """A user's mesh with its defects measured; refused if a pocket is not what the case says."""
    count = mesh.pocket_count
    asked = pocket_shapes(cage, defects, pocket_count=count)
    found = measure_pockets(
        mesh, range(count), pitch_radius=pitch_radius, spherical=is_sphere(cage)
    )
    sizes = {
        "shifted axially by": (asked.centre[:, 0], found.centre[:, 0]),
        "shifted circumferentially by": (asked.centre[:, 1], found.centre[:, 1]),
        "long": (2.0 * (asked.radius + asked.slot[:, 0]), 2.0 * (found.radius + found.slot[:, 0])),
        "wide": (2.0 * (asked.radius + asked.slot[:, 1]), 2.0 * (found.radius + found.slot[:, 1])),
    }
    for name, (should, is_) in sizes.items():
        worst = int(np.argmax(np.abs(is_ - should)))
        if abs(is_[worst] - should[worst]) > ENOUGH:
            raise InputError(
                f"{source}: pocket {worst} is {name} {is_[worst] * 1e3:.3f} mm, but the case says "
                f"{should[worst] * 1e3:.3f} mm; give the cage and the defects that the file "
                "contains",
                where=f"mesh.file pocket{worst}",
                value=float(is_[worst]),
            )
    return with_measured(mesh, cage, defects, pitch_radius=pitch_radius)
