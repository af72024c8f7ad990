"""A flexible body that tumbles free of force, in a frame that follows its mean motion."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy import sparse

from flexcage.verification.free_motion import Tumbler, full_mesh_invariants, launch, tumbler
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

POSITION = Tolerance(1e-3, "both programs agree to 1e-3 nm; deformations are 0.6 mm", absolute=True)
MODAL = Tolerance(1e-5, "share of the largest coordinate, integrated with 1e-11", absolute=True)
KEPT = Tolerance(1e-8, "invariants, integrated with 1e-11", absolute=True)
MASS = Tolerance(1e-12, "a sum, to rounding")


def modal_rows(flyer: Tumbler, states: np.ndarray, reference: np.ndarray) -> Iterator[Row]:
    """Modal coordinates of the states against others (n, modes)."""
    q = np.array([flyer.split(y)[4] for y in states])
    apart = np.abs(q - reference).max() / np.abs(reference).max()
    yield Row("largest difference of modal coordinates", "", 0.0, apart, MODAL)


def drift_rows(
    flyer: Tumbler, states: np.ndarray, points: np.ndarray, shapes: np.ndarray,
    mass: sparse.csr_matrix,
) -> Iterator[Row]:  # fmt: skip
    """Largest relative change of energy, momentum and angular momentum over the states."""
    seen = [full_mesh_invariants(flyer, y, points, shapes, mass) for y in states]
    for name, values in zip(("energy", "momentum", "angular momentum"), zip(*seen)):
        first = np.asarray(values[0])
        drift = np.abs(np.array(values) - first).max() / np.linalg.norm(first)
        yield Row(f"drift of {name}", "", 0.0, float(drift), KEPT)


def rows() -> Iterator[Row]:
    flyer, d, mass = tumbler("free")
    states = flyer.fly(launch(flyer, d), d["time"])
    seen = d["observed"]
    shapes = d["shapes_free"][seen]
    x = np.array([flyer.nodes(y, d["nodes"][seen], shapes)[0] for y in states])
    for name, key in (("first", "position"), ("second", "position_second")):
        apart = 1e6 * np.abs(x - d[key]).max()
        yield Row(f"largest distance from the {name} program", "um", 0.0, apart, POSITION)
    yield from modal_rows(flyer, states, d["modal"])
    yield from drift_rows(flyer, states, d["nodes"], d["shapes_free"], mass)
    yield Row("mass", "g", 96.56849805208265, 1e3 * flyer.data.mass, MASS)


CASE = KnownAnswer(
    name="flexible_body",
    title="Flexible body free of force",
    source="two independent programs (one a projection of the full mesh's motion, DOP853 at "
    "1e-11); body and motions in flexcage/verification/data",
    checks="An open ring with a tab tumbles for 20 ms at 40 turns a second with 12 free-free modes "
    "excited: positions of three nodes, modal coordinates and invariants. Leaving out Coriolis "
    "terms would cost 370 um within 5 ms, centrifugal ones 16 um, inertia that follows the "
    "deformation 4.7 um.",
    rows=rows,
)
