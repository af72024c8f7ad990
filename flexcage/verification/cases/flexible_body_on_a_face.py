"""The same body in a frame tied to one of its end faces."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage.verification.cases.flexible_body import POSITION, drift_rows, modal_rows
from flexcage.verification.free_motion import ProjectedMesh, launch, tumbler
from flexcage.verification.known_answer import KnownAnswer, Row


def rows() -> Iterator[Row]:
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


CASE = KnownAnswer(
    name="flexible_body_on_a_face",
    title="Flexible body in a frame tied to an end face",
    source="d'Alembert's principle on the unreduced mesh, integrated here: nodal accelerations "
    "times the mesh's mass matrix, projected on the shapes, without any inertia invariant",
    checks="As `flexible_body` for 5 ms, with shapes less the rigid motion of an end face, so that "
    "modes couple with the frame's translation and rotation. Leaving that coupling out would cost "
    "1210 um.",
    rows=rows,
)
