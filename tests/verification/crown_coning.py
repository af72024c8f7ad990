"""A crown cage that turns fast, by geometrically nonlinear finite elements (CalculiX, NLGEOM).

    python tests/verification/crown_coning.py

solves half a sector of the cage of ``tests/cages/crown_cage.py`` at several speeds and writes
``data/calculix_crown.json``. A cage that turns steadily is symmetric about the middle of every
pocket and of every bar: half a sector, whose cuts stay plane, is the whole cage. CalculiX updates
centrifugal loads with the deformed shape in such a step; ``data`` has a check of that against a bar
whose solution is known.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from math import pi
from pathlib import Path

import calculix
import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from flexcage.cages.crown.sector import mesh_crown_half
from flexcage.fem.model import FEModel, assemble
from flexcage.fem.prestress import geometric_stiffness
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions

sys.path.insert(0, str(Path(__file__).parents[1] / "cages"))
from crown_cage import CAGE, PITCH, Z

STORED = Path(__file__).parent / "data" / "calculix_crown.json"
BORE, BALL = 25.0, 7.938  # mm, of a 6205
DN = (0.25e6, 0.5e6, 0.75e6, 1.0e6, 1.25e6, 1.5e6)  # mm rpm, bore times speed of the inner ring
MATERIAL = MATERIALS["PA66"]


def cage_speed(dn: float) -> float:
    """Speed of the cage [rad/s]: epicyclic, outer ring at rest."""
    return 0.5 * (1.0 - BALL * 1e-3 / PITCH) * dn / BORE * 2.0 * pi / 60.0


@dataclass(frozen=True)
class HalfSector:
    """Half a sector of a crown cage, and the nodes of its cuts."""

    model: FEModel
    straight: np.ndarray  # nodes at psi = 0
    oblique: np.ndarray  # nodes at psi = pi/Z

    @property
    def normal(self) -> np.ndarray:
        """Of the oblique cut (3,)."""
        return np.array([0.0, -np.sin(pi / Z), np.cos(pi / Z)])


def half_sector(fineness: str = "coarse") -> HalfSector:
    half = mesh_crown_half(
        CAGE, pocket_count=Z, pitch_diameter=PITCH, options=MeshOptions(fineness=fineness)
    )
    groups = {name: half.surfaces[name] for name in ("cut_z", "cut_psi", "end+x")}
    model = assemble(CageMesh(half.points, half.tets, groups), MATERIAL)
    straight, oblique = (np.unique(model.face_nodes(groups[n])) for n in ("cut_z", "cut_psi"))
    return HalfSector(model, straight, oblique)


def solve(half: HalfSector, speed: float, *, nonlinear: bool = True) -> np.ndarray:
    """Displacements (N, 3) [m] of a cage that turns at ``speed`` [rad/s]."""
    model, oblique = half.model, half.oblique
    across = half.normal
    deck = [
        *calculix._mesh(model),
        *calculix.node_set("STRAIGHT", half.straight),
        *calculix.node_set("OBLIQUE", oblique),
        "*TRANSFORM, NSET=OBLIQUE, TYPE=R",
        ", ".join(f"{v:.13e}" for v in (*across, 1.0, 0.0, 0.0)),
        "*BOUNDARY", "STRAIGHT, 3, 3", "OBLIQUE, 1, 1", f"{half.straight[0] + 1}, 1, 1",
        "*STEP, NLGEOM" if nonlinear else "*STEP",
        "*STATIC", "0.25, 1." if nonlinear else "",
        "*DLOAD", f"CAGE, CENTRIF, {speed**2:.10e}, 0., 0., 0., 1., 0., 0.",
        "*NODE PRINT, NSET=ALL, GLOBAL=YES, FREQUENCY=100", "U", "*END STEP",
    ]  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        text = calculix._run(Path(folder), "turning", [line for line in deck if line])
    moved = np.array(calculix._tables(text)["displacements"])[-len(model.nodes) :]
    found = np.zeros((len(model.nodes), 3))
    found[moved[:, 0].astype(int) - 1] = moved[:, 1:4]
    return found


def linearised(half: HalfSector, speed: float, *, stiffened: bool = True) -> np.ndarray:
    """Displacements (N, 3) [m] of (K + w^2 (G - M_r)) u = w^2 M_r s on the same elements: spin
    softening by the mass M_r of radial motion, and stress stiffening by G if asked for."""
    model, n = half.model, len(half.model.nodes)
    radial = sp.diags_array([0.0, 1.0, 1.0])
    softening = sp.kron(model.mass_scalar, radial)
    load = softening @ model.nodes.ravel()
    free = _free_motions(half)

    def answer(matrix: sp.spmatrix) -> np.ndarray:
        return free @ splu(sp.csc_matrix(free.T @ matrix @ free)).solve(free.T @ load)

    matrix = model.K - speed**2 * softening
    if stiffened:
        geometric = geometric_stiffness(model, answer(model.K))
        matrix = matrix + speed**2 * sp.kron(geometric, np.eye(3))
    return speed**2 * answer(matrix).reshape(n, 3)


def _free_motions(half: HalfSector) -> sp.csc_matrix:
    """Columns (3N, m): unit motions that keep cuts plane and one node in its place along x."""
    n = len(half.model.nodes)
    blocks = [np.eye(3)] * n
    for node in half.straight:
        blocks[node] = np.eye(3)[:, :2]
    blocks[half.straight[0]] = np.eye(3)[:, 1:2]
    for node in half.oblique:
        blocks[node] = np.array([[1.0, 0.0], [0.0, np.cos(pi / Z)], [0.0, np.sin(pi / Z)]])
    return sp.csc_matrix(sp.block_diag(blocks))
