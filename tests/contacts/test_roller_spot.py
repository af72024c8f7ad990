"""A roller's pit or flat on a race: forces and moments as slopes of one energy, powers, tangent."""

from __future__ import annotations

import numpy as np
import pytest
from contact_kernels import race, turned
from test_race import MOTION

from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.contacts import laws
from flexcage.contacts.evaluation import DAMPED, MOMENT_PSI, NORMAL, ROLLED, RUBBED, STORED
from flexcage.contacts.spec import Contacts, FrictionLaw, NormalLaw, PairSpec

RW, LEVER = 4e-3, np.array([1.0, 1.0, 1.0, 4e-3, 4e-3, 4e-3])
#: size, depth, where on the spot the contact is [m], and axial width and middle
PLACES = {
    "edge": ({"size": 0.8e-3, "depth": 50e-6}, 0.25e-3),
    "before the middle": ({"size": 0.6e-3, "depth": 50e-6}, -0.1e-3),
    "bottom": ({"size": 0.8e-3, "depth": 3e-6}, 0.05e-3),
    "narrow": ({"size": 0.8e-3, "depth": 50e-6, "width": 2e-3, "offset": 1.5e-3}, 0.3e-3),
}
POSTURES = {"square": np.zeros(3), "askew": np.array([0.0, 4e-4, -3e-4])}


@pytest.fixture(scope="module")
def spotted(build_parts):
    """spotted(law, **spot) -> inner side, outer side of a bearing whose roller has that spot."""

    def make(law="elastic", **spot):
        pair = PairSpec(
            normal=NormalLaw(law=law, restitution=0.7), friction=FrictionLaw(law="traction")
        )
        model = build_parts(
            bearing={"roller_spot": RollerSpot(**spot)}, contacts=Contacts(race=pair)
        )
        return model.inner, model.outer

    return make


def state(side, along, depth=12e-6, posture="square"):
    """Place of a roller, its axes, and the angle of its spot, met ``along`` from its middle [m]:
    towards the ring, inwards or outwards."""
    P = np.array([2e-6, side.radius + side.sign * (RW - depth), 0.0])
    towards = np.pi if side.sign > 0.0 else 0.0
    return P, turned(np.eye(3), POSTURES[posture]), towards - along / RW


def slopes(function, steps):
    """Minus the slopes of a function of (6,) displacements and turns, by central differences."""
    out = np.empty(6)
    for j, h in enumerate(steps):
        e = np.eye(6)[j] * h
        out[j] = -(function(e) - function(-e)) / (2.0 * h)
    return out


STEPS = [2e-9] * 3 + [2e-7] * 3


@pytest.mark.parametrize("posture", POSTURES)
@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("which", [0, 1])
def test_wrench_is_the_slope_of_the_energy_and_the_ring_feels_its_reaction(
    spotted, which, name, posture
):
    """Over the roller's place and turns, its spin among them, and over those of the ring. All of a
    ring's moments but that about its axis, which a smooth race has not."""
    spot, along = PLACES[name]
    side = spotted(**spot)[which]
    P, axis, angle = state(side, along, posture=posture)
    b = turned(np.eye(3), [0.0, 2e-4, -3e-4])[0]

    def energy(e, ring=False):
        if not ring:
            return race(side, P + e[:3], axis=turned(axis, e[3:]), b=b, spot=angle)[1][STORED]
        return race(side, P - e[:3], axis=axis, b=turned(b[None], e[3:])[0], spot=angle)[1][STORED]

    wrench, sums, _ = race(side, P, axis=axis, b=b, spot=angle)
    slope = slopes(energy, STEPS)
    scale = np.abs(wrench / LEVER).max()
    assert sums[NORMAL] > 5.0  # and a spot's edge turns the roller, its bottom does not
    assert (abs(wrench[3]) > 1e-4 * scale * LEVER[3]) == (name != "bottom")
    np.testing.assert_allclose(wrench / LEVER / scale, slope / LEVER / scale, atol=3e-5)
    on_ring = slopes(lambda e: energy(e, ring=True), STEPS)
    reaction = -np.concatenate([wrench[:3], wrench[3:] + np.cross(P, wrench[:3])])
    np.testing.assert_allclose(
        on_ring / LEVER / scale, reaction / LEVER / scale, atol=3e-5 * np.abs(P).max() / LEVER[3]
    )
    np.testing.assert_allclose(reaction[3:] @ b, 0.0, atol=1e-9 * scale)


def test_on_the_other_side_the_spot_is_not_met(spotted):
    for side in spotted(**PLACES["edge"][0]):
        P, axis, angle = state(side, 0.25e-3)
        even, sums, _ = race(side, P, axis=axis)
        behind = race(side, P, axis=axis, spot=angle + np.pi)
        np.testing.assert_array_equal(behind[0], even)
        met = race(side, P, axis=axis, spot=angle)
        assert met[1][STORED] < 0.99 * sums[STORED]


def test_a_roller_on_its_flat_stands_lower_by_the_cut_cap(spotted):
    """At the middle of a flat of length c the cap c^2/(8 r) is missing; on the inner race, which is
    convex, the roller stands on the flat's middle (of an edge that is felt at a line), in the outer
    one on its edges: the mean of (l - x)^2 from -w to w is l^2 - l w + w^2/3."""
    size = 0.6e-3
    inner, outer = spotted(size=size, kind="flat")
    inner = inner._replace(spot=np.array([*inner.spot[:4], 1e-9]))
    half, wide = 0.5 * size, outer.spot[4] * RW
    cap = size**2 / (8.0 * RW)
    mean = (half**2 - half * wide + wide**2 / 3.0) * (1 / RW - 1 / outer.radius) / 2
    for side, sunk in ((inner, cap), (outer, mean)):
        P, axis, angle = state(side, 0.0, depth=20e-6)
        lower, *_ = state(side, 0.0, depth=20e-6 - sunk)
        on_flat = race(side, P, axis=axis, spot=angle)[1][NORMAL]
        assert on_flat == pytest.approx(race(side, lower, axis=axis)[1][NORMAL], rel=1e-9)
    assert mean < cap


def test_a_narrow_spot_loads_the_other_end(spotted):
    """A spot at +x takes load there: what is left turns the roller about e_psi."""
    spot, along = PLACES["narrow"]
    inner, _ = spotted(**spot)
    width = inner.s[1] - inner.s[0]
    assert inner.spotted.sum() * width == pytest.approx(2e-3, rel=1e-12)
    P, axis, angle = state(inner, 0.0)
    wrench, sums, _ = race(inner, P, axis=axis, spot=angle)
    assert wrench[5] < -1e-3 and sums[MOMENT_PSI] == pytest.approx(wrench[5], rel=1e-12)


@pytest.mark.parametrize("name", PLACES)
@pytest.mark.parametrize("which", [0, 1])
def test_power_is_what_the_channels_say(spotted, which, name):
    """Power of the forces on both bodies = - dU/dt + damping + friction + rolling resistance."""
    spot, along = PLACES[name]
    side = spotted("restitution", **spot)[which]
    P, axis, angle = state(side, along, posture="askew")
    V, w, Vr, wr = MOTION.values()
    call = {"law": laws.restitution, "friction": laws.traction}
    wrench, sums, _ = race(side, P, axis=axis, V=V, w=w, Vr=Vr, wr=wr, spot=angle, **call)
    power = wrench[:3] @ (V - Vr - np.cross(wr, P)) + wrench[3:] @ (w - wr)

    def energy(t):
        b = turned(np.eye(3), t * wr)[0]
        return race(
            side, P + t * (V - Vr), axis=turned(axis, t * w), b=b, spot=angle, **call
        )[1][STORED]  # fmt: skip

    h = 1e-11
    stored = (energy(h) - energy(-h)) / (2 * h)
    channels = sums[DAMPED] + sums[RUBBED] + sums[ROLLED]
    assert abs(stored) > 0.1 and sums[DAMPED] < 0.0
    size = np.abs(sums[DAMPED : ROLLED + 1]).sum() + abs(stored)
    assert power == pytest.approx(channels - stored, abs=1e-3 * size)


@pytest.mark.parametrize("name", PLACES)
def test_tangent_is_near_enough_for_newton(spotted, name):
    """Left out: how the spot's slope changes under a force that stays."""
    spot, along = PLACES[name]
    side = spotted(**spot)[0]
    P, axis, angle = state(side, along)
    pair = race(side, P, axis=axis, mode=1, spot=angle)[2]
    K = np.stack([
        -(race(side, P + e[:3], axis=turned(axis, e[3:]), spot=angle)[0]
          - race(side, P - e[:3], axis=turned(axis, -e[3:]), spot=angle)[0]) / (2.0 * h)
        for e, h in ((h * np.eye(6)[j], h) for j, h in enumerate(STEPS))
    ], axis=1)  # fmt: skip
    K, own = K / np.outer(LEVER, LEVER), pair.K / np.outer(LEVER, LEVER)
    assert np.abs(K - own).max() < 0.35 * np.abs(K).max()
