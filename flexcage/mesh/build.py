"""The mesh of a cage: a quarter sector mirrored, copied to the ring, and morphed by its defects."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from functools import singledispatch
from typing import Any

from flexcage.core.errors import InputError
from flexcage.geometry.ball_cages import BallCage
from flexcage.geometry.cages import WindowCage, check_cage
from flexcage.geometry.window_defects import WindowDefect
from flexcage.mesh.ball_build import build_ball_cage_mesh
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.morph import apply_defects
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.ring import ring_of
from flexcage.mesh.sector import mesh_quarter

log = logging.getLogger(__name__)


def build_cage_mesh(
    cage: Any,
    *,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[Any] = (),
    options: MeshOptions | None = None,
) -> CageMesh:
    """Mesh of a cage with its defects, or the user's own file checked against both.

    ``pitch_diameter`` [m] is where the displacement of a defect is defined and measured. Cage and
    defects are those of one type of bearing; InputError for a cage of none.
    """
    return build_mesh_of(cage, pocket_count, pitch_diameter, defects, options or MeshOptions())


@singledispatch
def build_mesh_of(
    cage: object,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[Any],
    options: MeshOptions,
) -> CageMesh:
    """Every type of cage registers here how it is meshed."""
    raise InputError(
        f"no mesh is known for a {type(cage).__name__}; a cage is a WindowCage or a BallCage",
        where="cage",
    )


@build_mesh_of.register
def _(
    cage: WindowCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
) -> CageMesh:
    check_cage(cage, pocket_count=pocket_count)
    cage.check_defects(defects, pocket_count=pocket_count, pitch_diameter=pitch_diameter)
    if options.file:
        return _from_file(cage, pocket_count, pitch_diameter, defects, options)
    quarter = mesh_quarter(cage, pocket_count=pocket_count, options=options)
    mesh = ring_of(quarter, pocket_count)
    log.debug("%r from %d tetrahedra in a quarter sector", mesh, len(quarter.tets))
    return apply_defects(mesh, cage, defects, pitch_radius=0.5 * pitch_diameter)


build_mesh_of.register(BallCage, build_ball_cage_mesh)


def _from_file(
    cage: WindowCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
) -> CageMesh:
    from flexcage.mesh.io import read_mesh
    from flexcage.mesh.measure import measure_file_defects

    mesh = read_mesh(options.file, pocket_count=pocket_count, unit=options.file_unit)
    return measure_file_defects(
        mesh, cage, defects, pitch_radius=0.5 * pitch_diameter, source=options.file
    )
