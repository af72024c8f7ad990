"""Ball in its pocket: a cylinder about a radial axis, or a sphere, in a cage that deforms.

The pocket may be a slot (its axis drawn out to a line), larger or displaced. A sphere ends at rims,
at bore and outside and, in ribbon and crown cages, at its open sides; there the ball touches the
rim's nearest point. What a bent claw moved is a displacement of the stations that the cage has
without stress. A ball that sinks straight into a round rim touches all of it: over a distance of
``SEAT`` across, the sideways push turns from one side to the other. The wall's motion by the cage's
modes is known at stations round the pocket and interpolated smoothly between them; towards a
sphere's poles it fades into the mean of all stations. What modes do not carry of a wall's yielding
is a compliance of each station, in series with the contact's own. Forces are slopes of one energy:
where the wall's displacement or compliance changes round the pocket, the force is inclined.
"""

from __future__ import annotations

from math import atan2, floor, pi, sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.evaluation import ANGLE, APPROACH, DAMPED, REPORT, RUBBED, STORED
from flexcage.contacts.laws import EXPONENT, N_FRICTION, N_NORMAL, STIFFNESS
from flexcage.contacts.slices import (
    friction_factors,
    friction_power,
    normal_forces,
)
from flexcage.contacts.state import add_force_and_moment
from flexcage.core.jit import part, zero
from flexcage.core.splines import smooth_weights
from flexcage.core.vectors import combine, cross, dot, minus, plus, row, times, xyz

ITERATIONS = 8  # of Newton's method for a contact and a compliance in series
POLAR = 0.3  # cosine of the latitude from which on a sphere's wall moves as its stations do
SEAT = 1e-3  # of the ball's radius, see above: with less the push would be stiffer than a contact
NARROW = 0.1  # of the pocket's play, the most that a seat may be

CYLINDER, SPHERE = range(2)  # shapes of pockets


class BallPockets(NamedTuple):
    """All pockets of a cage."""

    azimuth: np.ndarray  # (Z, 2) cos, sin of their middles in the cage
    shift: np.ndarray  # (Z, 2) of the axis, axially and along the circumference
    slot: np.ndarray  # (Z, 2) half of the axis' length, if it is drawn out, likewise
    radius: np.ndarray  # (Z,)
    height: float  # radius of the spheres' middles
    wall: np.ndarray  # (2,) inner and outer radius of the cage's wall
    shape: int  # CYLINDER or SPHERE
    rims: np.ndarray  # (Z, 2) sines of latitude at which spheres end: outwards, inwards
    sides: np.ndarray  # (Z, 2) the same: towards +x, towards -x
    offset: np.ndarray  # (Z, nst, 3) where stations are without stress, from the pocket's shape
    inset: float  # largest of these
    phi: np.ndarray  # (Z, 1, nst, 3, nm) modes at the stations (x, r, psi), from +psi towards +x
    phi_max: np.ndarray  # (nm,) largest displacement of a wall along its normal
    local: np.ndarray  # (Z, nst) compliance beyond the modes
    normal: np.ndarray  # (Z, N_NORMAL)
    friction: np.ndarray  # (N_FRICTION,)


class BallPocketWork(NamedTuple):
    """Buffers of one pocket, of n modes. Those of its tangent (``ball_pocket_tangent``) have rows
    and columns for the ball's translation and rotation, then the modes."""

    G: np.ndarray  # (3, 3) rows: the pocket's x, r, psi
    st: np.ndarray  # (1, nst, 3) station forces on the cage
    normal: np.ndarray  # (1,) normal force
    tangential: np.ndarray  # (1,) friction force
    K: np.ndarray  # (6 + n, 6 + n) minus the forces' slopes over places
    C: np.ndarray  # (6 + n, 6 + n) minus those over velocities
    gen: np.ndarray  # (7, 6 + n) generators
    bend: np.ndarray  # (3, 6 + n) how the depth's slope over the ball's place changes
    softer: np.ndarray  # (3, 3) how that of the wall's compliance does, over the place
    shape: np.ndarray  # (3, 3, n) modes where the ball touches, and their slopes


class BallInPocket(NamedTuple):
    """A ball as its pocket meets it, in the ball's frame."""

    radius: float
    centre: tuple[float, float, float]  # from the cage's origin
    velocity: tuple[float, float, float]  # less that of the cage's body there
    spin: tuple[float, float, float]  # angular velocity less the cage's
    onset: float  # speed at which the contact closed


def no_ball_pockets(count: int) -> BallPockets:
    """Those of so many balls without a cage: nowhere is a wall."""
    z, n = np.zeros, count
    return BallPockets(
        azimuth=z((n, 2)), shift=z((n, 2)), slot=z((n, 2)), radius=np.full(n, np.inf), height=0.0,
        wall=np.array([0.0, np.inf]), shape=CYLINDER, rims=z((n, 2)), sides=z((n, 2)),
        offset=z((n, 0, 3)), inset=0.0, phi=z((n, 1, 0, 3, 0)), phi_max=z(0), local=z((n, 0)),
        normal=z((n, N_NORMAL)), friction=z(N_FRICTION),
    )  # fmt: skip


def ball_pocket_work(stations: int, modes: int) -> BallPocketWork:
    n, z = 6 + modes, np.zeros
    return BallPocketWork(
        z((3, 3)), z((1, stations, 3)), z(1), z(1), z((n, n)), z((n, n)), z((7, n)), z((3, n)),
        z((3, 3)), z((3, 3, modes)),
    )  # fmt: skip


@part
def pocket_wall_contact(i, ball, modes, data, laws, sl, pw, wrench, mode, sums):
    """Wrench of pocket i's wall on its ball (``BallInPocket``), added to ``wrench``, and station
    forces in ``pw.st``.

    ``modes``: the cage's (``state.CageModes``). From REPORT on ``sums``: elastic energy, power of
    damping and friction, direction of the contact from +psi towards +x, and the speed at which
    ball and wall approach.
    """
    pw.normal[0] = pw.tangential[0] = 0.0
    if mode >= REPORT:
        zero(sums)
    rb, D, v = ball.radius, ball.centre, ball.velocity
    p, sphere = data.normal[i], data.shape == SPHERE
    # in pocket axes (x, r, psi): n from the ball's centre to the nearest point of the wall
    (x, h, t), seat = from_middle(i, rb, D, data, pw)
    n, distance, touch = nearest_wall((x, h, t), data.radius[i], rim_there(i, x, h, data), seat)
    if distance == 0.0:
        return False
    if mode >= REPORT:
        sums[ANGLE] = atan2(n[0], n[2])
        sums[APPROACH] = _along(n, v, pw)
    if rb - distance + modes.margin + data.inset <= 0.0:
        return False
    # the wall at the contact's azimuth: displacement u, its slope and rate, compliance
    nst = data.phi.shape[2]
    place = atan2(n[0], n[2]) * nst / (2.0 * pi)
    first = floor(place)
    weight, slope = smooth_weights(place - first)
    u = du = ud = (0.0, 0.0, 0.0)
    soft = softer = 0.0
    for k in range(4):
        s = (int(first) + k - 1 + nst) % nst
        here, rate = _place(data, i, s, modes.q), _wall(data, i, s, modes.qd)
        u, ud = combine(u, weight[k], here), combine(ud, weight[k], rate)
        du = combine(du, slope[k] * nst / (2.0 * pi), here)
        soft += weight[k] * data.local[i, s]
        softer += slope[k] * nst / (2.0 * pi) * data.local[i, s]
    # fading towards a pole: what changes with azimuth, and with the cosine of the latitude
    cosine = sqrt(n[0] * n[0] + n[2] * n[2])
    share, fade = share_at_pole(cosine)
    faded, fading = (0.0, 0.0, 0.0), 0.0
    if share < 1.0:
        mean, rate, yielding = _mean_wall(data, i, modes)
        faded, fading = times(fade, minus(u, mean)), fade * (soft - yielding)
        u = combine(times(share, u), 1.0 - share, mean)
        ud = combine(times(share, ud), 1.0 - share, rate)
        soft = share * soft + (1.0 - share) * yielding
        du, softer = times(share, du), share * softer
    depth = rb - distance - dot(u, n)  # d = r_ball - distance - n . u
    if depth <= 0.0:
        return False
    # slope of the depth: along n, and as the wall's displacement changes there
    across = (u[0], u[1] if sphere else 0.0, u[2])
    push = minus(n, turning(across, n, distance, touch))
    round_it = polewards = (0.0, 0.0, 0.0)  # slopes of the azimuth and of that cosine
    if cosine > 0.0:
        round_it = times(1.0 / (cosine * cosine), turning((n[2], 0.0, -n[0]), n, distance, touch))
        polewards = times(1.0 / cosine, turning((n[0], 0.0, n[2]), n, distance, touch))
        push = combine(push, -dot(du, n), round_it)
        push = combine(push, -dot(faded, n), polewards)
    yields = combine(times(softer, round_it), fading, polewards)  # slope of the compliance
    dx, dt = beyond_straight(i, x, t, data)
    push = (dx * push[0], push[1], dt * push[2])
    yields = (dx * yields[0], yields[1], dt * yields[2])
    rate = _along(push, v, pw) - dot(ud, n)
    softening = _along(yields, v, pw)
    N, pressed = _press(depth, rate, soft, softening, p, ball.onset, laws.normal, sl)
    if mode >= REPORT:
        Ne = sl.Ne[0]
        sums[STORED] = Ne * pressed / (p[EXPONENT] + 1.0) + 0.5 * soft * Ne * Ne
        sums[DAMPED] = -(N - Ne) * (rate - 0.5 * (N + Ne) * softening)
    if N <= 0.0:
        return True
    # friction, where the ball touches the wall
    nF = _in_frame(n, pw)
    arm = times(rb, nF)
    slip = minus(plus(v, cross(ball.spin, arm)), _in_frame(ud, pw))
    slip = combine(slip, -dot(slip, nF), nF)
    sl.u[0] = sqrt(dot(slip, slip))
    sl.N[0] = N
    friction_factors(laws.friction, (0, 1), sl, data.friction)
    drag = times(-N * sl.g[0], slip)
    # on the ball, in F: -mu N along the slip, -N grad d, + N^2/2 grad compliance
    total = combine(drag, -N, _in_frame(push, pw))
    total = combine(total, 0.5 * N * N, _in_frame(yields, pw))
    moment = cross(arm, drag)
    add_force_and_moment(wrench, total, moment)
    on_wall = (
        N * n[0] - dot(drag, row(pw.G, 0)),
        N * n[1] - dot(drag, row(pw.G, 1)),
        N * n[2] - dot(drag, row(pw.G, 2)),
    )
    zero(pw.st)
    for k in range(4):
        s = (int(first) + k - 1 + nst) % nst
        for c in range(3):
            pw.st[0, s, c] += share * weight[k] * on_wall[c]
    if share < 1.0:
        for s in range(nst):
            for c in range(3):
                pw.st[0, s, c] += (1.0 - share) / nst * on_wall[c]
    pw.normal[0], pw.tangential[0] = N, N * sl.g[0] * sl.u[0]
    if mode >= REPORT:
        sums[RUBBED] = friction_power((0, 1), sl)
    return True


@part
def from_middle(i, rb, D, data, pw):
    """Place (x, r, psi) of a ball of radius rb from the middle of pocket i, or from the nearest
    point of its axis, drawn out or not; D is that from the cage. And the width of its seat."""
    x, t = dot(D, row(pw.G, 0)) - data.shift[i, 0], dot(D, row(pw.G, 2)) - data.shift[i, 1]
    sphere = data.shape == SPHERE
    h = dot(D, row(pw.G, 1)) - data.height if sphere else 0.0
    x -= min(max(x, -data.slot[i, 0]), data.slot[i, 0])
    t -= min(max(t, -data.slot[i, 1]), data.slot[i, 1])
    return (x, h, t), min(SEAT * rb, NARROW * (data.radius[i] - rb)) if sphere else 0.0


@part
def beyond_straight(i, x, t, data):
    """1 along x and psi where the ball is beyond the straight part of a slot, along which nothing
    changes; 0 within it."""
    dx = 0.0 if x == 0.0 and data.slot[i, 0] > 0.0 else 1.0
    dt = 0.0 if t == 0.0 and data.slot[i, 1] > 0.0 else 1.0
    return dx, dt


@part
def rim_there(i, x, h, data):
    """Sines of the latitudes at which the wall ends on the ball's side, along r and along x."""
    high = data.rims[i, 0] if h >= 0.0 else data.rims[i, 1]
    return high, data.sides[i, 0] if x >= 0.0 else data.sides[i, 1]


@part
def nearest_wall(d, radius, rim, seat):
    """Where a ball at ``d`` from its pocket's middle is nearest to the wall, (x, r, psi).

    ``rim`` is that of ``rim_there``. Returns the direction from the ball's centre to the wall
    (shorter than 1 within a seat), the distance, and the wall's place there for ``turning``: which
    coordinates a rim holds (0 or 1), the direction of the others and their distance from the
    pocket's middle, and how much farther off the wall is. The middle of the pocket itself has
    distance 0 and means nothing.
    """
    high, wide = rim
    held_x, held_r = _on_rims(d, high, wide, seat)
    ex, er = held_x * (wide * radius - abs(d[0])), held_r * (high * radius - abs(d[1]))
    level = 1.0 - held_x * wide * wide - held_r * high * high  # of a circle on the sphere
    a = ((1.0 - held_x) * d[0], (1.0 - held_r) * d[1], d[2])
    reach = sqrt(dot(a, a) + seat * seat)
    off = sqrt(max(level, 0.0)) * radius - reach
    distance = sqrt(ex * ex + er * er + off * off)
    if reach == 0.0 or distance == 0.0:
        return (0.0, 0.0, 0.0), 0.0, (held_x, held_r, a, 1.0, off)
    f = times(1.0 / reach, a)
    n = times(off / distance, f)
    n = (
        n[0] + (ex if d[0] >= 0.0 else -ex) / distance,
        n[1] + (er if d[1] >= 0.0 else -er) / distance,
        n[2],
    )
    return n, distance, (held_x, held_r, f, reach, off)


@part
def _on_rims(d, high, wide, seat):
    """Whether the nearest point of a sphere's wall lies on a rim along x, and on one along r.

    ``high`` and ``wide``: sines of the latitudes at which the wall ends that way; over 1 nowhere.
    """
    x, r, tt = abs(d[0]), abs(d[1]), d[2] * d[2] + seat * seat
    reach = sqrt(x * x + r * r + tt)
    past_r, past_x = r > high * reach, x > wide * reach
    if not (past_r or past_x):
        return 0.0, 0.0
    # along the one rim alone: is the other passed then?
    at_r = at_x = -1.0
    if past_r:
        level = sqrt(1.0 - high * high)
        round_it = sqrt(x * x + tt)
        if level * x <= wide * round_it:
            at_r = high * r + level * round_it
    if past_x:
        level = sqrt(1.0 - wide * wide)
        round_it = sqrt(r * r + tt)
        if level * r <= high * round_it:
            at_x = wide * x + level * round_it
    if at_r < 0.0 and at_x < 0.0:
        return 1.0, 1.0
    if at_r >= at_x:
        return 0.0, 1.0
    return 1.0, 0.0


@part
def turning(a, n, distance, touch):
    """Slope of ``n . a`` over the ball's place, for a constant vector: the distance's second
    derivatives, less those of a wall that goes with the ball."""
    held_x, held_r, f, reach, off = touch
    free = ((1.0 - held_x) * a[0], (1.0 - held_r) * a[1], a[2])
    along = dot(f, free)
    bent = combine(times(along + off / reach * along, f), -off / reach, free)
    bent = (bent[0] + held_x * a[0], bent[1] + held_r * a[1], bent[2])
    return times(-1.0 / distance, combine(bent, -dot(n, a), n))


@part
def _wall(data, i, s, q):
    """Displacement of station s of pocket i by modal coordinates q, or its rate by theirs."""
    x = r = psi = 0.0
    for m in range(q.shape[0]):
        x += data.phi[i, 0, s, 0, m] * q[m]
        r += data.phi[i, 0, s, 1, m] * q[m]
        psi += data.phi[i, 0, s, 2, m] * q[m]
    return x, r, psi


@part
def _place(data, i, s, q):
    """Displacement of station s of pocket i from the pocket's shape, with what it has without
    stress."""
    return plus(_wall(data, i, s, q), xyz(data.offset[i, s]))


@part
def share_at_pole(cosine):
    """Share of the wall's motion that is as at the azimuth, and its slope over the cosine."""
    x = cosine / POLAR
    if x >= 1.0:
        return 1.0, 0.0
    return x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / POLAR


@part
def _mean_wall(data, i, modes):
    """Means over the stations of pocket i: displacement, its rate, compliance."""
    u = ud = (0.0, 0.0, 0.0)
    soft, nst = 0.0, data.phi.shape[2]
    for s in range(nst):
        u = combine(u, 1.0 / nst, _place(data, i, s, modes.q))
        ud = combine(ud, 1.0 / nst, _wall(data, i, s, modes.qd))
        soft += data.local[i, s] / nst
    return u, ud, soft


@part
def _in_frame(a, pw):
    """A vector of the pocket's axes in the ball's frame."""
    first = combine(times(a[0], row(pw.G, 0)), a[1], row(pw.G, 1))
    return combine(first, a[2], row(pw.G, 2))


@part
def _along(a, v, pw):
    """Component along ``a`` (pocket's axes) of a vector in the ball's frame."""
    return dot(_in_frame(a, pw), v)


@part
def _press(depth, rate, soft, softening, p, onset, law, sl):
    """Force of a contact in series with a compliance, and the contact's own depth.

    Both bear the elastic force of the contact's own depth d: d + soft K d^n = depth; ``rate`` and
    ``softening`` are those of depth and compliance.
    """
    d, stiff = depth, 0.0
    if soft > 0.0:
        for _ in range(ITERATIONS):
            power = p[STIFFNESS] * d ** (p[EXPONENT] - 1.0)
            stiff = soft * p[EXPONENT] * power
            step = (d + soft * power * d - depth) / (1.0 + stiff)
            d -= step
            if abs(step) < 1e-15:
                break
        d = max(d, 0.0)
        stiff = soft * p[EXPONENT] * p[STIFFNESS] * d ** (p[EXPONENT] - 1.0)
    force = p[STIFFNESS] * d ** p[EXPONENT]
    sl.d[0], sl.v[0] = d, (rate - force * softening) / (1.0 + stiff)
    normal_forces(law, (0, 1), sl, p, onset)
    return sl.N[0], d
