"""A cage by the slots of its type: its mesh, its reduced model, its interface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from flexcage.cages.cage_type import cage_type_of
from flexcage.cages.rows import build_rows, frames_of
from flexcage.geometry.bearing import RowPlace
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import in_row
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions
from flexcage.modes.basis import ContactInterface
from flexcage.modes.reduction import CageReduction
from flexcage.modes.rows import joined_interfaces
from flexcage.modes.spec import ModesSpec


def build_cage_mesh(
    cage: Cage,
    *,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[Any] = (),
    options: MeshOptions | None = None,
    places: Sequence[RowPlace] = (RowPlace(),),
) -> CageMesh:
    """Mesh of a cage with its defects, or the user's own file checked against both.

    ``pitch_diameter`` [m] is where the displacement of a defect is defined and measured. Cage and
    defects are those of one type of bearing; InputError for a cage of none. ``pocket_count`` is
    that of each of the rows, which stand at ``places``.
    """
    if len(places) > 1:
        return build_rows(
            cage, places, pocket_count=pocket_count, pitch_diameter=pitch_diameter,
            defects=defects, options=options or MeshOptions(),
        )  # fmt: skip
    build = cage_type_of(cage).mesh()
    return build(cage, pocket_count, pitch_diameter, defects, options or MeshOptions())


def reduce_cage(
    mesh: CageMesh,
    *,
    cage: Cage,
    defects: Sequence[Any],
    spec: ModesSpec,
    order: int = 2,
) -> CageReduction:
    """Reduce a cage; basis and interface come from the disk cache if they are there."""
    reduction = reduction_of(mesh, cage=cage, defects=defects, spec=spec, order=order)
    reduction.interface  # noqa: B018  (what a run needs is made now)
    return reduction


def reduction_of(
    mesh: CageMesh,
    *,
    cage: Cage,
    defects: Sequence[Any],
    spec: ModesSpec,
    order: int = 2,
    stored: Mapping[str, Mapping[str, np.ndarray]] | None = None,
) -> CageReduction:
    """The reduction of a cage, of which each part is made when first asked for; ``stored`` holds
    the arrays that a run's folder keeps of it."""
    interfaces = cage_type_of(cage).interfaces()
    return CageReduction(mesh, cage, tuple(defects), spec, order, interfaces, stored or {})


def rigid_interface_of(
    cage: Cage, *, pocket_count: int, defects: Sequence[Any] = (),
    places: Sequence[RowPlace] = (RowPlace(),),
) -> ContactInterface:  # fmt: skip
    """The interface of a rigid cage; arguments as those of ``build_cage_mesh``."""
    rigid = cage_type_of(cage).interfaces().rigid
    if len(places) == 1:
        return rigid(cage, pocket_count=pocket_count, defects=defects)
    rows = [
        rigid(cage, pocket_count=pocket_count, defects=in_row(defects, k, pocket_count))
        for k in range(len(places))
    ]
    return joined_interfaces(rows, frames_of(cage, places))
