"""Newton's matrix of a ball bearing in blocks against differences of the residual, in units of the
allowed error."""

from __future__ import annotations

import numpy as np
import pytest
from ball_parts import ball_bearing, contacts_of, four_point, pressed

from flexcage.contacts.spec import Lubricant
from flexcage.system.data import POWERS
from flexcage.system.spec import Load, Mount

LOAD = Load(axial=1000.0, tilt="free")


def slots(interface):
    """Pockets that are no circles any more: slots, shifted, wider."""
    interface.slot[::3, 1] = 20e-6
    interface.slot[1::3, 0] = 15e-6
    interface.centre[::2] = 10e-6, -8e-6
    interface.radius[::4] += 5e-6


#: Specs and disturbances: sliding [m/s], how far the ring is pushed in [m].
STATES = {
    "rolling": ({}, {}),
    "heavy": ({}, {"axial": 30e-6}),
    "sliding": ({}, {"slide": 2.0}),
    "apart": ({}, {"axial": -60e-6}),
    "slots": ({"change": slots}, {}),
    "spheres": ({"shape": "spherical"}, {}),
    "bushing": ({"mount": Mount(kind="bushing", mass=1.0)}, {}),
    "rigid cage": ({"modes": 0}, {}),
    "four arcs": (four_point(), {}),
    "four arcs, sliding": (four_point(clearance=0.0), {"slide": 2.0, "axial": 20e-6}),
    "three arcs": (four_point(shims=(0.2e-3, 0.0)), {}),
    "tilt held": ({"load": Load(axial=1000.0, misalignment=2e-4)}, {}),
}


def disturbed(bearing, *, slide=0.05, axial=0.0, seed=1):
    """A state in motion, with the onset speeds of its contacts."""
    y = pressed(bearing)
    layout, model = bearing.layout, bearing.data.model
    rng = np.random.default_rng(seed)
    q, u = layout.q(y), layout.u(y)
    q["inner"][0] += axial
    r, rb = q["elements"][:, 1], model.bodies.radius
    inner, orbit = 400.0, 170.0
    spin = -orbit * model.outer.centre / rb.mean()
    u["elements"][:] = slide * rng.standard_normal((layout.elements, 6))
    u["elements"][:, 2] += orbit * r
    u["elements"][:, 3:] *= 1.0 / rb.mean()
    u["elements"][:, 3] += spin
    u["elements"][:, 4] += 0.25 * abs(spin)
    u["inner"][3] = inner
    u["cage"][:] = 0.02 * rng.standard_normal(3)
    u["omega"][:] = np.array([orbit, 0.0, 0.0]) + rng.standard_normal(3)
    u["modes"][:] = 5e-3 * rng.standard_normal(layout.modes)
    ring = model.inner_ring
    q["inner"][4] = q["inner"][4] if ring.free[5] else ring.rest[5]
    yd = np.zeros_like(y)
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), np.zeros(len(POWERS)))
    bearing.function("note")(0.0, y, bearing.args)
    return y, yd, rng


def miss(bearing, y, yd, rng, alpha):
    """Largest error of one Newton step back from a displacement of one allowed error everywhere."""
    layout = bearing.layout
    weight = bearing.error_weights(1e-8)
    tested = weight > 0.0
    d = np.zeros(layout.size)
    d[tested] = rng.uniform(-1, 1, tested.sum()) / weight[tested]
    quat, dq = layout.q(y)["quaternion"], layout.q(d)["quaternion"]
    dq -= quat * (quat @ dq) / (quat @ quat)  # a rotation, no change of the norm
    s = 1e-2

    def along(e):
        return bearing.residual(0.0, y + e * d, yd + e * alpha * d)

    r = (along(s) - along(-s)) / (2 * s)
    bearing.function("linearise")(0.0, y, yd, bearing.args)
    assert bearing.function("factor")(alpha, bearing.args)
    bearing.function("backsolve")(alpha, y, r, bearing.args)
    return np.abs((r + d) * weight).max()


@pytest.mark.parametrize("name", STATES)
def test_full_matrix(name):
    """With friction and spin, damping, rolling resistance, at the steps of a run: alpha 3e5 is h of
    about 4 us."""
    specs, state = STATES[name]
    bearing = ball_bearing(
        **{
            "contacts": contacts_of("restitution", "step_coulomb"),
            "lubricant": Lubricant(),
            "load": LOAD,
            **specs,
        }
    )
    y, yd, rng = disturbed(bearing, **state)
    for alpha, limit in ((1e5, 0.03), (3e5, 0.01)):
        assert max(miss(bearing, y, yd, rng, alpha) for _ in range(5)) < limit
