"""The tangent of a ball on a groove against differences of its wrench."""

from __future__ import annotations

import numpy as np
import pytest
from ball_kernels import a_groove, on_race
from scipy.spatial.transform import Rotation

from flexcage.case.presets import load_preset
from flexcage.contacts import laws

BALL = 0.5 * load_preset("7010C-PI").bearing.ball_diameter
LEVER = np.array([1, 1, 1, BALL, BALL, BALL])

# depth [m], contact angle [rad], velocity at the centre [m/s], angular velocity [rad/s]
STATES = {
    "light": (5e-8, 0.26, (0.01, -0.02, 0.03), (-900.0, 3.0, 40.0)),
    "heavy": (2e-5, 0.35, (0.0, 1e-3, 0.01), (-1800.0, 500.0, -20.0)),
    "sliding": (4e-6, 0.26, (0.5, -0.1, 2.0), (-1500.0, 200.0, 100.0)),
    "still": (4e-6, 0.26, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    "no angle": (3e-6, 0.0, (0.0, 0.01, -0.3), (-1200.0, 1.0, 2.0)),
}


def placed(race, depth, angle, azimuth=0.03):
    """Place of the ball from the ring, a little aside of the first ball's azimuth."""
    reach = race.radius - BALL + depth
    outwards = -race.side  # towards the inner groove's centre or the outer's
    at = race.centre - outwards * reach * np.cos(angle)
    place = np.array([race.axial - outwards * reach * np.sin(angle), at, 0.0])
    return Rotation.from_rotvec([azimuth, 0, 0]).apply(place)


def differences(call, steps):
    """Minus the slopes (6, n) of the wrench that ``call`` gives, over the vector it takes."""
    columns = []
    for k, step in enumerate(steps):
        e = step * np.eye(len(steps))[k]
        columns.append(-(call(e) - call(-e)) / (2.0 * step))
    return np.stack(columns, axis=1)


@pytest.mark.parametrize("name", STATES)
@pytest.mark.parametrize("inner", [True, False])
@pytest.mark.parametrize("tilt", [0.0, 2e-3])
def test_slopes_over_place_and_velocities(name, inner, tilt):
    """Of force and moment, friction with spin and rolling resistance included; the ring tilted as
    well."""
    race = a_groove(inner=inner)
    depth, angle, v, spin = STATES[name]
    P = placed(race, depth, angle)
    b = Rotation.from_rotvec([0.0, tilt, -0.5 * tilt]).apply([1.0, 0.0, 0.0])
    P = P if tilt == 0.0 else Rotation.from_rotvec([0.0, tilt, -0.5 * tilt]).apply(P)
    hit, pair = on_race(race, P, v, spin, b=b, mode=1)
    assert hit and np.abs(pair.wrench[:3]).max() > 0.1
    reference = on_race(race, P, v, spin, b=b)[1].wrench
    np.testing.assert_array_equal(pair.wrench, reference)

    def of_place(e):
        return on_race(race, P + e, v, spin, b=b)[1].wrench

    def of_velocity(e):
        return on_race(race, P, v + e[:3], spin + e[3:], b=b)[1].wrench

    h = 1e-4 * depth
    K = differences(of_place, [h, h, h]) / LEVER[:, None]
    C = differences(of_velocity, [1e-6] * 3 + [1e-3] * 3) / np.outer(LEVER, LEVER)
    got_K, got_C = pair.K[:, :3] / LEVER[:, None], pair.C / np.outer(LEVER, LEVER)
    np.testing.assert_allclose(got_K, K, atol=2e-5 * np.abs(K).max())
    np.testing.assert_allclose(got_C, C, atol=2e-5 * np.abs(C).max())
    assert not pair.K[:, 3:].any()  # a ball looks the same however it has turned


@pytest.mark.parametrize("friction", [laws.no_friction, laws.step_coulomb, laws.traction])
@pytest.mark.parametrize("normal", [laws.elastic, laws.impact_step, laws.restitution])
def test_every_law(friction, normal):
    """Also of a ring that moves: P counts as it lies, with the relative velocity held."""
    names = {laws.no_friction: "none", laws.step_coulomb: "step_coulomb"}
    kinds = {laws.elastic: "elastic", laws.impact_step: "impact_step"}
    race = a_groove(
        normal=kinds.get(normal, "restitution"), friction=names.get(friction, "traction")
    )
    depth, angle, v, spin = STATES["heavy"]
    P, wr, Vr = placed(race, depth, angle), np.array([400.0, 3.0, -2.0]), np.array([0.1, 0.0, 0.2])
    v = np.array(v) + Vr + np.cross(wr, P)
    by = {"wr": wr, "Vr": Vr, "law": (normal, friction)}
    pair = on_race(race, P, v, spin, mode=1, **by)[1]

    def of_place(e):
        return on_race(race, P + e, v + np.cross(wr, e), spin, **by)[1].wrench

    K = differences(of_place, [1e-9] * 3) / LEVER[:, None]
    got = pair.K[:, :3] / LEVER[:, None]
    np.testing.assert_allclose(got, K, atol=2e-5 * np.abs(K).max())


def test_apart_or_held_back_there_is_no_tangent():
    race = a_groove()
    hit, pair = on_race(race, placed(race, -1e-7, 0.26), (0, 0, 0), (0, 0, 0), mode=1)
    assert not hit and not pair.K.any() and not pair.C.any()
    # a ball that leaves so fast that damping holds back all force
    P = placed(race, 1e-6, 0.26)
    hit, pair = on_race(race, P, 3.0 * (race.centre - P[1]) / race.radius * np.eye(3)[1], (0, 0, 0),
                        mode=1)  # fmt: skip
    fast = on_race(race, P, (0, 9.0, 0), (0, 0, 0), mode=1)
    slow = on_race(race, P, (0, -9.0, 0), (0, 0, 0), mode=1)
    held = [p for _, p in (fast, slow) if not p.wrench.any()]
    assert len(held) == 1 and not held[0].K.any() and not held[0].C.any()
