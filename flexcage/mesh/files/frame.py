"""Does a user's mesh lie about the bearing's axis, and is it in the unit that it is said to be in?

Both are asked before single faces are measured, whose sentences would blame the faces.
"""

from __future__ import annotations

import numpy as np

from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh

_ALONG = 0.9  # cosine of an axis that is meant to be x
_UNITS = {"m": 1.0, "inch": 25.4e-3, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}  # m
_ALIKE = 0.1  # by which a cage of one's own may be larger than the case's


def check_axis(mesh: CageMesh, source: str) -> None:
    """InputError for a mesh whose pockets lie on a circle about another axis than x."""
    names = [f"pocket{k}_" for k in range(mesh.pocket_count)]
    rows = [[t for n, t in mesh.groups.items() if n.startswith(own) and len(t)] for own in names]
    if mesh.pocket_count < 3 or not all(rows):
        return
    centres = np.array([mesh.points[np.unique(np.vstack(own))].mean(axis=0) for own in rows])
    axis = np.abs(np.linalg.svd(centres - centres.mean(axis=0))[2][2])
    if axis[0] < _ALONG:
        found = "xyz"[int(np.argmax(axis))] if axis.max() > _ALONG else "a line across the axes"
        raise InputError(
            f"{source}: the cage's axis is {found}, but should be x, with pocket 0 on the y axis; "
            "turn the mesh in its program, and write it again",
            where="mesh.file",
            value=found,
        )


def check_unit(mesh: CageMesh, radius: float, unit: str, source: str) -> None:
    """InputError for a mesh whose outside, of ``radius`` [m] in the case, is as large as that in
    another unit than ``unit``."""
    found = float(np.hypot(mesh.points[:, 1], mesh.points[:, 2]).max())
    for name, length in _UNITS.items():
        if name != unit and abs(found / radius * length / _UNITS[unit] - 1.0) < _ALIKE:
            fits = f'set mesh.file_unit = "{name}"' if name in ("m", "mm") else ("write it in mm")
            raise InputError(
                f"{source}: the cage has an outside diameter of {2e3 * found:.4g} mm if the file "
                f"is in {unit}, but the case says {2e3 * radius:.4g} mm, which it has if the file "
                f"is in {name}; {fits}",
                where="mesh.file_unit",
                value=unit,
            )
