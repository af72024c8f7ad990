"""Ribs and lands: where they touch, energy, power, third law about one point."""

from __future__ import annotations

import numpy as np
import pytest
from contact_kernels import land, rib, turned
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation

from flexcage.contacts import laws
from flexcage.contacts.evaluation import DAMPED, NORMAL, RUBBED, SHEARED, STORED
from flexcage.contacts.land import land_work
from flexcage.contacts.spec import Contacts, FrictionLaw, LandSpec, NormalLaw, PairSpec
from flexcage.modes.basis import CageInterface

PITCH, PLAY = 41.25e-3, 15e-6
PRESSES = NormalLaw(law="restitution", restitution=0.6)
RUBS = FrictionLaw(static=0.1, dynamic=0.06)


@pytest.fixture(scope="module", params=["N", "NU"])
def ribs(request, build_parts):
    """Two ribs of the inner ring, or of the outer one."""
    outer = request.param == "NU"
    bearing = {"design": "NU", "rib_diameter": 86.6e-3} if outer else {}
    contacts = Contacts(rib=PairSpec(normal=PRESSES, friction=RUBS))
    model = build_parts(bearing=bearing, contacts=contacts)
    return model.outer_rib if outer else model.rib


def test_ribs_bear_on_a_rollers_end_where_they_overlap(build_parts):
    """Halfway from the rib's edge to where the end's chamfer begins, below the axis or above it."""
    other = {"design": "NJ", "rib_diameter": 86.6e-3, "counter_rib_diameter": 78.4e-3}
    model = build_parts(bearing={**other, "counter_rib_gap": 8.03e-3})
    for data, edge, sense in ((model.rib, 78.4e-3, -1.0), (model.outer_rib, 86.6e-3, 1.0)):
        low, high = sorted((0.5 * edge - PITCH, sense * 0.9 * 4e-3))
        assert data.points[:, 0] == pytest.approx(0.5 * (low + high))
        assert data.points[2, 1] == -data.points[0, 1] > 1e-3
    assert (model.rib.first, model.rib.end, model.rib.column) == (1, 2, 2)  # one rib, at -x
    assert (model.outer_rib.first, model.outer_rib.end, model.outer_rib.column) == (0, 2, 0)


def test_a_single_rib_is_met_on_its_side_alone(build_parts):
    """An NJ's inner ring pushes its rollers one way and lets them go the other."""
    one = {"design": "NJ", "rib_diameter": 86.6e-3, "counter_rib_diameter": 78.4e-3}
    for thrust, face, sense in (("+x", 1, -1.0), ("-x", 0, 1.0)):
        bearing = {**one, "counter_rib_gap": 8.03e-3, "thrust": thrust}
        data = build_parts(bearing=bearing).rib
        wrench, sums, _ = rib(data, [sense * (PLAY + 1e-6), PITCH, 0])
        assert sums[NORMAL + face] > 1.0 and sums[NORMAL + 1 - face] == 0.0
        assert wrench[0] == pytest.approx(-sense * sums[NORMAL + face])
        assert not rib(data, [-sense * (PLAY + 50e-6), PITCH, 0])[0].any()


def test_ribs_touch_after_half_of_the_play(ribs):
    data = ribs
    for sense, face in ((1, 0), (-1, 1)):
        assert not rib(data, [sense * (PLAY - 1e-9), PITCH, 0])[0].any()
        wrench, sums, _ = rib(data, [sense * (PLAY + 1e-6), PITCH, 0])
        assert sums[NORMAL + face] > 1.0 and wrench[0] == pytest.approx(
            -sense * sums[NORMAL + face]
        )
        assert sums[NORMAL + 1 - face] == 0.0


def test_a_skewed_roller_is_turned_back(ribs):
    data = ribs
    for sense in (1, -1):  # about e_r: the ends' edges meet opposite ribs
        skew = turned(np.eye(3), [0, sense * 1.3e-2, 0])
        wrench, sums, _ = rib(data, [0.0, PITCH, 0.0], axis=skew)
        assert sums[NORMAL] > 1.0 and sums[NORMAL] == pytest.approx(sums[NORMAL + 1], rel=1e-6)
        assert np.sign(wrench[4]) == -sense


@pytest.mark.parametrize(
    ("shift", "turn", "ring"),
    [(3e-6, [0, 0, 0], [0, 0, 0]), (5e-6, [0, 2e-3, 0], [0, 0, 0]),
     (-9e-6, [0, 6e-3, 2e-3], [0, 1e-3, -1.5e-3])],
)  # fmt: skip
def test_rib_energy_and_power(ribs, shift, turn, ring):
    data = ribs
    ring = ring if data.points[0, 0] < 0.0 else [0, 0, 0]  # an outer ring does not tilt
    axis, b = turned(np.eye(3), turn), turned(np.eye(3), ring)[0]
    P = np.array([np.copysign(PLAY, shift) + shift, PITCH, 2e-5])
    still = rib(data, P, axis=axis, b=b)
    scale = np.abs(still[0]).max()
    assert still[1][NORMAL : NORMAL + 2].sum() > 1.0
    for j in range(6):
        h = 1e-10 if j < 3 else 1e-8
        e = h * np.eye(3)[j % 3]
        if j >= 3:
            e = e - (e @ axis[0]) * axis[0]  # spin is no displacement
        elif j == 2:
            continue  # the frame turns with the orbit: in the power, below
        at = [
            rib(data, P + (s * e if j < 3 else 0), b=b,
                axis=axis if j < 3 else turned(axis, s * e))[1][STORED]
            for s in (1, -1)
        ]  # fmt: skip
        lever = 1.0 if j < 3 else 4e-3
        assert -(at[0] - at[1]) / (2 * h) == pytest.approx(still[0][j], abs=1e-4 * scale * lever)
    V, w = np.array([np.copysign(0.02, shift), -0.03, 11.0]), np.array([-2900.0, 3.0, -5.0])
    Vr, wr = np.array([0.001, 0.002, -0.01]), np.array([628.0, -0.5, 0.2])
    call = {"law": laws.restitution, "friction": laws.step_coulomb}
    wrench, sums, _ = rib(data, P, axis=axis, b=b, V=V, w=w, Vr=Vr, wr=wr, **call)
    power = wrench[:3] @ (V - Vr - np.cross(wr, P)) + wrench[3:] @ (w - wr)
    # the kernel's points orbit with the roller, they do not spin; its b does not spin either
    orbit = (V - Vr - np.cross(wr, P))[2] / P[1] + wr @ axis[0]
    frame, tip = w + (orbit - w @ axis[0]) * axis[0], wr - (wr @ b) * b

    def energy(t):
        return rib(data, P + t * (V - Vr), axis=turned(axis, t * frame),
                   b=turned(b[None], t * tip)[0], **call)[1][STORED]  # fmt: skip

    h = 1e-10
    stored = (energy(h) - energy(-h)) / (2 * h)
    scale = abs(stored) + abs(sums[DAMPED]) + abs(sums[RUBBED])
    assert sums[DAMPED] <= 0.0 and sums[RUBBED] < -0.1
    assert power == pytest.approx(sums[DAMPED] + sums[RUBBED] - stored, abs=2e-4 * scale)


Y = np.array([0.0, 1.0, 0.0])


def land_modes(stations=24, n=3):
    """Smooth synthetic shapes round the land: breathing, oval, bent; the last two turn as well."""
    a = 2 * np.pi * np.arange(stations) / stations
    radial = np.stack([np.ones(stations), np.cos(2 * a), np.sin(a)], axis=1)
    modes = np.zeros((2, stations, 3, n))
    modes[:, :, 1, :] = radial
    modes[:, :, 2, 1:] = np.stack([-0.5 * np.sin(2 * a), np.cos(a)], axis=1)
    return modes


def flexible_land(build_parts, guidance, spec):
    itf = CageInterface(
        stations=np.stack([np.linspace(-4e-3, 4e-3, 3)] * 4), offset=np.zeros((22, 4, 3)),
        modes=np.zeros((22, 4, 3, 3, 3)), residual=np.zeros((22, 4, 3, 12)),
        compliance=np.zeros((22, 12, 12)), patch_half_width=1.9e-3, land=land_modes(),
    )  # fmt: skip
    cage, contacts = {"guidance": guidance}, Contacts(land=spec)
    return build_parts(interface=itf, cage=cage, contacts=contacts).land


@pytest.fixture(scope="module", params=["inner", "outer"])
def dry_land(request, build_parts):
    spec = LandSpec(kind="dry", normal=PRESSES, friction=RUBS)
    return flexible_land(build_parts, request.param, spec)


def side(data):
    """1 for a land in the cage's bore, -1 for one on its outside."""
    return 1.0 if data.inner else -1.0


def resultant_and_turn(data, st, A):
    """Force in space and moment about the cage's axis [N, N m] of forces st at its stations, and
    what they do to its modes."""
    a = 2 * np.pi * np.arange(len(st)) / len(st)
    zero = np.zeros_like(a)
    e = np.stack([zero, np.cos(a), np.sin(a)], axis=1)
    along = np.stack([zero, -np.sin(a), np.cos(a)], axis=1)
    force = A @ (st[:, :1] * e + st[:, 1:] * along).sum(axis=0)
    modal = np.einsum("sc,scm->m", st, data.phi[:, 1:])
    return force, data.radius * st[:, 1].sum(), modal


def pressed(data, depth=4e-6):
    """Cage centre pushed by the land's clearance and a bit, towards station 2."""
    a = 2 * np.pi * 2 / 24
    return (data.clearance + depth) * np.array([0.0, np.cos(a), np.sin(a)])


def test_land_touches_after_its_clearance(dry_land):
    data = dry_land
    quiet = np.zeros(3)
    assert not land(data, pressed(data, -1e-8), q=quiet, qd=quiet)[0].any()
    Fc = land(data, pressed(data), q=quiet, qd=quiet)[0]
    towards = pressed(data) / np.linalg.norm(pressed(data))
    assert Fc @ towards < -10.0 and np.abs(Fc + (-Fc @ towards) * towards).max() < 1e-3 * abs(
        Fc @ towards
    )
    oval = np.array([0.0, -side(data) * (data.clearance + 2e-6), 0.0])  # touches at 0 and 180 deg
    work = land(data, np.zeros(3), q=oval, qd=quiet)
    assert work[2][1] * oval[1] < 0.0 and np.abs(work[0]).max() < 1e-6 * abs(work[2][1])


def test_a_cage_that_rolls_on_its_land_does_not_feel_the_stations_pass(dry_land):
    """Between two of the 24 stations it touches as deep as at one, to 2e-4 of the clearance (the
    polygon of the stations themselves leaves 9e-3)."""
    data = dry_land
    quiet, size = np.zeros(3), data.clearance + 4e-6
    forces = [
        -land(data, size * Y, A=Rotation.from_rotvec([a, 0, 0]).as_matrix(), q=quiet, qd=quiet)[0]
        @ Y
        for a in np.linspace(0.0, 2.0 * np.pi / 24, 25)
    ]
    depth = 4e-6 * np.ptp(forces) / max(forces)
    assert min(forces) > 100.0 and depth < 2e-4 * data.clearance


def test_land_energy_power_and_third_law(dry_land):
    data = dry_land
    A = Rotation.from_rotvec([0.02, 2e-4, -3e-4]).as_matrix()
    Rr, Rc = np.array([2e-5, 1e-5, -2e-5]), pressed(data, 8e-6) + [3e-5, 1e-5, -2e-5]
    q, qd = np.array([1e-6, -2e-6, 1e-6]), np.array([2e-3, 5e-3, -4e-3])
    Vc, Vr = np.array([0.01, 0.04, 0.02]), np.array([0.0, 0.01, -0.01])
    w, turn = np.array([283.0, 0.4, -0.3]), np.array([628.0, 0.7, 0.9])
    call = {"law": laws.restitution, "friction": laws.step_coulomb}
    Fc, Mc, Qm, Fr, Mr, sums = land(
        data, Rc, A=A, Vc=Vc, w=w, q=q, qd=qd, Rr=Rr, Vr=Vr, spin=turn[0], tilting=turn[1:], **call
    )
    assert np.abs(Fc).max() > 10.0
    np.testing.assert_allclose(Fc + Fr, 0.0, atol=1e-12 * np.abs(Fc).max())
    moment = Mc + np.cross(Rc, Fc) + Mr + np.cross(Rr, Fr)
    np.testing.assert_allclose(moment, 0.0, atol=1e-9 * np.abs(Mc).max())

    # a turn about the axis of a ring of discrete stations is left out: only the rate, in power
    def energy(R=Rc, rotation=(0, 0, 0), modes=q, ring=Rr):
        turn = Rotation.from_rotvec(rotation).as_matrix()
        return land(data, R, A=turn @ A, q=modes, qd=0 * qd, Rr=ring)[5][STORED]

    still = land(data, Rc, A=A, q=q, qd=0 * qd, Rr=Rr)
    for j in range(1, 3):
        e = 1e-10 * np.eye(3)[j]
        assert -(energy(Rc + e) - energy(Rc - e)) / 2e-10 == pytest.approx(still[0][j], rel=1e-4)
    for j in range(3):
        e = 1e-8 * np.eye(3)[j]
        slope = -(energy(rotation=e) - energy(rotation=-e)) / 2e-8
        assert slope == pytest.approx(still[1][j], abs=1e-4 * np.abs(still[1]).max())
        e = 1e-10 * np.eye(3)[j]
        assert -(energy(modes=q + e) - energy(modes=q - e)) / 2e-10 == pytest.approx(
            still[2][j], abs=1e-4 * np.abs(still[2]).max()
        )
    power = Fc @ Vc + Mc @ w + Qm @ qd + Fr @ Vr + Mr @ turn
    tilting = turn * (0.0, 1.0, 1.0)

    def after(h):  # a ring that tilts sees the cage tilt the other way
        ring = Rr + h * Vr
        seen = ring + Rotation.from_rotvec(-h * tilting).apply(Rc + h * Vc - ring)
        return energy(seen, h * (w - tilting), q + h * qd, ring)

    stored = (after(1e-9) - after(-1e-9)) / 2e-9
    assert sums[DAMPED] <= 0.0 and sums[RUBBED] < -1.0
    scale = abs(stored) + abs(sums[DAMPED]) + abs(sums[RUBBED])
    assert power == pytest.approx(sums[DAMPED] + sums[RUBBED] - stored, abs=1e-4 * scale)


def parting(share):
    """Centre's offset and modes, over the clearance: bent to cos(2a), a land parts from its touch
    at a = 0 when it bends by a quarter of its offset, and stays pressed between both touches."""
    bend = 0.2 + 0.22 * share
    return [1.016 + bend, 0.02], [0.0, -bend, 0.0]


def growing(share):
    """A land that grows until it is pressed all round, twice as much at two sides."""
    return [0.01 * share, 0.003], [0.97 + 0.06 * share, 0.01, 0.0]


@pytest.mark.parametrize(("path", "everywhere"), [(parting, False), (growing, True)])
def test_a_dry_land_is_elastic_while_touches_part_and_merge(dry_land, path, everywhere):
    """Work on the way is the energy."""
    data, lean = dry_land, -1.0 if dry_land.inner else 1.0
    places, forces, energy, touched = [], [], [], []
    for share in np.linspace(0.0, 1.0, 2001):
        offset, q = (lean * data.clearance * np.array(x) for x in path(share))
        work = land_work(24)
        Fc, _, Qm, _, _, sums = land(data, np.array([0.0, *offset]), q=q, qd=0 * q, work=work)
        places.append([*offset, *q])
        forces.append([*Fc[1:], *Qm])
        energy.append(sums[STORED])
        touched.append((np.abs(work.st).max(axis=1) > 0.0).sum())
    mean = 0.5 * (np.array(forces[1:]) + np.array(forces[:-1]))
    done = -np.cumsum((mean * np.diff(places, axis=0)).sum(axis=1))
    assert touched[0] <= 4 < touched[-1] and energy[-1] > 1e-3
    assert (work.d.min() > 0.0) == everywhere
    np.testing.assert_allclose(np.array(energy[1:]) - energy[0], done, atol=1e-3 * np.ptp(energy))


def wavy(data):
    """The land with seven shapes of up to four waves, each at both phases."""
    a = 2 * np.pi * np.arange(24) / 24
    waves = [np.ones(24)] + [f(k * a) for k in (2, 3, 4) for f in (np.cos, np.sin)]
    phi = np.zeros((24, 3, 7))
    phi[:, 1] = np.transpose(waves)
    return data._replace(phi=phi, phi_max=np.ones(7))


def energy_of_profile(data, offset, q):
    """Elastic energy of both lands from their radius at 4,800 places between the stations: that of
    maxima less that of minima, but for the lowest if it is pressed."""
    fine = 2 * np.pi * np.arange(4800) / 4800
    closed = np.append(np.arange(24), 24)
    slope = 0.5 * (np.roll(data.phi[:, 1] @ q, -1) - np.roll(data.phi[:, 1] @ q, 1))
    ends = [np.append(x, x[0]) for x in (data.phi[:, 1] @ q, slope)]
    u = CubicHermiteSpline(closed, *ends)(fine * 24 / (2 * np.pi))
    y, z = (
        offset[1] + (data.radius + u) * np.cos(fine),
        offset[2] + (data.radius + u) * np.sin(fine),
    )
    d = side(data) * (data.radius - side(data) * data.clearance - np.hypot(y, z))
    before, after = np.roll(d, 1), np.roll(d, -1)
    most, least = d[(d > before) & (d >= after)], d[(d < before) & (d <= after)]
    stiffness, exponent = data.normal[:2]
    parts = [
        stiffness * np.maximum(x, 0.0) ** (exponent + 1) / (exponent + 1)
        for x in (most, least, np.array([d.min()]))
    ]
    return 2.0 * (parts[0].sum() - parts[1].sum() + parts[2].sum())


def test_a_wavy_dry_land_stores_what_its_profile_does_and_never_drives(dry_land):
    """Pressed at any number of places, or all round: neither damping nor friction does work on the
    bearing, and no land pulls."""
    data, rng, pressed = wavy(dry_land), np.random.default_rng(1), []
    call = {"law": laws.restitution, "friction": laws.step_coulomb, "spin": 628.0}
    for _ in range(600):
        q = rng.normal(size=7) * np.array([0.3, 0.3, 0.3, 0.1, 0.1, 0.05, 0.05]) * data.clearance
        offset = np.append(0.0, rng.normal(size=2)) * 0.9 * data.clearance
        qd, Vc = 0.02 * rng.normal(size=7), np.append(0.0, 0.02 * rng.normal(size=2))
        sums = land(data, offset, q=q, qd=qd, Vc=Vc, w=np.array([283.0, 0, 0]), **call)[5]
        assert (
            sums[DAMPED] <= 0.0
            and sums[RUBBED] <= 0.0
            and min(sums[NORMAL], sums[NORMAL + 1]) >= 0.0
        )
        assert sums[STORED] == pytest.approx(energy_of_profile(data, offset, q), rel=1e-3, abs=1e-7)
        pressed.append(sums[STORED] > 0.0)
    assert sum(pressed) > 300


def test_a_dry_land_pressed_evenly_all_round_counts_once(dry_land):
    data = wavy(dry_land)
    even = np.append(-side(data) * (data.clearance + 10e-6), np.zeros(6))
    once = land(data, np.zeros(3), q=even, qd=0 * even)[5]
    aside = land(data, 1e-9 * Y, q=even, qd=0 * even)[5]
    assert once[STORED] == pytest.approx(aside[STORED], rel=1e-3) and once[NORMAL] > 1e3


def test_forces_at_stations_of_a_dry_land_are_its_forces(dry_land):
    """On the four stations about the touch: the resultant to the bend of an arc of 15 degrees."""
    data, work = dry_land, land_work(24)
    A = Rotation.from_rotvec([0.02, 0.0, 0.0]).as_matrix()
    Rc, q = pressed(data, 8e-6), np.array([1e-6, -2e-6, 1e-6])
    Fc, Mc, Qm, *_ = land(data, Rc, A=A, q=q, qd=0 * q, w=np.array([283.0, 0, 0]), spin=628.0,
                          friction=laws.step_coulomb, work=work)  # fmt: skip
    force, turn, modal = resultant_and_turn(data, work.st, A)
    np.testing.assert_allclose(force, Fc, atol=0.02 * np.abs(Fc).max())
    assert turn == pytest.approx(Mc[0], rel=0.02) and abs(Mc[0]) > 0.01
    np.testing.assert_allclose(modal, Qm, atol=0.02 * np.abs(Qm).max())
    assert (np.abs(work.st).max(axis=1) > 0.0).sum() == 4


def test_dry_land_friction_drags_towards_the_ring(dry_land):
    data = dry_land
    still = np.zeros(3)
    for spin in (600.0, 0.0):
        out = land(data, pressed(data), q=still, qd=still, w=np.array([283.0, 0, 0]), spin=spin,
                   friction=laws.step_coulomb)  # fmt: skip
        assert np.sign(out[1][0]) == np.sign(spin - 283.0)


@pytest.mark.parametrize("guidance", ["inner", "outer"])
def test_film_third_law_and_power(build_parts, guidance):
    model = build_parts(cage={"guidance": guidance}, contacts=Contacts(land=LandSpec(kind="film")))
    data = model.land
    A = Rotation.from_rotvec([0.3, 2e-3, -3e-3]).as_matrix()
    Rr, Rc = np.array([0.0, 1e-5, -2e-5]), np.array([1e-4, 9e-5, 4e-5])
    Vc, Vr = np.array([0.0, 0.03, 0.05]), np.array([0.0, 0.01, -0.01])
    w, turn = np.array([283.0, 2.0, -3.0]), np.zeros(3)
    if guidance == "inner":
        turn[:] = 628.0, 5.0, -7.0
    Fc, Mc, _, Fr, Mr, sums = land(
        data, Rc, A=A, Vc=Vc, w=w, Rr=Rr, Vr=Vr, spin=turn[0], tilting=turn[1:]
    )
    assert np.abs(Fc).max() > 1e-4
    np.testing.assert_allclose(Fc + Fr, 0.0, atol=1e-12 * np.abs(Fc).max())
    moment = Mc + np.cross(Rc, Fc) + Mr + np.cross(Rr, Fr)
    np.testing.assert_allclose(moment, 0.0, atol=1e-9 * np.abs(Mc).max())
    power = Fc @ Vc + Mc @ w + Fr @ Vr + Mr @ turn
    assert power == pytest.approx(sums[SHEARED], rel=1e-4)
    assert np.sign(Mc[0]) == np.sign(turn[0] - 283.0)


@pytest.mark.parametrize("guidance", ["inner", "outer"])
def test_a_film_pushes_half_of_a_flexible_land(build_parts, guidance):
    """Its stations bear the resultant and the torque, and what these do to the modes is work."""
    data, work = flexible_land(build_parts, guidance, LandSpec(kind="film")), land_work(24)
    A = Rotation.from_rotvec([0.3, 0.0, 0.0]).as_matrix()
    Rc, Vc, qd = (
        np.array([0.0, 9e-5, 4e-5]),
        np.array([0.0, 0.03, 0.05]),
        np.array([2e-3, 5e-3, 1e-3]),
    )
    w, spin = np.array([283.0, 0.0, 0.0]), 628.0 if guidance == "inner" else 0.0
    call = {"A": A, "Vc": Vc, "w": w, "q": 0 * qd, "spin": spin}
    Fc, Mc, Qm, Fr, Mr, sums = land(data, Rc, qd=qd, work=work, **call)
    force, turn, modal = resultant_and_turn(data, work.st, A)
    np.testing.assert_allclose(force, Fc, atol=1e-3 * np.abs(Fc).max())
    assert turn == pytest.approx(Mc[0], rel=1e-9) and abs(turn) > 1e-6
    np.testing.assert_allclose(modal, Qm, rtol=1e-12)
    pushed = side(data) * work.st[:, 0]
    assert (pushed >= 0.0).all() and 11 <= (pushed > 0.0).sum() <= 13
    still = land(data, Rc, qd=0 * qd, **call)[5]
    assert sums[SHEARED] == pytest.approx(still[SHEARED] + Qm @ qd, rel=1e-12)
