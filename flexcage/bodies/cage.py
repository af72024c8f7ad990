"""The cage as a body: rigid from its mesh's volume integrals, or flexible from its reduction."""

from __future__ import annotations

import numpy as np

from flexcage.bodies.floating_frame import BodyData, FlexibleBody, flexible_body, rigid_body
from flexcage.core.hashing import content_hash
from flexcage.core.threads import one_blas_thread
from flexcage.modes.basis import ModeBasis
from flexcage.modes.reduction import CageReduction
from flexcage.modes.spec import ModesSpec

BODY_VERSION = 1  # of ``flexible_body``: raise it when the same input gives other invariants


def rigid_from_tets(points: np.ndarray, tets: np.ndarray, density: float) -> FlexibleBody:
    """Rigid body of a homogeneous mesh of straight tetrahedra (exact integrals)."""
    p = points[tets]  # (n, 4, 3)
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    volume = np.einsum("ni,ni->n", normal, p[:, 3] - p[:, 0])
    mass = density * volume / 6.0
    total = p.sum(axis=1)
    first = 0.25 * (mass[:, None] * total).sum(axis=0)
    # int x x^T over a tetrahedron = m/20 (sum_a p_a p_a^T + s s^T), s = sum_a p_a
    second = np.einsum("n,nai,naj->ij", mass, p, p) + np.einsum("n,ni,nj->ij", mass, total, total)
    m = float(mass.sum())
    return rigid_body(m, first / m, second / 20.0)


def flexible_from_basis(
    nodes: np.ndarray, mass_scalar, basis: ModeBasis, damping_ratios: np.ndarray
) -> FlexibleBody:
    """Flexible cage: modal damping 2 zeta omega m on the diagonal of the reduced matrices.

    It stiffens with spin if the basis says by how much (``basis.geometric``).
    """
    omega = 2.0 * np.pi * basis.frequencies
    damping = np.diag(2.0 * damping_ratios * omega * np.diag(basis.mass))
    return flexible_body(
        nodes, mass_scalar, basis.shapes, basis.stiffness, damping, geometric=basis.geometric
    )


def flexible_from_reduction(cage: CageReduction, spec: ModesSpec) -> FlexibleBody:
    """Flexible cage with the damping of ``spec``; its invariants are kept on disk, in the cache or
    in the folder of a run."""

    @one_blas_thread
    def make() -> dict[str, np.ndarray]:
        ratios = spec.damping_ratios(cage.basis.frequencies)
        body = flexible_from_basis(cage.model.nodes, cage.model.mass_scalar, cage.basis, ratios)
        return body.data._asdict()

    key = content_hash(BODY_VERSION, cage.version, spec)
    stored = cage.arrays("body", key, make)
    numbers = {"mass": float(stored["mass"]), "plain": int(stored["plain"])}
    return FlexibleBody(BodyData(**{**stored, **numbers}))  # type: ignore[arg-type]
