"""Newton's matrix in blocks against differences of the residual, in units of the allowed error."""

from __future__ import annotations

import numpy as np
import pytest
from bearing_runs import STATES, disturbed

from flexcage.contacts.spec import Contacts, FrictionLaw, Lubricant, NormalLaw, PairSpec
from flexcage.system.spec import Drive, Load

PLAIN = PairSpec(normal=NormalLaw(law="elastic"), friction=FrictionLaw(law="none"))
FRICTIONLESS = {
    "contacts": Contacts(race=PLAIN, pocket=PLAIN, side=PLAIN, rib=PLAIN),
    "lubricant": Lubricant(rolling_resistance="none", oil_fraction=0.0),
}


def miss(bearing, y, yd, rng, alpha):
    """Largest error of one Newton step back from a displacement of one allowed error everywhere."""
    layout = bearing.layout
    weight = bearing.error_weights(1e-8)
    tested = weight > 0.0
    d = np.zeros(layout.size)
    d[tested] = rng.uniform(-1, 1, tested.sum()) / weight[tested]
    if layout.has_cage:
        quat, dq = layout.q(y)["quaternion"], layout.q(d)["quaternion"]
        dq -= quat * (quat @ dq) / (quat @ quat)  # a rotation, no change of the norm
    s = 1e-2

    def along(e):
        return bearing.residual(0.0, y + e * d, yd + e * alpha * d)

    r = (along(s) - along(-s)) / (2 * s)
    bearing.residual(0.0, y, yd, mode=1)
    assert bearing.function("factor")(alpha, bearing.args)
    bearing.function("backsolve")(alpha, y, r, bearing.args)
    return np.abs((r + d) * weight).max()


@pytest.mark.parametrize("name", STATES)
def test_frictionless_matrix(bearing_of, name):
    """What is left out: how forces turn with geometry, and how inertia follows the motion (of 60
    random displacements on the compliant shaft the worst misses by 0.29, the mean by 0.21)."""
    specs, state = STATES[name]
    bearing = bearing_of(**FRICTIONLESS, **specs)
    y, yd, rng = disturbed(bearing, **state)
    for alpha, limit in ((1e5, 0.3), (1e6, 0.05)):
        assert max(miss(bearing, y, yd, rng, alpha) for _ in range(5)) < limit


@pytest.mark.parametrize("name", STATES)
def test_full_matrix(bearing_of, name):
    """With friction, damping, rolling resistance, at the steps of a run (alpha 3e5: h about 4 us).

    Left out besides: how friction and rolling resistance follow the load of a light contact.
    """
    specs, state = STATES[name]
    bearing = bearing_of(**{"load": Load(radial=1000.0), **specs})
    y, yd, rng = disturbed(bearing, **state)
    assert max(miss(bearing, y, yd, rng, 3e5) for _ in range(5)) < 0.2


def test_multipliers_have_exact_columns(bearing_of):
    """Rows are linear in the multipliers: one step takes any change of them back."""
    for specs in ({}, {"drive": Drive(kind="shaft")}):
        bearing = bearing_of(**specs)
        y, yd, rng = disturbed(bearing, press=105e-6)
        d = np.zeros_like(y)
        d[-7:] = rng.normal(size=7) * [10, 1, 1, 1, 1e-9, 1e-9, 1e-9]
        base, moved = bearing.residual(0.0, y, yd), bearing.residual(0.0, y + d, yd)
        bearing.residual(0.0, y, yd, mode=1)
        assert bearing.function("factor")(3e5, bearing.args)
        r = moved - base
        bearing.function("backsolve")(3e5, y, r, bearing.args)
        np.testing.assert_allclose(r[-7:-3], -d[-7:-3], rtol=2e-3, atol=1e-3)
