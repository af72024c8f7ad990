"""CalculiX (ccx): a stiff ball pressed into the groove of a ring whose outside is held.

    python tests/verification/ring_contact_calculix.py

solves a quarter of ring and ball by contact of solids and writes
``data/ring_contact_calculix.json``: force over approach, from the ball to the ring's seat, for
walls of several thicknesses. Nothing is taken from flexcage but gmsh's start. Units are mm, N, MPa.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from math import acos, cos, hypot, sin
from pathlib import Path

import numpy as np

from flexcage.mesh.gmsh_session import gmsh_model

STORED = Path(__file__).parent / "data" / "ring_contact_calculix.json"
BALL, GROOVE, BOTTOM = 2.775, 2.9, 23.975  # radii of ball, groove, and ring at the groove's bottom
SHOULDER, HALF_WIDTH = 1.2, 6.0
WALLS = (1.5, 3.0)
MODULUS, POISSON = 207e3, 0.3
STIFF = 1e3  # the ball's modulus over the ring's
APPROACHES = (6e-3,)
PATCH = (0.85, 0.12)  # semi-axes of the contact, for the mesh alone
FINE, GROWTH, COARSE = 0.03, 0.4, 1.6
SECTOR = 0.3  # rad of the ring
CAP = 0.7  # height of the piece of the ball
_FACES = ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3))  # S1 to S4 of the manual


def main() -> None:
    """Solve all walls and store force over approach."""
    rows = []
    for wall in WALLS:
        with tempfile.TemporaryDirectory() as folder:
            for approach, force in zip(APPROACHES, solve(wall, Path(folder))):
                rows.append({"wall_mm": wall, "approach_mm": approach, "force_n": force})
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    stored = {"source": f"CalculiX {said.split()[-1]}", "rows": rows}
    STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")


def solve(wall: float, folder: Path) -> list[float]:
    """Forces [N] at the approaches, of the whole ball."""
    deck = _deck(*_mesh(wall), wall)
    (folder / "ring.inp").write_text("\n".join(deck) + "\n", encoding="ascii")
    done = subprocess.run(["ccx", "ring"], cwd=folder, capture_output=True, text=True, check=False)
    text = (folder / "ring.dat").read_text(encoding="ascii")
    lines = [line.split() for line in text.splitlines()]
    found = [float(words[1]) for words in lines if len(words) == 3 and _number(words[1])]
    if done.returncode or len(found) != len(APPROACHES):
        raise RuntimeError(f"ccx failed: {done.stdout[-500:]}")
    return [4.0 * abs(f) for f in found]  # a quarter was solved


def _number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _mesh(wall: float):
    """Nodes, and quadratic tetrahedra of ring and ball, of a quarter of both."""
    with gmsh_model("ring") as gmsh:
        occ = gmsh.model.occ
        centre, edge = BOTTOM - GROOVE, acos(1.0 - SHOULDER / GROOVE)
        seat, tip = BOTTOM + wall, (GROOVE * sin(edge), centre + GROOVE * cos(edge))
        places = [(0, BOTTOM), tip, (HALF_WIDTH, tip[1]), (HALF_WIDTH, seat), (0, seat)]
        corners = [occ.addPoint(x, r, 0.0) for x, r in places]
        groove = occ.addCircleArc(corners[0], occ.addPoint(0.0, centre, 0.0), corners[1])
        lines = [occ.addLine(a, b) for a, b in zip(corners[1:], [*corners[2:], corners[0]])]
        face = occ.addPlaneSurface([occ.addCurveLoop([groove, *lines])])
        occ.revolve([(2, face)], 0, 0, 0, 1, 0, 0, SECTOR)
        ball = occ.addSphere(0.0, BOTTOM - BALL, 0.0, BALL)
        box = occ.addBox(0.0, BOTTOM - CAP, 0.0, 1.8, 2.0 * CAP, 0.9)
        occ.intersect([(3, ball)], [(3, box)])
        occ.synchronize()
        gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
        gmsh.model.mesh.setSizeCallback(lambda dim, tag, x, y, z, least: _size(x, y, z))
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
        tags, nodes, _ = gmsh.model.mesh.getNodes()
        number = np.zeros(int(tags.max()) + 1, int)
        number[tags] = np.arange(len(tags))
        bodies = []
        for _, volume in gmsh.model.getEntities(3):
            _, _, cells = gmsh.model.mesh.getElements(3, volume)
            bodies.append(number[cells[0]].reshape(-1, 10)[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]])
        nodes = nodes.reshape(-1, 3).copy()
    ring, ball_cells = sorted(bodies, key=lambda c: -nodes[c.ravel(), 1].max())
    return nodes, ring, ball_cells


def _size(x: float, y: float, z: float) -> float:
    along = min(x, PATCH[0])
    height = BOTTOM - GROOVE + (GROOVE**2 - along**2) ** 0.5
    away = hypot(max(x - PATCH[0], 0.0), y - height, z) - PATCH[1]
    return min(FINE + GROWTH * max(away, 0.0), COARSE)


def _deck(nodes: np.ndarray, ring: np.ndarray, ball: np.ndarray, wall: float) -> list[str]:
    radius = np.hypot(nodes[:, 1], nodes[:, 2])
    in_ring, in_ball = (np.isin(np.arange(len(nodes)), cells) for cells in (ring, ball))
    angle = np.arctan2(nodes[:, 2], nodes[:, 1])
    groove = np.abs(np.hypot(nodes[:, 0], radius - BOTTOM + GROOVE) - GROOVE) < 1e-3
    on_ball = np.linalg.norm(nodes - [0.0, BOTTOM - BALL, 0.0], axis=1) > BALL - 1e-3
    sets = {
        "SEAT": in_ring & ((radius > BOTTOM + wall - 1e-3) | (angle > SECTOR - 1e-6)),
        "XSYM": np.abs(nodes[:, 0]) < 1e-7,
        "ZSYM": np.abs(nodes[:, 2]) < 1e-7,
        "TOP": in_ball & (np.abs(nodes[:, 1] - BOTTOM + CAP) < 1e-6),
    }
    lines = ["*NODE"]
    lines += [f"{k}, {x:.12e}, {y:.12e}, {z:.12e}" for k, (x, y, z) in enumerate(nodes, 1)]
    first = 1
    for name, cells in (("RING", ring), ("BALL", ball)):
        lines.append(f"*ELEMENT, TYPE=C3D10, ELSET={name}")
        lines += [f"{k}, {', '.join(map(str, c + 1))}" for k, c in enumerate(cells, first)]
        first += len(cells)
    for name, chosen in sets.items():
        lines += [f"*NSET, NSET={name}", *(f"{k + 1}," for k in np.flatnonzero(chosen))]
    near = (nodes[:, 0] < 1.7) & (np.abs(nodes[:, 2]) < 0.8)
    lines += ["*SURFACE, NAME=SLAVE", *_faces(ring, in_ring & groove & near, 1)]
    lines += ["*SURFACE, NAME=MASTER", *_faces(ball, in_ball & on_ball, 1 + len(ring))]
    for name, factor in (("RING", 1.0), ("BALL", STIFF)):
        lines += [
            f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{factor * MODULUS:.6e}, {POISSON}",
            f"*SOLID SECTION, ELSET={name}, MATERIAL=M{name}",
        ]  # fmt: skip
    lines += [
        "*SURFACE INTERACTION, NAME=I",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
        f"{2e3 * MODULUS:.6e}, 1e-3",
        "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE",
        "SLAVE, MASTER",
        "*BOUNDARY", "SEAT, 1, 3", "XSYM, 1, 1", "ZSYM, 3, 3",
    ]  # fmt: skip
    for approach in APPROACHES:
        lines += [
            "*STEP", "*STATIC", "1.0, 1.0", "*BOUNDARY", f"TOP, 2, 2, {approach:.6e}",
            "*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=99", "RF", "*END STEP",
        ]  # fmt: skip
    return lines


def _faces(cells: np.ndarray, chosen: np.ndarray, first: int) -> list[str]:
    """Element faces whose corners are all chosen."""
    found = []
    for f, corners in enumerate(_FACES):
        hit = np.flatnonzero(chosen[cells[:, corners]].all(axis=1))
        found += [f"{k + first}, S{f + 1}" for k in hit]
    return found


if __name__ == "__main__":
    sys.exit(main())
