"""The mesh of a conical cage: half a sector mirrored, copied to the ring, morphed by defects."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from flexcage.cages.conical.sector import mesh_conical_half
from flexcage.cages.conical.shape import ConeShaped
from flexcage.cages.window.build import build_windows
from flexcage.cages.window.defects import WindowDefect
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import FaceAxes, with_face_axes


def build_conical_mesh(
    cage: ConeShaped,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[WindowDefect],
    options: MeshOptions,
    *,
    joint: bool = False,
) -> CageMesh:
    """Mesh of a conical cage with its defects, or the user's own file checked against both."""
    mesh = build_windows(
        cage, pocket_count, pitch_diameter, defects, options,
        part_of=partial(mesh_conical_half, joint=joint),
    )  # fmt: skip
    return replace(mesh, info=with_face_axes(mesh.info, _face_axes(cage)))


def _face_axes(cage: ConeShaped) -> FaceAxes:
    """How the faces of a pocket lie in its frame (x, r, psi)."""
    along = cage.axes[[0, 0, 2, 2]]
    middle = np.array([0.0, 0.5 * cage.pitch_diameter, 0.0])
    return FaceAxes(cage.face_normals @ cage.axes, along, along @ middle)
