"""Roller against a raceway: energy, power, tangents, third law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from contact_kernels import race, turned
from law_values import rolling

from flexcage.contacts import laws
from flexcage.contacts.evaluation import (
    DAMPED,
    MOMENT_PSI,
    NORMAL,
    ROLLED,
    RUBBED,
    SLIDING,
    STORED,
    TRACTION,
)
from flexcage.contacts.spec import Contacts, FrictionLaw, NormalLaw, PairSpec
from flexcage.geometry.rollers import RollerProfile
from flexcage.geometry.spall import Spall


@pytest.fixture(scope="module")
def sides(build_parts):
    """sides(clearance, profile, slices, waviness) -> inner side, outer side."""

    def make(clearance=20e-6, profile="logarithmic", slices=15, law="elastic", **waviness):
        pair = PairSpec(
            normal=NormalLaw(law=law, restitution=0.7), friction=FrictionLaw(law="traction"),
            slices=slices,
        )  # fmt: skip
        model = build_parts(
            bearing={
                "radial_clearance": clearance, "profile": RollerProfile(kind=profile), **waviness
            },
            contacts=Contacts(race=pair),
        )  # fmt: skip
        return model.inner, model.outer

    return make


STATES = {  # translation from the middle of the race [m], roller axis and ring axis turned [rad]
    "square": ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]),
    "skewed": ([2e-6, 1e-6, 3e-5], [0.0, 4e-4, 0.0], [0.0, 0.0, 0.0]),
    "tilted": ([5e-6, -1e-6, -2e-5], [0.0, 1e-4, 7e-4], [0.0, 3e-4, -2e-4]),
}


def state(side, name, depth=3e-6):
    """Centre, roller axes and ring axis of one of STATES, pressed into the race by ``depth``."""
    shift, roller, ring = (np.array(x) for x in STATES[name])
    P = np.array([0.0, side.radius + side.sign * (4e-3 - depth), 0.0]) + shift
    return P, turned(np.eye(3), roller), turned(np.eye(3), ring)[0]


@pytest.mark.parametrize("name", STATES)
@pytest.mark.parametrize("which", [0, 1])
def test_force_is_the_slope_of_the_energy(sides, name, which):
    side = sides()[which]
    P, axis, b = state(side, name)
    wrench, sums, _ = race(side, P, axis=axis, b=b)
    assert wrench[1] * side.sign > 10.0 and sums[NORMAL] > 10.0
    slope = np.empty(6)
    for j, h in enumerate([2e-9] * 3 + [1e-7] * 3):
        e = h * np.eye(3)[j % 3]
        energy = [
            race(side, P + (s * e if j < 3 else 0), axis=axis if j < 3 else turned(axis, s * e),
                 b=b)[1][STORED]
            for s in (1, -1)
        ]  # fmt: skip
        slope[j] = -(energy[0] - energy[1]) / (2 * h)
    scale = np.array([1, 1, 1, 4e-3, 4e-3, 4e-3]) * np.abs(wrench).max()
    np.testing.assert_allclose(slope / scale, wrench / scale, atol=2e-5)


def test_force_is_the_slope_of_the_energy_on_a_wavy_race(sides):
    """Along the race and about the ring's axis too: waves push along, not only in and out."""
    inner, _ = sides(inner_waviness=1e-6, inner_waviness_order=12)
    P = np.array([0.0, inner.radius + 4e-3 - 3e-6, 0.0])

    def energy(psi, theta):
        at = [0.0, P[1] * np.cos(psi), P[1] * np.sin(psi)]
        return race(inner, at, theta=theta, azimuth=0.3)[1][STORED]

    wrench = race(inner, P, theta=0.2, azimuth=0.3)[0]
    h = 1e-6
    along = -(energy(h, 0.2) - energy(-h, 0.2)) / (2 * h)
    torque = -(energy(0.0, 0.2 + h) - energy(0.0, 0.2 - h)) / (2 * h)
    assert abs(along) > 1e-3  # there is something to see
    assert P[1] * wrench[2] == pytest.approx(along, rel=1e-4)
    assert -P[1] * wrench[2] == pytest.approx(torque, rel=1e-4)  # the ring's reaction
    assert wrench[3] == pytest.approx(0.0, abs=1e-9)  # and nothing turns the roller
    bump = race(inner, P, theta=0.3, azimuth=0.3)[1][NORMAL]  # a crest under the roller
    flat = race(inner._replace(wave=np.zeros(3)), P)[1][NORMAL]
    deeper = race(inner._replace(wave=np.zeros(3)), P - [0, 1e-6, 0])[1][NORMAL]
    assert bump == pytest.approx(deeper, rel=1e-9) and bump > flat


@pytest.fixture(scope="module")
def spalled(build_parts):
    """spalled(**spall) -> inner side with a spall, outer side with the same."""

    def make(**spall):
        pit = Spall(length=1.2e-3, azimuth=0.3, **spall)
        pair = PairSpec(normal=NormalLaw(law="elastic"), friction=FrictionLaw(law="traction"))
        model = build_parts(
            bearing={"inner_spall": pit, "outer_spall": pit}, contacts=Contacts(race=pair)
        )
        return model.inner, model.outer

    return make


@pytest.mark.parametrize("which", [0, 1])
def test_roller_axis_follows_a_circle_about_the_edge_of_a_spall(spalled, which):
    """Where the roller is free, found from two circles (race and roller) and the edge's corner; of
    an edge that is felt at a line."""
    side = spalled(depth=300e-6)[which]
    side = side._replace(spall=np.array([*side.spall[:4], 1e-9]))
    R, sign, half = side.radius, side.sign, 0.6e-3 / side.radius
    edge = R * np.array([np.cos(half), np.sin(half)])
    flat = side._replace(drop=np.zeros_like(side.drop))
    for off in (0.1e-3 / R, 0.3e-3 / R, 0.55e-3 / R):
        # the axis at azimuth ``off`` from the spall's middle, at Rw from its edge
        along = edge @ [np.cos(off), np.sin(off)]
        touching = along + sign * np.sqrt(along**2 - R**2 + 4e-3**2)
        lift = [0.0, sign * 0.3e-6, 0.0]
        for shift, expected in ((lift, False), (np.negative(lift), True)):
            at = np.array([0.0, touching, 0.0]) + shift
            pressed = race(flat, at, azimuth=0.3 + off)[1][NORMAL] > 0.0
            assert pressed == expected, (off, shift)
    pit = spalled(depth=5e-6)[which]._replace(drop=np.zeros_like(side.drop))
    inside = race(pit, [0.0, R + sign * 4e-3 - sign * 6e-6, 0.0], azimuth=0.3)[1][NORMAL]
    outside = race(pit, [0.0, R + sign * 4e-3 - sign * 1e-6, 0.0], azimuth=0.5)[1][NORMAL]
    assert inside == pytest.approx(outside, rel=1e-9)  # the bottom bears like the race


@pytest.mark.parametrize("off", [-0.35e-3, 0.2e-3])
def test_force_is_the_slope_of_the_energy_on_the_way_into_a_spall(spalled, off):
    inner, _ = spalled(depth=300e-6)
    off /= inner.radius
    P = np.array([0.0, inner.radius + 4e-3 - 60e-6, 0.0])

    def energy(psi, theta):
        at = [0.0, P[1] * np.cos(psi), P[1] * np.sin(psi)]
        return race(inner, at, theta=theta, azimuth=0.3 + off)[1][STORED]

    wrench, h = race(inner, P, azimuth=0.3 + off)[0], 1e-6
    along = -(energy(h, 0.0) - energy(-h, 0.0)) / (2 * h)
    torque = -(energy(0.0, h) - energy(0.0, -h)) / (2 * h)
    assert np.sign(along) == -np.sign(off) and abs(along) > 1e-2  # it rolls in
    assert P[1] * wrench[2] == pytest.approx(along, rel=1e-4)
    assert -P[1] * wrench[2] == pytest.approx(torque, rel=1e-4)


def test_narrow_spall_takes_its_share_of_the_slices(spalled):
    side = spalled(width=2e-3, offset=1.0e-3)[0]
    width = side.s[1] - side.s[0]
    assert side.spalled.sum() * width == pytest.approx(2e-3, rel=1e-12)
    assert (side.spalled @ side.s) / side.spalled.sum() == pytest.approx(1e-3, abs=0.1 * width)


MOTION = {
    "V": np.array([0.02, -0.03, 11.0]),
    "w": np.array([-2900.0, 3.0, -5.0]),
    "Vr": np.array([0.01, 0.02, -0.01]),
    "wr": np.array([628.0, -1.0, 2.0]),
}


@pytest.mark.parametrize("name", STATES)
@pytest.mark.parametrize("which", [0, 1])
def test_power_of_the_wrench_is_what_the_channels_say(sides, name, which):
    """Power of the forces on both bodies = - dU/dt + damping + friction + rolling resistance."""
    side = sides(law="restitution")[which]
    P, axis, b = state(side, name)
    V, w, Vr, wr = MOTION.values()
    Vr = Vr if name != "square" else np.zeros(3)
    call = {"law": laws.restitution, "friction": laws.traction}
    wrench, sums, _ = race(side, P, axis=axis, b=b, V=V, w=w, Vr=Vr, wr=wr, **call)
    power = wrench[:3] @ (V - Vr - np.cross(wr, P)) + wrench[3:] @ (w - wr)

    def energy(t):
        return race(
            side,
            P + t * (V - Vr),
            axis=turned(axis, t * w),
            b=turned(b[None], t * wr)[0],
            **call,
        )[1][STORED]

    h = 1e-10
    stored = (energy(h) - energy(-h)) / (2 * h)
    assert (
        np.all(sums[DAMPED : ROLLED + 1] <= 0.0) and sums[RUBBED] < -1e-3 and sums[DAMPED] < -1e-6
    )
    channels = sums[DAMPED] + sums[RUBBED] + sums[ROLLED]
    assert power == pytest.approx(
        channels - stored, abs=3e-4 * (np.abs(sums[DAMPED : ROLLED + 1]).sum() + abs(stored))
    )


def test_rolling_resistance_is_one_force_on_each_surface(sides):
    """Shear F slows both surfaces; the pressure that goes with it acts through both centres."""
    for which, lever in ((0, -4e-3), (1, 4e-3)):
        side = sides()[which]
        P = state(side, "square")[0]
        # pure rolling: cage at orbit, the ring's surface and the roller's run together
        orbit = 283.7
        ring = 628.3 if which == 0 else 0.0
        spin = orbit + (ring - orbit) * side.radius / lever
        move = {"V": [0, 0, orbit * P[1]], "w": [spin, 0, 0], "wr": [ring, 0, 0]}
        with_it, sums, _ = race(side, P, **move)
        without = race(side._replace(rolling=np.zeros(2)), P, **move)[0]
        extra = with_it - without
        entrainment = abs(ring - orbit) * side.radius
        (force,) = rolling(side.rolling, entrainment, sums[NORMAL])
        assert force > 0.1
        sense = np.sign(ring - orbit)  # of the surfaces' motion through the contact
        assert extra[3] == pytest.approx(-lever * force * sense, rel=1e-6)
        on_ring = -(extra[3] + P[1] * extra[2])
        assert on_ring == pytest.approx(-side.radius * force * sense, rel=1e-3)
        assert sums[ROLLED] == pytest.approx(-2 * force * entrainment, rel=1e-3)


@pytest.mark.parametrize("name", STATES)
def test_tangents_against_differences(sides, name):
    """K and C of a pair; left out: what turning the forces does, and rolling resistance."""
    inner, _ = sides(law="restitution")
    inner = inner._replace(rolling=np.zeros(2))
    P, axis, b = state(inner, name)
    V, w = np.array([0.02, -0.03, 11.3]), np.array([-2900.0, 3.0, -5.0])
    wr = np.array([628.0, 0.0, 0.0])
    call = {"law": laws.restitution, "friction": laws.traction, "wr": wr, "b": b}
    pair = race(inner, P, axis=axis, V=V, w=w, mode=1, **call)[2]

    def column(j, h, moved):
        e = h * np.eye(3)[j % 3]
        if moved:

            def at(s):
                return race(inner, P + (s * e if j < 3 else 0), V=V, w=w,
                            axis=axis if j < 3 else turned(axis, s * e), **call)[0]  # fmt: skip
        else:

            def at(s):
                return race(inner, P, V=V + (s * e if j < 3 else 0), axis=axis,
                            w=w + (s * e if j >= 3 else 0), **call)[0]  # fmt: skip

        return -(at(1) - at(-1)) / (2 * h)

    K = np.stack([column(j, 1e-9 if j < 3 else 1e-7, True) for j in range(6)], axis=1)
    C = np.stack([column(j, 1e-5 if j < 3 else 1e-3, False) for j in range(6)], axis=1)
    scale = np.array([1, 1, 1, 4e-3, 4e-3, 4e-3])
    K, C = K / np.outer(scale, scale), C / np.outer(scale, scale)
    gotK, gotC = pair.K / np.outer(scale, scale), pair.C / np.outer(scale, scale)
    assert np.abs(K - gotK).max() < 1e-2 * np.abs(K).max()
    assert np.abs(C - gotC).max() < 1e-4 * np.abs(C).max()


def test_traction_drives_the_roller_and_brakes_the_ring(sides):
    inner, _ = sides()
    inner = inner._replace(rolling=np.zeros(2))
    P = state(inner, "square")[0]
    slow = {"V": [0, 0, 280.0 * P[1]], "w": [-2500.0, 0, 0], "wr": [628.3, 0, 0]}
    wrench, sums, _ = race(inner, P, friction=laws.traction, **slow)
    slide = 628.3 * inner.radius - 280.0 * P[1] - 2500.0 * 4e-3
    assert sums[SLIDING] == pytest.approx(-slide, rel=2e-3)  # the roller lags behind the race
    mu = laws.friction_parameters(FrictionLaw(law="traction"))
    a, b, c, d = mu[:4]
    expected = ((a + b * slide) * np.exp(-c * slide) + d) * sums[NORMAL]
    assert wrench[2] == pytest.approx(expected, rel=1e-3) and sums[TRACTION] == pytest.approx(
        wrench[2]
    )
    assert wrench[3] == pytest.approx(-4e-3 * wrench[2], rel=1e-3)


def test_a_tilted_roller_carries_more_on_one_side(sides):
    inner, _ = sides(profile="straight")
    P, _, b = state(inner, "square")
    for sense in (1, -1):  # about e_psi: the +x end comes down for a negative turn
        wrench = race(inner, P, axis=turned(np.eye(3), [0, 0, sense * 5e-4]))[0]
        assert np.sign(wrench[5]) == -sense  # the race turns it back
    # a tilt of dz over the length with the closed form of the slice law
    s, k, n = inner.s, inner.normal[0], inner.normal[1]
    depth = 3e-6 - s * 5e-4
    load = np.sum(k * np.clip(depth, 0, None) ** n)
    got = race(inner, P, axis=turned(np.eye(3), [0, 0, 5e-4]))[1]
    assert got[NORMAL] == pytest.approx(load, rel=3e-4)
    moment = np.sum(k * np.clip(depth, 0, None) ** n * s)
    assert got[MOMENT_PSI] == pytest.approx(moment, rel=2e-3)


def test_not_touching_is_nothing(sides):
    inner, outer = sides()
    assert not race(inner, [0, inner.radius + 4e-3 + 1e-9, 0])[0].any()
    assert not race(outer, [0, outer.radius - 4e-3 - 1e-9, 0])[0].any()


def test_profile_comes_from_the_bearing(sides, n1013):
    inner, bearing = sides(slices=30)[0], n1013[0]
    drop = bearing.profile.drop(inner.s, diameter=8e-3, length=bearing.effective_length)
    np.testing.assert_allclose(inner.drop, drop, rtol=1e-12)
    longer = replace(bearing, effective_length=30e-3)
    assert longer.profile.drop(np.array([4.9e-3]), diameter=8e-3, length=30e-3)[0] == 0.0
