"""The mesh of a window cage: a quarter sector mirrored, copied to the ring, morphed by defects."""

from __future__ import annotations

import logging
from collections.abc import Sequence

from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import WindowDefect
from flexcage.cages.window.morph import apply_defects
from flexcage.cages.window.sector import mesh_quarter
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.ring import ring_of

log = logging.getLogger(__name__)


def build_window_mesh(
    cage: WindowCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
) -> CageMesh:
    """Mesh of a window cage with its defects, or the user's own file checked against both."""
    cage.check(pocket_count)
    WindowDefect.check_all(defects, cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter)
    if options.file:
        return _from_file(cage, pocket_count, pitch_diameter, defects, options)
    return _built(cage, pocket_count, pitch_diameter, defects, options)


def _built(
    cage: WindowCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
) -> CageMesh:
    quarter = mesh_quarter(cage, pocket_count=pocket_count, options=options)
    mesh = ring_of(quarter, pocket_count)
    log.debug("%r from %d tetrahedra in a quarter sector", mesh, len(quarter.tets))
    return apply_defects(mesh, cage, defects, pitch_radius=0.5 * pitch_diameter)


def _from_file(
    cage: WindowCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
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
    check_place(
        mesh, lambda: _built(cage, pocket_count, pitch_diameter, defects, COARSE),
        source=options.file,
    )  # fmt: skip
    return mesh
