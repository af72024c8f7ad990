"""Slopes of a pocket's forces on its ball and on the cage's modes.

The contact's depth is a function of the ball's place in the pocket and of the modes, and the
elastic force pushes along its slope. So the tangent is a sum of products of two slopes, and of
forces times bends of the depth and of the wall's compliance. Bends over the ball's place are
differences of these slopes: a ball moves the contact round the pocket by its own way over the
pocket's play, over which a crown cage's compliance changes several times.

Vectors are in the pocket's axes until ``_to_frame``. Rows and columns: the ball's translation and
rotation, then n modes. Index letters: c component, m mode.
"""

from __future__ import annotations

from math import atan2, floor, pi, sqrt
from typing import NamedTuple

from flexcage.contacts.ball_pocket import (
    SPHERE,
    BallInPocket,
    beyond_straight,
    from_middle,
    nearest_wall,
    pocket_wall_contact,
    rim_there,
    share_at_pole,
    turning,
)
from flexcage.contacts.evaluation import RESIDUAL
from flexcage.contacts.laws import EXPONENT
from flexcage.core.jit import VECTORISED, outlined, part, zero
from flexcage.core.splines import smooth_weights
from flexcage.core.vectors import (
    MOMENT,
    RIGID,
    TURN,
    column,
    combine,
    cross,
    dot,
    minus,
    plus,
    put,
    row,
    times,
    turned,
    turned_back,
    xyz,
)

# in ``BallPocketWork.shape``: modes where the ball touches, their slopes over its azimuth in the
# pocket and over the cosine of its latitude there
HERE, AROUND, POLEWARDS = range(3)
# rows of ``gen``: sliding along the pocket's axes (0 to 2); depth; elastic force; what the normal
# force follows by place; the wrench that a unit of it is, with its friction
DEPTH, ELASTIC, BY_PLACE, PUSH = range(3, 7)
STEP = 1e-4  # of the pocket's play: how far a difference of slopes goes


class Wall(NamedTuple):
    """Where a ball touches its pocket's wall."""

    n: tuple[float, float, float]  # direction from the ball's centre
    bends: tuple[tuple[float, float, float], ...]  # [c]: slopes of n_c over the ball's place
    keep: tuple[float, float, float]  # 1 along what counts of the place, 0 along what does not
    around: tuple[float, float, float]  # slope of the azimuth over the ball's place
    polewards: tuple[float, float, float]  # of the latitude's cosine
    yields: tuple[float, float, float]  # of the wall's compliance
    soft: float  # that compliance
    still: tuple[tuple[float, float, float], ...]  # the wall's displacement without stress, and its
    # slopes over azimuth and cosine


class Slide(NamedTuple):
    """A ball's sliding along the wall, and the friction on it."""

    arm: float  # the ball's radius
    spin: tuple[float, float, float]  # relative angular velocity
    slip: tuple[float, float, float]  # of the ball's surface, along the wall
    across: float  # and across it
    N: float  # normal force
    g: float  # mu/u
    bent: float  # its slope over u, over u


@part
def pocket_wall_tangent(i, ball, modes, data, laws, sl, pw, wrench, sums):
    """``ball_pocket.pocket_wall_contact``, and minus the forces' slopes into ``pw.K`` and ``pw.C``.

    ``pw.K``: over the ball's place from the cage, with the relative velocities ``ball.velocity``
    and ``ball.spin`` as they are, and over the modes; ``pw.C``: over those velocities and the
    modes' rates. Components of the ball's are in its frame.
    """
    if not pocket_wall_contact(i, ball, modes, data, laws, sl, pw, wrench, RESIDUAL, sums):
        return False
    zero(pw.K)
    zero(pw.C)
    if sl.N[0] <= 0.0:
        return True
    v, spin = turned(pw.G, ball.velocity), turned(pw.G, ball.spin)
    _bends(i, ball, data, modes.q, pw)
    wall = _wall_there(i, ball, data, pw)
    _depth(wall, modes.q, pw)
    slide = _sliding(ball.radius, wall, v, spin, modes.qd, sl, pw)
    _law(wall, v, modes.qd, sl, data.normal[i], pw)
    _products(slide, sl, pw)
    _friction_by_velocity(wall, slide, pw)
    _friction_by_place(wall, slide, modes.qd, pw)
    _to_frame(pw.K, pw)
    _to_frame(pw.C, pw)
    return True


@part
def _wall_there(i, ball, data, pw):
    """The ``Wall``; fills ``pw.shape``."""
    d, seat = from_middle(i, ball.radius, ball.centre, data, pw)
    n, distance, touch = nearest_wall(d, data.radius[i], rim_there(i, d[0], d[1], data), seat)
    dx, dt = beyond_straight(i, d[0], d[2], data)
    keep = (dx, 1.0 if data.shape == SPHERE else 0.0, dt)  # along these the place counts
    cosine = sqrt(n[0] * n[0] + n[2] * n[2])
    around = polewards = (0.0, 0.0, 0.0)
    if cosine > 0.0:
        bend = turning((n[2], 0.0, -n[0]), n, distance, touch)
        around = _scaled(keep, times(1.0 / (cosine * cosine), bend))
        bend = turning((n[0], 0.0, n[2]), n, distance, touch)
        polewards = _scaled(keep, times(1.0 / cosine, bend))
    (soft, softer, fading), still = _shapes(i, n, cosine, data, pw)
    yields = combine(times(softer, around), fading, polewards)
    bends = (
        _scaled(keep, turning((1.0, 0.0, 0.0), n, distance, touch)),
        _scaled(keep, turning((0.0, 1.0, 0.0), n, distance, touch)),
        _scaled(keep, turning((0.0, 0.0, 1.0), n, distance, touch)),
    )
    return Wall(n, bends, keep, around, polewards, yields, soft, still)


@part
def _bends(i, ball, data, q, pw):
    """How the slopes of depth and compliance over the ball's place change with it, into ``pw.bend``
    and ``pw.softer``."""
    step = STEP * max(abs(data.radius[i] - ball.radius), 1e-3 * ball.radius)
    for c in range(3):
        aside = times(step, row(pw.G, c))
        deep, soft = _slopes(i, _at(ball, plus(ball.centre, aside)), data, q, pw)
        less, softer = _slopes(i, _at(ball, minus(ball.centre, aside)), data, q, pw)
        _put_column(pw.bend, c, times(0.5 / step, minus(deep, less)))
        _put_column(pw.softer, c, times(0.5 / step, minus(soft, softer)))


@part
def _at(ball, centre):
    return BallInPocket(ball.radius, centre, ball.velocity, ball.spin, ball.onset)


@part
def _slopes(i, ball, data, q, pw):
    """Slopes of depth and compliance over the ball's place."""
    wall = _wall_there(i, ball, data, pw)
    _depth(wall, q, pw)
    return xyz(pw.gen[DEPTH]), wall.yields


@part
def _scaled(a, b):
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]


@part
def _shapes(i, n, cosine, data, pw):
    """Modes at the contact and their slopes into ``pw.shape``; compliance there and its slopes;
    displacement without stress and its."""
    shape, nst = pw.shape, data.phi.shape[2]
    place = atan2(n[0], n[2]) * nst / (2.0 * pi)
    first = floor(place)
    weight, slope = smooth_weights(place - first)
    share, fade = share_at_pole(cosine)
    zero(shape)
    soft = softer = mean = 0.0
    here = around = polewards = (0.0, 0.0, 0.0)
    for k in range(4):
        s = (int(first) + k - 1 + nst) % nst
        rise = slope[k] * nst / (2.0 * pi)
        soft += weight[k] * data.local[i, s]
        softer += rise * data.local[i, s]
        _add_station(share * weight[k], data.phi[i, 0, s], shape[HERE])
        _add_station(share * rise, data.phi[i, 0, s], shape[AROUND])
        _add_station(fade * weight[k], data.phi[i, 0, s], shape[POLEWARDS])
        still = xyz(data.offset[i, s])
        here = combine(here, share * weight[k], still)
        around = combine(around, share * rise, still)
        polewards = combine(polewards, fade * weight[k], still)
    if share == 1.0:
        return (soft, softer, 0.0), (here, around, polewards)
    for s in range(nst):
        mean += data.local[i, s] / nst
        _add_station((1.0 - share) / nst, data.phi[i, 0, s], shape[HERE])
        _add_station(-fade / nst, data.phi[i, 0, s], shape[POLEWARDS])
        still = xyz(data.offset[i, s])
        here = combine(here, (1.0 - share) / nst, still)
        polewards = combine(polewards, -fade / nst, still)
    softness = share * soft + (1.0 - share) * mean, share * softer, fade * (soft - mean)
    return softness, (here, around, polewards)


@part(fastmath=VECTORISED)
def _add_station(weight, phi, shape):
    for c in range(3):
        for m in range(shape.shape[1]):
            shape[c, m] += weight * phi[c, m]


@part
def _moved(shape, q):
    """Displacement of a wall with those shapes (3, n) by modal coordinates q."""
    x = r = psi = 0.0
    for m in range(q.shape[0]):
        x += shape[0, m] * q[m]
        r += shape[1, m] * q[m]
        psi += shape[2, m] * q[m]
    return x, r, psi


@part
def _bent(wall, a):
    """Slope of n . a over the ball's place, for a displacement of the wall."""
    first = combine(times(a[0], wall.bends[0]), wall.keep[1] * a[1], wall.bends[1])
    return combine(first, a[2], wall.bends[2])


@part
def _depth(wall, q, pw):
    """The depth's slopes into ``pw.gen[DEPTH]``, and into ``pw.bend`` how those over the ball's
    place change with the modes."""
    gen, bend, shape, n = pw.gen[DEPTH], pw.bend, pw.shape, wall.n
    zero(gen)
    u = plus(_moved(shape[HERE], q), wall.still[HERE])
    du = plus(_moved(shape[AROUND], q), wall.still[AROUND])
    faded = plus(_moved(shape[POLEWARDS], q), wall.still[POLEWARDS])
    push = minus(_scaled(wall.keep, n), _bent(wall, u))
    push = combine(push, -dot(du, n), wall.around)
    put(gen, combine(push, -dot(faded, n), wall.polewards))
    for m in range(q.shape[0]):
        gen[RIGID + m] = -dot(column(shape[HERE], m), n)
        changes = _bent(wall, column(shape[HERE], m))
        changes = combine(changes, dot(column(shape[AROUND], m), n), wall.around)
        changes = combine(changes, dot(column(shape[POLEWARDS], m), n), wall.polewards)
        _put_column(bend, RIGID + m, times(-1.0, changes))


@part
def _put_column(M, c, a):
    M[0, c], M[1, c], M[2, c] = a


@part
def _sliding(arm, wall, v, spin, qd, sl, pw):
    """The ``Slide``; its generators into ``pw.gen``."""
    gen, shape, n = pw.gen, pw.shape, wall.n
    out = times(arm, n)
    for c in range(3):
        zero(gen[c])
        gen[c, c] = 1.0
        for m in range(qd.shape[0]):
            gen[c, RIGID + m] = -shape[HERE, c, m]
    put(gen[0, TURN:], (0.0, out[2], -out[1]))  # out x e_c
    put(gen[1, TURN:], (-out[2], 0.0, out[0]))
    put(gen[2, TURN:], (out[1], -out[0], 0.0))
    slip = minus(plus(v, cross(spin, out)), _moved(shape[HERE], qd))
    across = dot(slip, n)
    bent = sl.dg[0] / sl.u[0] if sl.u[0] > 1e-12 else 0.0
    return Slide(arm, spin, combine(slip, -across, n), across, sl.N[0], sl.g[0], bent)


@part
def _law(wall, v, qd, sl, p, pw):
    """What elastic and whole normal force follow, into ``pw.gen[ELASTIC]`` and ``[BY_PLACE]``:
    their slopes over place and modes. Over velocities it is ``sl.Nv`` times the first.

    The contact's own depth d solves d + soft K d^n = depth, so that it follows 1/(1 + stiff) of
    the depth's slope less the compliance's times the force; its rate does the same of velocities.
    """
    depth, elastic, by_place, bend = pw.gen[DEPTH], pw.gen[ELASTIC], pw.gen[BY_PLACE], pw.bend
    d, power, force = sl.d[0], p[EXPONENT], sl.Ne[0]
    stiff = wall.soft * power * force / d
    share = 1.0 / (1.0 + stiff)
    zero(elastic)
    put(elastic, times(share, combine(xyz(depth), -force, wall.yields)))
    for k in range(RIGID, elastic.shape[0]):
        elastic[k] = share * depth[k]
    softening = dot(wall.yields, v)
    # the rate's own slopes: force times softening and stiff grow with depth and compliance
    slower = share * (softening * power * force / d + sl.v[0] * (power - 1.0) * stiff / d)
    for k in range(elastic.shape[0]):
        by_place[k] = (sl.Nd[0] - sl.Nv[0] * slower) * elastic[k]
        if k >= RIGID:
            by_place[k] += sl.Nv[0] * share * dot(column(bend, k), v)
    for c in range(3):
        rate = dot(xyz(bend[c]), v) - force * dot(xyz(pw.softer[c]), v)
        for m in range(qd.shape[0]):
            rate += bend[c, RIGID + m] * qd[m]
        if wall.soft > 0.0:
            rate -= sl.v[0] * stiff / wall.soft * wall.yields[c]
        by_place[c] += sl.Nv[0] * share * rate
    put(pw.gen[PUSH], times(sl.N[0], wall.yields))


@part(fastmath=VECTORISED)
def _products(slide, sl, pw):
    """Add what the normal force changes by, with its friction, and the turning of its push."""
    push, elastic, by_place = pw.gen[PUSH], pw.gen[ELASTIC], pw.gen[BY_PLACE]
    n = push.shape[0]
    for k in range(n):
        along = 0.0
        for c in range(3):
            along += pw.gen[c, k] * slide.slip[c]
        moved = push[k] if k < TURN else 0.0
        push[k] = moved - pw.gen[DEPTH, k] - slide.g * along
    for k in range(n):
        rate = sl.Nv[0] * push[k]
        for j in range(n):
            pw.K[k, j] -= push[k] * by_place[j]
            pw.C[k, j] -= rate * elastic[j]
    for c in range(3):
        for j in range(n):
            pw.K[c, j] += slide.N * pw.bend[c, j]
        for j in range(3):
            pw.K[c, j] -= 0.5 * slide.N * slide.N * pw.softer[c, j]
        for j in range(RIGID, n):
            pw.K[j, c] += slide.N * pw.bend[c, j]


@part
def _resisted(wall, slide, change):
    """Minus the change of the friction force by a change of the slip, at the same normal force."""
    along = combine(change, -dot(change, wall.n), wall.n)
    pull = combine(times(slide.g, along), slide.bent * dot(slide.slip, along), slide.slip)
    return times(slide.N, pull)


@outlined
def _friction_by_velocity(wall, slide, pw):
    gen = pw.gen
    for j in range(gen.shape[1]):
        pull = _resisted(wall, slide, (gen[0, j], gen[1, j], gen[2, j]))
        for k in range(gen.shape[1]):
            pw.C[k, j] += gen[0, k] * pull[0] + gen[1, k] * pull[1] + gen[2, k] * pull[2]


@part
def _friction_by_place(wall, slide, qd, pw):
    """The wall turns and its modes change where the ball touches it."""
    K, gen, shape, drag = pw.K, pw.gen, pw.shape, times(-slide.N * slide.g, slide.slip)
    for c in range(3):
        turns = (wall.bends[0][c], wall.bends[1][c], wall.bends[2][c])
        change = cross(slide.spin, times(slide.arm, turns))
        change = combine(change, -wall.around[c], _moved(shape[AROUND], qd))
        change = combine(change, -wall.polewards[c], _moved(shape[POLEWARDS], qd))
        pull = _resisted(wall, slide, combine(change, -slide.across, turns))
        # of the normal share of the slip, (slip . n) n, the change along n is none along the wall
        pull = combine(pull, -slide.N * slide.g * dot(slide.slip, turns), wall.n)
        for k in range(gen.shape[1]):
            K[k, c] += gen[0, k] * pull[0] + gen[1, k] * pull[1] + gen[2, k] * pull[2]
        moment = times(slide.arm, cross(turns, drag))
        for k in range(3):
            K[MOMENT + k, c] -= moment[k]
        for m in range(qd.shape[0]):
            a, p = dot(column(shape[AROUND], m), drag), dot(column(shape[POLEWARDS], m), drag)
            K[RIGID + m, c] += wall.around[c] * a + wall.polewards[c] * p


@part
def _to_frame(M, pw):
    """Turn a matrix of the pocket's axes to the ball's frame."""
    n = M.shape[0]
    for at in range(0, RIGID, TURN):
        for k in range(n):
            put(M[k, at:], turned_back(pw.G, xyz(M[k, at:])))
    for at in range(0, RIGID, MOMENT):
        for k in range(n):
            _put_column(M[at:], k, turned_back(pw.G, column(M[at:], k)))
