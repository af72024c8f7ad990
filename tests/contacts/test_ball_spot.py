"""A ball's pit or flat on a groove: forces and moments as slopes of one energy, powers, tangent."""

from __future__ import annotations

import numpy as np
import pytest
from ball_kernels import a_groove, on_race, reported_on_race
from scipy.spatial.transform import Rotation
from test_groove_tangent import BALL, LEVER, differences, placed

from flexcage.bearings.ball.spot import BallSpot
from flexcage.contacts import laws
from flexcage.contacts.evaluation import DAMPED, NORMAL, ROLLED, RUBBED, STORED

ANGLE = 0.26
ELASTIC = {"law": (laws.elastic, laws.no_friction)}
STILL = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
#: size, depth, and the spot's middle from the contact along and across the groove [m]
PLACES = {
    "pit": (0.8e-3, 50e-6, 0.2e-3, 0.05e-3),
    "edge": (0.5e-3, 50e-6, -0.2e-3, 0.3e-3),
    "shallow": (0.5e-3, 3e-6, 0.1e-3, -0.1e-3),
}


def spotted(inner, name, **laws_of):
    """A groove, the place of a ball on it, and the direction of the ball's spot."""
    size, depth, along, across = PLACES[name]
    race = a_groove(inner=inner, ball_spot=BallSpot(size=size, depth=depth), **laws_of)
    P = placed(race, 9e-6, ANGLE, azimuth=0.0)
    centre = np.array([race.axial, race.centre, 0.0])
    n = (P - centre) / np.linalg.norm(P - centre)
    g = np.array([0.0, 0.0, 1.0])
    s = n * BALL + along * g + across * np.cross(n, g)
    return race, P, s


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("inner", [True, False])
def test_force_and_moment_are_slopes_of_the_energy(name, inner):
    """Over the ball's place and its turn; on the other side of the ball the spot is not met."""
    race, P, s = spotted(inner, name, normal="elastic", friction="none")

    def energy(e):
        turned = Rotation.from_rotvec(e[3:]).apply(s)
        return np.array(
            [reported_on_race(race, P + e[:3], *STILL, spot=turned, **ELASTIC)[2][STORED]]
        )

    hit, pair, sums = reported_on_race(race, P, *STILL, spot=s, **ELASTIC)
    slope = differences(energy, [1e-9] * 3 + [2e-7] * 3)[0]
    assert hit and sums[NORMAL] > 5.0 and np.abs(pair.wrench[3:]).max() > 1e-5
    np.testing.assert_allclose(
        pair.wrench / LEVER, slope / LEVER, atol=1e-5 * np.abs(slope[:3]).max()
    )
    even = reported_on_race(race, P, *STILL, **ELASTIC)
    behind = reported_on_race(race, P, *STILL, spot=-s, **ELASTIC)
    assert sums[STORED] < 0.99 * even[2][STORED]
    np.testing.assert_array_equal(behind[1].wrench, even[1].wrench)


def test_a_ball_on_its_flat_stands_lower_by_the_cut_cap():
    """At the middle of a flat of length c the cap c^2/(8 r) is missing, more than edges let it."""
    size = 0.6e-3
    race = a_groove(ball_spot=BallSpot(size=size, kind="flat"))
    cap = size**2 / (8.0 * BALL)
    assert race.spot[1] == pytest.approx(cap, rel=1e-12)
    on_edges = race.spot[2] * race.spot[0] ** 2
    assert on_edges > cap  # on a convex race it stands on the flat's middle
    outer = a_groove(inner=False, ball_spot=BallSpot(size=size, kind="flat"))
    assert outer.spot[2] * outer.spot[0] ** 2 < cap  # in a concave one on its edges


@pytest.mark.parametrize("name", PLACES)
def test_power_is_what_the_channels_say(name):
    race, P, s = spotted(True, name)
    v, spin, Vr, wr = (np.array(x) for x in (
        (0.02, -0.01, 9.0), (-1200.0, 5.0, 9.0), (0.01, 0.0, 0.02), (400.0, 0.0, 0.0)
    ))  # fmt: skip
    by = {"law": (laws.restitution, laws.traction)}
    _, pair, sums = reported_on_race(race, P, v, spin, Vr=Vr, wr=wr, spot=s, **by)
    relative, turning = v - Vr - np.cross(wr, P), spin - wr
    power = pair.wrench[:3] @ relative + pair.wrench[3:] @ turning

    def energy(t):
        turned = Rotation.from_rotvec(t * turning).apply(s)
        place = P + t * relative
        return reported_on_race(race, place, *STILL, spot=turned, **by)[2][STORED]

    h = 1e-10
    stored = (energy(h) - energy(-h)) / (2.0 * h)
    assert abs(stored) > 0.1 and sums[DAMPED] < 0.0
    channels = sums[DAMPED] + sums[RUBBED] + sums[ROLLED]
    assert power == pytest.approx(channels - stored, rel=1e-4)


@pytest.mark.parametrize("name", PLACES)
def test_tangent_is_near_enough_for_newton(name):
    race, P, s = spotted(True, name, normal="elastic", friction="none")
    _, pair = on_race(race, P, *STILL, mode=1, spot=s, **ELASTIC)
    K = differences(lambda e: on_race(race, P + e, *STILL, spot=s, **ELASTIC)[1].wrench, [1e-9] * 3)
    K = K / LEVER[:, None]
    assert np.abs(pair.K[:, :3] / LEVER[:, None] - K).max() < 0.35 * np.abs(K).max()
