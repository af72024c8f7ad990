"""CalculiX (ccx): an N1013's outer ring of hexahedra on two arcs, its rollers as springs.

    python tests/verification/ring_on_arcs_calculix.py

writes ``data/ring_on_arcs_calculix.json``: the force of every roller, and the supports'. CalculiX
has its own ring, supports that press, and search for equilibrium, at the displacement of the inner
ring that flexcage finds. A roller's force over its approach between rigid races is flexcage's; the
half-space that it holds is taken from it, as the patch of hexahedra on which it acts yields as
well. Units are mm and N. A quarter of the ring is solved, x and z from 0 on; the rollers in the
plane z = 0, which bear nothing, are left out.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from flexcage.bearings import sections_of, statics_of
from flexcage.case.presets import load_preset
from flexcage.contacts.spec import Contacts
from flexcage.geometry.ring import OuterRing
from flexcage.system.spec import Load
from flexcage.system.statics.equilibrium import nearest, settle
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.rings import BentRing, Rings
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.solve import posed, solve_bearing

STORED = Path(__file__).parent / "data" / "ring_on_arcs_calculix.json"
BEARING = load_preset("N1013").bearing
LOAD = Load(radial=5000.0)
RING = OuterRing(
    ring="flexible", seat="arcs", supports=tuple(np.radians([60.0, -60.0])),
    support_arc=np.radians(15.0),
)  # fmt: skip
AROUND, ALONG, THROUGH = 288, 4, 3  # nodes of half a turn; hexahedra
REACH = 4.0  # standard deviations of a patch that are loaded
FIRM = 1e8  # N/mm of a support
LOOSE = 1e-3  # N/mm of what does not touch


def ours() -> StaticSolution:
    """flexcage's solution."""
    rings = Rings(outer=RING, sections=sections_of(BEARING))
    return solve_bearing(BEARING, statics_of(BEARING), load=LOAD, rings=rings)


def law(bent: BentRing) -> list[tuple[float, float]]:
    """Force [N] of a roller over its approach [mm], less what the half-space under its patch
    yields."""
    elements = statics_of(BEARING)(BEARING, speed=0.0, contacts=Contacts(), options=StaticOptions())
    problem = posed(BEARING, elements, LOAD, StaticOptions())
    own = bent.seated.reduction.half_space[0, 0]
    rows = []
    for approach in np.concatenate([np.linspace(0.0, 8e-6, 9), np.linspace(9e-6, 6e-5, 52)]):
        v = np.tile([0.0, approach, 0.0], (len(elements.azimuth), 1))
        force = float(settle(problem, v, nearest(problem, v, None, 0.0), 0.0)[1].ring[0, 1])
        rows.append((force, 1e3 * (approach - own * force)))
    return [rows[0], *(row for row in rows[1:] if row[0] > 0.0)]


def rollers(bent: BentRing) -> np.ndarray:
    """Azimuths of the rollers that are solved."""
    return bent.azimuth[np.sin(bent.azimuth) > 1e-6]


def supports_of(bent: BentRing) -> np.ndarray:
    """Azimuths of the supports' patches that are solved."""
    return bent.seated.support[np.sin(bent.seated.support) > 1e-6]


def deck(bent: BentRing, moved_by: float) -> list[str]:
    """The input deck; ``moved_by``: displacement [m] of the inner ring."""
    nodes, cells = _hexahedra()
    azimuth, radius = np.arctan2(nodes[:, 2], nodes[:, 1]), np.hypot(nodes[:, 1], nodes[:, 2])
    x = np.abs(nodes[:, 0])
    inside = radius < 500.0 * BEARING.outer_race_diameter + 1e-6
    outside = radius > 500.0 * BEARING.outside_diameter - 1e-6
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{k}, {a:.12e}, {b:.12e}, {c:.12e}" for k, (a, b, c) in enumerate(nodes, 1)]
    lines.append("*ELEMENT, TYPE=C3D20R, ELSET=RING")
    for k, cell in enumerate(cells, 1):
        numbers = [str(n + 1) for n in cell]
        lines += [f"{k}, {', '.join(numbers[:10])},", ", ".join(numbers[10:])]
    steel = BEARING.material
    lines += [
        "*MATERIAL, NAME=M", "*ELASTIC",
        f"{1e-6 * steel.youngs_modulus:.8e}, {steel.poisson_ratio}",
        "*SOLID SECTION, ELSET=RING, MATERIAL=M",
    ]  # fmt: skip
    free = len(nodes) + 1  # numbers of nodes to come: what ports and the inner ring displace
    inner = free
    extra, equations, springs = [inner], [], []
    element = len(cells) + 1
    half = 500.0 * BEARING.effective_length
    for psi in rollers(bent):
        port, moved = inner + len(extra), inner + len(extra) + 1
        extra += [port, moved]
        weight = _weights(nodes, inside & (x < half + 1e-6), azimuth - psi,
                          bent.seated.reduction.along, half)  # fmt: skip
        equations += _equation(weight, azimuth, port)
        equations += ["*EQUATION", "2", f"{moved}, 1, 1.0, {inner}, 1, {-np.cos(psi):.12e}"]
        springs.append((element, moved, port))
        element += 1
    supports = []
    for psi in supports_of(bent):
        port = inner + len(extra)
        extra.append(port)
        weight = _weights(nodes, outside, azimuth - psi, bent.seated.support_length,
                          500.0 * BEARING.width)  # fmt: skip
        equations += _equation(weight, azimuth, port)
        supports.append((element, port))
        element += 1
    lines.append("*NODE, NSET=PORTS")
    lines += [f"{k}, 0.0, 0.0, 0.0" for k in extra]
    lines += equations
    lines.append("*ELEMENT, TYPE=SPRING2, ELSET=ROLLERS")
    lines += [f"{k}, {a}, {b}" for k, a, b in springs]
    table = [f"{0.5 * f:.8e}, {d:.8e}" for f, d in law(bent)]
    lines += ["*SPRING, ELSET=ROLLERS, NONLINEAR", "1, 1", f"{-LOOSE}, -1.0", *table]
    lines.append("*ELEMENT, TYPE=SPRING1, ELSET=SUPPORTS")
    lines += [f"{k}, {a}" for k, a in supports]
    lines += ["*SPRING, ELSET=SUPPORTS, NONLINEAR", "1", f"{-LOOSE}, -1.0", "0.0, 0.0",
              f"{FIRM:.6e}, 1.0"]  # fmt: skip
    lines += ["*NSET, NSET=XSYM", *(f"{k + 1}," for k in np.flatnonzero(x < 1e-9))]
    plane = np.flatnonzero(np.abs(nodes[:, 2]) < 1e-9)
    lines += ["*NSET, NSET=ZSYM", *(f"{k + 1}," for k in plane)]
    lines += ["*BOUNDARY", "XSYM, 1, 1", "ZSYM, 3, 3"]
    lines += [f"{k}, 2, 3" for k in extra]
    lines += [
        "*STEP, NLGEOM, INC=200", "*STATIC", "0.25, 1.0, 1e-6, 0.25",
        "*BOUNDARY", f"{inner}, 1, 1, {1e3 * moved_by:.9e}",
        "*NODE PRINT, NSET=PORTS, FREQUENCY=999", "U", "*END STEP",
    ]  # fmt: skip
    return lines


def _weights(
    nodes: np.ndarray, chosen: np.ndarray, apart: np.ndarray, length: float, half: float
) -> np.ndarray:
    """Weights (n,) of nodes in the mean displacement of a patch, Gaussian around the ring and even
    across: Simpson's rule over the quadratic edges in both directions."""
    apart = (apart + np.pi) % (2.0 * np.pi) - np.pi
    chosen = chosen & (np.abs(apart) < REACH * length)
    places = np.unique(np.round(nodes[chosen][:, 0], 9))
    across = {p: (1.0 if k in (0, len(places) - 1) else 4.0 if k % 2 else 2.0)
              for k, p in enumerate(places)}  # fmt: skip
    weight = np.exp(-0.5 * (apart / length) ** 2) * chosen
    weight[chosen] *= [across[p] for p in np.round(nodes[chosen][:, 0], 9)]
    return weight / weight.sum()


def _equation(weight: np.ndarray, azimuth: np.ndarray, port: int) -> list[str]:
    """The mean radial displacement of a patch is that of a port, along its first direction."""
    terms = [(port, 1, -1.0)]
    for k in np.flatnonzero(weight):
        for direction, part in ((2, np.cos(azimuth[k])), (3, np.sin(azimuth[k]))):
            if abs(part) > 1e-12:
                terms.append((k + 1, direction, weight[k] * part))
    lines = ["*EQUATION", str(len(terms))]
    return lines + [f"{n}, {d}, {c:.12e}" for n, d, c in terms]


def _hexahedra() -> tuple[np.ndarray, np.ndarray]:
    """Nodes and cells of half the ring, x from 0 on; the middles of its faces are left out."""
    half, line = 500.0 * BEARING.width, 500.0 * BEARING.effective_length
    edges = np.concatenate([np.linspace(0.0, line, ALONG), [half]])
    x = _halved(edges)
    r = _halved(500.0 * np.linspace(BEARING.outer_race_diameter, BEARING.outside_diameter,
                                    THROUGH + 1))  # fmt: skip
    psi = np.pi * np.arange(AROUND + 1) / AROUND
    i, j, k = np.meshgrid(np.arange(len(x)), np.arange(len(r)), np.arange(len(psi)), indexing="ij")
    number = -np.ones(i.shape, int)
    kept = (i % 2) + (j % 2) + (k % 2) < 2
    number[kept] = np.arange(kept.sum())
    nodes = np.stack([x[i], r[j] * np.cos(psi[k]), r[j] * np.sin(psi[k])], axis=-1)[kept]
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)]
    corners += [(a, b, 2) for a, b, _ in corners]
    pairs = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4),
             (0, 4), (1, 5), (2, 6), (3, 7)]  # fmt: skip
    local = np.array(corners + [tuple((np.array(corners[a]) + corners[b]) // 2) for a, b in pairs])
    begin = np.stack(np.meshgrid(np.arange(0, len(x) - 1, 2), np.arange(0, len(r) - 1, 2),
                                 np.arange(0, len(psi) - 1, 2), indexing="ij"), -1)  # fmt: skip
    at = begin.reshape(-1, 1, 3) + local
    return nodes, number[at[..., 0], at[..., 1], at[..., 2]]


def _halved(edges: np.ndarray) -> np.ndarray:
    return np.sort(np.concatenate([edges, 0.5 * (edges[1:] + edges[:-1])]))


def solve(bent: BentRing, moved_by: float, folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Forces [N] of rollers and supports, by the displacements that CalculiX finds."""
    (folder / "arcs.inp").write_text("\n".join(deck(bent, moved_by)) + "\n", encoding="ascii")
    done = subprocess.run(["ccx", "arcs"], cwd=folder, capture_output=True, text=True, check=False)
    text = (folder / "arcs.dat").read_text(encoding="ascii")
    rows = [line.split() for line in text.splitlines() if len(line.split()) == 4]
    count, held = len(rollers(bent)), len(supports_of(bent))
    found = np.array([float(row[1]) for row in rows[-(1 + 2 * count + held) :]])
    if done.returncode or len(found) != 1 + 2 * count + held:
        raise RuntimeError(f"ccx failed: {done.stdout[-500:]}")
    inner, ports = found[0], found[1 : 1 + 2 * count : 2]
    force, approach = np.array(law(bent)).T
    pressed = np.interp(inner * np.cos(rollers(bent)) - ports, approach, force)
    return pressed, 2.0 * FIRM * np.maximum(found[1 + 2 * count :], 0.0)


def main() -> None:
    """Solve and store."""
    solution = ours()
    (bent,) = solution.rings
    with tempfile.TemporaryDirectory() as folder:
        pressed, supports = solve(bent, solution.displacement[1], Path(folder))
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    stored = {
        "source": f"CalculiX {said.split()[-1]}",
        "displacement_m": solution.displacement[1],
        "roller_force_n": pressed.round(3).tolist(),
        "support_force_n": supports.round(3).tolist(),
    }
    STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
