"""Beam shafts as bodies in files, whole or by Craig and Bampton's reduction, for the tests."""

from __future__ import annotations

import numpy as np
import scipy.linalg as la

from flexcage.machine.shaft import build_shaft
from flexcage.machine.spec import Shaft, ShaftSection
from flexcage.modes.exchange.body import MODAL, ReducedBody
from flexcage.modes.exchange.formats import write_body

SECTIONS = ((60.0, 30.0), (120.0, 44.0), (80.0, 36.0))  # mm: length, diameter
LENGTH = 260.0
STATIONS = (0.0, 70.0, 150.0, 210.0, 260.0)  # mm: wheel, bearings, load, end
FIVE = [0, 1, 2, 4, 5]


def beam_body(elements=60, *, spin=True, gyroscopic=True, oval=0.0):
    """The matrices of the beam shaft: five coordinates a node, and with ``spin`` its turn about x,
    of a linear interpolation; ``oval``: by which share its inertia about z is larger."""
    sections = tuple(ShaftSection(length=1e-3 * L, diameter=1e-3 * d) for L, d in SECTIONS)
    beam = build_shaft(Shaft(sections=sections, elements=elements), [1e-3 * x for x in STATIONS])
    n = len(beam.places)
    size = 6 if spin else 5
    own = np.array([size * k + (c if spin else i) for k in range(n) for i, c in enumerate(FIVE)])
    K, M, G = (np.zeros((size * n, size * n)) for _ in range(3))
    for whole, part in ((K, beam.stiffness), (M, beam.mass), (G, beam.gyroscopic)):
        whole[np.ix_(own, own)] = part
    turns = size * np.arange(n) + (5 if spin else 4)
    M[turns, turns] *= 1.0 + oval
    for k, piece in enumerate(beam.beams if spin else ()):
        at = [6 * k + 3, 6 * k + 9]
        polar = 2.0 * piece.section.second_moment
        shear = piece.material.youngs_modulus / (2.0 + 2.0 * piece.material.poisson_ratio)
        K[np.ix_(at, at)] += shear * polar / piece.length * np.array([[1.0, -1.0], [-1.0, 1.0]])
        M[np.ix_(at, at)] += (
            piece.material.density * polar * piece.length / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
        )
    nodes = np.column_stack([beam.places, np.zeros((n, 2))])
    components = range(6) if spin else FIVE
    dofs = np.array([(k, c) for k in range(n) for c in components])
    return ReducedBody(
        stiffness=K, mass=M, nodes=nodes, dofs=dofs, gyroscopic=G if gyroscopic else None
    )


def reduced(body, modes, places=STATIONS):
    """Craig and Bampton's reduction to the nodes at ``places`` [mm] with so many modes."""
    kept = [k for k, x in enumerate(body.nodes[:, 0]) if np.abs(1e3 * x - places).min() < 1e-6]
    own = np.flatnonzero(np.isin(body.dofs[:, 0], kept))
    rest = np.setdiff1d(np.arange(body.size), own)
    static = -np.linalg.solve(body.stiffness[np.ix_(rest, rest)], body.stiffness[np.ix_(rest, own)])
    inner = np.ix_(rest, rest)
    swings = la.eigh(body.stiffness[inner], body.mass[inner])[1][:, :modes]
    basis = np.zeros((body.size, len(own) + modes))
    basis[own, : len(own)] = np.eye(len(own))
    basis[rest] = np.hstack([static, swings])
    dofs = [(kept.index(n), c) for n, c in body.dofs[own]] + [(MODAL, 0)] * modes
    given = body.gyroscopic
    return ReducedBody(
        stiffness=basis.T @ body.stiffness @ basis, mass=basis.T @ body.mass @ basis,
        nodes=body.nodes[kept], dofs=np.array(dofs),
        gyroscopic=None if given is None else basis.T @ given @ basis,
    )  # fmt: skip


def shaft_of(body, folder, ending="npz"):
    """The [shaft] of a body that is written into a folder."""
    file = write_body(body, folder / f"shaft.{ending}")
    return {"body": str(file), "length": f"{LENGTH} mm"}


def beams(elements=60):
    """The same shaft by its sections."""
    sections = [{"length": f"{L} mm", "diameter": f"{d} mm"} for L, d in SECTIONS]
    return {"sections": sections, "elements": elements}


def rotor(shaft, *, rpm=12000, duration="1 ms", **changes):
    """A wheel that overhangs, two bearings, a load: tables of a machine."""
    rows = [
        {"name": name, "preset": "7010C-PI", "position": f"{x} mm", "facing": face,
         "axial_offset": "6 um", "bearing": {"material": "GCr15"}, "cage": {"model": "rigid"}}
        for name, x, face in (("front", 70.0, "-x"), ("rear", 210.0, "+x"))
    ]  # fmt: skip
    wheel = {"position": "0 mm", "mass": "2 kg", "polar_inertia": "0.008 kg*m^2",
             "diametral_inertia": "0.005 kg*m^2", "unbalance": "10 g*mm"}  # fmt: skip
    load = {"position": "150 mm", "force": ["100 N", "300 N", "-50 N"],
            "moment": ["0 N*m", "2 N*m"]}  # fmt: skip
    return {
        "name": "rotor", "drive": {"speed": f"{rpm} rpm"}, "gravity": {"direction": "180 deg"},
        "shaft": {**shaft, "discs": [wheel], "loads": [load], **changes}, "bearings": rows,
        "solver": {"duration": duration}, "output": {"block": 50},
    }  # fmt: skip
