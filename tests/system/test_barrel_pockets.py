"""Barrels in pockets of a cage for both rows: slopes of one energy, balance, Newton's matrix."""

from __future__ import annotations

import numpy as np
import pytest
from barrel_parts import caged, in_pockets, settled
from leaning_rollers import (
    check_balance,
    check_integrators_in_pockets,
    check_slopes_in_pockets,
    miss_in_pockets,
    stir,
)
from scipy.spatial.transform import Rotation
from tapered_parts import DRY, ELASTIC, FRICTIONLESS, LIGHT, energy, pushed

from flexcage.bearings.spherical_roller.start import rolling_barrels
from flexcage.system.data import POCKET_FRICTION


@pytest.mark.parametrize("soft", [False, True])
def test_forces_in_pockets_of_barrels_are_slopes_of_one_energy(soft):
    """On cage, turned about each axis, its modes, and on barrels of both rows, pressed against bars
    and ends of pockets."""
    _, bearing = caged(soft=soft, **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y = in_pockets(bearing, settled(bearing))
    energy(bearing, y)
    touched = bearing.data.work.report.pocket_normal > 1.0
    assert (touched[:, :2].sum(axis=0) > 6).all() and touched[:16].sum() > 8
    assert touched[:16, 2].sum() > 3 and touched[16:, 3].sum() > 3  # ends at the cage's -x
    check_slopes_in_pockets(bearing, y, (0, 1, 6, 11, 16, 17, 24))


def test_both_rows_of_pockets_are_mirror_images():
    """What a row does to the cage along x and in tilt the other one does the other way."""
    _, bearing = caged(modes=0, soft=False, **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT,
                       **{"bearing.staggered": False})  # fmt: skip
    y = np.zeros(bearing.layout.size)
    q, each = bearing.layout.q(y), bearing.spec.roller_count
    y[:] = settled(bearing)
    first, second = q["elements"][:each], q["elements"][each:]
    second[:] = first * (-1.0, 1.0, 1.0, -1.0, -1.0, 1.0)
    q["inner"][:], q["outer"][:], q["quaternion"][0] = 0.0, 0.0, 1.0
    first[:, 2] += 20e-6 / first[0, 1] * np.tile([1.0, -1.0], each // 2) + 2e-3
    second[:, 2] = first[:, 2]
    q["elements"][:, :5] += 0.0
    moved = 0.12e-3 * np.cos(bearing.spec.axis_angle)
    first[:, 0] -= moved
    second[:, 0] += moved
    force, moment = pushed(bearing, y)[-1]
    normal = bearing.data.work.report.pocket_normal
    assert (normal[:each, 2] > 0.1).all()  # outer ends
    np.testing.assert_allclose(normal[:each], normal[each:], atol=1e-9 * normal.max())
    assert abs(force[0]) < 1e-9 * normal.sum()
    assert np.abs(moment[1:]).max() < 1e-9 * normal.sum() * bearing.spec.pitch_radius


def test_all_forces_in_pockets_of_barrels_balance():
    _, bearing = caged(modes=0, soft=False, **{"lubricant.oil_fraction": 0.0}, **LIGHT)
    y = in_pockets(bearing, settled(bearing))
    stir(bearing, y)
    found = pushed(bearing, y)
    assert bearing.data.work.report.power[POCKET_FRICTION] < -0.1
    assert np.abs(found[-1][0]).max() > 1.0  # on the cage
    check_balance(found)


@pytest.mark.parametrize("soft, limit", [(False, 0.4), (True, 0.8)])
def test_newton_matrix_in_pockets_of_barrels(soft, limit):
    """At a run's steps, with friction and damping, as of tapered rollers."""
    _, bearing = caged(soft=soft)
    y = in_pockets(bearing, settled(bearing))
    yd = rolling_barrels(bearing, y, Rotation.identity())
    assert miss_in_pockets(bearing, y, yd, touched=16) < limit


@pytest.mark.slow
def test_both_integrators_move_barrels_in_pockets_alike():
    """A flexible cage with yielding walls, whose bars the barrels strike."""

    def make():
        _, bearing = caged(**LIGHT)
        y = in_pockets(bearing, settled(bearing), depth=0.0)
        return bearing, y, rolling_barrels(bearing, y, Rotation.identity())

    check_integrators_in_pockets(make, 0.15e-3)
