"""Roller in its pocket: crossbeam faces in slices, side beams over points of the roller's end."""

from __future__ import annotations

from flexcage.contacts.condensation import add_residual_slope, condense, touches_more, yielded
from flexcage.contacts.evaluation import DAMPED, REPORT, RUBBED, STORED, TANGENT
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.pocket_forces import (
    add_crossbeam_forces,
    add_side_beam_forces,
    crossbeam_rates,
    relative_motion,
    side_beam_rates,
    spread_over_stations,
)
from flexcage.contacts.pocket_tangent import add_tangent, clear_tangent, give_pair, soften
from flexcage.contacts.pocket_wall import (
    FACES,
    SIDES,
    give_stations,
    penetrations,
    read_stations,
    read_values,
    span_of,
)
from flexcage.contacts.slices import (
    elastic_forces,
    friction_factors,
    friction_power,
    largest,
    normal_forces,
    stored_and_damped,
)
from flexcage.contacts.state import clear
from flexcage.core.jit import outlined, part, zero
from flexcage.core.vectors import RIGID, combine, row, xyz


@outlined
def pocket_contact(i, roller, cage, data, laws, sl, pw, pair, mode, sums):
    """Wrench of pocket i on its roller (``RollerInPocket``), and station forces on the cage
    (``CageAtRoller``) in ``pw.st``.

    With TANGENT slopes in ``pair`` and ``pw.K, pw.C``; from REPORT on ``sums``: elastic energy
    (with the residual's), damping power, friction power.
    """
    pose, Rw, D, onset, guess = roller
    Vc, wc, (q, qd, margin) = cage
    begin_pocket(pw, pair, mode, sums)
    # depths before the walls' residual deflection, then its coordinates b (``condensation``)
    centre = xyz(D)
    middle = combine(centre, -data.place[i], row(pw.G, 0))
    zero(pw.push)
    searching = True
    while searching:
        if not penetrations(pose, data, i, Rw, middle, q, margin, pw):
            return False
        searching = False
        if data.soft != 0:
            condense(data, i, laws, guess, sl, pw)
            searching = touches_more(pw)
    zero(pw.st)
    if mode == TANGENT:
        clear_tangent(pw)
    # roller relative to the cage's body at the roller's centre, in F
    rel, spin = relative_motion(pose, xyz(Vc), xyz(wc), centre)
    any_contact = False
    for f in range(FACES):
        if pw.near[f] != 0 and press_face(data, f, sl, pw):
            any_contact = True
            place, motion = (pose, Rw, centre[1]), (rel, spin, qd, onset[f])
            face_forces(i, f, place, motion, data, laws, (sl, pw), pair, mode, sums)
    end_pocket(any_contact, data, pw, pair, mode, sums)
    return any_contact


@part
def begin_pocket(pw, pair, mode, sums):
    """Clear what the faces of a pocket add to."""
    clear(pair, mode == TANGENT)
    zero(pw.normal)
    zero(pw.tangential)
    if mode >= REPORT:
        zero(sums)
        zero(pw.b)
    if mode == REPORT:
        zero(pw.slice_N)
        zero(pw.slice_T)
        zero(pw.point_N)
        zero(pw.point_T)


@part
def end_pocket(any_contact, data, pw, pair, mode, sums):
    """After all faces: the pair's tangent, or the energy of the walls."""
    if mode == TANGENT and any_contact:
        if data.soft != 0:  # b is condensed out of K
            soften(RIGID + data.phi_max.shape[0], pw)
        give_pair(pw, pair)
    elif mode >= REPORT and data.soft != 0:
        for l in range(pw.b.shape[0]):  # shapes of unit compliance: a wall stores b . b/2
            sums[STORED] += 0.5 * pw.b[l] * pw.b[l]


@part
def press_face(data, f, sl, pw):
    """Penetration sl.d of face f after all deflection; returns whether the roller touches."""
    span = span_of(pw, f)
    if data.soft != 0:
        if pw.live[f] == 0:
            return False
        yielded(span, pw.face[f], pw, sl)
        add_residual_slope(f, pw)
    else:
        for k in range(span[0], span[1]):
            sl.d[k] = pw.face[f].d0[k]
    return largest(span, sl.d) > 0.0


@part
def face_forces(i, f, place, motion, data, laws, work, pair, mode, sums):
    """Forces of face f, from the penetrations sl.d.

    ``place`` of the roller: pose, radius, distance of its centre from the bearing's axis;
    ``motion``: its velocities less the cage's, the modes' rates, speed at the begin of contact;
    ``work``: slices, pocket.
    """
    pose, Rw, distance = place
    rel, spin, qd, onset = motion
    sl, pw = work
    face, span, a = pw.face[f], span_of(pw, f), row(pose.axis, 0)
    kind = 0 if f < SIDES else 1
    p = data.normal[kind]
    normal, friction = (
        (laws.crossbeam, laws.crossbeam_rubs) if f < SIDES else (laws.side, laws.side_rubs)
    )
    for c in range(3):
        read_stations(data, i, f, qd, c, pw.wall[c])
        read_values(span, face.w, face, pw.wall[c], face.rate[c])
    if f < SIDES:
        crossbeam_rates(data, f, span, Rw, a, rel, spin, face, sl, pw)
    else:
        side_beam_rates(pose, data, f, distance, rel, spin, sl, pw, pair)
    if mode == TANGENT and data.soft != 0:
        elastic_forces(normal, span, sl, p)
        for k in range(span[0], span[1]):
            pw.h[k] = sl.Nd[k]
    normal_forces(normal, span, sl, p, onset)
    friction_factors(friction, span, sl, data.friction[kind])
    if f < SIDES:
        add_crossbeam_forces(data, f, span, Rw, a, face, sl, pw, pair.wrench)
    else:
        add_side_beam_forces(pose, data, f, distance, sl, pw, pair)
    spread_over_stations(span, f, face, sl, pw)
    give_stations(f, pw)
    if mode == TANGENT:
        add_tangent(pose, data, i, f, Rw, distance, sl, pw)
    elif mode >= REPORT:
        if mode == REPORT:
            N, T = (
                (pw.slice_N[f], pw.slice_T[f])
                if f < SIDES
                else (pw.point_N[f - SIDES], pw.point_T[f - SIDES])
            )
            for k in range(span[0], span[1]):
                N[k] = sl.N[k]
                T[k] = sl.N[k] * sl.g[k] * sl.u[k]
        sums[RUBBED] += friction_power(span, sl)
        energy, damped = stored_and_damped(span, sl, p[EXPONENT])
        sums[STORED] += energy
        sums[DAMPED] += damped
