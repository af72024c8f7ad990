"""Acceleration at a node of an elastic housing, by its own modes, under the forces of a run.

In the run the outer ring's seat yields as the housing at rest (``system.seat``). Here the housing
has its mass as well: with M and K of the body, its seat tied to the ring, and the ring's mass,

    x_node = sum_i (e phi_i) (phi_i^T f)/(1 - r^2 + 2 j D r),  r = w/w_i,

with all its modes, phi_i^T K phi_i = 1, and the force and moment f of all contacts on the ring.
High modes so give their static share. What the moving node does to these forces is left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh

from flexcage.core.errors import InputError
from flexcage.results.metrics import sampling_rate
from flexcage.results.registry import TIME
from flexcage.results.signals.chain import passed, response
from flexcage.results.signals.spec import Accelerometer
from flexcage.system.seat import DENSE, WHERE, Seated, seated, solved

if TYPE_CHECKING:
    import xarray

    from flexcage.modes.exchange.body import ReducedBody
    from flexcage.system.spec import Mount

LOWEST = 200  # modes that are sought of a body of more than DENSE coordinates; others are static
_STATIC = 30.0  # times the highest frequency of a record, from which on a mode is static


@dataclass(frozen=True)
class HousingPath:
    """From forces and moments on the outer ring to one direction at a node: modes' ``frequency``
    (n,) [Hz], what a static force makes by each of them, ``share`` (n, 6) [m/N, 1/N], and what the
    modes left out make, ``static`` (6,); ``damping`` over critical."""

    frequency: np.ndarray
    share: np.ndarray
    static: np.ndarray
    damping: float

    def gains(self, frequency: np.ndarray) -> np.ndarray:
        """Acceleration (m, 6) per force [m/s^2/N] and moment at frequencies (m,) [Hz]."""
        slow = self.frequency < _STATIC * frequency.max()
        found = np.zeros((len(frequency), 6), complex)
        found += self.static + self.share[~slow].sum(axis=0)
        for own, share in zip(self.frequency[slow], self.share[slow]):
            found += response(frequency, own, self.damping)[:, None] * share
        return np.asarray(-((2.0 * np.pi * frequency[:, None]) ** 2) * found)

    def acceleration(self, ds: xarray.Dataset) -> np.ndarray:
        """Acceleration (n,) [m/s^2] at the samples of a run, whose housing rested before."""
        names = ("outer_force", "outer_moment")
        loads = np.concatenate([ds[name].transpose(TIME, "axis").values for name in names], axis=1)
        return passed(loads, sampling_rate(ds), self.gains, self.damping * self.frequency.min())


@dataclass(frozen=True, eq=False)
class SensedHousing:
    """The housing of a run: the ``housing`` with the ring on its seat, and ``ring``: mass [kg] and
    moments of inertia [kg m^2] of the outer ring about x and across."""

    housing: Seated
    ring: tuple[float, float, float]

    @classmethod
    def of(
        cls, mount: Mount, *, diameter: float, width: float, ring: tuple[float, float, float]
    ) -> SensedHousing:
        """``diameter`` and ``width`` [m] of the seat."""
        return cls(seated(mount, diameter=diameter, width=width), ring)

    def check(self, sensor: Accelerometer) -> None:
        """InputError for a housing without a mass, and for a node that is not there."""
        _mass(self.housing, sensor, self.ring)
        _row(self.housing.body, sensor)

    def paths(self, sensors: Sequence[Accelerometer]) -> list[HousingPath]:
        """To the nodes of these sensors, of one solution of the housing's modes; InputError as by
        ``check``."""
        rows = [self.housing.tie.T @ _row(self.housing.body, sensor) for sensor in sensors]
        mass = _mass(self.housing, sensors[0], self.ring)
        frequency, shapes, whole = _modes(self.housing, mass)
        found = []
        for sensor, row in zip(sensors, rows):
            share = (row @ shapes)[:, None] * (shapes.T @ self.housing.ring)
            static = row @ whole - share.sum(axis=0)
            found.append(HousingPath(frequency, share, static, sensor.housing_damping))
        return found


def _mass(
    housing: Seated, sensor: Accelerometer, ring: tuple[float, float, float]
) -> sp.csr_matrix:
    """Mass (m, m) of the housing with the ring; InputError where the body has none."""
    body = housing.body
    if body.mass is None:
        raise InputError(
            f"{body.source}: the housing has no mass matrix, so the accelerometer '{sensor.name}' "
            "at its node cannot know its modes; write its mass with its stiffness.",
            where=WHERE,
            value=sensor.name,
        )
    m, about, across = ring
    own = housing.ring * np.sqrt([m, m, m, about, across, across])
    return sp.csr_matrix(housing.tie.T @ sp.csr_matrix(body.mass) @ housing.tie + own @ own.T)


def _row(body: ReducedBody, sensor: Accelerometer) -> np.ndarray:
    """What every coordinate (n,) moves the node along the sensor's axis."""
    known = np.arange(1, len(body.nodes) + 1) if body.numbers is None else body.numbers
    node = next(iter(np.flatnonzero(known == sensor.node)), -1)
    c, s = np.cos(sensor.direction), np.sin(sensor.direction)
    towards = np.array([1.0, 0.0, 0.0] if sensor.axial else [0.0, c, s])
    if node >= 0 and body.shapes is not None:
        return np.asarray(towards @ body.shapes[node])
    own = np.flatnonzero((body.dofs[:, 0] == node) & (body.dofs[:, 1] < 3))
    if node < 0 or not set(np.flatnonzero(towards)) <= set(body.dofs[own, 1]):
        there = ", ".join(map(str, known[body.boundary][:6]))
        raise InputError(
            f"The accelerometer '{sensor.name}' is on node {sensor.node}, but "
            f"{body.source or WHERE} has no node of this number that moves along its direction; it "
            f"has {there} ...",
            where="sensors",
            value=sensor.node,
        )
    row = np.zeros(body.size)
    row[own] = towards[body.dofs[own, 1]]
    return row


def _modes(housing: Seated, mass: sp.csr_matrix) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequencies [Hz] and shapes (m, n) with phi^T K phi = 1 of modes that have a mass, and the
    displacements (m, 6) under unit forces on the ring."""
    stiffness = housing.stiffness
    whole = solved(housing.body, stiffness, housing.ring)
    if stiffness.shape[0] > DENSE:
        from scipy.sparse.linalg import eigsh

        square, shapes = eigsh(stiffness.tocsc(), LOWEST, M=mass.tocsc(), sigma=0.0)
        speed = np.sqrt(square)
        return speed / (2.0 * np.pi), shapes / speed, whole
    dense = stiffness.toarray()
    size = np.sqrt(np.diag(dense))
    scaled = mass.toarray() / np.outer(size, size)
    inverse, shapes = eigh(scaled, dense / np.outer(size, size))  # 1/w^2; massless: 0
    kept = inverse > 1e-12 * inverse[-1]
    return (
        1.0 / (2.0 * np.pi * np.sqrt(inverse[kept])), shapes[:, kept] / size[:, None], whole
    )  # fmt: skip
