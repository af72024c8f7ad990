"""Tapered roller in the pocket of a conical cage: each wall is a plane in a frame of its own.

The spheres of which a roller is the envelope (``cone``) meet a plane as slices of a cylinder do, so
that walls, their deflection and their forces are those of ``pocket_wall`` and ``pocket_forces``,
one face after another, each in axes that lie in it: ``PocketWork.G`` is turned before each.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any, NamedTuple

import numpy as np

from flexcage.contacts.condensation import condense, touches_more
from flexcage.contacts.evaluation import TANGENT
from flexcage.contacts.pocket import begin_pocket, end_pocket, face_forces, press_face
from flexcage.contacts.pocket_forces import relative_motion
from flexcage.contacts.pocket_tangent import clear_tangent
from flexcage.contacts.pocket_wall import FACES, SIDES, PocketWork, face_penetrations, pocket_work
from flexcage.core.jit import outlined, part, zero
from flexcage.core.vectors import column, combine, dot, put, row, times, turned, xyz


class FaceFrames(NamedTuple):
    """How the faces of a conical cage's pockets lie, in (x, r, psi) at a pocket's azimuth."""

    axes: np.ndarray  # (4, 3, 3) rows of each: along it, up the wall, across; side beams' as G has
    origin: float  # radius of the point in the plane of the row from which faces are measured
    whole: float  # radius of the roller's sphere at its centre of mass
    taper: float  # sine of the roller's half angle


def _with_axes(name: str) -> Any:
    """``PocketWork`` with P (3, 3), rows: pocket axes x, r, psi in F."""
    return namedtuple(name, (*PocketWork._fields, "P"), module=__name__)


ConePocketWork = _with_axes("ConePocketWork")


def cone_pocket_work(n_slices: int, n_points: int, n_stations: int, n_modes: int) -> Any:
    work = pocket_work(n_slices, n_points, n_stations, n_modes)
    return ConePocketWork(*work, np.zeros((3, 3)))


@part
def set_pocket_axes(azimuth, A, F, pw):
    """Axes x, r, psi of a pocket at an ``azimuth`` (cos, sin) of a cage of attitude A, in F."""
    ca, sa = azimuth[0], azimuth[1]
    e1, e2 = column(A, 1), column(A, 2)
    put(pw.P[0], turned(F, column(A, 0)))
    put(pw.P[1], turned(F, combine(times(ca, e1), sa, e2)))
    put(pw.P[2], turned(F, combine(times(ca, e2), -sa, e1)))


@part
def set_face(frames, f, pw):
    """The axes of face f, in F, into ``pw.G``."""
    for k in range(3):
        axis = times(frames.axes[f, k, 0], row(pw.P, 0))
        axis = combine(axis, frames.axes[f, k, 1], row(pw.P, 1))
        put(pw.G[k], combine(axis, frames.axes[f, k, 2], row(pw.P, 2)))


@part
def _penetrations(pose, data, frames, i, centre, q, margin, pw):
    """As ``pocket_wall.penetrations``, of a roller whose ``centre`` of mass is there."""
    a0, a1, a2 = row(pose.axis, 0), row(pose.axis, 1), row(pose.axis, 2)
    whole, D = frames.whole, combine(centre, -data.place[i], row(pw.P, 0))
    D = combine(D, -frames.origin, row(pw.P, 1))
    reach = max(abs(data.s[0]), abs(data.s[data.s.shape[0] - 1]))
    touch = False
    for f in range(FACES):
        set_face(frames, f, pw)
        G0, G2 = row(pw.G, 0), row(pw.G, 2)
        X, T = dot(G0, D), dot(G2, D)
        ax = (dot(G0, a0), dot(G0, a1), dot(G0, a2))
        at = (dot(G2, a0), dot(G2, a1), dot(G2, a2))
        sgn = 1.0 if f % 2 == 0 else -1.0
        if f < SIDES:
            lean = abs(sgn * at[0] - frames.taper)
            gap = data.half[0] + data.low[i, f] - sgn * T - lean * reach - whole
        else:
            tilt = (abs(ax[1]) + abs(ax[2])) * (whole + frames.taper * data.half_roller)
            at_end = sgn * (X + data.middle * ax[0]) + data.half_roller
            gap = data.half[1] + data.low[i, f] - at_end - tilt
        if face_penetrations(data, i, f, gap, (whole, X, T, ax, at), q, margin, pw):
            touch = True
    return touch


@outlined
def cone_pocket_contact(i, roller, cage, pockets, laws, sl, pw, pair, mode, sums):
    """Wrench of pocket i on its roller, and station forces on the cage in the axes of each face;
    as ``pocket.pocket_contact``, with the pocket's axes in ``pw.P``; ``pockets``: their arrays and
    the axes of their faces."""
    pose, whole, D, onset, guess = roller
    data, frames = pockets
    Vc, wc, (q, qd, margin) = cage
    begin_pocket(pw, pair, mode, sums)
    centre = xyz(D)
    zero(pw.push)
    searching = True
    while searching:
        if not _penetrations(pose, data, frames, i, centre, q, margin, pw):
            return False
        searching = False
        if data.soft != 0:
            condense(data, i, laws, guess, sl, pw)
            searching = touches_more(pw)
    zero(pw.st)
    if mode == TANGENT:
        clear_tangent(pw)
    rel, spin = relative_motion(pose, xyz(Vc), xyz(wc), centre)
    any_contact = False
    for f in range(FACES):
        if pw.near[f] != 0 and press_face(data, f, sl, pw):
            any_contact = True
            set_face(frames, f, pw)
            place, motion = (pose, whole, centre[1]), (rel, spin, qd, onset[f])
            face_forces(i, f, place, motion, data, laws, (sl, pw), pair, mode, sums)
    end_pocket(any_contact, data, pw, pair, mode, sums)
    return any_contact


@part
def stations_in_pocket_axes(frames, st, out):
    """Station forces (4, nst, 3) in the axes of their faces as forces along x, r, psi."""
    for f in range(FACES):
        for s in range(st.shape[1]):
            for c in range(3):
                out[f, s, c] = 0.0
                for k in range(3):
                    out[f, s, c] += st[f, s, k] * frames.axes[f, k, c]
