"""A bearing that starts with its inner ring tilted: equilibrium found, reaction moment right.

The reference takes positions and angles from the start, and makes depths, slice forces and moments
of them by itself: ISO/TS 16281 slices at their centres.
"""

import numpy as np
import pytest
from verification_bearing import bearing_of, log, n1013

from flexcage.system.start import find_start

STILL = {"drive.speed": "0 rpm", "load.gravity": "0 m/s^2", "cage.model": "rigid"}
TILTS = (0.2, 0.5, 1.0, 2.0)


def misaligned(tilt: float, *tables):
    bearing = bearing_of(n1013(*tables, {"load.misalignment": f"{tilt} mrad"}))
    return bearing, find_start(bearing, limit_force=2e4)


@pytest.mark.parametrize(
    ("tilt", "model"),
    [
        (0.2, "rigid"),
        (0.2, "flexible"),
        (0.5, "rigid"),
        (1.0, "flexible"),
        (2.0, "rigid"),
    ],
)
def test_a_tilted_bearing_starts_at_speed(tilt, model):
    bearing, start = misaligned(tilt, {"cage.model": model})
    assert start.residual < 1e-6 and not start.pinched
    bearing.residual(0.0, start.y, start.yd, 2)
    report = bearing.data.work.report
    assert report.rib.max() == 0.0 and report.pocket_normal.max() == 0.0
    forces = report.race[:, 0, 0]
    psi = bearing.layout.q(start.y)["elements"][:, 2]
    assert (forces * np.cos(psi)).sum() == pytest.approx(1000.0, rel=2e-3)


@pytest.mark.parametrize("speed", [10, 300, 700, 1000, 3000])
@pytest.mark.parametrize("load", [100, 1000, 5000])
def test_rollers_that_hardly_resist_a_tilt_find_their_place(speed, load):
    """Slow ones are pressed on the outer race by a tenth of a newton, by little at a zone's end."""
    for tilt in (0.2, 0.362, 0.6):
        turning = {"drive.speed": f"{speed} rpm", "load.radial": f"{load} N"}
        _, start = misaligned(tilt, {"cage.model": "rigid"}, turning)
        assert start.residual < 1e-6


def slices_of(case, roller, inner, *, outer: bool) -> tuple[np.ndarray, np.ndarray]:
    """Forces (n,) of a roller's slices on one race, and their places along the roller.

    Depth: from the distance of a point of the roller's axis to the race's.
    """
    b, n = case.bearing, case.contacts.race.slices
    s = ((np.arange(n) + 0.5) / n - 0.5) * b.effective_length
    drop = b.profile.drop(s, diameter=b.roller_diameter, length=b.effective_length)
    x, r, psi, skew, tilt = roller[:5]
    assert abs(skew) < 1e-12
    out = np.array([0.0, np.cos(psi), np.sin(psi)])
    along = np.array([np.cos(tilt), *(np.sin(tilt) * out[1:])])
    points = np.array([x, 0.0, 0.0]) + r * out + s[:, None] * along
    if outer:
        distance = np.hypot(points[:, 1], points[:, 2])
        depth = distance + 0.5 * b.roller_diameter - drop - b.outer_race_radius
    else:
        axis = np.array([np.cos(inner[4]), np.sin(inner[4]), 0.0])
        distance = np.linalg.norm(np.cross(points - inner[:3], axis), axis=1)
        depth = b.inner_race_radius + 0.5 * b.roller_diameter - drop - distance
    both = 35948.0 * (1e3 * b.effective_length) ** (8 / 9) * 1e3 ** (10 / 9)
    single = both * 2.0 ** (10 / 9)
    return single / n * np.maximum(depth, 0.0) ** (10 / 9), s


@pytest.mark.parametrize("tilt", TILTS)
def test_forces_and_moments_of_the_start_balance(tilt):
    """At rest: slices carry the load, each roller's two moments cancel, the ring's are held."""
    case = n1013(STILL, {"load.misalignment": f"{tilt} mrad"})
    bearing, start = misaligned(tilt, STILL)
    assert start.residual < 1e-6
    q = bearing.layout.q(start.y)
    sums = np.zeros((22, 2, 2))  # force, moment about the roller's middle
    for i, roller in enumerate(q["elements"]):
        for k, outer in enumerate((False, True)):
            N, s = slices_of(case, roller, q["inner"], outer=outer)
            sums[i, k] = N.sum(), (N * s).sum()
    cos, sin = np.cos(q["elements"][:, 2]), np.sin(q["elements"][:, 2])
    assert sums[:, 0, 0] @ cos == pytest.approx(1000.0, rel=5e-4)
    scaled = sums / np.abs(sums).max(axis=(0, 1))
    np.testing.assert_allclose(scaled[:, 0], scaled[:, 1], atol=2e-3)
    # what the constraints add is what makes the ring's rows vanish: no multiplier is set yet
    rows = bearing.layout.u(bearing.residual(0.0, start.y, start.yd))["inner"]
    turning = np.array([rows[4], rows[5]])  # about y and z
    expected = np.array([-sums[:, 0, 1] @ sin, sums[:, 0, 1] @ cos])
    log.info("%g mrad: reaction %.4f N m, slices %.4f N m", tilt, turning[1], expected[1])
    assert turning[1] == pytest.approx(expected[1], rel=2e-3)
    assert abs(turning[0]) < 2e-3 * abs(turning[1]) and abs(expected[0]) < 2e-3 * abs(expected[1])
    assert turning[1] > 0.0  # the rollers would turn it back: the constraint holds it tilted


def test_more_tilt_takes_more_moment_and_edge_load():
    moments, edges = [], []
    for tilt in TILTS:
        case = n1013(STILL, {"load.misalignment": f"{tilt} mrad"})
        bearing, start = misaligned(tilt, STILL)
        q = bearing.layout.q(start.y)
        rows = bearing.layout.u(bearing.residual(0.0, start.y, start.yd))["inner"]
        N, _ = slices_of(case, q["elements"][0], q["inner"], outer=False)
        moments.append(rows[5])
        edges.append(N.max() / N.mean())
    log.info("moments %s N m, largest slice over mean %s", np.round(moments, 4), np.round(edges, 3))
    assert np.all(np.diff(moments) > 0.0) and np.all(np.diff(edges) > 0.0)
    assert moments[1] / moments[0] == pytest.approx(2.5, rel=0.07)  # nearly linear while small
