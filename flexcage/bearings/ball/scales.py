"""Local error allowed in a ball bearing's unknowns."""

from __future__ import annotations

import numpy as np

from flexcage.bearings.ball.model import BallModel
from flexcage.system.layout import Layout
from flexcage.system.scales import ERROR_RATE, shared_weights

SLOWER = 10.0  # than contact frequencies: what an implicit method holds velocities to


def ball_weights(model: BallModel, layout: Layout, length: float) -> np.ndarray:
    """1/(allowed local error) of a ball bearing's y, as ``scales.shared_weights`` has it."""
    pitch, speed = model.bodies.pitch, length * ERROR_RATE
    weight = shared_weights(model, layout, length)
    q, u = layout.q(weight), layout.u(weight)
    q["inner"][0], q["inner"][3:5] = 1.0 / length, pitch / length
    u["elements"][:, 3:] = float(model.bodies.radius.mean()) / (10.0 * speed)
    u["inner"][0], u["inner"][3:] = 1.0 / speed, pitch / speed
    spotted = model.spot.has > 0
    q["elements"][spotted, 3:] = float(model.bodies.radius.mean()) / length
    return weight


def implicit_ball_weights(model: BallModel, layout: Layout, length: float) -> np.ndarray:
    """The same for methods whose steps are longer than a contact's period.

    They damp what swings in a contact, and what they miss of its velocities meanwhile stays in
    motions that nothing holds: with V_psi' = -V_r V_psi/r as a drift of the orbits. So they hold
    all velocities as if a position error moved at a tenth of contact frequencies (measured: means
    of forces, speeds and places are then within 1 % of those of explicit steps, at a cost of a
    tenth).
    """
    weight = ball_weights(model, layout, length)
    for velocities in layout.u(weight).values():
        velocities *= SLOWER
    return weight
