"""A conical cage as contacts see it: the stations of window cages, on faces that lie askew.

Stations on the bars' faces count along the roller's axis, those on the ends' along the tangent.
Displacements have components (x, r, psi), as of all cages; ``PocketWalls.normal`` turned by
``ConeShaped.axes`` are the faces' normals in these. Offsets are along the normals.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from flexcage.cages.conical.shape import ConeShaped
from flexcage.cages.window.defects import WindowDefect
from flexcage.cages.window.interface import (
    face_offsets,
    offset_points,
    reduced_interface,
    rigid_interface,
)
from flexcage.modes.basis import CageInterface
from flexcage.modes.reduction import CageReduction, Interfaces


@dataclass(frozen=True)
class ConicalInterface(CageInterface):
    """The interface of window cages, whose contact forces have more components: on the bars' faces
    along r and psi, on the ends' along x and r."""

    single: ClassVar[tuple[tuple[int, ...], ...]] = ((1, 2), (1, 2), (0, 1), (0, 1))
    even: ClassVar[tuple[tuple[int, ...], ...]] = ((0,), (0,), (2,), (2,))


def rigid_conical_interface(
    cage: ConeShaped, *, pocket_count: int, defects: Sequence[WindowDefect] = ()
) -> ConicalInterface:
    """Interface of a rigid cage: no modes, no compliance, no mesh; defects in the offsets."""
    made = rigid_interface(cage, pocket_count=pocket_count, defects=defects)
    return ConicalInterface(**vars(made))


def _reduced(cage: CageReduction) -> ConicalInterface:
    return ConicalInterface(**vars(reduced_interface(cage)))


def _depends_on(
    cage: ConeShaped, defects: Sequence[WindowDefect], pocket_count: int
) -> tuple[Any, ...]:
    points = offset_points(cage)
    offsets = face_offsets(cage, points, pocket_count=pocket_count, defects=defects)
    pocket = cage.pocket_length, cage.end_width(1.0), cage.end_width(-1.0), cage.fillet_radius
    return pocket, cage.axes, cage.face_normals, cage.wall, offsets


CONICAL_INTERFACES: Interfaces[ConeShaped] = Interfaces(
    kind=ConicalInterface, rigid=rigid_conical_interface, reduced=_reduced, depends_on=_depends_on
)
