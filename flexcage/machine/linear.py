"""The machine of small motions about its equilibrium: natural frequencies, critical speeds, and the
response to unbalance.

Bearings are their exact tangents at the machine's speed, whatever the speed that is asked for; the
shaft has its mass and gyroscopic moments. q'' M + q' (w G + C) + K q = f, w the shaft's speed.
Damping is that of the bearings, where the machine gives it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg as la

from flexcage.core.threads import one_blas_thread
from flexcage.machine.shaft import ShaftModel

_MODES = 60  # of the shaft at rest, in which natural frequencies at speed are sought
_STILL = 1e-6  # of the highest natural frequency of those modes: a motion that nothing holds
_ROUND = 0.2  # of a whirl: as round an orbit has a direction


@dataclass(frozen=True)
class Critical:
    """A speed [rad/s] at which a natural frequency is that of the shaft's turns; ``way`` of its
    whirl: "forward", "backward", "straight" (along a line, or nearly), or "axial"."""

    speed: float
    way: str


@dataclass(frozen=True, eq=False)
class Linearised:
    """Matrices (m, m) over the shaft's own motions T (5 n, m), at ``places`` (n,) [m]."""

    motions: np.ndarray
    places: np.ndarray
    stiffness: np.ndarray
    mass: np.ndarray
    gyroscopic: np.ndarray
    damping: np.ndarray
    unbalance: np.ndarray  # (5 n,) complex, kg m: of the force at 1 rad/s

    @property
    def has_mass(self) -> bool:
        return bool(np.diag(self.mass).all())

    @cached_property
    def _modes(self) -> np.ndarray:
        """The lowest modes (m, r) at rest, of unit modal mass."""
        count = min(_MODES, len(self.mass))
        symmetric = 0.5 * (self.stiffness + self.stiffness.T)
        _, modes = la.eigh(symmetric, self.mass, subset_by_index=(0, count - 1))
        return np.asarray(modes)

    @one_blas_thread
    def frequencies(self, speed: float, count: int = 6) -> tuple[np.ndarray, list[str]]:
        """The lowest natural frequencies [rad/s] at a speed [rad/s], rising, and the ways of their
        whirls."""
        if not self.has_mass:
            return np.zeros(0), []
        V = self._modes
        K, B = V.T @ self.stiffness @ V, V.T @ (speed * self.gyroscopic + self.damping) @ V
        one, none = np.eye(len(K)), np.zeros_like(K)
        values, vectors = la.eig(np.block([[none, one], [-K, -B]]))
        highest = float(np.abs(values).max())
        going = values.imag > _STILL * highest
        values, vectors = values[going], vectors[: len(K), going]
        order = np.argsort(values.imag)[:count]
        return values.imag[order], [self._way(V @ vectors[:, k]) for k in order]

    def criticals(self) -> list[Critical]:
        """Critical speeds, rising: K q = w^2 (M - i G) q, undamped."""
        return list(self._criticals)

    @cached_property
    def _criticals(self) -> list[Critical]:
        if not self.has_mass:
            return []
        values, vectors = la.eig(self.stiffness, self.mass - 1j * self.gyroscopic)
        real = (values.real > 0.0) & (np.abs(values.imag) < 1e-4 * np.abs(values.real))
        rising = [k for k in np.argsort(values.real) if real[k]]
        most = float(values.real[rising[-1]]) if rising else 0.0
        found = [
            Critical(float(np.sqrt(values.real[k])), self._way(vectors[:, k]))
            for k in rising
            if values.real[k] > 1e-12 * most
        ]
        return found

    def critical_speeds(self, *ways: str) -> np.ndarray:
        """The same as an array [rad/s]; of all whirls but backward and axial ones, unless ``ways``
        names others."""
        wanted = ways or ("forward", "straight")
        return np.array([c.speed for c in self.criticals() if c.way in wanted])

    def _way(self, mode: np.ndarray) -> str:
        moved = (self.motions @ mode).reshape(-1, 5)
        x, y, z = moved[:, 0], moved[:, 1], moved[:, 2]
        across = float((np.abs(y) ** 2 + np.abs(z) ** 2).sum())
        if float((np.abs(x) ** 2).sum()) > across:
            return "axial"
        turn = -2.0 * float((y.conj() * z).imag.sum()) / max(across, 1e-300)
        return "straight" if abs(turn) < _ROUND else "forward" if turn > 0.0 else "backward"

    @one_blas_thread
    def response(self, speeds: np.ndarray) -> np.ndarray:
        """Complex displacements (s, n, 5) under the discs' unbalance at speeds (s,) [rad/s]: the
        real part of them times exp(i w t) is the motion."""
        T, found = self.motions, []
        right = T.T @ self.unbalance
        for w in np.asarray(speeds, float):
            matrix = self.stiffness - w**2 * self.mass
            matrix = matrix + 1j * w * (w * self.gyroscopic + self.damping)
            found.append((T @ la.solve(matrix, w**2 * right)).reshape(-1, 5))
        return np.array(found)


def amplitude(response: np.ndarray) -> np.ndarray:
    """Half of the orbit's long axis (...) [m] from complex displacements (..., 5)."""
    y, z = response[..., 1], response[..., 2]
    forward, backward = 0.5 * np.abs(y + 1j * z), 0.5 * np.abs(y.conj() + 1j * z.conj())
    return np.asarray(forward + backward)


def on_supports(shaft: ShaftModel, supports: Mapping[float, np.ndarray]) -> Linearised:
    """A shaft on linear supports: the stiffness (5, 5) of each by its place [m]."""
    whole = shaft.stiffness.copy()
    for place, stiffness in supports.items():
        rows = shaft.dofs(place)  # the first coordinates are those of nodes
        whole[np.ix_(rows, rows)] += stiffness
    return of_shaft(shaft, shaft.made.T @ whole @ shaft.made, {})


def of_shaft(shaft: ShaftModel, tangent: np.ndarray, dampers: Mapping[float, float]) -> Linearised:
    """A shaft with slopes (m, m) of all forces over its own motions, and radial damping [N s/m] by
    place [m]."""
    T, own = shaft.motions, shaft.made
    damping = np.zeros((len(T), len(T)))
    for place, value in dampers.items():
        rows = shaft.dofs(place)[1:3]
        damping[rows, rows] += value
    unbalance = np.zeros(len(T), complex)
    for disc in shaft.spec.discs:
        rows = shaft.dofs(disc.position)[1:3]
        turned = disc.unbalance * np.exp(1j * disc.azimuth)
        unbalance[rows] += turned * np.array([1.0, -1.0j])  # y = cos, z = sin
    return Linearised(
        motions=T, places=shaft.places, stiffness=tangent,
        mass=own.T @ shaft.mass @ own, gyroscopic=own.T @ shaft.gyroscopic @ own,
        damping=T.T @ damping @ T, unbalance=unbalance,
    )  # fmt: skip
