"""A flexible body that tumbles free of force, in a frame that follows its mean motion.

An open ring with a tab tumbles for 20 ms at 40 turns a second with 12 free-free modes excited:
positions of three nodes, modal coordinates and invariants. Leaving out Coriolis terms would cost
370 um within 5 ms, centrifugal ones 16 um, inertia that follows the deformation 4.7 um.

Source: two independent programs (one a projection of the full mesh's motion, DOP853 at 1e-11); body
and motions in tests/bodies/data.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from free_motion import ProjectedMesh, Tumbler, full_mesh_invariants, launch, tumbler
from known_rows import check
from scipy import sparse

from flexcage.verification import Row, Tolerance

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


def in_its_mean_motion() -> Iterator[Row]:
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


def on_a_face() -> Iterator[Row]:
    """As above for 5 ms, in a frame tied to an end face, so that modes couple with the frame's
    translation and rotation. Leaving that coupling out would cost 1210 um.

    Source: d'Alembert's principle on the unreduced mesh, integrated here: nodal accelerations times
    the mesh's mass matrix, projected on the shapes, without any inertia invariant.
    """
    flyer, d, mass = tumbler("clamped")
    shapes, seen = d["shapes_clamped"], d["observed"]
    times = d["time"][:51]
    states = flyer.fly(launch(flyer, d), times)
    mesh = ProjectedMesh(flyer.body, d["nodes"], shapes, mass)
    reference = mesh.fly(launch(mesh, d), times)
    x, expected = (
        np.array([flyer.nodes(y, d["nodes"][seen], shapes[seen])[0] for y in run])
        for run in (states, reference)
    )
    yield Row(
        "largest distance from the mesh", "um", 0.0, 1e6 * np.abs(x - expected).max(), POSITION
    )
    yield from modal_rows(flyer, states, np.array([mesh.split(y)[4] for y in reference]))
    yield from drift_rows(flyer, states, d["nodes"], shapes, mass)


def test_a_free_flexible_body():
    check(in_its_mean_motion())


def test_a_body_in_a_frame_on_its_face():
    check(on_a_face())
