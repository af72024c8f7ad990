"""Equilibrium on a seat that yields: the outer ring moves with the load that it passes on.

Elements feel the inner ring's displacement relative to the outer one's. So the equilibrium on a
rigid seat is solved with held motions and springs that are shifted by the outer ring's displacement
o, and o = S f with the seat's compliance S and the forces f that elements bear. Newton's method on
o - S f(o) = 0 has the exact slope: what is free follows (T + spring) du = -T du_held - spring do,
T the tangent of the elements.

The outer ring bears what the elements bear from the inner one. Centrifugal forces and gyroscopic
moments, which sum up to little over a bearing's elements, are left out of f.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from flexcage.core.errors import RunFailed
from flexcage.geometry.bearing import Bearing
from flexcage.system.bodies import bushing_stiffness
from flexcage.system.spec import Mount
from flexcage.system.statics.equilibrium import Posture, Problem, balance, tangent

_CLOSE = 1e-9  # of the seat's displacement, that a step may leave
_ITERATIONS = 30


def compliance_of(mount: Mount, bearing: Bearing) -> np.ndarray | None:
    """Compliance (5, 5) of the outer ring's seat in its housing or bushing; None for a rigid one,
    or one with clearance."""
    if mount.kind == "bushing":
        stiffness = bushing_stiffness(mount)
        return np.diag(np.divide(1.0, stiffness, out=np.zeros(5), where=stiffness > 0.0))
    if not mount.body:
        return None
    from flexcage.system.seat import seat_compliance  # with readers of files, which few need

    return seat_compliance(mount, diameter=bearing.outside_diameter, width=bearing.width)


def questioned(mount: Mount, bearing: Bearing, seat: np.ndarray | None) -> tuple[str, ...]:
    """A sentence on a housing's seat that is hardly meant; none for a usual one, or no housing."""
    if seat is None or not mount.body:
        return ()
    from flexcage.system.seat import implausible_seat

    modulus = bearing.material.youngs_modulus
    said = implausible_seat(seat, mount, modulus=modulus, width=bearing.width)
    return (said,) if said else ()


def balance_on_seat(problem: Problem, compliance: np.ndarray) -> Posture:
    """Posture of the inner ring relative to the outer one, which moves with its seat.

    Raises as ``balance``, and RunFailed if the seat's displacement is not found.
    """
    outer = np.zeros(5)
    for _ in range(_ITERATIONS):
        posture = balance(replace(problem, held=problem.held - outer))
        gap = compliance @ posture.force - outer
        step = np.linalg.solve(np.eye(5) - compliance @ _slope(problem, posture), gap)
        outer = outer + step
        if np.abs(step * problem.lever).max() <= _CLOSE * np.abs(outer * problem.lever).max():
            return replace(balance(replace(problem, held=problem.held - outer)), outer=outer)
    raise RunFailed(
        f"no equilibrium was found on the seat of [mount]: after {_ITERATIONS} steps its "
        f"displacement still changes by {np.abs(step[:3]).max():.1e} m; is the housing far softer "
        "than the bearing?"
    )


def _slope(problem: Problem, posture: Posture) -> np.ndarray:
    """Slope (5, 5) of the forces that elements bear over the outer ring's displacement."""
    T, free = tangent(problem, posture), problem.free
    spring = np.diag(problem.spring)
    moved = -np.eye(5)  # of the inner ring relative to the outer: what is held
    ring = np.ix_(free, free)
    if free.any():
        pull = -T[np.ix_(free, ~free)] @ moved[~free] - spring[free]
        moved[free] = np.linalg.lstsq(T[ring] + spring[ring], pull, rcond=None)[0]
    return T @ moved


def on_seat(stiffness: np.ndarray, compliance: np.ndarray) -> np.ndarray:
    """Tangent (5, 5) over the inner ring's displacement in space: bearing and seat in series."""
    return stiffness @ np.linalg.inv(np.eye(5) + compliance @ stiffness)
