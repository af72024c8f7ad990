"""A crown cage that turns fast, by geometrically nonlinear finite elements (CalculiX, NLGEOM).

    python tests/verification/crown_coning.py

solves half a sector of the cage of ``tests/cages/crown_cage.py`` at several speeds, of two
materials, and writes ``data/calculix_crown.json``. A cage that turns steadily is symmetric about
the middle of every pocket and of every bar: half a sector, whose cuts stay plane, is the whole
cage. In such a step CalculiX updates centrifugal loads with the deformed shape (a bar of large
strain agrees with its differential equation, with spin softening, to 0.02 %).
"""

from __future__ import annotations

import json
import sys
import tempfile
from dataclasses import dataclass, replace
from math import pi
from pathlib import Path
from types import MappingProxyType

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
from crown_cage import CAGE, PITCH, Z, mesh_of

STORED = Path(__file__).parent / "data" / "calculix_crown.json"
BORE, BALL = 25.0, 7.938  # mm, of a 6205
DN = (0.25e6, 0.5e6, 0.75e6, 1.0e6, 1.25e6, 1.5e6)  # mm rpm, bore times speed of the inner ring
CAGES = {  # thick and thin rings, stiff and soft
    "PA66": (CAGE, MATERIALS["PA66"]),
    "PA66 conditioned": (CAGE, MATERIALS["PA66 A3K conditioned"]),
    "thin ring": (replace(CAGE, width=7.0e-3), MATERIALS["PA66"]),
}


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


def half_sector(name: str = "PA66") -> HalfSector:
    """Coarse half sector of one of the ``CAGES``."""
    cage, material = CAGES[name]
    half = mesh_crown_half(
        cage, pocket_count=Z, pitch_diameter=PITCH, options=MeshOptions(fineness="coarse")
    )
    groups = {name: half.surfaces[name] for name in ("cut_z", "cut_psi", "end+x")}
    model = assemble(CageMesh(half.points, half.tets, MappingProxyType(groups)), material)
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


def tip_growth(half: HalfSector, moved: np.ndarray) -> float:
    """Largest radial displacement [m] of the claw's tip under displacements (N, 3)."""
    tip = np.unique(half.model.group("end+x"))
    out = half.model.nodes[tip] * (0.0, 1.0, 1.0)
    return float(np.max(np.sum(moved[tip] * out, axis=1) / np.linalg.norm(out, axis=1)))


def rotation(half: HalfSector, moved: np.ndarray) -> float:
    """Mean rotation [rad] of the half sector about the circumference, as ``modes.rotation``."""
    gradients, volumes = half.model.element_geometry
    slope = np.einsum("mva,mvc->mac", gradients, moved[half.model.tets])
    turned = 0.5 * (slope[:, 0, 1] - slope[:, 1, 0])
    return abs(float(turned @ volumes / volumes.sum()))


def off(moved: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference of displacements (N, 3) over the largest displacement."""
    return float(np.linalg.norm(moved - exact, axis=1).max() / np.linalg.norm(exact, axis=1).max())


def compared(name: str) -> list[dict[str, float]]:
    """Speed by speed: what the nonlinear solution gives, and how far the others are off."""
    half, rows = half_sector(name), []
    for dn in DN:
        speed = cage_speed(dn)
        exact = solve(half, speed)
        soft, stiff = (linearised(half, speed, stiffened=s) for s in (False, True))
        rows.append(
            {
                "dn": dn,
                "tip_growth_m": tip_growth(half, exact),
                "rotation": rotation(half, soft),
                "error": off(soft, exact),
                "error_stiffened": off(stiff, exact),
            }
        )
        print(name, rows[-1])  # noqa: T201
    return rows


def frequencies() -> np.ndarray:
    """First ten elastic frequencies [Hz] of the free cage on its full coarse mesh."""
    model = assemble(mesh_of(), CAGES["PA66"][1])
    with tempfile.TemporaryDirectory() as folder:
        return calculix.free_frequencies(model, Path(folder))[:10]


if __name__ == "__main__":
    found = {name: compared(name) for name in CAGES}
    stored = {
        "source": f"CalculiX {calculix.version()}; with NLGEOM but for the frequencies",
        "frequencies_hz": frequencies().tolist(),
        "cages": found,
    }
    STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")
