"""CalculiX (ccx): an N1013's outer ring of hexahedra on two arcs, its rollers as springs.

    python tests/verification/ring_on_arcs_calculix.py

writes ``data/ring_on_arcs_calculix.json``: the force of every roller, for arcs of three widths.
CalculiX gives how far rollers' patches and narrow strips of the seat yield under a force on each
other; SciPy finds which strips of an arc press, and the forces under the load. A roller's force
over its approach between rigid races is flexcage's; the half-space that it holds is taken from it,
as the patch of hexahedra on which it acts yields as well. Units are mm and N. A quarter of the ring
is solved, x and z from 0 on, with its translation along y held at one node and put back here;
rollers in the plane z = 0 and beyond 90 degrees, which bear nothing, are left out. Integration is
full: with the reduced one narrow strips sink in without end as hexahedra become flat.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.optimize import nnls, root

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
MIDDLE, ARCS = 60.0, (5.0, 10.0, 20.0)  # [deg] of an arc, and how wide it is
HALF = (0.0, 1.0, 1.7, 2.2, 2.5, 3.0, 3.6, 4.2, 4.7, 5.0, 5.4, 6.2, 7.2, 8.4, 9.2, 9.7, 10.0)
STRIPS = MIDDLE + np.concatenate([-np.array(HALF[:0:-1]), HALF])  # [deg] edges of strips
AROUND = 144  # hexahedra of half a turn beside the arc
ALONG = (0.0, 0.5, 0.8, 0.95, 1.0)  # of half a roller's length: edges of hexahedra
THROUGH = (0.0, 0.08, 0.22, 0.5, 0.78, 0.92, 1.0)  # of the wall, from the race outwards
REACH = 4.0  # standard deviations of a patch that are loaded


def ours(arc: float) -> StaticSolution:
    """flexcage's solution on arcs as wide as ``arc`` [deg]."""
    ring = OuterRing(
        ring="flexible", seat="arcs", supports=tuple(np.radians([MIDDLE, -MIDDLE])),
        support_arc=np.radians(arc),
    )  # fmt: skip
    rings = Rings(outer=ring, sections=sections_of(BEARING))
    return solve_bearing(BEARING, statics_of(BEARING), load=LOAD, rings=rings)


def law(bent: BentRing) -> list[tuple[float, float]]:
    """Force [N] of a roller over its approach [mm], less what the half-space under its patch
    yields."""
    elements = statics_of(BEARING)(BEARING, speed=0.0, contacts=Contacts(), options=StaticOptions())
    problem = posed(BEARING, elements, LOAD, StaticOptions())
    own = bent.seated.reduction.half_space[0, 0]
    rows = []
    for approach in np.arange(0.0, 6e-5, 2e-7):
        v = np.tile([0.0, approach, 0.0], (len(elements.azimuth), 1))
        force = float(settle(problem, v, nearest(problem, v, None, 0.0), 0.0)[1].ring[0, 1])
        rows.append((force, 1e3 * (approach - own * force)))
    first = next(k for k, row in enumerate(rows) if row[0] > 0.0)
    return rows[first - 1 :]


def solved(bent: BentRing) -> np.ndarray:
    """Numbers of the rollers that are solved."""
    psi = bent.azimuth
    return np.flatnonzero((np.sin(psi) > 1e-6) & (np.cos(psi) > 1e-6))


def rollers(bent: BentRing) -> np.ndarray:
    """Azimuths of the rollers that are solved."""
    return bent.azimuth[solved(bent)]


def strips() -> tuple[np.ndarray, np.ndarray]:
    """Middles and widths [rad] of the seat's strips."""
    edges = np.radians(STRIPS)
    return 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)


def deck(bent: BentRing) -> list[str]:
    """The input deck: a step for a force of 1 kN on every patch, rollers' and then strips."""
    nodes, cells = _hexahedra()
    azimuth, radius = np.arctan2(nodes[:, 2], nodes[:, 1]), np.hypot(nodes[:, 1], nodes[:, 2])
    x = np.abs(nodes[:, 0])
    inside = radius < 500.0 * BEARING.outer_race_diameter + 1e-6
    outside = radius > 500.0 * BEARING.outside_diameter - 1e-6
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{k}, {a:.12e}, {b:.12e}, {c:.12e}" for k, (a, b, c) in enumerate(nodes, 1)]
    lines.append("*ELEMENT, TYPE=C3D20, ELSET=RING")
    for k, cell in enumerate(cells, 1):
        numbers = [str(n + 1) for n in cell]
        lines += [f"{k}, {', '.join(numbers[:10])},", ", ".join(numbers[10:])]
    steel = BEARING.material
    lines += [
        "*MATERIAL, NAME=M", "*ELASTIC",
        f"{1e-6 * steel.youngs_modulus:.8e}, {steel.poisson_ratio}",
        "*SOLID SECTION, ELSET=RING, MATERIAL=M",
    ]  # fmt: skip
    half, first = 500.0 * BEARING.effective_length, len(nodes) + 1
    r = bent.seated.reduction
    weights = [
        _weights(nodes, inside & (x < half + 1e-6), np.round(azimuth, 12), _gauss(psi, r.along))
        for psi in rollers(bent)
    ]
    for psi, width in zip(*strips()):
        on = outside & (np.abs(azimuth - psi) < 0.5 * width + 1e-9)
        weights.append(_weights(nodes, on, np.round(azimuth, 12), np.ones_like))
    ports = first + np.arange(len(weights))
    lines += ["*NODE, NSET=PORTS", *(f"{k}, 0.0, 0.0, 0.0" for k in ports)]
    for port, weight in zip(ports, weights):
        lines += _equation(weight, azimuth, [(int(port), 1, -1.0)])
    plane = np.abs(nodes[:, 2]) < 1e-9
    held = plane & outside & (nodes[:, 1] < 0.0) & (x < 1e-9)
    for name, on in (("XSYM", x < 1e-9), ("ZSYM", plane), ("HELD", held)):
        lines += [f"*NSET, NSET={name}", *(f"{k + 1}," for k in np.flatnonzero(on))]
    lines += ["*BOUNDARY", "XSYM, 1, 1", "ZSYM, 3, 3", "HELD, 2, 2"]
    lines += [f"{k}, 2, 3" for k in ports]
    for port in ports:
        lines += [
            "*STEP", "*STATIC", "*CLOAD, OP=NEW", f"{port}, 1, 500.0",  # of half the width
            "*NODE PRINT, NSET=PORTS", "U", "*END STEP",
        ]  # fmt: skip
    return lines


def _gauss(psi: float, length: float) -> Callable[[np.ndarray], np.ndarray]:
    return lambda azimuth: (
        np.exp(-0.5 * ((azimuth - psi) / length) ** 2) * (np.abs(azimuth - psi) < REACH * length)
    )


def _weights(
    nodes: np.ndarray, chosen: np.ndarray, azimuth: np.ndarray,
    density: Callable[[np.ndarray], np.ndarray],
) -> np.ndarray:  # fmt: skip
    """Weights (n,) of nodes in the mean displacement of a patch, of a ``density`` around the ring
    and even across: Simpson's rule over the quadratic edges in both directions."""
    weight = np.zeros(len(nodes))
    places = [np.round(nodes[:, 0], 9), azimuth]
    parts = [_simpson(np.unique(p[chosen])) for p in places]
    stations = [np.unique(p[chosen]) for p in places]
    x, psi = (np.searchsorted(s, p[chosen]) for s, p in zip(stations, places))
    weight[chosen] = parts[0][x] * parts[1][psi] * density(azimuth[chosen])
    return weight / weight.sum()


def _simpson(places: np.ndarray) -> np.ndarray:
    """Weights at the ends and middles of edges, one after the other."""
    weight = np.zeros(len(places))
    for k in range(0, len(places) - 1, 2):
        weight[k : k + 3] += (places[k + 2] - places[k]) * np.array([1.0, 4.0, 1.0]) / 6.0
    return weight


def _equation(
    weight: np.ndarray, azimuth: np.ndarray, terms: list[tuple[int, int, float]]
) -> list[str]:
    """The mean radial displacement of a patch, and further terms, are zero together."""
    terms = list(terms)
    for k in np.flatnonzero(weight):
        for direction, part in ((2, np.cos(azimuth[k])), (3, np.sin(azimuth[k]))):
            if abs(part) > 1e-12:
                terms.append((k + 1, direction, weight[k] * part))
    lines = ["*EQUATION", str(len(terms))]
    return lines + [f"{n}, {d}, {c:.12e}" for n, d, c in terms]


def _hexahedra() -> tuple[np.ndarray, np.ndarray]:
    """Nodes and cells of half the ring, x from 0 on; the middles of its faces are left out."""
    half, line = 500.0 * BEARING.width, 500.0 * BEARING.effective_length
    x = _halved(np.append(line * np.array(ALONG), half))
    race, seat = 500.0 * BEARING.outer_race_diameter, 500.0 * BEARING.outside_diameter
    r = _halved(race + (seat - race) * np.array(THROUGH))
    psi = np.radians(_halved(_around()))
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


def _around() -> np.ndarray:
    """Edges [deg] of hexahedra around half a turn: strips where the arc is."""
    even = np.linspace(0.0, 180.0, AROUND + 1)
    return np.concatenate([even[even < STRIPS[0] - 0.1], STRIPS, even[even > STRIPS[-1] + 0.1]])


def _halved(edges: np.ndarray) -> np.ndarray:
    return np.sort(np.concatenate([edges, 0.5 * (edges[1:] + edges[:-1])]))


def compliance(bent: BentRing, folder: Path) -> np.ndarray:
    """How far [mm/N] patches yield under forces on them, and their mirror images."""
    (folder / "arcs.inp").write_text("\n".join(deck(bent)) + "\n", encoding="ascii")
    done = subprocess.run(["ccx", "arcs"], cwd=folder, capture_output=True, text=True, check=False)
    text = (folder / "arcs.dat").read_text(encoding="ascii")
    rows = [line.split() for line in text.splitlines() if len(line.split()) == 4]
    count = len(rollers(bent)) + len(STRIPS) - 1
    if done.returncode or len(rows) != count**2:
        raise RuntimeError(f"ccx failed: {done.stdout[-500:]}")
    return np.array([float(row[1]) for row in rows]).reshape(count, count).T / 1000.0


def pressing(yields: np.ndarray, cos: np.ndarray, pressed: np.ndarray) -> np.ndarray:
    """Displacements of the rollers' patches under their forces, between strips that only press.

    Strips' forces p >= 0 have the least energy that balances the rollers' forces along y.
    """
    count = len(pressed)
    among, beside = yields[count:, count:], yields[count:, :count] @ pressed
    root_of, heavy = np.linalg.cholesky(among), 1e3 * np.sqrt(np.trace(among))
    balanced = cos[:count] @ pressed
    rows = np.vstack([root_of.T, heavy * cos[count:]])
    p, _ = nnls(rows, np.append(np.linalg.solve(root_of, beside), heavy * balanced))
    on = p > 1e-9 * p.max()
    border = np.block([[among[np.ix_(on, on)], -cos[count:][on, None]],
                       [cos[count:][None, on], np.zeros((1, 1))]])  # fmt: skip
    solved_for = np.linalg.solve(border, np.append(beside[on], balanced))
    p[on], across = solved_for[:-1], solved_for[-1]
    return yields[:count, :count] @ pressed - yields[:count, count:] @ p + cos[:count] * across


def forces(bent: BentRing, yields: np.ndarray, arc: float) -> tuple[float, np.ndarray]:
    """Displacement [m] of the inner ring under the load, and forces [N] of the rollers, on arcs
    ``arc`` [deg] wide."""
    force, approach = np.array(law(bent)).T
    middle = strips()[0]
    count = len(rollers(bent))
    here = np.abs(np.degrees(middle) - MIDDLE) < 0.5 * arc
    keep = np.concatenate([np.arange(count), count + np.flatnonzero(here)])
    there, cos = yields[np.ix_(keep, keep)], np.cos(np.append(rollers(bent), middle[here]))

    def gap(unknown: np.ndarray) -> np.ndarray:
        inner, approaches = unknown[0], unknown[1:]
        pressed = np.interp(approaches, approach, force)
        left = approaches - inner * cos[:count] + pressing(there, cos, pressed)
        return np.append(left, 1e-6 * (2.0 * pressed @ cos[:count] - LOAD.radial))

    start = np.append(1e3 * ours(arc).displacement[1], np.full(count, approach[10]))
    found = root(gap, start, tol=1e-12)
    if np.abs(found.fun).max() > 1e-8:
        raise RuntimeError(f"no equilibrium: {found.message}")
    return 1e-3 * found.x[0], np.interp(found.x[1:], approach, force)


def main() -> None:
    """Solve and store."""
    (bent,) = ours(ARCS[0]).rings
    with tempfile.TemporaryDirectory() as folder:
        yields = compliance(bent, Path(folder))
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False).stdout
    rows = []
    for arc in ARCS:
        inner, pressed = forces(bent, yields, arc)
        rows.append({
            "arc_deg": arc, "displacement_m": inner, "roller_force_n": pressed.round(3).tolist(),
        })  # fmt: skip
    stored = {
        "source": f"CalculiX {said.split()[-1]}",
        "yields_mm_per_n": [[float(f"{y:.7g}") for y in row] for row in yields],
        "arcs": rows,
    }
    STORED.write_text(json.dumps(stored) + "\n", encoding="utf-8")


if __name__ == "__main__":
    sys.exit(main())
