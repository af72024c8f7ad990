"""A ball in a spherical pocket that ends at rims: the wall's nearest point, by a dense wall."""

import numpy as np
import pytest

from flexcage.contacts.ball_pocket import nearest_wall, turning
from flexcage.core.jit import kernel

RADIUS = 3.45


@kernel
def nearest(d, rims, seat, a):
    high = rims[0] if d[1] >= 0.0 else rims[1]
    wide = rims[2] if d[0] >= 0.0 else rims[3]
    n, apart, touch = nearest_wall((d[0], d[1], d[2]), RADIUS, (high, wide), seat)
    return n, apart, turning((a[0], a[1], a[2]), n, apart, touch)


def found(d, rims, seat=0.0, a=(0.0, 0.0, 0.0)):
    n, apart, turning = nearest(np.asarray(d, float), np.asarray(rims, float), seat, np.asarray(a))
    return np.array(n), apart, np.array(turning)


def wall(rims):
    """Points (n, 3) of the wall's half z >= 0, every 0.02 mm or nearer, its rims' nearer still."""
    high, low, ahead, behind = np.minimum(rims, 1.0)
    r, x = np.meshgrid(np.linspace(-low, high, 1201), np.linspace(-behind, ahead, 1601))
    level = 1.0 - r**2 - x**2
    t = np.sqrt(np.maximum(level, 0.0))
    return RADIUS * np.stack([x, r, t], axis=-1)[level >= 0.0]


RIMS = {
    "ribbon": (0.36, 0.57, 0.942, 0.942),  # of the preset 15x37x10
    "narrow": (0.36, 0.57, 0.64, 0.64),  # rims that meet in corners
    "flat": (0.2, 0.2, 2.0, 2.0),  # without side openings
    "crown": (0.36, 0.57, 0.45, 2.0),  # open on one side
}


@pytest.mark.parametrize("rims", RIMS.values(), ids=RIMS)
def test_the_nearest_point_is_that_of_a_dense_wall(rims):
    rng = np.random.default_rng(2)
    points = wall(rims)
    half_square = 0.5 * np.einsum("ij,ij->i", points, points)
    held = set()
    for d in 0.3 * rng.standard_normal((200, 3)):
        n, apart, _ = found(d, rims)
        mirrored = d * (1.0, 1.0, np.sign(d[2]))  # the wall is the same on both sides
        closest = points[np.argmin(half_square - points @ mirrored)]
        assert apart == pytest.approx(np.linalg.norm(closest - mirrored), abs=2e-4)
        assert np.linalg.norm(n) == pytest.approx(1.0, abs=1e-12)
        at = (d + apart * n) / RADIUS
        assert np.linalg.norm(at) == pytest.approx(1.0, abs=1e-9)
        assert -rims[1] - 1e-9 < at[1] < rims[0] + 1e-9
        assert -rims[3] - 1e-9 < at[0] < rims[2] + 1e-9
        on_side = min(abs(at[0] - rims[2]), abs(at[0] + rims[3])) < 1e-9
        on_rim = min(abs(at[1] - rims[0]), abs(at[1] + rims[1])) < 1e-9
        held.add((on_side, on_rim))
    wanted = {"ribbon": 3, "narrow": 4, "flat": 2, "crown": 4}
    assert len(held) >= wanted[next(k for k, v in RIMS.items() if v == rims)]


@pytest.mark.parametrize("rims", [*RIMS.values(), (2.0, 2.0, 2.0, 2.0)])
def test_direction_and_turning_are_slopes(rims):
    """Of the distance, and of its direction; within a seat too, where a ball sinks straight in."""
    rng = np.random.default_rng(3)
    seat, h = 3e-3, 1e-6
    places = [*0.3 * rng.standard_normal((40, 3)), (0.0, 0.9, 1e-3), (2e-3, -0.9, -1e-3)]
    for d in places:
        a = rng.standard_normal(3)
        n, _, turning = found(d, rims, seat, a)
        steps = h * np.eye(3)
        high, low = ([found(d + sign * step, rims, seat) for step in steps] for sign in (1, -1))
        slope = [-(up[1] - down[1]) / (2.0 * h) for up, down in zip(high, low)]
        np.testing.assert_allclose(n, slope, atol=1e-7)
        bend = [(up[0] - down[0]) @ a / (2.0 * h) for up, down in zip(high, low)]
        np.testing.assert_allclose(turning, bend, atol=2e-3 * (1.0 + np.abs(bend).max()))


def test_a_seat_turns_the_push_without_a_jump():
    """Straight above a round rim the wall pushes along the radius alone."""
    rims, seat = (0.36, 0.57, 2.0, 2.0), 3e-3
    sideways = [found((0.0, 0.9, t), rims, seat)[0][2] for t in np.linspace(-0.03, 0.03, 61)]
    assert sideways[30] == 0.0 and np.abs(np.diff(sideways)).max() < 0.35
    assert sideways[-1] > 0.9 * np.sqrt(1.0 - found((0.0, 0.9, 0.03), rims, seat)[0][1] ** 2)
