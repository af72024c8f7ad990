"""Cage land against a ring land: dry contact where it is nearest, or a film."""

from __future__ import annotations

from math import cos, floor, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.evaluation import APPROACH, DAMPED, NORMAL, RUBBED, SHEARED, STORED
from flexcage.contacts.laws import EXPONENT, N_FRICTION, N_NORMAL, LandFilm, short_bearing
from flexcage.contacts.ring_waves import (
    PLACE,
    RATE,
    furthest,
    no_waves,
    outwards_at,
    push_outwards,
    push_shifted,
    shifted,
    widened,
)
from flexcage.contacts.slices import (
    friction_factors,
    friction_power,
    normal_forces,
    stored_and_damped,
)
from flexcage.core.jit import VECTORISED, outlined, part, zero
from flexcage.core.splines import smooth_weights
from flexcage.core.vectors import add_to, column, combine, cross, dot, minus, plus, times, xyz

NONE, DRY, FILM = 0, 1, 2  # kinds; a film has dry contact beneath it
KINDS = {"none": NONE, "dry": DRY, "film": FILM}


class OtherLand(NamedTuple):
    """The cage's land against the ring that does not guide it, dry: fields as in ``LandData``."""

    kind: int
    inner: int
    clearance: float
    radius: float
    x: np.ndarray
    angle: np.ndarray
    phi: np.ndarray
    phi_max: np.ndarray
    normal: np.ndarray
    friction: np.ndarray
    crest: np.ndarray  # no waves: it counts as rigid
    borne: np.ndarray


class LandData(NamedTuple):
    """Land of the cage on the ring that guides it, or may touch it; and what it may meet on the
    other ring (``other_``: as ``OtherLand`` has it)."""

    kind: int
    inner: int  # 1: the cage rides on the inner ring, 0: inside the outer; no record holds a bool
    clearance: float
    radius: float
    x: np.ndarray  # (2,) axial positions of the two lands
    angle: np.ndarray  # (nl, 2) cos, sin of the stations in the cage frame
    phi: np.ndarray  # (nl, 3, nm) modes at the stations: (x, r, psi)
    phi_max: np.ndarray  # (nm,)
    normal: np.ndarray  # (N_NORMAL,)
    friction: np.ndarray  # (N_FRICTION,)
    viscosity: float  # of the oil in a film
    width: float  # of one land
    crest: np.ndarray  # (N + 1, 2, 2, 3) of the ring's waves, see ``ring_waves``
    borne: np.ndarray  # (N + 1, 2, 3) forces on them
    other_kind: int
    other_clearance: float
    other_radius: float
    other_x: np.ndarray
    other_phi: np.ndarray
    other_phi_max: np.ndarray
    other_normal: np.ndarray


def no_land() -> LandData:
    """That of a bearing without a cage."""
    z, (crest, borne) = np.zeros, no_waves()
    return LandData(
        NONE, 0, 0.0, 0.0, z(2), z((0, 2)), z((0, 3, 0)), z(0), z(N_NORMAL), z(N_FRICTION), 0.0,
        0.0, crest, borne, NONE, 0.0, 0.0, z(2), z((0, 3, 0)), z(0), z(N_NORMAL),
    )  # fmt: skip


def with_other(land: LandData, other: LandData) -> LandData:
    """A cage's land with what it may meet on the other ring."""
    return land._replace(
        other_kind=other.kind, other_clearance=other.clearance, other_radius=other.radius,
        other_x=other.x, other_phi=other.phi, other_phi_max=other.phi_max,
        other_normal=other.normal,
    )  # fmt: skip


class LandWork(NamedTuple):
    """Buffers of the land's contact."""

    u: np.ndarray  # (nl,) radial displacement of the stations by the modes
    d: np.ndarray  # (nl,) penetration of one land's stations
    rise: np.ndarray  # (nl,) its slope there, by station
    span: np.ndarray  # (2 nl, 2) between which places, in stations, there is an extreme of it
    sign: np.ndarray  # (2 nl,) 1: a maximum, -1: a minimum
    place: np.ndarray  # (2 nl,) of the extreme
    depth: np.ndarray  # (2 nl,)
    share: np.ndarray  # (2 nl,) of damping and friction there
    st: np.ndarray  # (nl, 2) force on the cage at the stations, outwards and forwards
    A: np.ndarray  # (3, 3) the cage's attitude in a tilted ring's frame
    seen: np.ndarray  # (8, 3) what else that ring sees of it, see ``land_frame``


def land_work(n_stations: int) -> LandWork:
    n, zeros = n_stations, np.zeros
    return LandWork(
        zeros(n), zeros(n), zeros(n), zeros((2 * n, 2)), zeros(2 * n), zeros(2 * n), zeros(2 * n),
        zeros(2 * n), zeros((n, 2)), zeros((3, 3)), zeros((8, 3)),
    )  # fmt: skip


class LandCage(NamedTuple):
    """The cage as a ring's land meets it: place and motion of its origin in space, and modes."""

    A: np.ndarray  # (3, 3) attitude
    centre: np.ndarray  # (3,)
    velocity: np.ndarray  # (3,)
    spin: np.ndarray  # (3,)
    q: np.ndarray  # (nm,) modal coordinates
    qd: np.ndarray  # (nm,) their rates


class LandRing(NamedTuple):
    """The ring that the cage's land meets, its axis along x: in space, or in its own frame."""

    centre: np.ndarray  # (3,)
    velocity: np.ndarray  # (3,)
    turn: np.ndarray  # (3,) angular velocity


class LandForces(NamedTuple):
    """What lands add to the forces on cage and ring, in space."""

    cage_force: np.ndarray  # (3,)
    cage_moment: np.ndarray  # (3,) about the cage's origin
    modal: np.ndarray  # (nm,) on the cage's modes
    ring_force: np.ndarray  # (3,)
    ring_moment: np.ndarray  # (3,) about the ring's centre


class LandTouch(NamedTuple):
    """An extreme of the penetration round a land, as ``LandWork`` has it."""

    side: int  # 0: the land at -x, 1: at +x
    place: float
    depth: float
    sign: float
    share: float


@part
def land_contact(cage, ring, data, onset, laws, sl, lw, out, sums):
    """Forces of a cage's lands, added to ``out`` (``LandForces``); those at its stations in
    ``lw.st``.

    ``onset``: speeds (2,) at which the lands at -x and +x closed. Dry contact is elastic
    where the penetration round the land has a maximum, less what it would be at minima between
    pressed ones: touches that merge or part do so without a jump, and energy is conserved. It damps
    and rubs at maxima. Modes are interpolated smoothly between their stations: a cage that rolls on
    its land does not feel the stations pass. ``sums``: elastic energy, damping power, friction
    power, film power; then of each land its normal force, and the approach speed where it is
    nearest to the ring.
    """
    zero(sums)
    zero(lw.st)
    if data.kind == NONE:
        return
    if data.kind == FILM:
        _film(cage, ring, data, lw, out, sums)
    dry_contact(cage, ring, data, onset, laws, sl, lw, out, sums)


@part
def other_land(data):
    """What a cage's land meets on the ring that does not guide it."""
    return OtherLand(
        data.other_kind, 1 - data.inner, data.other_clearance, data.other_radius, data.other_x,
        data.angle, data.other_phi, data.other_phi_max, data.other_normal, data.friction,
        data.crest[:0], data.borne[:0],
    )  # fmt: skip


@part
def other_contact(cage, ring, data, onset, laws, sl, lw, out, sums):
    """``land_contact`` of an ``OtherLand``."""
    zero(sums)
    zero(lw.st)
    dry_contact(cage, ring, data, onset, laws, sl, lw, out, sums)


@part
def dry_contact(cage, ring, data, onset, laws, sl, lw, out, sums):
    """The dry part of ``land_contact``, added to its forces and ``sums``."""
    A, offset = cage.A, minus(xyz(cage.centre), xyz(ring.centre))
    # a bound of eccentricity, tilt, modes and the ring's waves: can the land touch?
    reach = sqrt(offset[1] * offset[1] + offset[2] * offset[2])
    reach += (abs(A[1, 0]) + abs(A[2, 0])) * abs(data.x[1])
    for m in range(cage.q.shape[0]):
        reach += data.phi_max[m] * abs(cage.q[m])
    reach += furthest(data.crest, abs(data.x[1]))
    if reach < data.clearance:
        return
    _displaced(data, cage.q, lw.u)
    for side in range(2):
        deepest, pressed = _press(A, data, offset, side, lw)
        count = _find_extremes(A, data, offset, side, deepest, lw)
        for i in range(count):
            _extreme(A, data, offset, side, i, lw)
        if count == 0:  # pressed evenly
            lw.place[0], lw.depth[0], lw.sign[0], count = deepest, lw.d[deepest], 1.0, 1
        _share(count, pressed, lw)
        most = -1.0
        for i in range(count):
            nearest = lw.sign[i] > 0.0 and lw.depth[i] > most
            if lw.sign[i] == 0.0 or (lw.depth[i] <= 0.0 and not nearest):
                continue
            touch = LandTouch(side, lw.place[i], lw.depth[i], lw.sign[i], lw.share[i])
            speed = _touch(touch, cage, ring, data, onset, laws, sl, lw, out, sums)
            if nearest:
                most, sums[APPROACH + side] = lw.depth[i], speed


@part(fastmath=VECTORISED)
def _displaced(data, q, u):
    """Radial displacement u of the stations by the modes."""
    for s in range(u.shape[0]):
        shape = data.phi[s, 1]
        total = 0.0
        for m in range(q.shape[0]):
            total += shape[m] * q[m]
        u[s] = total


@part
def _around(place, n):
    """Station before ``place`` (counted in stations, round the cage), and the share beyond it."""
    first = floor(place)
    return int(first) % n, place - first


@part
def _surface(A, data, side, place, lw):
    """The land at ``place``: its point from the cage's origin, that point's slope by station, and
    its outward direction, in space."""
    n_l = data.angle.shape[0]
    j, t = _around(place, n_l)
    weights, slopes = smooth_weights(t)
    u = du = 0.0
    for k in range(4):
        s = (j + k - 1) % n_l
        u += weights[k] * lw.u[s]
        du += slopes[k] * lw.u[s]
    e, along = _directions(A, place * 2.0 * pi / n_l)
    c = combine(times(data.x[side], column(A, 0)), data.radius + u, e)
    return c, combine(times(du, e), (data.radius + u) * 2.0 * pi / n_l, along), e


@part
def _press(A, data, offset, side, lw):
    """Penetration of a land's stations and its slope; the deepest station, and whether all are
    pressed."""
    deepest, pressed = 0, True
    n_l = data.angle.shape[0]
    middle = times(data.x[side], column(A, 0))
    for s in range(n_l):
        e, along = _turned(A, data.angle[s, 0], data.angle[s, 1])
        radius = data.radius + lw.u[s]
        bend = 0.5 * (lw.u[(s + 1) % n_l] - lw.u[s - 1])
        rise = combine(times(bend, e), radius * 2.0 * pi / n_l, along)
        lw.d[s], lw.rise[s] = _within(data, offset, side, combine(middle, radius, e), rise)
        if lw.d[s] > lw.d[deepest]:
            deepest = s
        pressed = pressed and lw.d[s] > 0.0
    return deepest, pressed


@part
def _find_extremes(A, data, offset, side, deepest, lw):
    """Where the penetration round a land has extremes, as far as it may be pressed there or is the
    nearest to it: lw.span and lw.sign; their number.

    Between two stations it is a cubic, or very nearly so: one extreme where its slope changes
    sign, two where it does so on the way.
    """
    n_l, count = lw.d.shape[0], 0
    for s in range(n_l):
        following = (s + 1) % n_l
        here, there = lw.rise[s], lw.rise[following]
        bulge = 0.25 * (abs(here) + abs(there))
        near = s == deepest or following == deepest
        if not near and max(lw.d[s], lw.d[following]) + bulge <= 0.0:
            continue
        rises, turn = here > 0.0, 0.0
        if rises == (there > 0.0):
            cubic = 3.0 * (here + there - 2.0 * (lw.d[following] - lw.d[s]))
            square = there - here - cubic
            turn = -0.5 * square / cubic if cubic != 0.0 else 0.0
            if not 0.0 < turn < 1.0 or (here + 0.5 * square * turn > 0.0) == rises:
                continue
            if (_depth(A, data, offset, side, s + turn, lw)[1] > 0.0) == rises:
                continue
            lw.span[count, 0], lw.span[count, 1] = s, s + turn
            lw.sign[count] = 1.0 if rises else -1.0
            rises, count = not rises, count + 1
        lw.span[count, 0], lw.span[count, 1] = s + turn, s + 1.0
        lw.sign[count] = 1.0 if rises else -1.0
        count += 1
    return count


@outlined
def _depth(A, data, offset, side, place, lw):
    """Penetration at ``place`` round the land, and its slope by station."""
    c, rise, _ = _surface(A, data, side, place, lw)
    return _within(data, offset, side, c, rise)


@part
def _outwards(data):
    """1 if the ring pushes the cage outwards where they touch, -1 inwards."""
    return 1.0 if data.inner != 0 else -1.0


@part
def _within(data, offset, side, c, rise):
    """Penetration of a point c of a land into the ring, and its slope where c's is ``rise``."""
    y, z = offset[1] + c[1], offset[2] + c[2]
    d = sqrt(y * y + z * z)
    out = _outwards(data)
    ring = data.radius - out * data.clearance
    # d = out (R_ring + its waves - distance of c from the ring's axis)
    if data.crest.shape[0] == 0:
        return out * (ring - d), -out * (y * rise[1] + z * rise[2]) / d
    moved, slope, _ = outwards_at(data.crest, data.x[side], y, z)
    turn = (y * rise[2] - z * rise[1]) / (d * d)
    return out * (ring + moved - d), out * (slope * turn - (y * rise[1] + z * rise[2]) / d)


@part
def _extreme(A, data, offset, side, i, lw):
    """Place and depth of extreme i of the penetration: false position, the end that stays counted
    by half each time (the Illinois method), and never quite at an end."""
    first, last, up = lw.span[i, 0], lw.span[i, 1], lw.sign[i] > 0.0
    depth, rise = _depth(A, data, offset, side, first, lw)
    _, fall = _depth(A, data, offset, side, last, lw)
    for _ in range(60):
        if last - first < 1e-9:
            break
        share = rise / (rise - fall) if rise != fall else 0.5
        place = first + min(max(share, 0.02), 0.98) * (last - first)
        here, slope = _depth(A, data, offset, side, place, lw)
        if (slope > 0.0) == up:
            first, depth, rise, fall = place, here, slope, 0.5 * fall
        else:
            last, rise, fall = place, 0.5 * rise, slope
    lw.place[i], lw.depth[i] = first, depth


@part
def _share(count, pressed, lw):
    """How much of damping and friction each of a land's maxima has: the less the deeper it is still
    pressed towards a deeper one, so that nothing jumps when they merge. The least of a land that is
    pressed all round is no minimum between others: its sign becomes zero."""
    least = -1
    for i in range(count):
        lw.share[i] = max(lw.sign[i], 0.0)
        if lw.sign[i] < 0.0 and (least < 0 or lw.depth[i] < lw.depth[least]):
            least = i
    if pressed and least >= 0:
        lw.sign[least] = 0.0
    for i in range(count):
        if lw.sign[i] < 0.0 and lw.depth[i] > 0.0:
            before, after = (i - 1) % count, (i + 1) % count
            lower = before if lw.depth[before] < lw.depth[after] else after
            lw.share[lower] = max(lw.share[lower] - lw.depth[i] / lw.depth[lower], 0.0)


@part
def _directions(A, angle):
    """Outward and forward directions at an angle round the cage, in space."""
    return _turned(A, cos(angle), sin(angle))


@part
def _turned(A, ca, sa):
    """The same for the angle's cosine and sine."""
    y, z = column(A, 1), column(A, 2)
    return combine(times(ca, y), sa, z), combine(times(ca, z), -sa, y)


@part
def _touch(touch, cage, ring, data, onset, laws, sl, lw, out, sums):
    """Forces where a land touches; the speed of approach there. Four stations' modes."""
    A, qd, place = cage.A, cage.qd, touch.place
    offset = minus(xyz(cage.centre), xyz(ring.centre))
    sl.d[0] = touch.depth
    n_l = data.angle.shape[0]
    j, t = _around(place, n_l)
    weights, _ = smooth_weights(t)
    outwards = forwards = 0.0  # velocity of the surface by the modes
    for k in range(4):
        shape = data.phi[(j + k - 1) % n_l]
        for m in range(qd.shape[0]):
            outwards += weights[k] * shape[1, m] * qd[m]
            forwards += weights[k] * shape[2, m] * qd[m]
    c, _, e = _surface(A, data, touch.side, place, lw)
    _, along = _directions(A, place * 2.0 * pi / n_l)
    at = plus(offset, c)
    size = _outwards(data) / sqrt(at[1] * at[1] + at[2] * at[2])
    n = (0.0, size * at[1], size * at[2])  # on the cage, in the plane of rotation
    ahead, x, rate = (0.0, -n[2], n[1]), data.x[touch.side], 0.0
    if data.crest.shape[0] > 0:  # it leans where the ring's radius changes along it
        _, slope, rate = outwards_at(data.crest, x, at[1], at[2])
        n = combine(n, -slope * abs(size), ahead)
    # velocity of the rigid land less that of the ring's material there, across the ring's axis
    v = plus(minus(xyz(cage.velocity), xyz(ring.velocity)), cross(xyz(cage.spin), c))
    w = ring.turn
    v = (0.0, v[1] + w[0] * at[2] - w[2] * at[0], v[2] - w[0] * at[1] + w[1] * at[0])
    sl.v[0] = -(dot(n, v) + dot(n, e) * outwards) + _outwards(data) * rate
    if sl.d[0] <= 0.0:
        return sl.v[0]
    normal_forces(laws.normal, (0, 1), sl, data.normal, onset[touch.side])
    # on the cage: f = N n - mu N along the circumference, by its sliding there
    N = touch.sign * sl.Ne[0] + touch.share * (sl.N[0] - sl.Ne[0])
    rubs = touch.share * sl.N[0]
    slide = dot(ahead, combine(plus(v, times(outwards, e)), forwards, along))
    sl.u[0] = abs(slide)
    friction_factors(laws.friction, (0, 1), sl, data.friction)
    g = sl.g[0] * slide
    f = combine(times(N, n), -rubs * g, ahead)
    add_to(out.cage_force, f)
    add_to(out.ring_force, times(-1.0, f))
    add_to(out.cage_moment, cross(c, f))
    add_to(out.ring_moment, cross(f, at))
    push_outwards(data.borne, x, at[1], at[2], -_outwards(data) * N)
    radial, rubbed = dot(f, e), -rubs * g * dot(ahead, along)  # the depth knows radial modes alone
    for k in range(4):
        s = (j + k - 1) % n_l
        _push_modes(weights[k] * radial, weights[k] * rubbed, data.phi[s], out.modal)
        lw.st[s, 0] += weights[k] * radial
        lw.st[s, 1] += weights[k] * dot(f, along)
    energy, damped = stored_and_damped((0, 1), sl, data.normal[EXPONENT])
    sums[NORMAL + touch.side] += N
    sums[STORED] += touch.sign * energy
    sums[DAMPED] += touch.share * damped
    sums[RUBBED] += touch.share * friction_power((0, 1), sl)
    return sl.v[0]


@part(fastmath=VECTORISED)
def _push_modes(radial, tangential, shape, Qm):
    """Add to Qm what a force at a station with ``shape`` (3, n) does to the modes."""
    for m in range(Qm.shape[0]):
        Qm[m] += radial * shape[1, m] + tangential * shape[2, m]


@part
def _spread_film(A, data, film, qd, lw, modal, sums):
    """A film's force ``film`` (y, z) as pressure round the half of the land that it pushes, by the
    cosine, and its torque, the third, evenly: on the stations, on the modes, and the power of
    these."""
    fy, fz, torque = film
    n_l, size, out = data.angle.shape[0], sqrt(fy * fy + fz * fz), _outwards(data)
    total = 0.0
    for s in range(n_l):
        e, _ = _directions(A, s * 2.0 * pi / n_l)
        lw.d[s] = max(out * (fy * e[1] + fz * e[2]), 0.0)
        total += lw.d[s] * lw.d[s]
    for s in range(n_l):
        radial = out * size * size * lw.d[s] / total if total > 0.0 else 0.0
        tangential = torque / (n_l * data.radius)
        shape = data.phi[s]
        _push_modes(radial, tangential, shape, modal)
        lw.st[s, 0] += radial
        lw.st[s, 1] += tangential
        for m in range(qd.shape[0]):
            sums[SHEARED] += (radial * shape[1, m] + tangential * shape[2, m]) * qd[m]


@outlined
def _film(cage, ring, data, lw, out, sums):
    """Short-bearing film on both lands: whirl and squeeze of a rigid cage included."""
    A, (w0, w1, w2), (spin, r1, r2) = cage.A, xyz(cage.spin), xyz(ring.turn)
    rel = minus(xyz(cage.velocity), xyz(ring.velocity))
    for side in range(2):
        x, cy, cz = times(data.x[side], column(A, 0))  # of the land's middle, from the cage's
        lever, ey, ez = minus(plus(xyz(cage.centre), (x, cy, cz)), xyz(ring.centre))
        vy = rel[1] + w2 * data.x[side] * A[0, 0] - w0 * cz - r2 * lever
        vz = rel[2] + w0 * cy - w1 * data.x[side] * A[0, 0] + r1 * lever
        clearance = data.clearance - _outwards(data) * widened(data.crest, data.x[side])
        film = LandFilm(data.viscosity, data.width, data.radius, clearance)
        sy, sz = shifted(data.crest, data.x[side], PLACE)
        ry, rz = shifted(data.crest, data.x[side], RATE)
        vy, vz = vy - ry, vz - rz
        # eccentricity and its rate from the ring's circle; half-Sommerfeld film
        fy, fz, size = short_bearing(film, (ey - sy, ez - sz), (vy, vz), spin + w0, abs(spin - w0))
        torque = size if spin > w0 else -size
        _spread_film(A, data, (fy, fz, torque), cage.qd, lw, out.modal, sums)
        add_to(out.cage_force, (0.0, fy, fz))
        add_to(out.ring_force, (0.0, -fy, -fz))
        push_shifted(data.borne, data.x[side], -fy, -fz)
        add_to(out.cage_moment, (torque + cy * fz - cz * fy, -x * fz, x * fy))
        add_to(out.ring_moment, (-torque - ey * fz + ez * fy, lever * fz, -lever * fy))
        sums[SHEARED] += fy * vy + fz * vz + torque * (w0 - spin)
        sums[SHEARED] -= spin * (ey * fz - ez * fy)
