"""What pictures and charts read of any run: loads of its elements, faces of its pockets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray

#: What faces are called, those of one name shown as one; others are called as the run calls them.
_FACES = {
    "front": "front face", "rear": "rear face", "side+x": "side beams", "side-x": "side beams",
    "pocket": "pocket wall",
}  # fmt: skip


def race_loads(ds: xarray.Dataset) -> np.ndarray:
    """Normal forces of inner and outer race, (time, element, 2) [N]."""
    force = ds["race_force"].transpose(..., "element", "race")
    return np.asarray(force.sel(race=["inner", "outer"]).values)


def shown_faces(ds: xarray.Dataset) -> dict[str, list[str]]:
    """Faces of a pocket that are shown as one, by what they are called."""
    found: dict[str, list[str]] = {}
    for face in map(str, ds["face"].values):
        found.setdefault(_FACES.get(face, face), []).append(face)
    return found
