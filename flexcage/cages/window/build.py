"""The mesh of a window cage: a quarter sector mirrored, copied to the ring, morphed by defects."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Protocol

from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import WindowDefect
from flexcage.cages.window.morph import apply_defects
from flexcage.cages.window.sector import mesh_quarter
from flexcage.cages.window.windowed import WindowedCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.ring import ring_of
from flexcage.mesh.sector import Quarter

log = logging.getLogger(__name__)


class PartOf(Protocol):
    """Meshes a part of one sector of a sound cage, of which the others are images."""

    def __call__(self, cage: Any, *, pocket_count: int, options: MeshOptions) -> Quarter: ...


def build_window_mesh(
    cage: WindowCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
    *,
    joint: bool = False,
) -> CageMesh:
    """Mesh of a window cage with its defects, or the user's own file checked against both."""
    part_of = partial(mesh_quarter, joint=joint)
    return build_windows(cage, pocket_count, pitch_diameter, defects, options, part_of=part_of)


def build_windows(
    cage: WindowedCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
    *,
    part_of: PartOf,
) -> CageMesh:
    """The same of a cage with windows whose sectors ``part_of`` meshes."""
    cage.check(pocket_count)
    WindowDefect.check_all(defects, cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter)

    def built(options: MeshOptions) -> CageMesh:
        part = part_of(cage, pocket_count=pocket_count, options=options)
        mesh = ring_of(part, pocket_count)
        log.debug("%r from %d tetrahedra in a part of a sector", mesh, len(part.tets))
        return apply_defects(mesh, cage, defects, pitch_radius=0.5 * pitch_diameter)

    if options.file:
        return _from_file(cage, pocket_count, pitch_diameter, defects, options, built)
    return built(options)


def _from_file(
    cage: WindowedCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
    built: Callable[[MeshOptions], CageMesh],
) -> CageMesh:
    from flexcage.cages.window.measure import measure_file_defects
    from flexcage.mesh.compare import COARSE, check_place
    from flexcage.mesh.files.frame import check_unit
    from flexcage.mesh.io import read_mesh

    mesh = read_mesh(options.file, pocket_count=pocket_count, unit=options.file_unit)
    check_unit(mesh, 0.5 * cage.outside_diameter, options.file_unit, options.file)
    mesh = measure_file_defects(
        mesh, cage, defects, pitch_radius=0.5 * pitch_diameter, source=options.file
    )
    check_place(mesh, lambda: built(COARSE), source=options.file)
    return mesh
