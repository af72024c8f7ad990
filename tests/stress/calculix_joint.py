"""The riveted joint by CalculiX, an independent program, on the same mesh.

    python tests/stress/calculix_joint.py [ccx]      # writes calculix_joint.json beside this file

Ten-node tetrahedra, surface-to-surface penalty contact with Coulomb friction, the same stiffness of
contact and the same gaps; Debian's package calculix-ccx. Lengths in mm, N, MPa. Compared is the
joint with interference as it is assembled, loaded, nearly unloaded and loaded again, and with play
as it is assembled, and assembled under load at once. Every step is one increment: with two, the
same load makes 268 MPa at the roots, not 240, by CalculiX 2.20, while flexcage has 245 in one, two
or eight. Where the shank has play, CalculiX loses friction from step to step, and stops.
``test_joint_calculix.py`` compares with the stored values.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.riveted_joint import CONTACTS, JointMesh, JointShape
from flexcage.stress.operators import von_mises
from flexcage.stress.riveted_joint import RivetedJoint

STORED = Path(__file__).with_suffix(".json")
SHAPE = JointShape(
    shank_diameter=1.2e-3, head_diameter=2.1e-3, head_height=0.72e-3, root_radius=0.1e-3,
    thickness=0.8e-3, inner=-1.6e-3, outer=1.6e-3, length=4.36e-3,
)  # fmt: skip
MESH = JointMesh(sectors=6, root=3, size=1.5, seat=0.5, growth=2.0)
STEEL = MATERIALS["steel"]
FRICTION = 0.15
#: Radial gaps of the holes and gaps under each head [m]: with interference, and with play.
GAPS = {"interference": (-1.0e-6, -0.5e-6), "play": (5.0e-6, -0.5e-6)}
#: Force [N] and moment [N m] through the rivet: enough to open and to slip a part of the joint.
LOAD = np.array([-12.0, 6.0, 8.0, 0.002, 0.004, 0.005])
#: What is computed: the gaps, and shares of LOAD, one after the other.
CASES = {
    "interference": ("interference", (0.0, 1.0, 0.2, 1.0)),
    "play": ("play", (0.0,)),
    "play, loaded": ("play", (1.0,)),
}
_FACES = {(0, 1, 2): 1, (0, 1, 3): 2, (1, 2, 3): 3, (0, 2, 3): 4}


def gaps(case: str) -> dict[str, float]:
    radial, head = GAPS[CASES[case][0]]
    return {"hole_lower": radial, "hole_upper": radial, "head_lower": head, "head_upper": head}


def deck(joint: RivetedJoint, case: str) -> str:
    """The input of CalculiX."""
    b = joint.bodies
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i + 1},{x:.12g},{y:.12g},{z:.12g}" for i, (x, y, z) in enumerate(b.nodes * 1e3)]
    lines.append("*ELEMENT, TYPE=C3D10, ELSET=ALL")
    lines += [f"{i + 1}," + ",".join(str(n + 1) for n in t) for i, t in enumerate(b.tets)]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC"]
    lines.append(f"{STEEL.youngs_modulus / 1e6},{STEEL.poisson_ratio}")
    lines.append("*SOLID SECTION, ELSET=ALL, MATERIAL=M")
    owner = {}
    for e, tet in enumerate(b.tets[:, :4].tolist()):
        for corners, face in _FACES.items():
            owner[tuple(sorted(tet[c] for c in corners))] = (e + 1, face)
    for name, bodies in CONTACTS.items():
        for body in bodies:
            lines.append(f"*SURFACE, NAME={name}_{body}, TYPE=ELEMENT")
            for three in np.sort(b.faces[name, body][:, :3], axis=1).tolist():
                element, face = owner[tuple(three)]
                lines.append(f"{element},S{face}")
    own = gaps(case)
    stiff = joint.penalty * 1e-9  # MPa/mm
    lines += ["*SURFACE INTERACTION, NAME=I", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
              f"{stiff:.9g}", "*FRICTION", f"{FRICTION},{stiff:.9g}"]  # fmt: skip
    for name, (one, other) in CONTACTS.items():
        lines += ["*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE",
                  f"{name}_{other},{name}_{one}",
                  f"*CLEARANCE, MASTER={name}_{one}, SLAVE={name}_{other}, "
                  f"VALUE={1e3 * own.get(name, 0.0):.9g}"]  # fmt: skip
    lines.append("*BOUNDARY")
    lines += [f"{d // 3 + 1},{d % 3 + 1},{d % 3 + 1},0." for d in joint.held.tolist()]
    for share in CASES[case][1]:
        lines += [
            "*STEP, INC=200",
            "*STATIC",
            "1.,1.",
            "*CLOAD, OP=NEW",
        ]
        nodal = joint.loads(share * LOAD)
        lines += [
            f"{n + 1},{k + 1},{nodal[n, k]:.12g}"
            for n, k in zip(*np.nonzero(np.abs(nodal) > 1e-12))
        ]
        lines += ["*NODE FILE, FREQUENCY=100", "U", "*EL FILE, FREQUENCY=100", "S"]
        for name, (one, other) in CONTACTS.items():
            lines += [f"*CONTACT PRINT, SLAVE={name}_{other}, MASTER={name}_{one}, FREQUENCY=100",
                      "CF"]  # fmt: skip
        lines.append("*END STEP")
    return "\n".join(lines) + "\n"


def stresses(path: Path, nodes: int) -> list[np.ndarray]:
    """Nodal stress (n, 6) [Pa] of every step in a .frd: xx, yy, zz, xy, yz, xz."""
    found: list[np.ndarray] = []
    reading = False
    for line in path.open():
        if line.startswith(" -4"):
            reading = line.split()[1] == "STRESS"
            if reading:
                found.append(np.zeros((nodes, 6)))
        elif reading and line.startswith(" -1"):
            found[-1][int(line[3:13]) - 1] = [1e6 * float(line[13 + 12 * k : 25 + 12 * k])
                                              for k in range(6)]  # fmt: skip
        elif line.startswith(" -3"):
            reading = False
    return found


def forces(path: Path) -> list[dict[str, list[float]]]:
    """Total force [N] on the slave surface of every contact, by step."""
    found: list[dict[str, list[float]]] = []
    seen: dict[str, int] = {}
    lines = path.read_text().splitlines()
    for i, line in enumerate(lines):
        if "statistics for slave set" in line.lower():
            name = line.lower().split("slave set")[1].split(",")[0].strip().rsplit("_", 1)[0]
            values = next(
                l.split() for l in lines[i + 1 :] if len(l.split()) >= 3 and _numbers(l.split()[:3])
            )
            step = seen.get(name, 0)
            seen[name] = step + 1
            found += [{} for _ in range(step + 1 - len(found))]
            found[step][name] = [float(v) for v in values[:3]]
    return found


def _numbers(words: list[str]) -> bool:
    try:
        [float(w) for w in words]
    except ValueError:
        return False
    return True


def computed(case: str, ccx: str = "ccx", folder: Path | None = None) -> list[dict]:
    """Peaks of stress [Pa] and forces [N] by CalculiX, step by step."""
    joint = RivetedJoint(SHAPE, STEEL, mesh=MESH)
    where = folder or Path(tempfile.mkdtemp())
    (where / "joint.inp").write_text(deck(joint, case))
    subprocess.run([ccx, "joint"], cwd=where, check=True, capture_output=True)
    steps = stresses(where / "joint.frd", len(joint.bodies.nodes))
    acting = forces(where / "joint.dat")
    return [
        {
            "share": share,
            "peaks": {place: float(von_mises(stress)[nodes].max())
                      for place, nodes in joint.places.items()},
            "range": largest_range(steps[i - 1], stress, joint.places["root"]) if i else 0.0,
            "forces": acting[i],
        }
        for i, (share, stress) in enumerate(zip(CASES[case][1], steps))
    ]  # fmt: skip


def largest_range(one: np.ndarray, other: np.ndarray, nodes: np.ndarray) -> float:
    """The largest normal part [Pa] of the change from one stress (n, 6) to the other at nodes."""
    xx, yy, zz, xy, yz, xz = (other - one)[nodes].T
    tensors = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]).transpose(2, 0, 1)
    return float(np.abs(np.linalg.eigvalsh(tensors)).max())


def main() -> None:
    ccx = sys.argv[1] if len(sys.argv) > 1 else "ccx"
    found = {case: computed(case, ccx) for case in CASES}
    STORED.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
