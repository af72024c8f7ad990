"""Local error allowed in a roller bearing's unknowns."""

from __future__ import annotations

import numpy as np

from flexcage.bearings.cylindrical_roller.model import RollerModel
from flexcage.system.layout import Layout
from flexcage.system.scales import ERROR_RATE, shared_weights


def roller_weights(model: RollerModel, layout: Layout, length: float) -> np.ndarray:
    """1/(allowed local error) of a roller bearing's y, as ``scales.shared_weights`` has it."""
    reach, speed = float(model.pocket.half_roller), length * ERROR_RATE
    weight = shared_weights(model, layout, length)
    q, u = layout.q(weight), layout.u(weight)
    q["elements"][:, 3:5] = reach / length
    spotted = model.spot.has > 0
    q["elements"][spotted, 5] = float(model.bodies.radius.mean()) / length
    u["elements"][:, 3] = float(model.bodies.radius.mean()) / (10.0 * speed)
    u["elements"][:, 4:] = reach / speed
    u["inner"][3] = model.inner.radius / speed
    free = model.inner_ring.free[[0, 4, 5]]
    arm = np.array([1.0, model.bodies.pitch, model.bodies.pitch]) * free
    q["inner"][[0, 3, 4]], u["inner"][[0, 4, 5]] = arm / length, arm / speed
    return weight
