"""Contacts of balls, compiled once with laws as first-class functions, and a groove and pockets to
call them with."""

from __future__ import annotations

from functools import cache

import numba
import numpy as np
from numba import types

from flexcage.bearings.ball.model import POINT, strips
from flexcage.case.presets import load_preset
from flexcage.contacts import laws
from flexcage.contacts.ball_pocket import (
    CYLINDER,
    BallInPocket,
    BallPockets,
    ball_pocket_work,
    pocket_wall_contact,
)
from flexcage.contacts.ball_pocket_tangent import pocket_wall_tangent
from flexcage.contacts.evaluation import N_SUMS
from flexcage.contacts.groove import BallOnRace, Groove, groove_contact
from flexcage.contacts.groove_tangent import groove_tangent
from flexcage.contacts.slices import Laws, new_slices
from flexcage.contacts.spec import FrictionLaw, Lubricant, NormalLaw
from flexcage.contacts.state import CageModes, new_pair
from flexcage.core.jit import OPTIONS

F8, I8 = types.float64, types.int64
VEC = types.Array(F8, 1, "C")
LAWS = types.Tuple((laws.NORMAL_TYPE, laws.FRICTION_TYPE))


def a_groove(*, inner=True, normal="restitution", friction="traction", rolling=True) -> Groove:
    """One raceway of the preset 7010C-PI."""
    bearing = load_preset("7010C-PI").bearing
    contact = bearing.contacts[0 if inner else 1]
    axial, centre = bearing.inner_groove_centre if inner else bearing.outer_groove_centre
    strip, share = strips(16)
    resistance = laws.point_rolling_resistance(Lubricant(), contact)
    return Groove(
        side=-1.0 if inner else 1.0,
        axial=axial,
        centre=centre,
        radius=bearing.inner_groove_radius if inner else bearing.outer_groove_radius,
        long=float(contact.semi_axes(1.0)[0]),
        bend=bearing.contact_curvatures[0 if inner else 1],
        strip=strip,
        share=share,
        normal=laws.normal_parameters(NormalLaw(law=normal), contact.stiffness, POINT),
        friction=laws.friction_parameters(FrictionLaw(law=friction)),
        rolling=resistance if rolling else 0.0 * resistance,
    )


def pockets(*, shape=CYLINDER, modes=5, soft=3e-8, rims=(2.0, 2.0, 2.0), slot=(0.0, 0.0)):
    """One pocket 11.2 mm wide whose wall moves by smooth shapes and yields by ``soft`` [m/N]."""
    angle = 2 * np.pi * np.arange(16) / 16
    phi = np.zeros((1, 1, 16, 3, modes))
    for m in range(modes):
        for c in range(3):
            phi[0, 0, :, c, m] = np.cos((m % 3) * angle + 2.0 * m + c)
    return BallPockets(
        azimuth=np.array([[1.0, 0.0]]), shift=np.array([[10e-6, -8e-6]]), slot=np.array([slot]),
        radius=np.array([5.6e-3]), height=32.5e-3, wall=np.array([30e-3, 35e-3]), shape=shape,
        rims=np.array([rims]), phi=phi, phi_max=np.ones(modes),
        local=soft * (1.0 + 0.3 * np.cos(2 * angle))[None],
        normal=laws.normal_parameters(NormalLaw(law="restitution"), 5e8, POINT)[None],
        friction=laws.friction_parameters(FrictionLaw(law="step_coulomb")),
    )  # fmt: skip


def _groove(ball, race, law, sl, pair, mode, sums):
    if mode == 0:
        pair.wrench[:] = 0.0
        return groove_contact(ball, race, Laws(*law), sl.row[0], pair.wrench, 0, sums)
    return groove_tangent(ball, race, Laws(*law), sl.row[0], pair, sums)


def _pocket(ball, modes, data, law, sl, pw, wrench, mode, sums):
    wrench[:] = 0.0
    by = Laws(*law)
    if mode == 0:
        return pocket_wall_contact(0, ball, modes, data, by, sl.row[0], pw, wrench, 0, sums)
    return pocket_wall_tangent(0, ball, modes, data, by, sl.row[0], pw, wrench, sums)


def _compiled(function, *arguments):
    kinds = [a if isinstance(a, types.Type) else numba.typeof(a) for a in arguments]
    return numba.njit(types.boolean(*kinds), **OPTIONS)(function)


def _ball_on_race(P, v, spin, b, Vr, wr):
    return BallOnRace(4e-3, *(tuple(float(x) for x in a) for a in (P, v, spin, b, Vr, wr)), 0.05)


@cache
def _groove_kernel():
    three = (0.0, 0.0, 0.0)
    return _compiled(
        _groove, BallOnRace(1.0, three, three, three, three, three, three, 0.0), a_groove(), LAWS,
        new_slices(), new_pair(), I8, VEC,
    )  # fmt: skip


@cache
def _pocket_kernel():
    three, none = (0.0, 0.0, 0.0), np.zeros(1)
    return _compiled(
        _pocket, BallInPocket(1.0, three, three, three, 0.0), CageModes(none, none, 0.0),
        pockets(), LAWS, new_slices(), ball_pocket_work(1, 1), VEC, I8, VEC,
    )  # fmt: skip


def on_race(
    race, P, v, spin, *, b=(1.0, 0.0, 0.0), Vr=(0.0, 0.0, 0.0), wr=(0.0, 0.0, 0.0), mode=0,
    law=(laws.restitution, laws.traction),
):  # fmt: skip
    """(does it touch, pair) of a raceway and a ball; ``mode`` 1: with its tangent."""
    radius = 0.5 * load_preset("7010C-PI").bearing.ball_diameter
    ball = _ball_on_race(P, v, spin, b, Vr, wr)._replace(radius=radius)
    pair = new_pair()
    hit = _groove_kernel()(ball, race, law, new_slices(), pair, mode, np.zeros(N_SUMS))
    return hit, pair


def in_pocket(
    data, D, v, spin, q, qd, *, G, radius=5.5e-3, mode=0, law=(laws.restitution, laws.step_coulomb)
):  # fmt: skip
    """(does it touch, wrench (6,) on the ball and forces (n,) on the modes, work); ``mode`` 1: with
    the tangent in ``work``."""
    n = data.phi.shape[-1]
    work, wrench = ball_pocket_work(data.phi.shape[2], n), np.zeros(6)
    work.G[:] = G
    vectors = (tuple(float(x) for x in a) for a in (D, v, spin))
    ball = BallInPocket(radius, *vectors, 0.05)
    q, qd = np.array(q, float), np.array(qd, float)
    modes = CageModes(q, qd, float(np.abs(q).sum()) * 2.0)
    sums = np.zeros(N_SUMS)
    hit = _pocket_kernel()(ball, modes, data, law, new_slices(), work, wrench, mode, sums)
    modal = np.einsum("sc,scm->m", work.st[0], data.phi[0, 0])
    return hit, np.concatenate([wrench, modal]), work
