"""A ball on waves and over a spall of a groove: where it stands, forces as slopes of one energy,
powers, tangents."""

from __future__ import annotations

import numpy as np
import pytest
from ball_kernels import a_groove, on_race, reported_on_race
from scipy.integrate import quad
from test_groove_tangent import BALL, LEVER, differences, placed

from flexcage.contacts import laws
from flexcage.contacts.evaluation import APPROACH, DAMPED, NORMAL, ROLLED, RUBBED, STORED
from flexcage.geometry.spall import Spall

ANGLE, AZIMUTH, LENGTH = 0.26, 0.3, 0.8e-3
ELASTIC = {"law": (laws.elastic, laws.no_friction)}
STILL = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
WAVY = {f"{ring}_waviness{of}": v for ring in ("inner", "outer")
        for of, v in (("", 2e-6), ("_order", 12), ("_azimuth", 0.1))}  # fmt: skip


def groove(inner, *, width=None, offset=0.0, depth=50e-6, waves=False, **laws_of):
    """A groove with a spall at ``AZIMUTH``, whose middle lies ``offset`` [m] aside of the path."""
    sine = np.sin(ANGLE) * (-1.0 if inner else 1.0)
    even = a_groove(inner=inner)
    spall = Spall(
        length=LENGTH, depth=depth, azimuth=AZIMUTH, width=width,
        offset=even.radius * sine + offset,
    )  # fmt: skip
    uneven = {"inner_spall": spall, "outer_spall": spall, **(WAVY if waves else {})}
    return a_groove(inner=inner, normal="elastic", friction="none", **uneven, **laws_of)


def sharp(race):
    """The same with edges that are felt at a line."""
    return race._replace(spall=np.array([*race.spall[:4], 1e-9]))


def force(race, P, off=0.0):
    """Normal force on a ball at rest at P, ``off`` [rad] from the spall's middle."""
    return reported_on_race(race, P, *STILL, azimuth=AZIMUTH + off, **ELASTIC)[2][NORMAL]


def from_edge(race, P, azimuth):
    """Least distance [m] of the point P from the groove's arc at an azimuth, an edge's corner."""
    angle = np.linspace(ANGLE - 0.3, ANGLE + 0.3, 20001)
    radius = race.centre + race.side * race.radius * np.cos(angle)
    x = race.axial + race.side * race.radius * np.sin(angle)
    points = np.stack([x, radius * np.cos(azimuth), radius * np.sin(azimuth)], axis=1)
    return np.linalg.norm(points - P, axis=1).min()


@pytest.mark.parametrize("inner", [True, False])
def test_a_ball_rides_on_the_edges_and_down_to_the_bottom(inner):
    """Where it is free it just touches the edge's corner, in space; on the bottom it bears as on
    the race. Of edges that are felt at a line."""
    race = sharp(groove(inner, depth=300e-6))
    half = race.spall[0]
    assert 2.0 * half * (race.centre + race.side * race.radius * np.cos(ANGLE)) == pytest.approx(
        LENGTH, rel=1e-3
    )
    for off in (0.1 * half, 0.5 * half, 0.9 * half):
        low, high = 0.0, 100e-6  # depth at which it touches
        for _ in range(40):
            middle = 0.5 * (low + high)
            touches = force(race, placed(race, middle, ANGLE, azimuth=0.0), off) > 0.0
            low, high = (low, middle) if touches else (middle, high)
        missed = from_edge(race, placed(race, high, ANGLE, azimuth=0.0), half - off) - BALL
        assert high > 0.1e-6 and abs(missed) < 0.02 * high
    shallow = groove(inner, depth=3e-6)
    inside = force(shallow, placed(race, 10e-6, ANGLE, azimuth=0.0))
    beside = force(shallow, placed(race, 7e-6, ANGLE, azimuth=0.0), off=0.2)
    assert inside == pytest.approx(beside, rel=1e-9)


def energy_of_strips(race, depth, sunk, sides):
    """Of the row of strips, by quadrature; ``sides`` of the spall from the contact [m]."""
    stiffness, c = race.normal[0], race.reach

    def strip(y):
        inside = sides[0] < y < sides[1]
        return max(depth - (sunk if inside else 0.0) - (y / c) ** 2, 0.0) ** 2

    half = c * np.sqrt(depth)
    within = c * np.sqrt(max(depth - sunk, 0.0))
    breaks = [y for y in (*sides, -within, within) if abs(y) < half]
    found = quad(strip, -half, half, points=breaks or None, limit=200, epsabs=0.0, epsrel=1e-10)
    return 0.4 * stiffness * 15.0 / 16.0 / c * found[0]


@pytest.mark.parametrize(
    ("width", "offset", "depth"),
    [
        (0.3e-3, 0.0, 12e-6), (0.3e-3, 0.25e-3, 12e-6), (1.5e-3, -0.9e-3, 12e-6),
        (0.4e-3, 0.1e-3, 3e-6),
    ],
    ids=["narrow", "aside", "one side", "shallow"],
)  # fmt: skip
@pytest.mark.parametrize("inner", [True, False])
def test_a_narrow_spall_takes_its_strips_of_the_ellipse(inner, width, offset, depth):
    """The energy of a contact whose ellipse reaches over the spall's sides, by quadrature."""
    race, pressed = sharp(groove(inner, width=width, offset=offset, depth=depth)), 9e-6
    P = placed(race, pressed, ANGLE, azimuth=0.0)
    sunk = min(depth, race.spall[3] * race.spall[0] ** 2)
    sides = race.radius * (race.sides - ANGLE)
    expected = energy_of_strips(race, pressed, sunk, sides)
    found = reported_on_race(race, P, *STILL, azimuth=AZIMUTH, **ELASTIC)[2][STORED]
    whole = 0.4 * race.normal[0] * pressed**2.5
    assert found == pytest.approx(expected, rel=1e-7) and 0.02 < found / whole < 0.98


PLACES = {  # width and offset of the spall [m]; of the ball's place along the race, over half of it
    "wide": (None, 0.0, 0.85),
    "narrow": (0.5e-3, 0.0, -0.4),
    "one side": (1.5e-3, 0.8e-3, 0.93),
    "waves": (0.5e-3, 0.1e-3, 0.6),
}


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("inner", [True, False])
@pytest.mark.parametrize("tilt", [0.0, 1e-3])
def test_force_is_the_slope_of_the_energy(name, inner, tilt):
    """Over the ball's place, and over the ring's turn, which takes the spall with it."""
    width, offset, share = PLACES[name]
    race = groove(inner, width=width, offset=offset, waves=name == "waves")
    P = placed(race, 9e-6, ANGLE, azimuth=0.0)
    b = np.array([1.0, tilt, -0.5 * tilt]) / np.linalg.norm([1.0, tilt, 0.5 * tilt])
    P = P + tilt * P[1] * np.array([-1.0, 0.0, 0.0])  # turned with it, to first order
    azimuth = AZIMUTH + share * race.spall[0]

    def energy(e, turned=0.0):
        sums = reported_on_race(race, P + e, *STILL, b=b, azimuth=azimuth - turned, **ELASTIC)[2]
        return sums[STORED]

    hit, pair, sums = reported_on_race(race, P, *STILL, b=b, azimuth=azimuth, **ELASTIC)
    slope = differences(lambda e: np.array([energy(e)]), [1e-9] * 3)[0]
    assert hit and sums[NORMAL] > 5.0
    along = np.cross(b, P / np.linalg.norm(P))
    assert abs(pair.wrench[:3] @ along) > 1e-3 * sums[NORMAL]  # there is something to see
    np.testing.assert_allclose(pair.wrench[:3], slope, atol=3e-6 * np.abs(slope).max())
    assert not pair.wrench[3:].any()  # the edge's force goes through the ball's centre
    h = 1e-7
    torque = -(energy(0.0, h) - energy(0.0, -h)) / (2.0 * h)
    on_ring = -np.cross(P, pair.wrench[:3]) @ b
    assert on_ring == pytest.approx(torque, abs=3e-6 * np.abs(slope).max() * P[1])


@pytest.mark.parametrize("inner", [True, False])
def test_energy_and_force_pass_the_edges_without_a_step(inner):
    """Along a path through a narrow spall: what force does, is what energy becomes."""
    race = groove(inner, width=0.5e-3, depth=6e-6)
    P = placed(race, 9e-6, ANGLE, azimuth=0.0)
    half = race.spall[0]
    way = np.linspace(-1.3 * half, 1.3 * half, 4001)
    stored, pushed = np.transpose([
        (sums[STORED], pair.wrench[2] * np.hypot(P[1], P[2]))
        for _, pair, sums in (
            reported_on_race(race, P, *STILL, azimuth=AZIMUTH + off, **ELASTIC) for off in way
        )
    ])  # fmt: skip
    work = np.cumsum(0.5 * (pushed[1:] + pushed[:-1]) * np.diff(way))
    np.testing.assert_allclose(stored[1:] - stored[0], -work, atol=1e-3 * stored[0])
    assert stored.min() < 0.8 * stored[0] and stored[-1] == pytest.approx(stored[0], rel=1e-12)
    assert np.abs(np.diff(stored)).max() < 5e-3 * stored[0]


@pytest.mark.parametrize("name", PLACES)
def test_power_is_what_the_channels_say(name):
    """Of both bodies' motion, friction, damping and rolling resistance included; the ring spins."""
    width, offset, share = PLACES[name]
    race = groove(True, width=width, offset=offset, waves=name == "waves")
    like = a_groove(inner=True)
    race = race._replace(normal=like.normal, friction=like.friction)
    P = placed(race, 9e-6, ANGLE, azimuth=0.0)
    azimuth = AZIMUTH + share * race.spall[0]
    v, spin, Vr, wr = (np.array(x) for x in (
        (0.02, -0.01, 9.0), (-1200.0, 5.0, 9.0), (0.01, 0.0, 0.02), (400.0, 0.0, 0.0)
    ))  # fmt: skip
    by = {"law": (laws.restitution, laws.traction)}
    _, pair, sums = reported_on_race(race, P, v, spin, Vr=Vr, wr=wr, azimuth=azimuth, **by)
    relative = v - Vr - np.cross(wr, P)
    power = pair.wrench[:3] @ relative + pair.wrench[3:] @ (spin - wr)

    def energy(t):
        return reported_on_race(race, P + t * relative, *STILL, azimuth=azimuth, **by)[2][STORED]

    h = 1e-10
    stored = (energy(h) - energy(-h)) / (2.0 * h)
    channels = sums[DAMPED] + sums[RUBBED] + sums[ROLLED]
    assert sums[DAMPED] < 0.0 and sums[RUBBED] < 0.0 and abs(stored) > 0.1
    assert power == pytest.approx(channels - stored, rel=1e-5)
    assert abs(sums[APPROACH]) < 5.0


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("inner", [True, False])
def test_tangent_is_near_enough_for_newton(name, inner):
    """Within a few per cent of differences: it leaves out how edges and waves bend."""
    width, offset, share = PLACES[name]
    race = groove(inner, width=width, offset=offset, waves=name == "waves")
    P = placed(race, 9e-6, ANGLE, azimuth=0.0)
    by = {**ELASTIC, "azimuth": AZIMUTH + share * race.spall[0]}
    _, pair = on_race(race, P, *STILL, mode=1, **by)
    K = differences(lambda e: on_race(race, P + e, *STILL, **by)[1].wrench, [1e-9] * 3)
    K = K / LEVER[:, None]
    bound = 0.1 if width is None else 0.35
    assert np.abs(pair.K[:, :3] / LEVER[:, None] - K).max() < bound * np.abs(K).max()
