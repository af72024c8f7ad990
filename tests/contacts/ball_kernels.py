"""Contacts of balls, compiled once with laws as first-class functions, and a groove and pockets to
call them with."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numba
import numpy as np
from numba import types

from flexcage.bearings.ball.model import POINT, groove_of
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
from flexcage.contacts.evaluation import N_SUMS, REPORT, TANGENT
from flexcage.contacts.groove import BallOnRace, Groove, groove_contact
from flexcage.contacts.groove_tangent import groove_tangent
from flexcage.contacts.slices import Laws, new_slices
from flexcage.contacts.spec import Contacts, FrictionLaw, Lubricant, NormalLaw, PairSpec
from flexcage.contacts.state import CageModes, new_pair
from flexcage.core.jit import OPTIONS

F8, I8 = types.float64, types.int64
VEC = types.Array(F8, 1, "C")
LAWS = types.Tuple((laws.NORMAL_TYPE, laws.FRICTION_TYPE))


def a_groove(
    *, inner=True, normal="restitution", friction="traction", rolling=True, **uneven
) -> Groove:
    """One raceway of the preset 7010C-PI; ``uneven``: its waves and its spall."""
    bearing = replace(load_preset("7010C-PI").bearing, **uneven)
    contacts = Contacts(race=PairSpec(
        normal=NormalLaw(law=normal), friction=FrictionLaw(law=friction), slices=16
    ))  # fmt: skip
    lubricant = Lubricant() if rolling else Lubricant(rolling_resistance="none")
    return groove_of(bearing, contacts, lubricant, inner=inner)


def pockets(
    *, shape=CYLINDER, modes=5, soft=3e-8, uneven=0.3, rims=(2.0, 2.0, 2.0), slot=(0.0, 0.0),
    moved=0.0,
):  # fmt: skip
    """One pocket 11.2 mm wide whose wall moves by smooth shapes and yields by ``soft`` [m/N], more
    or less by the share ``uneven``; ``rims`` outwards, inwards, to both sides; ``moved`` [m]: where
    it is without stress."""
    angle = 2 * np.pi * np.arange(16) / 16
    phi = np.zeros((1, 1, 16, 3, modes))
    for m in range(modes):
        for c in range(3):
            phi[0, 0, :, c, m] = np.cos((m % 3) * angle + 2.0 * m + c)
    offset = moved * np.stack([np.cos(angle + c) for c in range(3)], axis=-1)[None]
    return BallPockets(
        azimuth=np.array([[1.0, 0.0]]), shift=np.array([[10e-6, -8e-6]]), slot=np.array([slot]),
        radius=np.array([5.6e-3]), height=32.5e-3, wall=np.array([30e-3, 35e-3]), shape=shape,
        rims=np.array([rims[:2]]), sides=np.array([[rims[2], rims[2]]]), offset=offset,
        inset=float(np.linalg.norm(offset, axis=2).max()), phi=phi, phi_max=np.ones(modes),
        local=soft * (1.0 + uneven * np.cos(2 * angle))[None],
        normal=laws.normal_parameters(NormalLaw(law="restitution"), 5e8, POINT)[None],
        friction=laws.friction_parameters(FrictionLaw(law="step_coulomb")),
    )  # fmt: skip


def _groove(ball, race, law, sl, pair, mode, sums):
    if mode != TANGENT:
        pair.wrench[:] = 0.0
        return groove_contact(ball, race, Laws(*law), sl.row[0], pair.wrench, mode, sums)
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


def _ball_on_race(P, v, spin, b, Vr, wr, azimuth, spot):
    vectors = (tuple(float(x) for x in a) for a in (P, v, spin, b, Vr, wr))
    where = (1.0, 0.0, 0.0) if spot is None else tuple(float(x) for x in spot)
    return BallOnRace(4e-3, *vectors, 0.05, azimuth, 0 if spot is None else 1, where)


@cache
def _groove_kernel():
    three = (0.0, 0.0, 0.0)
    return _compiled(
        _groove, BallOnRace(1.0, three, three, three, three, three, three, 0.0, 0.0, 0, three),
        a_groove(),
        LAWS, new_slices(), new_pair(), I8, VEC,
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
    law=(laws.restitution, laws.traction), azimuth=0.0, spot=None,
):  # fmt: skip
    """(does it touch, pair) of a raceway and a ball; ``mode`` 1: with its tangent. ``azimuth`` of
    the frame's e_r from the ring's material; ``spot``: direction of the ball's, if it has one."""
    hit, pair, _ = reported_on_race(
        race, P, v, spin, b=b, Vr=Vr, wr=wr, mode=mode, law=law, azimuth=azimuth, spot=spot
    )
    return hit, pair


def reported_on_race(
    race, P, v, spin, *, b=(1.0, 0.0, 0.0), Vr=(0.0, 0.0, 0.0), wr=(0.0, 0.0, 0.0), mode=REPORT,
    law=(laws.restitution, laws.traction), azimuth=0.0, spot=None,
):  # fmt: skip
    """The same, and what the contact reports."""
    radius = 0.5 * load_preset("7010C-PI").bearing.ball_diameter
    ball = _ball_on_race(P, v, spin, b, Vr, wr, float(azimuth), spot)._replace(radius=radius)
    pair, sums = new_pair(), np.zeros(N_SUMS)
    hit = _groove_kernel()(ball, race, law, new_slices(), pair, mode, sums)
    return hit, pair, sums


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
