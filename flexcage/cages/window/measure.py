"""Where a pocket's faces are: measured on the mesh, at the pitch radius and mid-pocket."""

from __future__ import annotations

from collections.abc import Sequence

from flexcage.cages.window.defects import WindowDefect, pocket_changes
from flexcage.cages.window.faces import pocket_size
from flexcage.cages.window.windowed import WindowedCage
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.with_defects import with_measured


def measure_file_defects(
    mesh: CageMesh,
    cage: WindowedCage,
    defects: Sequence[WindowDefect],
    *,
    pitch_radius: float,
    source: str,
) -> CageMesh:
    """A user's mesh with its defects measured; refused if a pocket is not what the case says.

    The tolerance is 20 um or a tenth of the displacement asked, whichever is larger.
    """
    z = mesh.pocket_count
    width, length = pocket_changes(defects, pocket_count=z)
    for k in range(z):
        found = pocket_size(mesh, k, pitch_radius=pitch_radius, cage=cage)
        wanted = (cage.pocket_width + width[k], cage.pocket_length + length[k])
        for name, is_, should, change in zip(
            ("wide", "long"), found, wanted, (width[k], length[k])
        ):
            if abs(is_ - should) > max(20e-6, 0.1 * abs(change)):
                raise InputError(
                    f"{source}: pocket {k} is {is_ * 1e3:.3f} mm {name} at the pitch radius, but "
                    f"the case says {should * 1e3:.3f} mm; give the cage and the defects that the "
                    "file contains",
                    where=f"mesh.file pocket{k}",
                    value=is_,
                )
    return with_measured(mesh, cage, defects, pitch_radius=pitch_radius)
