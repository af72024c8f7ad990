"""Ball bearings by the implicit method: its order on a smooth motion, and the explicit method's
trajectories."""

from __future__ import annotations

import numpy as np
from ball_parts import ball_bearing, contacts_of, four_point, pressed
from bearing_runs import march

from flexcage.contacts.spec import Lubricant
from flexcage.solve.contract import DONE
from flexcage.system.data import POWERS
from flexcage.system.spec import Load


def rolling(bearing, *, push=2e-6):
    """(y, y') of balls between their races under load, orbiting, the cage clear of them."""
    y = pressed(bearing, push=0.0)
    layout, model = bearing.layout, bearing.data.model
    q, u = layout.q(y), layout.u(y)
    q["inner"][:5] = 3.0 * push, push, 0.0, 0.0, 0.0
    balls, Z = q["elements"], layout.elements
    balls[:, 0] = 0.5 * (model.inner.axial + model.outer.axial) + 1.5 * push
    balls[:, 1] = 0.5 * (model.inner.centre + model.outer.centre)
    balls[:, 2] = 2 * np.pi * np.arange(Z) / Z
    q["cage"][:], q["quaternion"][:], q["modes"][:] = 0.0, (1.0, 0.0, 0.0, 0.0), 0.0
    orbit = 170.0
    u["elements"][:, 2] = orbit * balls[:, 1]
    u["elements"][:, 3] = -orbit * model.outer.centre / model.bodies.radius
    u["inner"][3], u["omega"][0] = 400.0, orbit
    yd = np.zeros_like(y)
    rate = layout.q(yd)
    rate["elements"][:, 2], rate["elements"][:, 3:] = orbit, u["elements"][:, 3:]
    rate["inner"][5], rate["quaternion"][1] = 400.0, 0.5 * orbit
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), np.zeros(len(POWERS)))
    bearing.function("note")(0.0, y, bearing.args)
    return y, yd


def of(**specs):
    return ball_bearing(
        contacts=contacts_of("elastic", "traction"), speed=400.0,
        load=Load(axial=200.0, radial=50.0, tilt="held"), lubricant=Lubricant(), **specs,
    )  # fmt: skip


def error(bearing, found, reference):
    """Largest difference of positions at the end, in units of 10 nm moved."""
    weight = bearing.error_weights(1e-8)
    n = bearing.layout.n_q
    return np.abs((found.y[-1] - reference.y[-1])[:n] * weight[:n]).max()


def runs(bearing, y, yd, tolerances, duration):
    """Errors of the BDF at these tolerances at the end, and its steps; the reference's samples."""
    run = {"duration": duration, "rate": 1e5}
    reference = march(bearing, y.copy(), yd.copy(), tolerance=1e-13, method="explicit", **run)
    found = [march(bearing, y.copy(), yd.copy(), tolerance=t, **run) for t in tolerances]
    assert all(history.outcome == DONE for history in (reference, *found))
    missed = np.array([error(bearing, history, reference) for history in found])
    return missed, np.array([len(history.log) for history in found]), reference


def test_order_on_a_smooth_motion():
    """Twice the steps miss a quarter: the balls' oscillation between their races."""
    bearing = of(modes=0)
    missed, steps, _ = runs(bearing, *rolling(bearing), (1e-9, 1e-10, 1e-11), 0.3e-3)
    order = np.diff(np.log(missed)) / -np.diff(np.log(steps))
    assert (np.abs(order - 2.0) < 0.25).all() and missed[-1] < 3.0


def test_the_trajectory_of_the_explicit_method():
    """With a flexible cage that balls strike: both approach one solution as tolerances shrink."""
    bearing = of()
    y, yd = rolling(bearing)
    bearing.layout.u(y)["cage"][1] = 0.5
    missed, _, reference = runs(bearing, y, yd, (1e-9, 1e-12), 1e-3)
    assert (reference.samples.pocket_normal > 0.1).any()
    assert missed[1] < 0.02 * missed[0] and missed[1] < 0.5


def test_both_methods_move_balls_on_four_arcs_alike():
    """The inner ring swings under its load: balls leave one inner arc and come back to it."""
    bearing = of(modes=0, **four_point(clearance=-2e-6))
    missed, _, reference = runs(bearing, *rolling(bearing), (1e-9, 1e-11), 0.5e-3)
    arcs = reference.samples.rib[:, :, 1:] > 0.0
    count = arcs.sum(axis=2)
    assert {2, 3, 4} <= set(np.unique(count))
    assert missed[1] < 0.1 * missed[0] and missed[1] < 3.0
