"""Is a body what it should be? One sentence each on what it is not.

``check_body`` holds for every body; ``check_free`` for those that nothing holds, as cages.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cholesky, eigh, eigvalsh

from flexcage.core.errors import InputError
from flexcage.modes.exchange.body import ReducedBody

_ASYMMETRY = 1e-6  # of the largest entry: text of seven digits
# Of the largest eigenvalue, or of the mean one for a rigid motion's: what rounding leaves in
# numbers of double and of single precision.
_DOUBLE, _SINGLE = 1e-8, 1e-6
_HELD = 1e-5  # of the forces that rigid motion makes entry by entry: text of seven digits
_SOFT = 1e-4  # of the lowest elastic squared frequency: a support that hardly changes it
_MECHANISM = 1e-12  # of the largest scaled stiffness: a motion without any
_MASSLESS = 1e-12  # of the longest squared period: a motion without mass


def check_body(body: ReducedBody, *, where: str) -> None:
    """Raise InputError for matrices that are no finite, symmetric, positive semi-definite ones."""
    for name, matrix in (("stiffness", body.stiffness), ("mass", body.mass)):
        if matrix is not None:
            _check_numbers(body, name, matrix, where)
    if not np.isfinite(body.nodes).all():
        raise InputError(f"{body.source}: places of nodes are not finite numbers.", where=where)
    if sp.issparse(body.stiffness):
        _check_diagonals(body, where)
    else:
        stiffness, mass = body.dense()
        _check_definite(body, "stiffness", (stiffness, mass), where)
        _check_definite(body, "mass", (mass, stiffness), where)


def _check_numbers(body: ReducedBody, name: str, matrix: Any, where: str) -> None:
    values = matrix.data if sp.issparse(matrix) else np.asarray(matrix)
    if np.iscomplexobj(values):
        raise InputError(
            f"{body.source}: the {name} matrix is complex, as with structural damping; write the "
            "real one without damping, and give damping as modes.damping.",
            where=where,
        )
    if not np.isfinite(values).all():
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


def _check_diagonals(body: ReducedBody, where: str) -> None:
    """Of matrices too large for their eigenvalues: a negative entry there is a negative one."""
    for name, matrix in (("stiffness", body.stiffness), ("mass", body.mass)):
        if matrix is None:
            continue
        values = np.asarray(matrix.diagonal())
        negative = np.flatnonzero(values < -_SINGLE * np.abs(values).max(initial=0.0))
        if len(negative) == np.count_nonzero(values):
            said = "its whole diagonal is negative; change its sign"
        else:
            said = (
                f"{len(negative):,} of the {len(values):,} numbers on its diagonal are negative, "
                f"the lowest, {values.min():.3g}, in row {values.argmin() + 1}"
            )
        if len(negative):
            raise InputError(
                f"{body.source}: the {name} matrix is not positive semi-definite: {said}.",
                where=where,
                value=float(values.min()),
            )


def _units(stiffness: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """Sizes (n,) by which coordinates are compared: rotations and modes beside translations have
    entries of all sizes. Both matrices count, so that a rigid coordinate, whose stiffness is
    rounding, has the size of its mass, and a massless one that of its stiffness."""
    stiff, heavy = np.abs(np.diag(stiffness)), np.abs(np.diag(mass))
    if not heavy.any():
        return np.full(len(stiff), np.sqrt(stiff.max()))
    size = np.sqrt(stiff / stiff.sum() + heavy / heavy.sum())
    size[size == 0.0] = 1.0
    return size


def _rounding(matrix: np.ndarray) -> float:
    with np.errstate(over="ignore"):
        return _SINGLE if (matrix == matrix.astype(np.float32)).all() else _DOUBLE


def _check_definite(
    body: ReducedBody, name: str, both: tuple[np.ndarray, np.ndarray], where: str
) -> None:
    """``both``: the matrix that is judged, and the other."""
    size = _units(*both) if name == "stiffness" else _units(*both[::-1])
    scaled = both[0] / np.outer(size, size)
    if _surely_definite(scaled, _rounding(both[0])):
        return
    values = eigvalsh(scaled)
    limit = -_rounding(both[0]) * values[-1]
    if values[0] < limit:
        negative = int(np.count_nonzero(values < limit))
        raise InputError(
            f"{body.source}: the {name} matrix is not positive semi-definite: {negative} of its "
            f"{len(values)} eigenvalues are negative, down to {_lowest(*both):.1e} of the largest.",
            where=where,
            value=float(values[0]),
        )


def _surely_definite(matrix: np.ndarray, rounding: float) -> bool:
    """Is it positive definite once moved by rounding? A Cholesky factor tells at a tenth of the
    work of eigenvalues; the largest entry is no more than the largest of these."""
    try:
        cholesky(matrix + rounding * np.diag(matrix).max() * np.eye(len(matrix)))
    except np.linalg.LinAlgError:
        return False
    return True


def _lowest(matrix: np.ndarray, other: np.ndarray) -> float:
    """The lowest eigenvalue over that of largest magnitude: those of the pair where the other is
    positive definite, which no change of coordinates alters."""
    try:
        values = eigvalsh(matrix, other)
    except np.linalg.LinAlgError:
        values = eigvalsh(matrix)
    return float(values[0] / abs(values).max())


def check_free(body: ReducedBody, *, where: str) -> None:
    """Raise InputError for a body that has no mass, or that something holds."""
    if body.mass is None:
        raise InputError(
            f"{body.source} has no mass matrix, which motion needs; write it as well.", where=where
        )
    if body.rigid is None:
        return
    if len(body.boundary):
        _check_balanced(body, body.rigid, where)
    else:
        _check_slow(body, body.rigid, where)


def _check_balanced(body: ReducedBody, rigid: np.ndarray, where: str) -> None:
    """Forces of coordinates of nodes under a rigid motion must cancel."""
    stiffness = body.stiffness
    diagonal = stiffness.diagonal()
    per = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))[:, None]
    force = np.linalg.norm(per * (stiffness @ rigid), axis=0)
    parts = np.linalg.norm(per * (abs(stiffness) @ np.abs(rigid)), axis=0)
    share = force / np.maximum(parts, np.finfo(float).tiny)
    worst = int(np.argmax(share))
    if share[worst] > _HELD:
        said = f"stiffness times this rigid motion is {share[worst]:.1e} of its parts, not 0"
        raise _held(body, worst, said, float(share[worst]), where)


def _check_slow(body: ReducedBody, rigid: np.ndarray, where: str) -> None:
    """Rigid motions among modes must have no frequency. In no basis of modes can it be told from
    forces: those of a diagonal stiffness have no parts that would cancel."""
    stiffness, mass = body.dense()
    work, energy = (np.einsum("ik,ij,jk->k", rigid, m, rigid) for m in (stiffness, mass))
    squares = np.abs(work) / np.maximum(energy, np.finfo(float).tiny)
    worst = int(np.argmax(squares))
    if squares[worst] <= _rounding(stiffness) * np.trace(stiffness) / np.trace(mass):
        return
    lowest = elastic_modes(body, where=where)[0][:1]
    if (squares[worst] > _SOFT * lowest).any():
        own, elastic = (np.sqrt(v) / (2.0 * np.pi) for v in (squares[worst], lowest[0]))
        said = f"with a frequency of {own:.3g} Hz, and its lowest elastic mode has {elastic:.4g} Hz"
        raise _held(body, worst, said, float(own), where)


def _held(body: ReducedBody, motion: int, said: str, value: float, where: str) -> InputError:
    way = ("moved along", "turned about")[motion // 3] + f" {'xyz'[motion % 3]}"
    return InputError(
        f"{body.source}: the body resists being {way} as a whole ({said}); reduce it free, without "
        "supports and springs to the ground, with nodes in the frame of the bearing and with "
        "coordinates in the order of its file's format, or named there.",
        where=where,
        value=value,
    )


def elastic_modes(body: ReducedBody, *, where: str) -> tuple[np.ndarray, np.ndarray]:
    """Squared angular frequencies (m,) and coordinates (n, m) of the elastic eigenmodes,
    mass-orthonormal, the lowest first.

    The rigid motions in the body's span are left out, and so are motions without mass, which follow
    the others statically. InputError for motions that have no stiffness and are not rigid.
    """
    stiffness, mass = body.dense()
    per = 1.0 / _units(stiffness, mass)
    stiffness, mass = (m * np.outer(per, per) for m in (stiffness, mass))
    span = np.eye(body.size)
    if body.rigid is not None:
        carried = (body.rigid / per[:, None]).T @ mass
        span = np.linalg.svd(carried)[2][6:].T  # orthogonal in mass to rigid motion
    held = span.T @ stiffness @ span
    strength = eigvalsh(held)
    loose = int(np.count_nonzero(strength < _MECHANISM * strength[-1]))
    if loose:
        among = "beside its rigid motions " if body.rigid is not None else ""
        raise InputError(
            f"{body.source}: the stiffness matrix is singular: {among}{loose} of "
            f"{len(strength)} motions have no stiffness; the body has loose parts, or its shapes "
            "hold rigid motions in part.",
            where=where,
            value=loose,
        )
    periods, turns = eigh(span.T @ mass @ span, held)  # 1/omega^2, the longest last
    moving = periods > _MASSLESS * periods[-1]
    values, turns = 1.0 / periods[moving][::-1], turns[:, moving][:, ::-1]
    return values, per[:, None] * (span @ (turns * np.sqrt(values)))
