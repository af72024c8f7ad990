"""Contact kernels compiled once with laws as first-class functions, and poses to call them with."""

from __future__ import annotations

from functools import cache

import numba
import numpy as np
from numba import types
from scipy.spatial.transform import Rotation

from flexcage.contacts import laws
from flexcage.contacts.evaluation import N_SUMS
from flexcage.contacts.land import LandCage, LandForces, LandRing, land_contact, land_work
from flexcage.contacts.pocket import pocket_contact
from flexcage.contacts.pocket_wall import (
    N_LOCAL,
    CageAtRoller,
    PocketLaws,
    RollerInPocket,
    pocket_work,
)
from flexcage.contacts.race import race_forces, race_penetrations, race_work, race_wrench
from flexcage.contacts.rib import rib_contact
from flexcage.contacts.slices import Laws, new_slices
from flexcage.contacts.state import CageModes, RollerPose, new_pair, new_pose
from flexcage.core.jit import OPTIONS

F8, I8 = types.float64, types.int64
VEC = types.Array(F8, 1, "C")
MATRIX = types.Array(F8, 2, "C")
N, MU = laws.NORMAL_TYPE, laws.FRICTION_TYPE
LAWS = types.Tuple((N, MU))
ZERO = np.zeros(3)
X = np.array([1.0, 0.0, 0.0])


def pose_of(axis, V, w, azimuth=0.0) -> RollerPose:
    """Pose with the given axes (rows), velocity and angular velocity, all in F."""
    pose = new_pose()
    c, s = np.cos(azimuth), np.sin(azimuth)
    pose.F[:] = [[1, 0, 0], [0, c, s], [0, -s, c]]
    pose.axis[:], pose.V[:], pose.w[:] = axis, V, w
    return pose


def turned(axis, rotation):
    """Rows of ``axis`` turned by a rotation vector."""
    return axis @ Rotation.from_rotvec(rotation).as_matrix().T


def _race(pose, side, Rw, theta, onset, law, mu, rw, pair, mode, sums):
    if not race_penetrations(1, pose, side, Rw, theta, onset, rw):
        return False
    race_forces(2, side, Laws(law, mu), rw)
    race_wrench(1, pose, side, Rw, theta, rw, pair, mode, sums)
    return True


def _rib(pose, ring, data, onset, law, sl, pair, mode, sums):
    laws = Laws(law[0], law[1])
    return rib_contact(pose, ring, data, 0.0, onset, laws, sl.row[0], pair, mode, sums)


def _pocket(i, roller, cage, data, law, sl, pw, pair, mode, sums):
    laws = PocketLaws(law[0], law[1], law[2], law[3])
    return pocket_contact(i, roller, cage, data, laws, sl.row[0], pw, pair, mode, sums)


def _land(cage, ring, data, onset, law, sl, lw, out, sums):
    land_contact(cage, ring, data, onset, Laws(law[0], law[1]), sl.row[0], lw, out, sums)


def _compiled(function, *arguments, returns=types.boolean):
    kinds = [a if isinstance(a, types.Type) else numba.typeof(a) for a in arguments]
    return numba.njit(returns(*kinds), **OPTIONS)(function)


@cache
def _race_kernel(side_type):
    return _compiled(
        _race, new_pose(), side_type, F8, F8, F8, N, MU, race_work(8), new_pair(), I8, VEC,
    )  # fmt: skip


@cache
def _rib_kernel(data_type):
    return _compiled(
        _rib, new_pose(), MATRIX, data_type, VEC, LAWS, new_slices(), new_pair(), I8, VEC,
    )  # fmt: skip


@cache
def _pocket_kernel(data_type):
    return _compiled(
        _pocket, I8, RollerInPocket(new_pose(), 1.0, ZERO, ZERO, ZERO),
        CageAtRoller(ZERO, ZERO, CageModes(ZERO, ZERO, 0.0)), data_type,
        types.Tuple((N, N, MU, MU)), new_slices(), pocket_work(1, 1, 2, 0),
        new_pair(), I8, VEC,
    )  # fmt: skip


@cache
def _land_kernel(data_type):
    cage = LandCage(np.eye(3), ZERO, ZERO, ZERO, ZERO, ZERO)
    return _compiled(
        _land, cage, LandRing(ZERO, ZERO, ZERO), data_type, VEC, LAWS, new_slices(), land_work(1),
        LandForces(ZERO, ZERO, ZERO, ZERO, ZERO), VEC, returns=types.void,
    )  # fmt: skip


def race(
    side, P, *, radius=4e-3, axis=None, b=X, V=ZERO, w=ZERO, Vr=ZERO, wr=ZERO, theta=0.0,
    law=laws.elastic, friction=laws.no_friction, mode=2, azimuth=0.0,
    onset=0.3, spot=None,
):  # fmt: skip
    """(wrench, sums, pair) of one raceway on a roller at P from the ring's centre; ``spot``: angle
    of the roller's own, if it has one."""
    pose = pose_of(np.eye(3) if axis is None else axis, V, w, azimuth)
    if spot is not None:
        pose.spot[:2] = 1.0, spot
    pair, sums = new_pair(), np.zeros(N_SUMS)
    rw = race_work(len(side.s))  # contact 0 of the lot is one that does not touch
    rw.partner[1] = P, b, Vr, wr
    _race_kernel(numba.typeof(side))(
        pose, side, radius, theta, onset, law, friction, rw, pair, mode, sums
    )
    return pair.wrench, sums, pair


def rib(
    data, P, *, axis=None, b=X, V=ZERO, w=ZERO, Vr=ZERO, wr=ZERO, law=laws.elastic,
    friction=laws.no_friction, mode=2, onset=0.05,
):  # fmt: skip
    """(wrench, sums, pair) of both ribs on a roller at P from the ring's centre."""
    pose = pose_of(np.eye(3) if axis is None else axis, V, w)
    pair, sums = new_pair(), np.zeros(N_SUMS)
    ring = np.array([P, b, Vr, wr], float)
    _rib_kernel(numba.typeof(data))(
        pose, ring, data, np.full(2, onset), (law, friction), new_slices(), pair, mode, sums
    )
    return pair.wrench, sums, pair


def pocket(
    data, D, *, i=0, radius=4e-3, axis=None, G=None, V=ZERO, w=ZERO, Vc=ZERO, wc=ZERO, q=(),
    qd=(), normal=laws.elastic, friction=laws.no_friction, mode=2, onset=0.0,
):  # fmt: skip
    """(wrench, sums, work, pair) of pocket i on its roller at D from the cage's origin."""
    pose = pose_of(np.eye(3) if axis is None else axis, V, w)
    work = pocket_work(len(data.s), len(data.points), data.phi.shape[2], data.phi.shape[4])
    work.G[:] = np.eye(3) if G is None else G
    pair, sums = new_pair(), np.zeros(N_SUMS)
    D, Vc, wc, q, qd = (np.array(x, float) for x in (D, Vc, wc, q, qd))
    margin = float(data.phi_max @ np.abs(q)) if len(q) else 0.0
    roller = RollerInPocket(pose, radius, D, np.full(4, onset), np.zeros(N_LOCAL))
    cage = CageAtRoller(Vc, wc, CageModes(q, qd, margin))
    by = (normal, normal, friction, friction)
    _pocket_kernel(numba.typeof(data))(
        i, roller, cage, data, by, new_slices(), work, pair, mode, sums
    )
    return pair.wrench, sums, work, pair


def land(
    data, Rc, *, A=None, Vc=ZERO, w=ZERO, q=(), qd=(), Rr=ZERO, Vr=ZERO, spin=0.0,
    tilting=(0.0, 0.0), law=laws.elastic, friction=laws.no_friction, onset=0.05, work=None,
):  # fmt: skip
    """(Fc, Mc, Qm, Fr, Mr, sums) between cage and a ring that has no tilt, but the rates
    ``tilting`` of one; forces at stations in ``work.st``."""
    A = np.eye(3) if A is None else np.ascontiguousarray(A)
    out = LandForces(np.zeros(3), np.zeros(3), np.zeros(len(q)), np.zeros(3), np.zeros(3))
    sums = np.zeros(N_SUMS)
    Rc, Vc, w, q, qd, Rr, Vr = (np.array(x, float) for x in (Rc, Vc, w, q, qd, Rr, Vr))
    _land_kernel(numba.typeof(data))(
        LandCage(A, Rc, Vc, w, q, qd), LandRing(Rr, Vr, np.array([spin, *tilting])), data,
        np.full(2, onset), (law, friction), new_slices(), work or land_work(len(data.angle)), out,
        sums,
    )  # fmt: skip
    return [*out, sums]
