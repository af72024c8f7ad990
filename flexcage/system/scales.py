"""Local error allowed in every unknown, from one length."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

import numpy as np

from flexcage.system.layout import Layout
from flexcage.system.model import Model

# assumption: a position error moves at contact frequencies, about 5 kHz, when turned into a speed
ERROR_RATE = 2.0 * np.pi * 5e3


@singledispatch
def error_weights(model: Any, layout: Layout, length: float) -> np.ndarray:
    """1/(allowed local error) of y for a position error of ``length`` [m]; 0: not tested.

    Angles are scaled by the lever over which they move a contact, modal coordinates by the
    largest displacement of a station, velocities by ``ERROR_RATE``; spin angles and multipliers
    are left out (nothing depends on them, or they follow).
    """
    raise NotImplementedError(f"{type(model).__name__} has no error weights")


@error_weights.register
def _(model: Model, layout: Layout, length: float) -> np.ndarray:
    allowed = np.full(layout.size, np.inf)
    q, u = layout.q(allowed), layout.u(allowed)
    rw = float(model.bodies.radius.mean())
    reach = float(model.pocket.half_roller)
    pitch = 0.5 * (model.inner.radius + model.outer.radius)
    q["rollers"][:, :2] = length
    q["rollers"][:, 2] = length / pitch
    q["rollers"][:, 3:5] = length / reach
    q["inner"][1:3] = length
    q["outer"][:] = length
    q["cage"][:] = length
    q["quaternion"][:] = 0.5 * length / pitch
    speed = length * ERROR_RATE
    u["rollers"][:, :3] = speed
    u["rollers"][:, 3] = 10.0 * speed / rw
    u["rollers"][:, 4:] = speed / reach
    u["inner"][1:3] = speed
    u["inner"][3] = speed / model.inner.radius
    u["outer"][:] = speed
    u["cage"][:] = speed
    u["omega"][:] = speed / pitch
    if layout.modes:
        largest = np.maximum(model.pocket.phi_max, 1e-3 * model.pocket.phi_max.max())
        q["modes"][:] = length / largest
        u["modes"][:] = speed / largest
    return 1.0 / allowed
