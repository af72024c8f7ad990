"""The tangent of a ball in its pocket against differences of its forces, the modes' included."""

from __future__ import annotations

import numpy as np
import pytest
from ball_kernels import in_pocket, pockets
from scipy.spatial.transform import Rotation

from flexcage.contacts.ball_pocket import CYLINDER, SPHERE

RADIUS = 5.5e-3
G = Rotation.from_rotvec([0.02, -0.01, 0.03]).as_matrix()
MODAL = np.array([2e-6, -3e-6, 1e-6, 4e-6, -1e-6])
RATES = np.array([0.02, 0.01, -0.03, 0.0, 0.02])

# what the pocket is, direction of the contact (x, r, psi), depth [m], velocity, angular velocity
STATES = {
    "light": ({}, (0.3, 0.0, 1.0), 1e-7, (0.01, 0.0, 0.02), (-900.0, 20.0, 5.0)),
    "heavy": ({}, (-0.8, 0.0, 0.5), 2e-5, (0.01, 0.2, 0.05), (-1500.0, 20.0, 5.0)),
    "rigid wall": ({"soft": 0.0}, (0.3, 0.0, -1.0), 5e-6, (0.2, 0.3, 0.1), (-900.0, 20.0, 5.0)),
    "sliding": ({}, (1.0, 0.0, 0.2), 5e-6, (0.5, -2.0, 0.7), (-1500.0, 100.0, 50.0)),
    "still": ({}, (0.3, 0.0, 1.0), 5e-6, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    "slot": ({"slot": (0.0, 50e-6)}, (1.0, 0.0, 0.0), 5e-6, (0.1, 0.1, 0.1), (-900.0, 20.0, 5.0)),
    "sphere": ({"shape": SPHERE}, (0.5, -0.4, 0.7), 5e-6, (0.1, 0.1, 0.1), (-900.0, 20.0, 5.0)),
    "pole": ({"shape": SPHERE}, (0.1, 0.97, 0.15), 5e-6, (0.1, 0.1, 0.1), (-900.0, 20.0, 5.0)),
    "rim": (
        {"shape": SPHERE, "rims": (0.42, 0.55, 0.7)}, (0.3, 0.60, 0.7), 5e-6, (0.1, 0.1, 0.1),
        (-900.0, 20.0, 5.0),
    ),
    "corner": (
        {"shape": SPHERE, "rims": (0.42, 0.55, 0.7)}, (0.85, 0.65, 0.3), 5e-6, (0.1, 0.1, 0.1),
        (-900.0, 20.0, 5.0),
    ),
    "moved": (
        {"shape": SPHERE, "moved": 2e-6}, (0.5, -0.4, 0.7), 5e-6, (0.1, 0.1, 0.1),
        (-900.0, 20.0, 5.0),
    ),
    # a crown cage's claw: 60 times as soft as the ring opposite, under 150 N
    "claw": (
        {"shape": SPHERE, "soft": 3e-7, "uneven": 0.97}, (0.9, 0.1, 0.6), 6e-5, (0.1, 0.1, 0.1),
        (-900.0, 20.0, 5.0),
    ),
    "side rim": (
        {"shape": SPHERE, "rims": (0.42, 0.55, 0.7)}, (-0.85, 0.1, 0.5), 5e-6, (0.1, 0.1, 0.1),
        (-900.0, 20.0, 5.0),
    ),
}  # fmt: skip


def placed(data, direction, depth, q):
    """Place from the cage, in the ball's frame, at which a ball is ``depth`` deep."""
    way = np.array(direction) / np.linalg.norm(direction)
    if data.shape == CYLINDER:
        way = way * (1.0, 0.0, 1.0) / np.hypot(way[0], way[2])
    middle = np.array([data.shift[0, 0], data.height, data.shift[0, 1]])
    low, high = 0.0, 0.5e-3

    def force(s):
        hit, forces, _ = in_pocket(data, G.T @ (middle + s * way), still, still, q, 0.0 * q, G=G)
        return np.linalg.norm(forces[:3])

    still = (0.0, 0.0, 0.0)
    for _ in range(50):  # where it begins to touch
        s = 0.5 * (low + high)
        low, high = (low, s) if force(s) > 0.0 else (s, high)
    return G.T @ (middle + (high + depth) * way)


@pytest.mark.parametrize("bent", [1e-4, 1.0], ids=["", "bent"])
@pytest.mark.parametrize("name", STATES)
def test_slopes_over_place_modes_and_velocities(name, bent):
    """With the bends of a wall's displacement and of its compliance, which decide at a claw."""
    kind, direction, depth, v, spin = STATES[name]
    data = pockets(**kind)
    q = bent * MODAL
    D = placed(data, direction, depth, q)
    hit, forces, work = in_pocket(data, D, v, spin, q, RATES, G=G, mode=1)
    assert hit and np.linalg.norm(forces[:3]) > 1e-3
    np.testing.assert_array_equal(forces, in_pocket(data, D, v, spin, q, RATES, G=G)[1])

    def of_place(e):
        return in_pocket(data, D + e[:3], v, spin, q + e[3:], RATES, G=G)[1]

    def of_velocity(e):
        return in_pocket(data, D, v + e[:3], spin + e[3:6], q, RATES + e[6:], G=G)[1]

    def differences(call, steps):
        columns = []
        for k, step in enumerate(steps):
            e = step * np.eye(len(steps))[k]
            columns.append(-(call(e) - call(-e)) / (2.0 * step))
        return np.stack(columns, axis=1)

    h = 1e-4 * depth
    row = np.array([1.0] * 3 + [RADIUS] * 3 + [1.0] * len(q))
    K = differences(of_place, [h] * (3 + len(q))) / row[:, None]
    C = differences(of_velocity, [1e-6] * 3 + [1e-4] * 3 + [1e-6] * len(q)) / np.outer(row, row)
    used = [0, 1, 2, *range(6, 6 + len(q))]
    got_K, got_C = (work.K / row[:, None])[:, used], work.C / np.outer(row, row)
    np.testing.assert_allclose(got_K, K, atol=1e-5 * np.abs(K).max())
    np.testing.assert_allclose(got_C, C, atol=1e-6 * np.abs(C).max())
    assert not work.K[:, 3:6].any()


def test_without_modes_and_compliance_it_is_exact():
    data = pockets(modes=0, soft=0.0)
    _, direction, depth, v, spin = STATES["heavy"]
    D = placed(data, direction, depth, np.zeros(0))
    hit, forces, work = in_pocket(data, D, v, spin, [], [], G=G, mode=1)
    assert hit and np.linalg.norm(forces[:3]) > 1.0
    for c in range(3):
        e = 1e-9 * np.eye(3)[c]
        high, low = (in_pocket(data, D + s * e, v, spin, [], [], G=G)[1] for s in (1, -1))
        np.testing.assert_allclose(
            work.K[:, c], -(high - low) / 2e-9, atol=2e-6 * np.abs(work.K).max()
        )


def test_apart_there_is_no_tangent():
    data = pockets()
    D = G.T @ np.array([0.0, data.height, 0.0])
    hit, forces, work = in_pocket(data, D, (0, 0, 0), (0, 0, 0), MODAL, RATES, G=G, mode=1)
    assert not hit and not forces.any() and not work.K.any() and not work.C.any()
