"""Balls in motion between rings that bend: the residual of ``residual`` with races that yield.

A ball meets a groove as one of a rigid ring that is displaced as the race is at its azimuth; lands
follow their ring's modes (``system.rings.sections``).
"""

from __future__ import annotations

from dataclasses import replace

from flexcage.bearings.ball.model import BallModel
from flexcage.bearings.ball.motion import MOTION
from flexcage.bearings.ball.residual import (
    NEIGHBOUR_FORCES,
    SHARED,
    ball_in_pocket,
    ball_rows,
    on_race,
    report_race,
    set_bodies,
)
from flexcage.bearings.ball.scales import ball_weights
from flexcage.bearings.ball.start import ball_start_between_bent_rings
from flexcage.contacts.evaluation import RACE_LAW, RACE_RUBS, REPORT
from flexcage.contacts.groove import (
    BallOnRace,
    gradient_direction,
    groove_contact,
    line_of_contact,
    penetration_gradient,
)
from flexcage.contacts.slices import Laws, elastic_forces
from flexcage.contacts.state import set_frame
from flexcage.core.jit import array_from, fields, outlined, part, zero
from flexcage.core.vectors import cross, minus, plus
from flexcage.system.data import FAMILY_PARTS, INNER_RACE, OUTER_RACE
from flexcage.system.equations import push_pair
from flexcage.system.layout import of_element
from flexcage.system.motion import BendingMotion, bending_model, parts_type
from flexcage.system.ring import inner_of, outer_of
from flexcage.system.rings.modes import (
    displace_by_modes,
    mode_rows,
    push_modes_by_element,
    report_modes,
)
from flexcage.system.rings.races import (
    STEPS,
    after,
    at_once,
    borne_of,
    close,
    deflect_races,
    force_rows,
    guess,
    push_by_slopes,
    report_races,
    with_ring_weights,
)

BendingBallModel = bending_model("BendingBallModel", BallModel, __name__)
BendingBallParts = parts_type("BendingBallParts", BendingBallModel, __name__)


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``, as ``residual.evaluate``."""
    at, races = fields(d.places), fields(d.rings)
    q, u, qd, ud = y[: at.bodies_q], y[at.u : at.bodies_u], yd[: at.bodies_q], yd[at.u :]
    r_q, r_u, s = out[: at.bodies_q], out[at.u :], y[at.loads :]
    modes = set_bodies(y, d, mode)
    law[NEIGHBOUR_FORCES](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    deflect_races(q, inner_of(y, d).q, outer_of(y, d).q, s, races)
    displace_by_modes(q, u, y, d)
    Rc, Vc = array_from(y, at.cage_q), array_from(y, at.cage_u)
    for i in range(at.elements):
        own = of_element(i)
        qi, ui = q[own], u[own]
        set_frame(qi[2], fields(d.pose).F)
        ring, race = inner_of(y, d), fields(d.inner)
        _on_race(INNER_RACE, i, y, ring, race, fields(d.inner_modes), d, law, mode)
        ring, race = outer_of(y, d), fields(d.outer)
        _on_race(OUTER_RACE, i, y, ring, race, fields(d.outer_modes), d, law, mode)
        push_modes_by_element(i, d)
        push_by_slopes(i, q, y, d)
        if at.cages > 0:
            ball_in_pocket(i, qi, ui, Rc, Vc, modes, d, law, mode)
        ball_rows(i, qi, ui, qd[own], ud[own], d, r_q[own], r_u[own], mode)
    force_rows(s, yd[at.loads :], races, out[at.loads :])
    if mode >= REPORT:
        report_races(u, q, s, races, fields(d.report))
        report_modes(y, d)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    mode_rows(y, yd, d, out, mode)


@outlined
def _on_race(side, i, y, ring, race, modes, d, law, mode):
    """Ball i on the race of a ring (``side``), in its frame F."""
    work, pair, races = fields(d.scratch), fields(d.pair), fields(d.rings)
    at, own = fields(d.places), of_element(i)
    qi, ui, s = y[: at.bodies_q][own], y[at.u : at.bodies_u][own], y[at.loads :]
    laws, sl = Laws(law[RACE_LAW], law[RACE_RUBS]), fields(d.slices).row[0]
    zero(pair.wrench)
    onset = fields(d.memory).race[i, side]
    ball = _carried(i, on_race(i, qi, ui, ring, onset, d), modes)
    yielded = _yielded(side, i, ball, race, s, laws, sl, races)
    if groove_contact(yielded, race, laws, sl, pair.wrench, mode, work.sums):
        _bear(side, i, yielded, race, sl, races)
        if modes.push.shape[0] > 0:
            for c in range(2):
                modes.total[i, c] = -pair.wrench[c]
        push_pair(i, pair.wrench, work.unit, ball.centre, ring.b, d)
    if mode >= REPORT:
        report_race(i, side, work.sums, fields(d.report))


@part
def _yielded(side, i, ball, race, s, laws, sl, rings):
    """The ball as the race meets it that yields under it at once."""
    moved, taken = _moved(ball, guess(side, i, s, rings)), borne_of(side, i, s, rings)
    for _ in range(STEPS):
        n = _pressing(moved, race, sl)
        if sl.d[0] <= 0.0:
            return moved
        elastic_forces(laws.normal, (0, 1), sl, race.normal)
        force, stiff = (sl.Ne[0] * n[0], sl.Ne[0] * n[1]), sl.Nd[0]
        slope = (stiff * n[0] * n[0], stiff * n[0] * n[1], stiff * n[1] * n[1])
        step = at_once(side, taken, force, slope, rings)
        moved = _moved(moved, step)
        if close(taken, force):
            return moved
        taken = after(force, slope, step)
    return moved


@part
def _carried(i, ball, modes):
    """The ball as a race meets it that its ring's modes move."""
    rate = modes.rate
    if modes.push.shape[0] == 0:
        return ball
    return BallOnRace(
        ball.radius, ball.centre, ball.velocity, ball.spin, ball.axis,
        plus(ball.ring_velocity, (rate[i, 0], rate[i, 1], 0.0)), ball.ring_spin, ball.onset,
        ball.azimuth, ball.spotted, ball.spot,
    )  # fmt: skip


@part
def _moved(ball, w):
    """The ball as a race meets it that has yielded by w, axially and radially."""
    return BallOnRace(
        ball.radius, minus(ball.centre, (w[0], w[1], 0.0)), ball.velocity, ball.spin, ball.axis,
        ball.ring_velocity, ball.ring_spin, ball.onset, ball.azimuth, ball.spotted, ball.spot,
    )  # fmt: skip


@part
def _pressing(ball, race, sl):
    """The direction in which a ball's depth grows, as long as it grows there; the depth into
    sl.d."""
    e, n, distance, reach = line_of_contact(ball.centre, ball.axis, race)
    sl.d[0] = reach - race.radius + ball.radius
    if race.uneven + ball.spotted > 0:
        gradient, _ = penetration_gradient(ball, race, (e, n, distance, reach), sl)
        return gradient_direction(gradient, n, cross(ball.axis, e))
    return n


@part
def _bear(side, i, ball, race, sl, rings):
    """What the ring bears of a ball that touches it: elastic forces along the axis, radially."""
    n = _pressing(ball, race, sl)
    rings.force[side, i, 0], rings.force[side, i, 1] = sl.Ne[0] * n[0], sl.Ne[0] * n[1]


BENDING = BendingMotion(
    motion=replace(
        MOTION,
        parts=BendingBallParts,
        evaluate=evaluate,
        start=ball_start_between_bent_rings,
        error_weights=with_ring_weights(ball_weights),
        implicit_share=0.0,
        linearise=None,
    ),
    model=BendingBallModel,
)
