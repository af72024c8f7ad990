"""Energy over runs, momentum and third law at instants, symmetry under turning and mirroring."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from bearing_runs import BETWEEN_RIBS, NU, NUP, SOFT, march, rolling_start
from scipy.spatial.transform import Rotation
from test_newton_matrix import disturbed

from flexcage.contacts import laws
from flexcage.contacts.spec import (
    Contacts,
    FrictionLaw,
    LandSpec,
    Lubricant,
    NormalLaw,
    PairSpec,
)
from flexcage.system.data import POWERS
from flexcage.system.spec import Drive, Load, Mount

LOADED = Load(radial=1000.0)
RUNS = {
    "rigid": {},
    "bushing and shaft": {
        "mount": Mount(kind="bushing", mass=0.5), "drive": Drive(kind="shaft")
    },
    "land film": {"contacts": Contacts(land=LandSpec(kind="film")), "cage": {"guidance": "inner"}},
    "other laws": {
        "contacts": Contacts(
            race=PairSpec(friction=FrictionLaw(law="step_coulomb")),
            pocket=PairSpec(
                normal=NormalLaw(law="impact_step", damping=500.0, full_damping_depth=1e-5),
                friction=FrictionLaw(law="ramp_coulomb", v_static=0.01, v_dynamic=0.1),
            ),
        )
    },
    "wavy races": {"bearing": {"inner_waviness": 0.5e-6, "inner_waviness_order": 13,
                               "outer_waviness": 0.5e-6, "outer_waviness_order": 17}},
    "compliant shaft": {"load": SOFT},
    "NU": {"bearing": NU},
    "NUP under axial load": {"bearing": NUP, "load": BETWEEN_RIBS},
    "flexible": {"flexible": {"modes": 8, "soft": True}},
}  # fmt: skip


@pytest.mark.parametrize("name", RUNS)
def test_energy_balance_of_a_run(bearing_of, name):
    """What is stored changes by what powers brought: within 0.1 % of the drive's work."""
    bearing = bearing_of(**{"load": LOADED, **RUNS[name]})
    h = march(bearing, *rolling_start(bearing), duration=3e-3)
    assert h.outcome == 0
    stored = h.samples.energy.sum(axis=1)
    missing = (stored - stored[0]) - (h.work - h.work[0]).sum(axis=1)
    drive = np.abs(h.power("drive")[-1])
    assert drive > 0.1 and h.samples.pocket_normal.max() > 1.0
    assert np.abs(missing).max() < 1e-3 * drive
    for loss in POWERS[POWERS.index("race_damping") :]:
        assert np.all(np.diff(h.power(loss)) <= 1e-12), loss


def forces_on_bodies(bearing, y, yd):
    """Forces and moments about the origin, in space, that contacts put on each body (n, 2, 3).

    From the residual's momentum rows with accelerations zero; the known inertia terms are taken
    out with formulas of their own; those of the outer ring, of which some rows are held, from its
    rows of the border. Bodies: rollers, inner ring, outer ring, cage if there is one.
    """
    layout, still = bearing.layout, yd.copy()
    for part in layout.u(still).values():
        part[...] = 0.0
    r = layout.u(bearing.residual(0.0, y, still))
    q, u = layout.q(y), layout.u(y)
    mass = bearing.data.model.bodies.element[0]
    out = []
    for i in range(layout.elements):
        x, radius, psi = q["elements"][i, :3]
        v = u["elements"][i]
        assert v[4] == v[5] == 0.0  # nothing gyroscopic
        c, s = np.cos(psi), np.sin(psi)
        F = np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
        force = -r["elements"][i, :3] + mass * np.array([0, -(v[2] ** 2), v[1] * v[2]]) / radius
        skew, tilt = q["elements"][i, 3:5]
        axis = Rotation.from_euler("YZ", [skew, tilt]).as_matrix().T  # rows: the roller's axes
        at = np.array([x, radius, 0.0])
        moment = axis.T @ -r["elements"][i, 3:] + np.cross(at, force)
        out.append((F.T @ force, F.T @ moment))
    ring = -r["inner"]
    load = bearing.data.model.bodies
    force = ring[:3] - load.load[1, 0] * np.append(0.0, load.load_direction)
    out.append((force, ring[3:] + np.cross(q["inner"][:3], force)))
    outer = layout.border(bearing.data.work.scratch.border)["outer"]
    out.append((outer[:3], outer[3:] + np.cross(q["outer"][:3], outer[:3])))
    if "cage" in q:
        A = Rotation.from_quat(q["quaternion"], scalar_first=True).as_matrix()
        force = -r["cage"]
        out.append((force, A @ -r["omega"] + np.cross(q["cage"], force)))
    return np.array(out)


def crowded(bearing, **state):
    """A state with every kind of contact and friction, but nothing gyroscopic."""
    y, yd, rng = disturbed(bearing, **state)
    u = bearing.layout.u(y)
    u["elements"][:, 4:] = 0.0
    u["omega"][1:] = 0.0
    q = bearing.layout.q(y)
    q["quaternion"][:] = Rotation.from_rotvec([1e-4, 2e-4, -1e-4]).as_quat(scalar_first=True)
    q["cage"][:] = [2e-6, 4e-6, -3e-6]
    return y, yd


QUIET = {
    "load": Load(radial=1000.0, gravity=0.0), "lubricant": Lubricant(oil_fraction=0.0),
    "mount": Mount(kind="bushing", mass=0.5),
}  # fmt: skip


@pytest.mark.parametrize("design", [{}, NU, NUP])
def test_contact_forces_sum_to_nothing(bearing_of, design):
    """Third law over all bodies: every contact force is found once more, reversed."""
    bearing = bearing_of(bearing=design, **QUIET)
    forces = forces_on_bodies(bearing, *crowded(bearing, press=104e-6, skew=3e-4, axial=20e-6))
    size = np.abs(forces[:, 0]).sum(axis=0).max()
    assert size > 1000.0 and np.abs(forces[-1, 0]).max() > 1.0
    np.testing.assert_allclose(forces[:, 0].sum(axis=0), 0.0, atol=1e-12 * size)


def test_contact_moments_sum_to_nothing(bearing_of):
    """The same of moments about the origin."""
    bearing = bearing_of(**QUIET)
    y, yd = crowded(bearing, press=104e-6, skew=3e-4, axial=20e-6)
    report = bearing.data.work.report
    bearing.residual(0.0, y, yd, mode=2)
    assert (report.race[:, :, 0].max(axis=0) > 10.0).all()
    assert report.rib.max() > 1.0 and report.pocket_normal.max() > 1.0
    forces, moments = np.moveaxis(forces_on_bodies(bearing, y, yd), 1, 0)
    np.testing.assert_allclose(forces.sum(axis=0), 0.0, atol=1e-11 * np.abs(forces).sum())
    size = np.abs(moments).sum(axis=0).max()
    np.testing.assert_allclose(moments.sum(axis=0), 0.0, atol=1e-6 * size)


def test_angular_momentum_of_a_run(bearing_of):
    """About the bearing's axis: what rollers and cage gain is the torque of drive, drag and race.

    The outer race's torque is that of its traction and rolling resistance, from the report.
    """
    bearing = bearing_of(load=LOADED, lubricant=Lubricant(rolling_resistance="none"))
    h = march(bearing, *rolling_start(bearing), duration=2e-3, rate=400e3)
    layout, model = bearing.layout, bearing.data.model
    q, u = layout.q(h.y), layout.u(h.y)
    mass, axial, _ = model.bodies.element
    radius, orbital, turn = q["elements"][:, :, 1], u["elements"][:, :, 2], u["elements"][:, :, 3]
    rollers = radius * orbital * mass + axial * turn
    d = model.cage
    spin = (np.trace(d.G0) - d.G0[0, 0]) * u["omega"][:, 0]
    orbit = d.mass * (q["cage"][:, 1] * u["cage"][:, 2] - q["cage"][:, 2] * u["cage"][:, 1])
    ring = model.inner_ring.inertia[0] * (
        q["inner"][:, 1] * u["inner"][:, 2] - q["inner"][:, 2] * u["inner"][:, 1]
    )
    momentum = rollers.sum(axis=1) + spin + orbit + ring
    drive = layout.multipliers(h.y)[:, 3]
    outer = (h.samples.race[:, :, 1, 1] * model.outer.radius).sum(axis=1)
    drag = -(model.bodies.drag[0] * orbital**2 * radius).sum(axis=1)
    drag -= model.bodies.drag[1] * u["omega"][:, 0] ** 2
    load = -h.y[:, 0] * 0.0 - 1000.0 * q["inner"][:, 2]
    torque = drive + outer + drag + load
    # weight of off-centre bodies: about 1e-8 N m, left out
    impulse = np.concatenate([[0.0], np.cumsum(0.5 * (torque[1:] + torque[:-1]) * np.diff(h.time))])
    gained = momentum - momentum[0]
    assert np.ptp(gained) > 1e-5
    np.testing.assert_allclose(gained, impulse, atol=0.02 * np.abs(impulse).max())


def turned_state(bearing, y, yd, angle):
    """The same motion with everything turned about the axis by ``angle``."""
    layout = bearing.layout
    c, s = np.cos(angle), np.sin(angle)
    R = np.array([[1, 0, 0], [0, c, s], [0, -s, c]]).T
    y2, yd2 = y.copy(), yd.copy()
    turn = Rotation.from_matrix(R)
    for z in (y2, yd2):
        q, u = layout.q(z), layout.u(z)
        for part in (q["inner"], u["inner"]):
            part[:3] = R @ part[:3]
        for part in (q["cage"], u["cage"]):
            part[:] = R @ part
        for part in (q["outer"], u["outer"]):
            part[:3] = R @ part[:3]
    layout.q(y2)["elements"][:, 2] += angle
    for z in (y2, yd2):
        p = layout.q(z)["quaternion"]
        n = np.linalg.norm(p)
        if n > 0.0:
            p[:] = (turn * Rotation.from_quat(p, scalar_first=True)).as_quat(scalar_first=True) * n
    return y2, yd2


@pytest.mark.parametrize("flexible", [None, {"modes": 6, "soft": True}])
def test_turning_everything_turns_the_forces(bearing_of, flexible):
    angle = 0.83
    load = Load(radial=1000.0, direction=0.2, gravity_direction=-0.5)
    bearing = bearing_of(load=load, flexible=flexible)
    turned = bearing_of(
        load=replace(load, direction=0.2 + angle, gravity_direction=-0.5 + angle), flexible=flexible
    )
    y, yd = crowded(bearing, press=103e-6, skew=3e-4, axial=18e-6)
    yd[: bearing.layout.n_q] = 0.0  # kinematic rows have no say here
    for mine, other in zip(turned.data.memory, bearing.data.memory):
        mine[...] = other  # onset speeds
    here = bearing.layout.u(bearing.residual(0.0, y, yd))
    y2, yd2 = turned_state(bearing, y, yd, angle)
    there = bearing.layout.u(turned.residual(0.0, y2, yd2))
    R = Rotation.from_rotvec([angle, 0, 0]).as_matrix()
    size = np.abs(here["elements"][:, :3]).max()
    np.testing.assert_allclose(there["elements"], here["elements"], atol=1e-6 * size)
    for name in ("inner", "cage"):
        np.testing.assert_allclose(there[name][:3], R @ here[name][:3], atol=1e-6 * size)
    np.testing.assert_allclose(there["omega"], here["omega"], atol=1e-6 * size)
    np.testing.assert_allclose(there["modes"], here["modes"], atol=1e-6 * size)


def test_reversed_rotation_is_the_mirror_image(bearing_of):
    """Mirror in the x-y plane: roller i becomes roller -i, z and the sense of rotation turn."""
    forward = bearing_of(load=LOADED)
    backward = bearing_of(load=LOADED, drive=Drive(speed=-Drive().speed))
    a, b = (march(m, *rolling_start(m), duration=1.5e-3) for m in (forward, backward))
    layout, swap = forward.layout, (-np.arange(22)) % 22
    qa, qb, ua, ub = layout.q(a.y), layout.q(b.y), layout.u(a.y), layout.u(b.y)
    assert a.samples.pocket_normal.max() > 1.0
    np.testing.assert_allclose(qb["inner"][:, 1:3], qa["inner"][:, 1:3] * [1, -1], atol=2e-8)
    np.testing.assert_allclose(qb["cage"][:, 1:], qa["cage"][:, 1:] * [1, -1], atol=1e-6)
    np.testing.assert_allclose(ub["omega"][:, 0], -ua["omega"][:, 0], rtol=1e-3)
    spin = ua["elements"][:, :, 3]
    np.testing.assert_allclose(ub["elements"][:, swap, 3], -spin, atol=2e-3 * np.abs(spin).max())
    na, nb = a.samples.race[:, :, 0, 0], b.samples.race[:, swap, 0, 0]
    assert np.abs(na - nb).max() < 0.01 * na.max()
    pa, pb = (h.samples.pocket_normal.max(axis=0) for h in (a, b))
    assert pb[swap][:, [1, 0]].sum() == pytest.approx(pa[:, :2].sum(), rel=0.05)


@laws.kernel(laws.NORMAL_SIGNATURE)
def softer(n, d, v, onset, p, F, Fe, Fd, Fv):
    """A user's law: half of the elastic force."""
    for k in range(n):
        F[k] = Fe[k] = Fd[k] = Fv[k] = 0.0
        if d[k] > 0.0:
            F[k] = Fe[k] = 0.5 * p[0] * d[k] ** p[1]
            Fd[k] = p[1] * F[k] / d[k]


def test_a_law_of_ones_own_in_a_bearing(bearing_of, monkeypatch):
    """One line of registration, and the compiled bearing takes it."""
    monkeypatch.setitem(laws.NORMAL_LAWS, "softer", softer)
    forces = []
    for name in ("elastic", "softer"):
        pair = PairSpec(normal=NormalLaw(law=name))
        bearing = bearing_of(contacts=Contacts(race=pair), load=LOADED)
        y, yd = rolling_start(bearing)
        bearing.layout.q(y)["inner"][1] = 15e-6
        bearing.residual(0.0, y, yd, mode=2)
        forces.append(bearing.data.work.report.race[:, 0, 0].copy())
    assert forces[0].max() > 10.0
    np.testing.assert_allclose(forces[1], 0.5 * forces[0], rtol=1e-12)


def test_contacts_remember_how_fast_they_closed(bearing_of):
    """And laws keep their own numbers while they do."""
    normal = NormalLaw(law="impact_step", damping=500.0, full_damping_depth=1e-5)
    bearing = bearing_of(contacts=Contacts(pocket=PairSpec(normal=normal)), load=LOADED)
    before = bearing.data.model.pocket.normal.copy()
    assert not bearing.data.memory.pocket.any()
    march(bearing, *rolling_start(bearing), duration=1e-3)
    assert np.array_equal(before, bearing.data.model.pocket.normal)
    assert bearing.data.memory.pocket.max() > 0.0
