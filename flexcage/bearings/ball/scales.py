"""Local error allowed in a ball bearing's unknowns."""

from __future__ import annotations

import numpy as np

from flexcage.bearings.ball.model import BallModel
from flexcage.system.layout import Layout
from flexcage.system.scales import ERROR_RATE, shared_weights


def ball_weights(model: BallModel, layout: Layout, length: float) -> np.ndarray:
    """1/(allowed local error) of a ball bearing's y, as ``scales.shared_weights`` has it."""
    pitch, speed = model.bodies.pitch, length * ERROR_RATE
    weight = shared_weights(model, layout, length)
    q, u = layout.q(weight), layout.u(weight)
    q["inner"][0], q["inner"][3:5] = 1.0 / length, pitch / length
    u["elements"][:, 3:] = float(model.bodies.radius.mean()) / (10.0 * speed)
    u["inner"][0], u["inner"][3:] = 1.0 / speed, pitch / speed
    return weight
