"""Elements by meshio's names: tetrahedra and triangles of any order, and what is neither."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from flexcage.mesh.files.raw import Refused

SOLIDS = re.compile(r"tetra\d*")
TRIANGLES = re.compile(r"triangle\d*")
_OTHERS = ("hexahedron", "wedge", "pyramid", "polyhedron")
OTHER_SHAPE = "it has elements of another shape ({}); a cage's mesh has tetrahedra alone"


def solids_of(found: Any) -> tuple[np.ndarray, ...]:
    """Blocks of tetrahedra of a mesh of meshio; Refused if it has solids of another shape."""
    others = sorted({b.type for b in found.cells if b.type.startswith(_OTHERS)})
    if others:
        raise Refused(OTHER_SHAPE.format(", ".join(others)))
    return tuple(np.asarray(block.data) for block in found.cells if SOLIDS.fullmatch(block.type))
