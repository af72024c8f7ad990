"""Tapered rollers in pockets of a conical cage: slopes of one energy, balance, Newton's matrix."""

from __future__ import annotations

import numpy as np
import pytest
from leaning_rollers import (
    check_balance,
    check_integrators_in_pockets,
    check_slopes_in_pockets,
    miss_in_pockets,
    stir,
)
from tapered_parts import (
    DRY,
    ELASTIC,
    FRICTIONLESS,
    LIGHT,
    caged,
    energy,
    in_pockets,
    pressed,
    pushed,
)

from flexcage.bearings.tapered_roller.start import rolling_cones
from flexcage.system.data import POCKET_FRICTION


@pytest.mark.parametrize("soft", [False, True])
def test_forces_in_conical_pockets_are_slopes_of_one_energy(soft):
    """On cage, turned about each axis, its modes, and on rollers, pressed against bars that lean
    and taper and against ends across their axes."""
    _, bearing = caged(soft=soft, **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y = in_pockets(bearing, pressed(bearing))
    energy(bearing, y)
    normal = bearing.data.work.report.pocket_normal
    assert ((normal > 1.0).sum(axis=0)[[0, 1, 3]] > 3).all()
    check_slopes_in_pockets(bearing, y, (0, 1, 6, 11))


def test_all_forces_in_conical_pockets_balance():
    _, bearing = caged(modes=0, soft=False, **{"lubricant.oil_fraction": 0.0}, **LIGHT)
    y = in_pockets(bearing, pressed(bearing))
    stir(bearing, y)
    found = pushed(bearing, y)
    assert bearing.data.work.report.power[POCKET_FRICTION] < -0.1
    assert np.abs(found[-1][0]).max() > 1.0  # on the cage
    check_balance(found)


NO_RIB_FRICTION = {"contacts.rib.friction.law": "none"}


@pytest.mark.parametrize(
    "changes, soft, limit",
    [
        (NO_RIB_FRICTION, False, 0.05),
        (NO_RIB_FRICTION, True, 0.05),
        ({}, False, 1.5),
        ({}, True, 1.0),
    ],
)
def test_newton_matrix_in_conical_pockets(changes, soft, limit):
    """At a run's steps, with friction and damping. The rib presses ends with 3 to 6 kN here, whose
    friction lever and force turn rollers that nothing holds: it is the worst for Newton's steps,
    which missed by 12 to 90 without the slopes of ``test_tapered_rib`` and without how axes that
    lean keep their direction while rollers orbit."""
    _, bearing = caged(soft=soft, **changes)
    y = in_pockets(bearing, pressed(bearing))
    yd = rolling_cones(bearing.data.model, bearing.layout, bearing.spec, y)
    assert miss_in_pockets(bearing, y, yd, touched=10) < limit


@pytest.mark.slow
def test_both_integrators_move_tapered_rollers_in_pockets_alike():
    """A flexible cage with yielding walls, whose bars the rollers strike."""

    def make():
        _, bearing = caged(**LIGHT)
        y = in_pockets(bearing, pressed(bearing), depth=0.0)
        return bearing, y, rolling_cones(bearing.data.model, bearing.layout, bearing.spec, y)

    check_integrators_in_pockets(make, 0.2e-3)
