"""Load distribution of the N1013 at rest and in rotation, through the whole start of a run.

Known answers: an independent Sjoevall-type program (ISO/TS 16281 stiffness 35948 Lwe^(8/9) of both
races in series, slices at their centres), roller 0 under the load or the load between two rollers.
"""

import numpy as np
import pytest
from verification_bearing import bearing_of, n1013

from flexcage.system.start import find_start

STILL = {"drive.speed": "0 rpm", "load.gravity": "0 m/s^2", "cage.model": "rigid"}
STRAIGHT = {"bearing.profile.kind": "straight"}
BETWEEN = {"load.direction": "8.18181818181818 deg"}  # half of a pitch


def equilibrium(*tables):
    """(radial displacement [um], inner forces (Z,), outer forces (Z,)) of the start."""
    bearing = bearing_of(n1013(*tables))
    start = find_start(bearing, limit_force=2e4)
    assert start.residual < 1e-6 and not start.pinched
    bearing.residual(0.0, start.y, start.yd, 2)
    race = bearing.data.work.report.race[:, :, 0]
    moved = np.hypot(*bearing.layout.q(start.y)["inner"][1:3])
    return 1e6 * moved, race[:, 0].copy(), race[:, 1].copy()


@pytest.mark.parametrize(
    ("clearance", "direction", "moved", "largest", "loaded"),
    [
        (0, {}, 1.7830, 185.693, 11),
        (0, BETWEEN, 1.7828, 183.568, 10),
        (10, {}, 7.6180, 284.541, 5),
        (10, BETWEEN, 7.5779, 270.421, 6),
        (20, {}, 13.0073, 331.925, 5),
        (20, BETWEEN, 13.0694, 323.249, 4),
        (40, {}, 23.7221, 420.678, 3),
        (40, BETWEEN, 23.5645, 371.070, 4),
        (55, {}, 31.4245, 446.171, 3),
        (55, BETWEEN, 31.4289, 406.497, 4),
    ],
)
def test_straight_rollers(clearance, direction, moved, largest, loaded):
    size = {"bearing.radial_clearance": f"{clearance} um"}
    ours, inner, outer = equilibrium(STILL, STRAIGHT, size, direction)
    assert ours == pytest.approx(moved, rel=1e-4)
    assert inner.max() == pytest.approx(largest, rel=3e-4)
    assert np.count_nonzero(inner > 1e-3) == loaded
    np.testing.assert_allclose(inner, outer, atol=1e-3)


@pytest.mark.parametrize(
    ("clearance", "moved", "largest"),
    [(0, 3.6907, 199.715), (20, 14.9584, 311.914), (40, 25.6264, 377.813)],
)
def test_profiled_rollers_with_the_rows_own_thirty_slices(clearance, moved, largest):
    size = {"bearing.radial_clearance": f"{clearance} um", "contacts.race.slices": 30}
    ours, inner, _ = equilibrium(STILL, size)
    assert ours == pytest.approx(moved, rel=2e-4)
    assert inner.max() == pytest.approx(largest, rel=5e-4)


def test_fifteen_slices_are_converged_at_the_preset_s_clearance():
    """312.6 N is the converged force; the production quadrature stays within 0.2 % of it."""
    _, inner, _ = equilibrium(STILL)
    assert inner.max() == pytest.approx(312.6, rel=2e-3)


@pytest.mark.parametrize(
    ("clearance", "moved", "inner_force", "outer_force"),
    [
        (0, 1.8418, 187.281, 197.761),
        (20, 13.0557, 332.635, 343.115),
        (40, 23.7658, 420.936, 431.416),
    ],
)
def test_centrifugal_force_at_speed(clearance, moved, inner_force, outer_force):
    """6000 rpm, cage epicyclic: F_c = 10.4799 N on every roller, all of it on the outer race."""
    size = {"bearing.radial_clearance": f"{clearance} um", "drive.speed": "6000 rpm"}
    ours, inner, outer = equilibrium(STILL, STRAIGHT, size)
    assert ours == pytest.approx(moved, rel=1e-4)
    assert inner.max() == pytest.approx(inner_force, rel=3e-4)
    assert outer.max() == pytest.approx(outer_force, rel=3e-4)
    assert outer[inner == 0.0] == pytest.approx(10.4799, rel=5e-4)
