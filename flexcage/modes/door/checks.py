"""Is a body what it should be? One sentence each on what it is not.

``check_body`` holds for every body; ``check_free`` for those that nothing holds, as cages.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh, eigvalsh

from flexcage.core.errors import InputError
from flexcage.modes.door.body import ReducedBody

_ASYMMETRY = 1e-6  # of the largest entry: text of seven digits
_NEGATIVE = 1e-8  # of the largest eigenvalue: rounding of matrices that are positive semi-definite
_HELD = 1e-5  # of the forces that rigid motion makes entry by entry: text of seven digits
_MECHANISM = 1e-12  # of the largest scaled stiffness: a motion without any
_MASSLESS = 1e-12  # of the longest squared period: a motion without mass


def check_body(body: ReducedBody, *, where: str) -> None:
    """Raise InputError for matrices that are no finite, symmetric, positive semi-definite ones."""
    for name, matrix in (("stiffness", body.stiffness), ("mass", body.mass)):
        if matrix is not None:
            _check_numbers(body, name, matrix, where)
    if not np.isfinite(body.nodes).all():
        raise InputError(f"{body.source}: places of nodes are not finite numbers.", where=where)
    if not sp.issparse(body.stiffness):
        stiffness, mass = body.dense()
        _check_definite(body, "stiffness", stiffness, where)
        _check_definite(body, "mass", mass, where)


def _check_numbers(body: ReducedBody, name: str, matrix: Any, where: str) -> None:
    values = matrix.data if sp.issparse(matrix) else np.asarray(matrix)
    if np.iscomplexobj(values) or not np.isfinite(values).all():
        raise InputError(
            f"{body.source}: the {name} matrix has entries that are no real numbers.", where=where
        )
    largest = abs(values).max(initial=0.0)
    if not largest > 0.0:
        raise InputError(f"{body.source}: the {name} matrix is zero.", where=where)
    asymmetry = abs(matrix - matrix.T).max() / largest
    if asymmetry > _ASYMMETRY:
        raise InputError(
            f"{body.source}: the {name} matrix is not symmetric: entries differ by {asymmetry:.1e} "
            "of the largest; write the whole matrix, or one triangle as its format has it.",
            where=where,
            value=float(asymmetry),
        )


def _scaled(matrix: np.ndarray) -> np.ndarray:
    """The matrix with ones on its diagonal: what has rotations and modes beside translations has
    entries of all sizes."""
    size = np.sqrt(np.abs(np.diag(matrix)))
    size[size == 0.0] = 1.0
    return matrix / np.outer(size, size)


def _check_definite(body: ReducedBody, name: str, matrix: np.ndarray, where: str) -> None:
    values = eigvalsh(_scaled(matrix))
    if values[0] < -_NEGATIVE * values[-1]:
        negative = int(np.count_nonzero(values < -_NEGATIVE * values[-1]))
        raise InputError(
            f"{body.source}: the {name} matrix is not positive semi-definite: {negative} of its "
            f"{len(values)} eigenvalues are negative, down to {values[0] / values[-1]:.1e} of the "
            "largest.",
            where=where,
            value=float(values[0]),
        )


def check_free(body: ReducedBody, *, where: str) -> None:
    """Raise InputError for a body that has no mass, or that something holds."""
    if body.mass is None:
        raise InputError(
            f"{body.source} has no mass matrix, which motion needs; write it as well.", where=where
        )
    if body.rigid is None:
        return
    rigid, stiffness = body.rigid, body.stiffness
    if sp.issparse(stiffness):
        diagonal = stiffness.diagonal()
    else:
        diagonal = np.diag(stiffness)
    per = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))[:, None]
    force = np.linalg.norm(per * (stiffness @ rigid), axis=0)
    share = force / np.linalg.norm(per * (abs(stiffness) @ np.abs(rigid)), axis=0)
    worst = int(np.argmax(share))
    if share[worst] > _HELD:
        motion = ("moved along", "turned about")[worst // 3] + f" {'xyz'[worst % 3]}"
        raise InputError(
            f"{body.source}: the body resists being {motion} as a whole (stiffness times this "
            f"rigid motion is {share[worst]:.1e} of its parts, not 0); reduce it free, without "
            "supports and springs to the ground, with nodes in the frame of the bearing.",
            where=where,
            value=float(share[worst]),
        )


def elastic_modes(body: ReducedBody, *, where: str) -> tuple[np.ndarray, np.ndarray]:
    """Squared angular frequencies (m,) and coordinates (n, m) of the elastic eigenmodes,
    mass-orthonormal, the lowest first.

    The rigid motions in the body's span are left out, and so are motions without mass, which follow
    the others statically. InputError for motions that have no stiffness and are not rigid.
    """
    stiffness, mass = body.dense()
    size = np.sqrt(np.diag(stiffness))
    per = 1.0 / np.where(size > 0.0, size, 1.0)
    stiffness, mass = (m * np.outer(per, per) for m in (stiffness, mass))
    span = np.eye(body.size)
    if body.rigid is not None:
        carried = (body.rigid / per[:, None]).T @ mass
        span = np.linalg.svd(carried)[2][6:].T  # orthogonal in mass to rigid motion
    held = span.T @ stiffness @ span
    strength = eigvalsh(held)
    loose = int(np.count_nonzero(strength < _MECHANISM * strength[-1]))
    if loose:
        beside = "beside its rigid motions " if body.rigid is not None else ""
        raise InputError(
            f"{body.source}: the stiffness matrix is singular: {beside}{loose} of "
            f"{len(strength)} motions have no stiffness; the body has loose parts, or its shapes "
            "hold rigid motions in part.",
            where=where,
            value=loose,
        )
    periods, turns = eigh(span.T @ mass @ span, held)  # 1/omega^2, the longest last
    moving = periods > _MASSLESS * periods[-1]
    values, turns = 1.0 / periods[moving][::-1], turns[:, moving][:, ::-1]
    return values, per[:, None] * (span @ (turns * np.sqrt(values)))
