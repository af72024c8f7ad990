"""Newton's matrix of a ball bearing: every contact's slopes, put where its unknowns are.

``linearise`` fills the tangent apart from ``residual.evaluate``, so that who takes explicit steps
neither compiles nor passes it. Contacts give slopes over a ball's place and velocities against the
ring or cage (``contacts.groove_tangent``, ``contacts.ball_pocket_tangent``);
``system.contact_tangent`` makes of these the columns of ball and body. Left out are how inertia
follows motion, but for the ball's, and how the orbit's rate follows the ball's radius.
"""

from __future__ import annotations

from flexcage.bearings.ball.residual import (
    NEIGHBOUR_FORCES,
    SHARED,
    in_pocket,
    on_race,
    set_bodies,
)
from flexcage.contacts.ball_pocket_tangent import pocket_wall_tangent
from flexcage.contacts.evaluation import (
    POCKET_LAW,
    POCKET_RUBS,
    RACE_LAW,
    RACE_RUBS,
    TANGENT,
)
from flexcage.contacts.groove_tangent import groove_tangent
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import set_frame
from flexcage.core.jit import array_from, fields, part, zero
from flexcage.core.vectors import RIGID, TURN, column, minus, put, turn_of, turned, xyz
from flexcage.system.contact_tangent import BodyUnknowns, RelativeMotion, add_contact_tangent
from flexcage.system.data import (
    AXIAL,
    CAGE_SPIN,
    FAMILY_PARTS,
    INNER_RACE,
    MASS,
    OUTER_RACE,
)
from flexcage.system.layout import cage_at, cage_of, of_element
from flexcage.system.ring import inner_of, outer_of


def linearise(t, y, yd, data):
    """Keep dF/dy and dF/dy' at this point; see ``system.newton``."""
    d, law = data[0], data[1]
    at = fields(d.places)
    q, u = y[: at.bodies_q], y[at.u : at.bodies_u]
    modes = set_bodies(y, d, TANGENT)
    law[NEIGHBOUR_FORCES](t, y, yd, d, law[:FAMILY_PARTS], fields(d.scratch).out, TANGENT)
    Rc, Vc = array_from(y, at.cage_q), array_from(y, at.cage_u)
    for i in range(at.elements):
        qi, ui = q[of_element(i)], u[of_element(i)]
        set_frame(qi[2], fields(d.pose).F)
        onset = fields(d.memory).race[i]
        race_slopes(i, qi, ui, inner_of(y, d), fields(d.inner), onset[INNER_RACE], d, law)
        race_slopes(i, qi, ui, outer_of(y, d), fields(d.outer), onset[OUTER_RACE], d, law)
        if at.cages > 0:
            pocket_slopes(i, qi, ui, Rc, Vc, modes, d, law)
        inertia_slopes(i, qi[1], ui, d)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], fields(d.scratch).out, TANGENT)


@part
def race_slopes(i, qi, ui, ring, groove, onset, d, law):
    """Ball i on the race ``groove`` of a ring, which it met at a speed ``onset``."""
    F, pair, work = fields(d.pose).F, fields(d.pair), fields(d.scratch)
    laws, sl = Laws(law[RACE_LAW], law[RACE_RUBS]), fields(d.slices).row[0]
    ball = on_race(i, qi, ui, ring, onset, d)
    if not groove_tangent(ball, groove, laws, sl, pair, work.sums):
        return
    moves = work.S
    zero(moves)
    for c in range(3):
        put(moves[c], column(F, c))
        put(moves[TURN + c, TURN:], column(F, c))
    by, tan = _relative_motion(ball, ui, qi[1]), fields(d.tangent)
    body = BodyUnknowns(ring.b, 6, 1, 0, 0)
    add_contact_tangent(i, by, body, moves, pair.K, pair.C, pair.wrench, pair.W[0], tan)


@part
def _relative_motion(ball, ui, r):
    """Motion of a ball (``BallOnRace``) and its ring."""
    V, w = xyz(ui), turn_of(ui)
    return RelativeMotion(ball.centre, minus(V, ball.ring_velocity), ball.ring_spin, V, w, r)


@part
def pocket_slopes(i, qi, ui, Rc, Vc, modes, d, law):
    F, pair, work, pw = fields(d.pose).F, fields(d.pair), fields(d.scratch), fields(d.pocket_work)
    laws, sl = Laws(law[POCKET_LAW], law[POCKET_RUBS]), fields(d.slices).row[0]
    ball, data, wrench = in_pocket(i, qi, ui, Rc, Vc, d), fields(d.pocket), pair.wrench
    zero(wrench)
    hit = pocket_wall_tangent(i, ball, modes, data, laws, sl, pw, wrench, work.sums)
    tan = fields(d.tangent)
    tan.active[i] = 1 if hit else 0
    if not hit:
        return
    moves = work.S
    zero(moves)
    for c in range(3):
        put(moves[c], column(F, c))
        put(moves[TURN + c, TURN:], turned(F, column(work.A, c)))
    V, w = xyz(ui), turn_of(ui)
    spin = turned(F, xyz(work.vec[CAGE_SPIN]))
    by = RelativeMotion(ball.centre, minus(V, turned(F, xyz(Vc))), spin, V, w, qi[1])
    at = fields(d.places)
    b = cage_at(cage_of(i, at), at).b
    body = BodyUnknowns(b, 6, 0, 1, b + RIGID)
    add_contact_tangent(i, by, body, moves, pw.K, pw.C, wrench, pw.gen[0], tan)


@part
def inertia_slopes(i, r, ui, d):
    """Of the ball itself in its orbiting frame, and its drag."""
    bodies, K, C = fields(d.bodies), fields(d.tangent).Krr[i], fields(d.tangent).Crr[i]
    mass, inertia, orbit = bodies.element[MASS], bodies.element[AXIAL], ui[2] / r
    C[1, 2] -= 2.0 * mass * orbit
    C[2, 1] += mass * orbit
    C[2, 2] += mass * ui[1] / r + 2.0 * bodies.drag[0] * abs(ui[2])
    K[1, 1] += mass * orbit * orbit
    K[2, 1] -= mass * orbit * ui[1] / r
    around, outwards = inertia * ui[TURN + 2], inertia * ui[TURN + 1]
    C[TURN + 1, TURN + 2] -= inertia * orbit
    C[TURN + 2, TURN + 1] += inertia * orbit
    C[TURN + 1, 2] -= around / r
    C[TURN + 2, 2] += outwards / r
    K[TURN + 1, 1] += around * orbit / r
    K[TURN + 2, 1] -= outwards * orbit / r
