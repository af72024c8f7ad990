"""What the mesh needs of a cage type: how its cages are meshed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol, TypeVar

from flexcage.geometry.cage import Cage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions

C = TypeVar("C", bound=Cage, contravariant=True)


class MeshBuilder(Protocol[C]):
    """Mesh of a cage with its defects, or the user's own file (``options.file``) checked against
    both. ``pitch_diameter`` [m] is where defects are defined and measured."""

    def __call__(
        self,
        cage: C,
        pocket_count: int,
        pitch_diameter: float,
        defects: Sequence[Any],
        options: MeshOptions,
    ) -> CageMesh: ...
