"""Roller in its pocket: geometry of contact, energy, power, the condensed wall, the modal wall."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from contact_kernels import pocket, turned
from scipy.optimize import brentq, minimize

from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.contacts import laws
from flexcage.contacts.evaluation import DAMPED, RUBBED, STORED
from flexcage.contacts.pocket_wall import N_FACE, N_LOCAL, most_of_curve, with_end_stations
from flexcage.contacts.spec import Contacts, FrictionLaw, NormalLaw, PairSpec
from flexcage.core.splines import smooth_weights
from flexcage.modes.basis import CageInterface

PITCH = 41.25e-3
HALF = (4.1e-3, 4.125e-3)  # half width and half length of a pocket
CONTACTS = Contacts(
    pocket=PairSpec(
        normal=NormalLaw(law="elastic"), friction=FrictionLaw(static=0.1, dynamic=0.06)
    ),
    side=PairSpec(normal=NormalLaw(law="elastic"), friction=FrictionLaw(static=0.1, dynamic=0.06)),
)


def interface(*, stations=9, modes=None, soft=False, offset=None):
    """A synthetic cage's interface; ``modes`` (22, 4, stations, 3, n); ``soft``: soft walls."""
    z = np.zeros
    at = np.stack([np.linspace(-4e-3, 4e-3, stations)] * 4)
    residual, compliance = z((22, 4, stations, 12)), z((22, 12, 12))
    if soft:
        for f in range(4):  # three patterns on each face, and a neighbour's echo
            residual[:, f, :, 2 * f] = 1.0
            residual[:, f, :, 2 * f + 1] = 1.5 * at[f] / 4e-3
            residual[:, f, :, 8 + f] = 1.5 * (at[f] / 4e-3) ** 2 - 0.5
            residual[:, f, :, (2 * f + 2) % 8] = 0.1
        root = np.random.default_rng(5).normal(size=(12, 12))
        spread = np.diag([4e-8, 2e-8] * 4 + [1e-8] * 4)  # m/N
        compliance[:] = spread + 2e-9 * root @ root.T / 12
    return CageInterface(
        stations=at, offset=z((22, 4, stations)) if offset is None else offset,
        modes=z((22, 4, stations, 3, 0)) if modes is None else modes, residual=residual,
        compliance=compliance, patch_half_width=1.9e-3,
        land=z((2, 24, 3, 0 if modes is None else modes.shape[-1])),
    )  # fmt: skip


@pytest.fixture(scope="module")
def walls(build_parts):
    """walls(interface) -> pocket data."""

    def make(itf, contacts=CONTACTS):
        return build_parts(interface=itf, contacts=contacts).pocket

    return make


def squeeze(front=8e-6, side=0.0):
    """Roller centre that presses the front face by ``front`` and the +x face by ``side`` [m]."""
    gap = HALF[1] - 4e-3
    return np.array([gap + side if side else 0.0, PITCH, HALF[0] - 4e-3 + front])


@pytest.mark.parametrize("displacement", [0.1e-3, 0.2e-3, -0.15e-3])
@pytest.mark.parametrize("turn", [[0, 0, 0], [0, 1e-3, 0], [0, -2e-3, 5e-4]])
def test_a_bent_crossbeam_touches_where_geometry_says(walls, displacement, turn):
    """Pocket k-1 meets the narrowed front face first where beam, profile and skew come closest."""
    defect = CrossbeamDefect(crossbeam=1, displacement=displacement)
    stations = 161
    itf = interface(stations=stations)
    offset = itf.offset.copy()
    offset[0, 0] = -displacement * defect.profile(itf.stations[0], 2 * HALF[1])
    offset[1, 1] = displacement * defect.profile(itf.stations[0], 2 * HALF[1])
    data = walls(interface(stations=stations, offset=offset))
    axis = turned(np.eye(3), turn)

    def first(i, sense):
        face = 0 if sense > 0 else 1

        def force(t):  # the opposite face may touch at the same time
            return pocket(data, [0.0, PITCH, sense * t], i=i, axis=axis)[2].normal[face] - 1e-9

        touch = brentq(force, -0.3e-3, 0.6e-3, xtol=1e-12)
        work = pocket(data, [0.0, PITCH, sense * (touch + 1e-9)], i=i, axis=axis)[2]
        return touch, np.flatnonzero(work.slice_N[face])

    x = data.s * axis[0, 0]
    for i, sense in ((0, 1.0), (1, -1.0)):
        wall = HALF[0] - sense * displacement * defect.profile(x, 2 * HALF[1])
        room = wall - (4e-3 - data.drop) - sense * data.s * axis[0, 2]
        touch, slices = first(i, sense)
        assert touch == pytest.approx(room.min(), abs=2e-8)
        assert np.argmin(room) in slices
    # the sound faces are untouched by the defect
    assert first(0, -1.0)[0] == pytest.approx(
        (HALF[0] - 4e-3 + data.drop + data.s * axis[0, 2]).min(), abs=1e-9
    )


def test_side_beams_touch_after_half_of_the_play(walls):
    data = walls(interface())
    gap = HALF[1] - 4e-3
    for sense, face in ((1, 2), (-1, 3)):
        assert not pocket(data, [sense * (gap - 1e-9), PITCH, 0])[0].any()
        wrench, _, work, _ = pocket(data, [sense * (gap + 1e-6), PITCH, 0])
        assert wrench[0] * sense < 0.0 and work.normal[face] == pytest.approx(-sense * wrench[0])
        k = 2 * 0.9 * 4e-3 / ((1 - 0.3**2) / 206e9 + (1 - 0.34**2) / 105e9)
        assert abs(wrench[0]) == pytest.approx(k * 1e-6, rel=1e-9)  # a flat punch, 2 E* a d


SINE = np.random.default_rng(8)


def smooth_modes(stations=9, n=5):
    """Synthetic shapes at the stations: smooth along each face, every component alive."""
    at = np.linspace(-1.0, 1.0, stations)
    c = SINE.normal(size=(22, 4, 3, n, 3))
    return np.ascontiguousarray(
        np.einsum("zfcnp,ps->zfscn", c, np.stack([np.ones(stations), at, at**2]))
    )


CAGES = {
    "rigid": {},
    "soft walls": {"soft": True},
    "modes": {"modes": smooth_modes()},
    "modes and soft walls": {"modes": smooth_modes(), "soft": True},
}


def modal_force(data, work, i=0):
    """Generalised forces on the modes from the station forces that the kernel scattered."""
    return np.einsum("fsc,fscm->m", work.st, data.phi[i])


@pytest.mark.parametrize("name", CAGES)
@pytest.mark.parametrize("place", ["front", "front, skewed", "corner"])
def test_forces_are_slopes_of_the_energy(walls, name, place):
    """Roller's wrench and modal forces against the elastic energy, the wall's own included."""
    data = walls(interface(**CAGES[name]))
    nm = data.phi.shape[-1]
    D = squeeze(side=2e-6 if place == "corner" else 0.0)
    axis = turned(np.eye(3), [0, 0, 0] if place == "front" else [0, 6e-4, 2e-4])
    q = 1e-6 * np.linspace(-1, 1, nm) if nm else np.zeros(0)
    wrench, _, work, _ = pocket(data, D, axis=axis, q=q, qd=0 * q)
    assert work.normal[0] > 5.0 and (work.normal[2] > 5.0) == (place == "corner")

    def energy(d=0.0, turn=None, dq=0.0):
        a = axis if turn is None else turned(axis, turn)
        return pocket(data, D + d, axis=a, q=q + dq, qd=0 * q)[1][STORED]

    scale = np.abs(wrench).max()
    for j in range(3):
        e = 5e-10 * np.eye(3)[j]
        assert -(energy(e) - energy(-e)) / 1e-9 == pytest.approx(wrench[j], abs=2e-4 * scale)
    for j in (1, 2):  # skew and tilt
        e = 1e-7 * np.eye(3)[j]
        slope = -(energy(turn=e) - energy(turn=-e)) / 2e-7
        assert slope == pytest.approx(wrench[3 + j], abs=2e-4 * scale * 4e-3)
    forces = modal_force(data, work)
    for m in range(nm):
        e = 1e-10 * np.eye(nm)[m]
        slope = -(energy(dq=e) - energy(dq=-e)) / 2e-10
        assert slope == pytest.approx(forces[m], abs=2e-4 * np.abs(forces).max())


def test_condensed_walls_against_minimisation(walls):
    """The kernel's residual coordinates make the total energy least; found again by a minimiser."""
    data = walls(interface(soft=True))
    D, axis = squeeze(12e-6, 3e-6), turned(np.eye(3), [0, 4e-4, 0])
    wrench, sums, work, _ = pocket(data, D, axis=axis)

    def total(b):  # coordinates of unit compliance
        e = 0.5 * b @ b
        for f in (0, 2):
            n = len(data.s) if f == 0 else len(data.points)
            face = work.face[f]
            shape = sum(face.w[s, :n, None] * data.res[0, f, face.j[:n] + s] for s in range(4))
            d = np.clip(face.d0[:n] - shape @ b, 0.0, None)
            k, n = data.normal[f // 2, :2]
            e += np.sum(k * d ** (n + 1) / (n + 1))
        return e

    best = minimize(total, np.zeros(12), method="BFGS", options={"gtol": 1e-12})
    assert sums[STORED] == pytest.approx(total(work.b), rel=1e-10)
    assert sums[STORED] <= best.fun * (1 + 1e-9)
    assert sums[STORED] == pytest.approx(best.fun, rel=1e-5)
    outward = work.st[[0, 2], :, [2, 0]]  # station forces on the two faces that are touched
    given = interface(soft=True)
    loads = np.einsum("fs,fsl->l", outward, given.residual[0][[0, 2]])
    np.testing.assert_allclose(data.root[0] @ work.b, given.compliance[0] @ loads, rtol=1e-8)
    # rigid walls give the same law undiminished
    stiff_data = walls(interface(), CONTACTS)
    assert np.abs(pocket(stiff_data, D, axis=axis)[0]).max() > np.abs(wrench).max()


def test_a_face_alone_yields_as_among_others(walls):
    """The coordinates of one face give what the pocket's twelve do: the same roller, once with
    another face that is touched by a hair."""
    data = walls(interface(soft=True))
    alone, _, one, _ = pocket(data, squeeze(8e-6, -1e-9))
    beside, _, two, _ = pocket(data, squeeze(8e-6, 1e-9))
    assert one.size[0] == N_FACE and two.size[0] == N_LOCAL
    np.testing.assert_allclose(alone, beside, atol=1e-3 * np.abs(alone).max())
    np.testing.assert_allclose(one.b, two.b, atol=1e-3 * np.abs(one.b).max())


def test_a_wall_pushes_the_opposite_one_to_the_roller(walls):
    """A push that moves the front wall out by a moves the rear one in by 5 a; the rear one, 2 um
    away, is looked at only then. a = c (F_front - 5 F_rear), solved apart."""
    itf, c, ratio = interface(), 1e-6, 5.0
    itf.residual[:, 0, :, 0], itf.residual[:, 1, :, 0] = 1.0, -ratio
    itf.compliance[:] = np.diag([c] + [0] * 11)
    data = walls(itf)
    play, press = 0.5e-6, 1e-6
    data = data._replace(drop=np.zeros_like(data.drop), half=np.array([4e-3 + play, HALF[1]]))
    k, n = data.normal[0, 0] * len(data.s), data.normal[0, 1]
    gap = 2.0 * play + press

    def miss(a):
        return a - c * k * (max(press - a, 0.0) ** n - ratio * max(ratio * a - gap, 0.0) ** n)

    a = brentq(miss, 0.0, press, xtol=1e-20)
    _, _, work, _ = pocket(data, [0.0, PITCH, play + press])
    assert ratio * a > gap
    np.testing.assert_allclose(
        work.normal[:2], k * np.array([press - a, ratio * a - gap]) ** n, rtol=1e-6
    )


@pytest.mark.parametrize("seesaw", [1.0, 400.0])
def test_slices_that_are_left_out_do_not_touch(walls, seesaw):
    """Slices are left out eight at a time; in another order, one of eight from all along the
    roller, hardly any are. ``seesaw``: the wall's linear compliance, enough to push the far end in.
    """
    rng = np.random.default_rng(3)
    itf = interface(soft=True, modes=smooth_modes())
    itf.compliance[:, 1::2] *= np.sqrt(seesaw)
    itf.compliance[:, :, 1::2] *= np.sqrt(seesaw)
    contacts = replace(CONTACTS, pocket=replace(CONTACTS.pocket, slices=64))
    data = walls(itf, contacts)
    order = np.arange(64).reshape(8, 8).T.ravel()
    mixed = data._replace(s=data.s[order].copy(), drop=data.drop[order].copy())
    fewer = 0
    for _ in range(40):
        D = squeeze(rng.uniform(-1e-6, 3e-6)) * [1.0, 1.0, rng.choice([-1.0, 1.0])]
        axis = turned(np.eye(3), [0.0, rng.normal(0.0, 1e-3), rng.normal(0.0, 1e-3)])
        q = rng.normal(0.0, 2e-7, 5)
        call = {"axis": axis, "q": q, "qd": np.zeros(5), "V": [0.0, 0.0, 0.1], "mode": 1}
        some, sums, work, pair = pocket(data, D, **call)
        all_, _, other, whole = pocket(mixed, D, **call)
        np.testing.assert_allclose(some, all_, rtol=1e-6, atol=1e-9 * np.abs(all_).max())
        np.testing.assert_allclose(work.st, other.st, rtol=1e-6, atol=1e-7)
        np.testing.assert_allclose(pair.K, whole.K, rtol=1e-5, atol=1e-6 * np.abs(whole.K).max())
        touched = work.normal[:2] > 0.0
        fewer += np.ptp(work.span[:2][touched].astype(int), axis=1).sum() < 64 * touched.sum()
    assert fewer > 5


@pytest.mark.parametrize("stations", [3, 7, 12])
def test_bound_of_a_wall_between_its_stations(stations):
    """No curve through random stations passes it, nor half a spacing beyond; one comes near."""
    rng = np.random.default_rng(stations)
    x = np.linspace(-0.5, stations - 0.5, 481)
    at = np.clip(x, 0.0, stations - 1.0)
    j = np.minimum(np.floor(at), stations - 2.0).astype(int)
    weights, slopes = (np.array(w) for w in smooth_weights.py_func(at - j))
    weights = weights + (x - at) * slopes
    closest = np.inf
    for _ in range(300):
        values = with_end_stations(rng.normal(size=(1, stations, 1)))[0, :, 0]
        curve = (weights * values[j + np.arange(4)[:, None]]).sum(axis=0)
        for sign in (1.0, -1.0):
            spare = most_of_curve.py_func(stations, sign, values) - (sign * curve).max()
            assert spare > -1e-12
            closest = min(closest, spare)
    assert closest < 0.02


def test_two_springs_in_series(walls):
    """A uniform wall compliance c under a straight push: F = K (d - c F)^n, solved apart."""
    itf = interface()
    itf.residual[:, 0, :, 0] = 1.0
    itf.compliance[:] = np.diag([3e-8] + [0] * 11)
    data = walls(itf)
    data = data._replace(drop=np.zeros_like(data.drop))
    wrench, _, work, _ = pocket(data, squeeze(10e-6))
    k, n = data.normal[0, 0] * len(data.s), data.normal[0, 1]
    force = brentq(lambda F: k * max(10e-6 - 3e-8 * F, 0.0) ** n - F, 0.0, 1e-5 / 3e-8)
    assert -wrench[2] == pytest.approx(force, rel=1e-9)
    assert (data.root[0] @ work.b)[0] == pytest.approx(3e-8 * force)


@pytest.mark.parametrize("name", CAGES)
@pytest.mark.parametrize("law", ["restitution", "impact_step"])
def test_power_is_what_the_channels_say(walls, name, law):
    """Power on roller, cage and modes = - dU/dt + damping + friction."""
    spec = NormalLaw(law=law, restitution=0.6, damping=3e3, full_damping_depth=1e-5)
    pair = PairSpec(normal=spec, friction=CONTACTS.pocket.friction)
    data = walls(interface(**CAGES[name]), Contacts(pocket=pair, side=pair))
    nm = data.phi.shape[-1]
    D, axis = squeeze(9e-6), np.eye(3)
    # no motion along the wall's slope (see above): the roller slides only up and down
    V, w = np.array([0.0, 0.04, 0.06]), np.array([-2900.0, 0.0, 0.0])
    Vc, wc = np.array([0.0, -0.01, -0.02]), np.array([0.3, 0.0, 0.0])
    qd = 1e-2 * np.linspace(1, -1, nm) if nm else np.zeros(0)
    call = {"normal": laws.NORMAL_LAWS[law], "friction": laws.step_coulomb, "onset": 0.1}
    wrench, sums, work, _ = pocket(
        data, D, axis=axis, V=V, w=w, Vc=Vc, wc=wc, q=0 * qd, qd=qd, **call
    )
    power = wrench[:3] @ (V - Vc - np.cross(wc, D)) + wrench[3:] @ (w - wc)
    power += modal_force(data, work) @ qd

    def energy(t):
        return pocket(
            data, D + t * (V - Vc), axis=axis, G=turned(np.eye(3), t * wc), q=t * qd, qd=qd,
            **call,
        )[1][STORED]  # fmt: skip

    h = 1e-8
    stored = (energy(h) - energy(-h)) / (2 * h)
    assert sums[DAMPED] < 0.0 and sums[RUBBED] < -1.0
    scale = abs(stored) + abs(sums[DAMPED]) + abs(sums[RUBBED])
    assert power == pytest.approx(sums[DAMPED] + sums[RUBBED] - stored, abs=1e-3 * scale)


@pytest.mark.parametrize("turn", [[0, 0, 0], [0, 3e-3, -2e-3]])
def test_a_spinning_end_wastes_friction_only(walls, turn):
    """A roller askew to its side beam: spin has no normal power, whatever the tilt."""
    pair = PairSpec(normal=NormalLaw(restitution=0.6), friction=CONTACTS.side.friction)
    data = walls(interface(), Contacts(pocket=pair, side=pair))
    axis = turned(np.eye(3), turn)
    D, w = np.array([HALF[1] - 4e-3 + 3e-6, PITCH, 0.0]), -2900.0 * axis[0]
    # nothing orbits; the moment about the spin axis is that of friction
    call = {"normal": laws.restitution, "friction": laws.step_coulomb, "onset": 0.05}
    wrench, sums, work, _ = pocket(data, D, axis=axis, w=w, **call)
    assert work.normal[2] > 1.0 and abs(sums[DAMPED]) < 1e-25 and sums[RUBBED] < -0.1
    assert wrench[3:] @ w == pytest.approx(sums[RUBBED], rel=2e-4)


@pytest.mark.parametrize("turn", [[0, 0, 0], [0, 3e-4, -8e-4]])
@pytest.mark.parametrize("sense, side", [(1.0, 0), (-1.0, 1)])
def test_points_of_an_end_bear_its_wrench(walls, turn, sense, side):
    """Each pushes along x where it stands and rubs against its own velocity; together they make
    the wrench on the roller, those of the other side beam nothing."""
    pair = PairSpec(normal=NormalLaw(restitution=0.6), friction=CONTACTS.side.friction)
    data = walls(interface(), Contacts(pocket=pair, side=pair))
    axis = turned(np.eye(3), turn)
    D, w = np.array([sense * (HALF[1] - 4e-3 + 3e-6), PITCH, 0.0]), -2900.0 * axis[0]
    law = {"normal": laws.restitution, "friction": laws.step_coulomb, "onset": 0.05}
    wrench, _, work, _ = pocket(data, D, axis=axis, w=w, **law)
    normal, rubbing = work.point_N[side], work.point_T[side]
    assert 2 < np.count_nonzero(normal) and not work.point_N[1 - side].any()
    lever = sense * 4e-3 * axis[0] + data.points @ axis[1:]
    velocity = np.cross(w, lever)
    velocity[:, 0] = 0.0  # along the wall
    along = velocity / np.linalg.norm(velocity, axis=1)[:, None]
    pressing = normal[:, None] * [-sense, 0.0, 0.0]
    force = pressing - rubbing[:, None] * along
    total, moment = force.sum(axis=0), np.cross(lever, force).sum(axis=0)
    twist = axis[0] @ np.cross(lever, pressing).sum(axis=0)  # an end that spins feels none of it
    total[2] += twist / PITCH  # ``state.add_end_generator``
    moment -= twist * axis[0]
    np.testing.assert_allclose(total, wrench[:3], atol=1e-12 * normal.sum())
    np.testing.assert_allclose(moment, wrench[3:], atol=1e-12 * normal.sum())


@pytest.mark.parametrize("name", CAGES)
def test_tangent_against_differences(walls, name):
    """Stiffness to roller and cage motion, condensed walls included, and damping from friction."""
    data = walls(interface(**CAGES[name]))
    nm = data.phi.shape[-1]
    q = np.zeros(nm)
    D, axis = squeeze(8e-6), turned(np.eye(3), [0, 3e-4, 0])
    V, w = np.array([0.0, 0.0, 0.0]), np.array([-2900.0, 0.0, 0.0])
    call = {"friction": laws.step_coulomb, "q": q, "qd": q}
    pair = pocket(data, D, axis=axis, V=V, w=w, mode=1, **call)[3]
    scale = np.array([1, 1, 1, 4e-3, 4e-3, 4e-3])

    def normed(M):
        return M / np.outer(scale, scale)

    K, C = np.empty((6, 6)), np.empty((6, 6))
    for j in range(6):
        e, h, hv = np.eye(3)[j % 3], 1e-9 if j < 3 else 1e-7, 1e-5 if j < 3 else 1e-2
        at = [
            pocket(data, D + (s * h * e if j < 3 else 0), V=V, w=w,
                   axis=axis if j < 3 else turned(axis, s * h * e), **call)[0]
            for s in (1, -1)
        ]  # fmt: skip
        K[:, j] = -(at[0] - at[1]) / (2 * h)
        at = [
            pocket(data, D, V=V + (s * hv * e if j < 3 else 0), axis=axis,
                   w=w + (s * hv * e if j >= 3 else 0), **call)[0]
            for s in (1, -1)
        ]  # fmt: skip
        C[:, j] = -(at[0] - at[1]) / (2 * hv)
    assert np.abs(normed(K - pair.K)).max() < 1e-2 * np.abs(normed(K)).max()
    assert np.abs(normed(C - pair.C)).max() < 1e-3 * np.abs(normed(C)).max()


@pytest.mark.parametrize("place", ["front", "corner", "front, in part without force"])
def test_tangent_of_the_modes_against_differences(walls, place):
    """Forces on roller and modes by modal motion: stiffness, damping by rates, and friction."""
    contacts = replace(
        CONTACTS,
        pocket=replace(CONTACTS.pocket, normal=NormalLaw(restitution=0.7)),
        side=replace(CONTACTS.side, normal=NormalLaw(restitution=0.7)),
    )
    data = walls(interface(modes=smooth_modes(), soft=True), contacts)
    D, axis = (
        squeeze(8e-6, side=4e-6 if place == "corner" else 0.0),
        turned(np.eye(3), [0, 3e-4, 0]),
    )
    q, qd = np.zeros(5), 2e-3 * np.linspace(-1.0, 1.0, 5)
    w = [-2900.0, 60.0 if "part" in place else 0.0, 0.0]  # away so fast that damping holds back all
    call = {"axis": axis, "w": w, "normal": laws.restitution,
            "friction": laws.step_coulomb}  # fmt: skip

    def forces(q, qd):
        wrench, _, work, _ = pocket(data, D, q=q, qd=qd, **call)
        return np.concatenate([wrench, modal_force(data, work)])

    def check(got, columns, tolerance):
        want, got = np.array(columns).T, got[:11, 6:11]
        for part in (slice(0, 3), slice(3, 6), slice(6, 11)):  # forces, moments, modal forces
            most = np.abs(want[part]).max()
            assert most > 0.0
            assert np.abs(got[part] - want[part]).max() < tolerance * most

    tangent = pocket(data, D, q=q, qd=qd, mode=1, **call)[2]
    pressed, elastic = (
        np.count_nonzero(pocket(data, D, q=q, qd=qd, **{**call, **law})[2].slice_N[0])
        for law in ({}, {"normal": laws.elastic})
    )
    assert pressed < elastic if "part" in place else pressed == elastic
    steps = 1e-10 * np.eye(5)
    check(tangent.K, [(forces(-e, qd) - forces(e, qd)) / 2e-10 for e in steps], 5e-3)
    steps = 1e-6 * np.eye(5)
    check(tangent.C, [(forces(q, qd - e) - forces(q, qd + e)) / 2e-6 for e in steps], 1e-6)
