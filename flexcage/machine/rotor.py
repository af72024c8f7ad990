"""The shaft as a rotor for a run: a rigid body, and its own lowest modes, free at both ends."""

from __future__ import annotations

import numpy as np
import scipy.linalg as la

from flexcage.core.threads import one_blas_thread
from flexcage.machine.machine import Machine
from flexcage.machine.shaft import ShaftModel
from flexcage.machine.solution import MachineSolution
from flexcage.machine.spec import Gravity
from flexcage.system.shaft.data import RIGID_ROTOR, Rotor

#: Assumptions: what is faster than elements' contacts follows them at once and has no say; steel
#: parts that are joined lose about this share of critical damping.
HIGHEST, MOST, DAMPING = 5e3, 20, 0.01  # Hz, modes, of critical damping


class TurningShaft:
    """A machine's shaft by its rigid motions about its centre of mass and its modes."""

    @one_blas_thread
    def __init__(self, machine: Machine, solution: MachineSolution) -> None:
        self.machine, self.model = machine, solution.shaft
        mass = self.model.mass
        whole = self.model.rigid_about(0.0)
        own = whole.T @ mass @ whole
        self.mass = float(own[1, 1])
        bearings = [b.place.position for b in machine.bearings]
        self.centre = float(own[1, 4] / self.mass) if self.mass > 0.0 else float(np.mean(bearings))
        self.rigid = self.model.rigid_about(self.centre)  # (c, 5)
        frequency, self.modes = _own_modes(self.model, self.rigid)  # (5 n, m)
        self.frequency = frequency
        self._solution = solution

    @property
    def shapes(self) -> np.ndarray:
        """Coordinates of all motions (c, 5 + m); the first of a motion are those of nodes."""
        return np.hstack([self.rigid, self.modes])

    def rotor(self) -> Rotor:
        """Its equations' arrays."""
        machine, model, T = self.machine, self.model, self.shapes
        own = self.rigid.T @ model.mass @ self.rigid
        gyro = T.T @ model.gyroscopic @ T
        loads = model.point_loads(Gravity(acceleration=0.0))
        unbalance = np.zeros((2, 2, T.shape[1]))
        for disc in machine.shaft.discs:
            rows = T[model.dofs(disc.position)]
            along = disc.unbalance * np.array([np.cos(disc.azimuth), np.sin(disc.azimuth)])
            unbalance += along[:, None, None] * rows[1:3]
        places = [b.place for b in machine.bearings]
        return Rotor(
            place=np.array([p.position for p in places]) - self.centre,
            reversed=np.array([p.reversed for p in places]),
            offset=np.array([b.offset for b in self._solution.bearings]),
            inertia=np.array([self.mass, gyro[3, 4], own[4, 4]]),
            gravity=machine.gravity.vector,
            load=T[: len(loads)].T @ loads,
            unbalance=unbalance[0], phase=unbalance[1],
            shape=np.array([self.modes[model.dofs(p.position)] for p in places]),
            stiffness=self.frequency**2, damping=2.0 * DAMPING * self.frequency,
            gyro=gyro[RIGID_ROTOR:, RIGID_ROTOR:], gyro_turn=gyro[RIGID_ROTOR:, 3:RIGID_ROTOR],
        )  # fmt: skip

    def pose(self) -> np.ndarray:
        """Coordinates (5 + m,) of the static solution."""
        q = self._solution.coordinates
        weighted = self.shapes.T @ self.model.mass
        if self.mass > 0.0:
            return np.linalg.solve(weighted @ self.shapes, weighted @ q)
        return np.linalg.lstsq(self.rigid, q, rcond=None)[0]

    def at(self, position: float) -> np.ndarray:
        """From coordinates to displacements (5, 5 + m) at a place [m] from the left end."""
        return self.model.at(position) @ self.shapes[: len(self.model.motions)]


def _own_modes(model: ShaftModel, rigid: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies (m,) [rad/s] and shapes (c, m), of unit mass, of a shaft that nothing holds."""
    if model.rigid:
        return np.zeros(0), np.zeros((len(rigid), 0))
    last = min(RIGID_ROTOR + MOST, len(rigid)) - 1
    values, shapes = la.eigh(model.stiffness, model.mass, subset_by_index=(0, last))
    values, shapes = values[RIGID_ROTOR:], shapes[:, RIGID_ROTOR:]
    shapes = shapes - rigid @ np.linalg.solve(
        rigid.T @ model.mass @ rigid, rigid.T @ model.mass @ shapes
    )
    shapes /= np.sqrt(np.einsum("im,ij,jm->m", shapes, model.mass, shapes))
    low = np.sqrt(np.maximum(values, 0.0)) < 2.0 * np.pi * HIGHEST
    return np.sqrt(values[low]), shapes[:, low]
