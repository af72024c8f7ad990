"""Contact laws called on arrays of penetrations and speeds, and a mass that strikes one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from flexcage.contacts.laws import rolling_forces
from flexcage.core.errors import RunFailed

Law = Callable[..., None]
IMPACT_SPEED = 0.5  # m/s of both
# K [N/m^n], n, mass [kg]; depth [um], time [us], force [N]
IMPACTS = {
    "N1013 roller, line contact": (
        454517.4944 * 1e3 ** (10.0 / 9.0), 10.0 / 9.0, 3.1567e-3, 1.916562, 11.84622, 434.6419,
    ),
    "7010C ball, Hertz": (8.69343e9, 1.5, 2.7173e-3, 6.250555, 36.79327, 135.8529),
}  # fmt: skip


def normal(
    law: Law, p: np.ndarray, d: ArrayLike, v: ArrayLike, *, onset: float = 0.0
) -> tuple[np.ndarray, ...]:
    """Force [N], its elastic part, and its derivatives by d and v on penetrations d [m] and their
    rates v [m/s], of contacts that closed at the speed ``onset`` [m/s]."""
    shaped = np.broadcast_arrays(np.asarray(d, float), np.asarray(v, float))
    d, v = (np.ascontiguousarray(x) for x in shaped)
    F, Fe, Fd, Fv = np.full((4, *d.shape), np.nan)
    law(d.size, d, v, np.full(d.shape, onset), p, F, Fe, Fd, Fv)
    return F, Fe, Fd, Fv


def friction(law: Law, p: np.ndarray, u: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    """mu/u [s/m] and its derivative on sliding speeds u [m/s]."""
    u = np.ascontiguousarray(u, float)
    g, dg = np.full(u.shape, np.nan), np.full(u.shape, np.nan)
    law(u.size, u, p, g, dg)
    return g, dg


def coefficient(law: Law, p: np.ndarray, u: ArrayLike) -> np.ndarray:
    """Friction coefficient mu on sliding speeds u [m/s]."""
    return friction(law, p, u)[0] * np.asarray(u, float)


def rolling(c: np.ndarray, u: ArrayLike, q: ArrayLike) -> np.ndarray:
    """Rolling resistance [N] at entrainment speeds u [m/s] under loads q [N]."""
    u, q = (np.ascontiguousarray(x) for x in np.broadcast_arrays(np.atleast_1d(u), q))
    force = np.full(u.shape, np.nan)
    rolling_forces(u.size, c, u.astype(float), q.astype(float), force)
    return force


@dataclass(frozen=True)
class Impact:
    """Speed after an impact over that before, largest penetration, force there, time in contact."""

    restitution: float
    depth: float  # [m]
    force: float  # [N]
    time: float  # [s]


def strike(law: Law, p: np.ndarray, mass: float, speed: float) -> Impact:
    """A mass [kg] flies against a wall of a normal law at a speed [m/s]; until it parts."""

    def rate(t: float, y: np.ndarray) -> list[float]:
        return [y[1], -normal(law, p, [max(y[0], 0.0)], [y[1]], onset=speed)[0][0] / mass]

    def parted(t: float, y: np.ndarray) -> float:  # clipped at zero: beyond, the body flies
        return y[0] if t > 0.0 else 1.0

    def turned(t: float, y: np.ndarray) -> float:
        return y[1]

    parted.terminal, parted.direction = True, -1  # type: ignore[attr-defined]
    scale = (mass * speed**2 / p[0]) ** (1.0 / (p[1] + 1.0))
    out = solve_ivp(
        rate, (0.0, 1e4 * scale / speed), [0.0, speed], method="DOP853", rtol=1e-10,
        atol=[1e-12 * scale, 1e-12 * speed], events=(parted, turned), max_step=0.05 * scale / speed,
    )  # fmt: skip
    if not out.t_events[0].size:
        raise RunFailed("the impact's mass does not leave the wall; is its law damped beyond all?")
    depth = out.y_events[1][0][0]
    force = normal(law, p, [depth], [0.0], onset=speed)[0][0]
    return Impact(-out.y[1, -1] / speed, depth, force, out.t[-1])
