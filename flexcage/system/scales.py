"""Local error allowed in every unknown, from one length."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.system.data import POWERS
from flexcage.system.layout import Layout

# assumption: a position error moves at contact frequencies, about 5 kHz, when turned into a speed
ERROR_RATE = 2.0 * np.pi * 5e3
_OF_VELOCITIES = [0, 1, 2, 5, 3, 4]  # a ring's coordinates in the order of its velocities


def shared_weights(model: Any, layout: Layout, length: float) -> np.ndarray:
    """1/(allowed local error) of y for a position error of ``length`` [m]; 0: not tested.

    Of what all bearings have: places and speeds of elements and bodies, modes; a family's own
    ``error_weights`` add the rest. Angles are scaled by the lever over which they move a contact,
    modal coordinates by the largest displacement of a station, velocities by ``ERROR_RATE``; spin
    angles and multipliers are left out (nothing depends on them, or they follow).
    """
    pitch = model.bodies.pitch  # lever of the cage's turns and of elements along their orbit
    allowed = np.full(layout.size, np.inf)
    q, u, speed = layout.q(allowed), layout.u(allowed), length * ERROR_RATE
    q["elements"][:, :2] = length
    q["elements"][:, 2] = length / pitch
    q["inner"][1:3] = length
    u["elements"][:, :3] = speed
    u["inner"][1:3] = speed
    free, arm = model.outer_ring.free > 0, np.array([1.0, 1.0, 1.0, pitch, pitch, pitch])
    q["outer"][_OF_VELOCITIES] = np.where(free, length / arm, np.inf)
    u["outer"][:] = np.where(free, speed / arm, np.inf)
    if layout.has_cage:
        q["cage"][:], q["quaternion"][:] = length, 0.5 * length / pitch
        u["cage"][:], u["omega"][:] = speed, speed / pitch
    if layout.modes:
        largest = np.maximum(model.pocket.phi_max, 1e-3 * model.pocket.phi_max.max())
        q["modes"][:] = length / largest
        u["modes"][:] = speed / largest
    return 1.0 / allowed


def work_weights(model: Any, length: float) -> np.ndarray:
    """1/(allowed local error) of the work of every power for a position error of ``length`` [m].

    What forces of the bearing's size do over ``length``: its radial and axial loads at their
    largest, waves left out, and the elements' weight on earth and centrifugal force at the drive's
    largest speed.
    """
    bodies = model.bodies
    orbit = 0.5 * np.abs(bodies.speed[1]).max()
    pull = 9.81 + orbit**2 * bodies.pitch
    loads = np.abs(bodies.load[1]).max() + np.abs(bodies.axial[1]).max()
    force = loads + len(bodies.radius) * bodies.element[0] * pull
    return np.full(len(POWERS), 1.0 / (length * force))
