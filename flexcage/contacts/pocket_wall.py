"""The deformed walls of a pocket: where they are under every slice, and how they move.

Dynamic modes are read at a few stations per face and interpolated smoothly (a wall with kinks has
no equilibrium on them), and forces go back to the same stations with the same weights; a defect's
offset is known on a finer grid. One more station at either end goes on straight, so that every
slice reads four. What pockets add by residual (quasi-static) flexibility is in ``condensation``.
"""

from __future__ import annotations

from math import floor
from typing import Any, NamedTuple

import numpy as np

from flexcage.contacts.laws import N_FRICTION, N_NORMAL
from flexcage.contacts.slices import CAPACITY, largest
from flexcage.contacts.state import CageModes, RollerPose
from flexcage.core.jit import VECTORISED, part
from flexcage.core.splines import smooth_weights
from flexcage.core.vectors import RIGID, dot, row

N_LOCAL = 12  # residual coordinates of a pocket: uniform, linear and quadratic on four faces
N_FACE = 6  # the softest of those that move one face
FRONT, REAR, PLUS_X, MINUS_X = range(4)  # faces: two crossbeams, two side beams
SIDES = PLUS_X  # the first face that is a side beam
FACES = 4
LAST = 3  # of the four stations that a slice reads
BLOCK = 8  # slices that are looked at together
SLACK = 0.1  # of a penetration, by which the residual deflection may bring slices to the roller


class PocketData(NamedTuple):
    """All pockets of a cage: faces 0 front, 1 rear, 2 side +x, 3 side -x."""

    azimuth: np.ndarray  # (Z, 2) cos, sin of pocket azimuths in the cage frame
    place: np.ndarray  # (Z,) of their middles along the cage's axis
    half: np.ndarray  # (2,) half width, half length of a pocket
    s: np.ndarray  # (ns,) slice positions along the roller
    drop: np.ndarray  # (ns,)
    points: np.ndarray  # (np, 2) points of a roller's end: along its two transverse axes
    half_roller: float  # half of the roller's overall length
    middle: float  # place of mid-length on the roller's axis, from its centre
    x0: np.ndarray  # (4,) first station
    dx: np.ndarray  # (4,) station spacing
    offset: np.ndarray  # (Z, 4, no) stress-free outward offset, on a grid of its own
    grid: np.ndarray  # (2, 4) first point and spacing of that grid
    low: np.ndarray  # (Z, 4) least offset of a face
    bent: np.ndarray  # (Z, 4) 1 if a face has any offset
    phi: np.ndarray  # (Z, 4, nst, 3, nm)
    phi_max: np.ndarray  # (nm,) largest normal value over all stations
    rows: np.ndarray  # (Z, 4, 3, n4, n8) phi for ``read_stations``, filled up with zeros
    soft: int  # 1 if pockets have residual flexibility
    res: np.ndarray  # (Z, 4, nst + 2, 12) residual shapes of unit compliance, with the end stations
    res_max: np.ndarray  # (Z, 4, 12) their largest values
    most: np.ndarray  # (Z, 12) those of all faces
    own: np.ndarray  # (Z, 4, nst + 2, 6) the same in a face's own coordinates
    own_max: np.ndarray  # (Z, 4, 6) their largest values
    turn: np.ndarray  # (Z, 4, 6, 12) those coordinates from the pocket's
    root: np.ndarray  # (Z, 12, 12) residual coordinates of the modal basis from those of the shapes
    normal: np.ndarray  # (2, N_NORMAL) of a slice of crossbeams, a point of side beams
    friction: np.ndarray  # (2, N_FRICTION) likewise


FACE = np.dtype(
    [
        ("d0", np.float64, CAPACITY),  # penetration before the residual deflection
        ("top", np.float64, CAPACITY // BLOCK),  # its largest value of every block of slices
        ("slope", np.float64, CAPACITY),  # of the wall's offset along the face
        ("x", np.float64, CAPACITY),  # place on the wall, in stations
        ("j", np.int64, CAPACITY),  # first of the four stations that a slice reads
        ("w", np.float64, (4, CAPACITY)),  # their weights
        ("ws", np.float64, (4, CAPACITY)),  # slopes of the weights along the face [1/m]
        ("R", np.float64, (N_LOCAL, CAPACITY)),  # residual shapes under the slices
        ("rate", np.float64, (3, CAPACITY)),  # velocity of the wall there (x, r, psi)
        ("read", np.float64, CAPACITY),  # what slices have read
        ("j_least", np.int64),  # of the span
        ("j_most", np.int64),
    ],
    align=True,
)


class PocketWork(NamedTuple):
    """Buffers of one pocket; n slices or points, nst stations."""

    G: np.ndarray  # (3, 3) rows: pocket axes x, r, psi in F
    face: np.ndarray  # (4,) records FACE
    near: np.ndarray  # (4,) face may touch
    span: np.ndarray  # (4, 2) first slice or point that may, and the one after the last; unsigned,
    # as a compiler cannot tell that a signed place is not one from the end
    live: np.ndarray  # (4,) face is touched, or pushed to by the deflection of another
    deep: np.ndarray  # (4,) largest penetration before the residual deflection; not near: a bound
    rest: np.ndarray  # (4,) bound of that of what is left out of the span; not near: of all
    push: np.ndarray  # (4,) the most by which the residual deflection may add to them
    wall: np.ndarray  # (3, n4 + 2) displacement or velocity (x, r, psi) of a face's stations
    deflection: np.ndarray  # (4, nst + 2) residual deflection of the faces' stations
    spread: np.ndarray  # (3, nst + 2) forces on a face's stations
    st: np.ndarray  # (4, nst, 3) forces on the cage, pocket axes
    normal: np.ndarray  # (4,) sums of the faces
    tangential: np.ndarray  # (4,)
    slice_N: np.ndarray  # (2, ns) of the crossbeams
    slice_T: np.ndarray  # (2, ns)
    point_N: np.ndarray  # (2, np) of the side beams
    point_T: np.ndarray  # (2, np)
    b: np.ndarray  # (12,) residual coordinates
    size: np.ndarray  # (1,) coordinates in use: 12, or 6 of a face that is touched alone
    c: np.ndarray  # (12,) those coordinates
    g: np.ndarray  # (12,) right-hand side of the condensation
    A: np.ndarray  # (12, 12) 1 + R^T H R, then its factors
    h: np.ndarray  # (ROOM,) products; slopes of the elastic forces for the tangent
    gen: np.ndarray  # (4, n) generators of a slice: normal, two tangents, all of its force (WHOLE)
    K: np.ndarray  # (n, n) stiffness of the pocket: roller 6, modes, residual coordinates 12
    C: np.ndarray  # (n, n) damping, zero for residual coordinates


class RollerInPocket(NamedTuple):
    """A roller as its pocket meets it, and what the contact remembers; in F."""

    pose: RollerPose
    radius: float
    centre: np.ndarray  # (3,) from the cage's origin
    onset: np.ndarray  # (4,) speeds at which the faces were met
    guess: np.ndarray  # (12,) residual coordinates to begin with


class CageAtRoller(NamedTuple):
    """Motion of a cage as a roller meets it, in F, and the cage's modes."""

    velocity: np.ndarray  # (3,) of the cage's origin
    spin: np.ndarray  # (3,) angular velocity
    modes: CageModes


class PocketLaws(NamedTuple):
    """Laws of crossbeams and side beams: normal, then friction."""

    crossbeam: Any
    side: Any
    crossbeam_rubs: Any
    side_rubs: Any


def no_pockets(count: int, half_roller: float) -> PocketData:
    """Those of so many rollers, half as long [m] as given, without a cage: nowhere is a wall."""
    z, n, m = np.zeros, count, N_LOCAL
    return PocketData(
        azimuth=z((n, 2)), place=z(n), half=np.full(2, np.inf), s=z(0), drop=z(0), points=z((0, 2)),
        half_roller=half_roller, middle=0.0, x0=z(4), dx=z(4), offset=z((n, 4, 1)), grid=z((2, 4)),
        low=z((n, 4)), bent=z((n, 4), np.int64), phi=z((n, 4, 0, 3, 0)), phi_max=z(0),
        rows=z((n, 4, 3, 0, 0)), soft=0, res=z((n, 4, 0, m)), res_max=z((n, 4, m)), most=z((n, m)),
        own=z((n, 4, 0, N_FACE)), own_max=z((n, 4, N_FACE)), turn=z((n, 4, N_FACE, m)),
        root=z((n, m, m)), normal=z((2, N_NORMAL)), friction=z((2, N_FRICTION)),
    )  # fmt: skip


def pocket_work(n_slices: int, n_points: int, n_stations: int, n_modes: int) -> PocketWork:
    st, z, m = n_stations, np.zeros, N_LOCAL
    whole = filled(RIGID + n_modes + m, 8)
    return PocketWork(
        z((3, 3)), z(4, FACE).view(np.recarray), z(4, np.int64), z((4, 2), np.uint64),
        z(4, np.int64), z(4), z(4), z(4), z((3, filled(st, 4) + 2)), z((4, st + 2)),
        z((3, st + 2)), z((4, st, 3)), z(4), z(4),
        z((2, n_slices)), z((2, n_slices)), z((2, n_points)), z((2, n_points)),
        z(m), z(1, np.int64), z(m), z(m), z((m, m)), z(CAPACITY),
        z((4, whole)), z((whole, whole)), z((whole, whole)),
    )  # fmt: skip


def filled(n: int, whole: int) -> int:
    """n, or the next larger number that is ``whole`` times another."""
    return -(-n // whole) * whole


def modal_rows(phi: np.ndarray) -> np.ndarray:
    """Modes at stations (Z, 4, nst, 3, nm) as (Z, 4, 3, n4, n8): four stations are read at a time,
    and modes fill whole vectors; zeros where there is none."""
    z, faces, n, _, m = phi.shape
    rows = np.zeros((z, faces, 3, filled(n, 4), filled(m, 8)))
    rows[..., :n, :m] = np.swapaxes(phi, 2, 3)
    return rows


def with_end_stations(values: np.ndarray) -> np.ndarray:
    """Station values (..., nst, m) with one more station at either end, straight on."""
    first = 2.0 * values[..., :1, :] - values[..., 1:2, :]
    last = 2.0 * values[..., -1:, :] - values[..., -2:-1, :]
    return np.ascontiguousarray(np.concatenate([first, values, last], axis=-2))


def with_offset(data: PocketData, offset: np.ndarray) -> PocketData:
    """The pockets with other stress-free offsets (Z, 4, no) [m]."""
    offset = np.ascontiguousarray(offset)
    bent = np.any(offset, axis=2).astype(np.int64)
    return data._replace(offset=offset, low=offset.min(axis=2), bent=bent)


@part
def points_of_face(data, f):
    """How many slices (crossbeams) or points (side beams) face f has."""
    return data.s.shape[0] if f < SIDES else data.points.shape[0]


@part
def span_of(pw, f):
    """The slices or points of face f that may touch."""
    return pw.span[f, 0], pw.span[f, 1]


@part(fastmath=VECTORISED)
def read_stations(data, i, f, q, c, wall):
    """Component c of the modal displacement (or velocity) of face f's stations into a row.

    q: modal coordinates, best filled up with zeros to n8 (a remainder is slow).
    """
    n, rows = data.phi.shape[2], data.rows[i, f, c]
    for s in range(0, rows.shape[0], 4):
        x = y = z = w = 0.0
        for m in range(q.shape[0]):
            x += rows[s, m] * q[m]
            y += rows[s + 1, m] * q[m]
            z += rows[s + 2, m] * q[m]
            w += rows[s + 3, m] * q[m]
        wall[s + 1], wall[s + 2], wall[s + 3], wall[s + 4] = x, y, z, w
    wall[0] = 2.0 * wall[1] - wall[2]
    wall[n + 1] = 2.0 * wall[n] - wall[n - 1]


@part
def give_stations(f, pw):
    """Forces spread over the stations of face f, those of the end stations handed to the others."""
    n = pw.st.shape[1]
    for c in range(3):
        total = pw.spread[c]
        for s in range(n):
            pw.st[f, s, c] = total[1 + s]
        pw.st[f, 0, c] += 2.0 * total[0]
        pw.st[f, 1, c] -= total[0]
        pw.st[f, n - 1, c] += 2.0 * total[n + 1]
        pw.st[f, n - 2, c] -= total[n + 1]


@part
def station_weight(face, k, n, s):
    """Weight of station s (of n) in what slice k reads, the end stations' share included."""
    j, w = face.j[k], 0.0
    if 0 <= s + 1 - j < 4:
        w += face.w[s + 1 - j, k]
    if j == 0:
        w += 2.0 * face.w[0, k] if s == 0 else (-face.w[0, k] if s == 1 else 0.0)
    if j + 3 == n + 1:
        w += 2.0 * face.w[LAST, k] if s == n - 1 else (-face.w[LAST, k] if s == n - 2 else 0.0)
    return w


@part
def read_values(span, weights, face, values, out):
    """What the slices of a span read of stations' values, into a field ``out`` of ``face``: with
    weights ``face.w``, or with ``face.ws`` its slope along the face.

    Few stations are the first for any of them, so the span is gone through once for each: vectors
    without gathering.
    """
    for j in range(face.j_least, face.j_most + 1):
        add_share(
            span, j, weights, face, values[j], values[j + 1], values[j + 2], values[j + 3], out
        )


@part(fastmath=VECTORISED)
def add_share(span, j, weights, face, v0, v1, v2, v3, out):
    """What slices read whose first station is j; others keep what they have, or zero if j is the
    first that is looked at."""
    seen = j > face.j_least
    for k in range(span[0], span[1]):
        x = weights[0, k] * v0 + weights[1, k] * v1 + weights[2, k] * v2 + weights[LAST, k] * v3
        rest = out[k] if seen else 0.0
        out[k] = x if face.j[k] == j else rest


@part
def penetrations(pose, data, i, Rw, D, q, margin, pw):
    """Penetration of the slices of every face that is near; returns whether any touches.

    Near is what touches, or may when the residual deflection pushes it by ``pw.push``, and so is a
    slice in ``pw.span``. No station moves by more than ``margin``, and no curve through them by
    more than twice that.
    """
    # the roller's centre and axes along the pocket's x and psi
    X, T = dot(row(pw.G, 0), D), dot(row(pw.G, 2), D)
    a0, a1, a2 = row(pose.axis, 0), row(pose.axis, 1), row(pose.axis, 2)
    ax = (dot(row(pw.G, 0), a0), dot(row(pw.G, 0), a1), dot(row(pw.G, 0), a2))
    at = (dot(row(pw.G, 2), a0), dot(row(pw.G, 2), a1), dot(row(pw.G, 2), a2))
    reach = abs(data.s[data.s.shape[0] - 1])
    touch = False
    for f in range(FACES):
        sgn = 1.0 if f % 2 == 0 else -1.0
        if f < SIDES:
            gap = data.half[0] + data.low[i, f] - sgn * T - abs(at[0]) * reach - Rw
        else:
            tilt = (abs(ax[1]) + abs(ax[2])) * Rw
            gap = data.half[1] + data.low[i, f] - sgn * X - tilt - data.half_roller
        if face_penetrations(data, i, f, gap, (Rw, X, T, ax, at), q, margin, pw):
            touch = True
    return touch


@part
def face_penetrations(data, i, f, gap, place, q, margin, pw):
    """The same of face f, from which the roller is ``gap`` away at the least if no station moves;
    ``place`` of the roller: its radius, and its centre and axes along the pocket's x and psi."""
    Rw, X, T, ax, at = place
    sgn, n_st = 1.0 if f % 2 == 0 else -1.0, data.phi.shape[2]
    # three bounds of the depth, each tighter and dearer: extent, profile, stations
    pw.near[f] = 0
    pw.deep[f] = pw.rest[f] = 2.0 * margin - gap
    if pw.deep[f] + pw.push[f] <= 0.0:
        return False
    face, n = pw.face[f], points_of_face(data, f)
    if f < SIDES:
        _lay_crossbeam(data, f, sgn, X, T + sgn * (Rw - data.half[0]), ax[0], at[0], face)
    else:
        _lay_side_beam(data, f, sgn, sgn * X - data.half[1], T, ax, at, face)
    bare = _block_by_block(n, face)
    pw.deep[f] = pw.rest[f] = bare - data.low[i, f] + 2.0 * margin
    if pw.deep[f] + pw.push[f] <= 0.0:
        return False
    across, along = (2, 0) if f < SIDES else (0, 2)
    read_stations(data, i, f, q, across, pw.wall[across])
    inward = most_of_curve(n_st, -sgn, pw.wall[across]) - data.low[i, f]
    pw.deep[f] = pw.rest[f] = bare + inward
    if pw.deep[f] + pw.push[f] <= 0.0:
        return False
    pw.near[f] = 1
    _find_span(n, f, inward, face, pw)
    span = span_of(pw, f)
    read_stations(data, i, f, q, along, pw.wall[along])
    _follow(span, n_st, pw.wall[along], data.dx[f], face)
    _weigh(span, n_st, data.dx[f], face)
    read_values(span, face.w, face, pw.wall[across], face.read)
    read_values(span, face.ws, face, pw.wall[across], face.slope)
    for k in range(span[0], span[1]):  # outwards by sgn u: less depth, and a slope
        face.d0[k] -= sgn * face.read[k]
        face.slope[k] *= sgn
    if data.bent[i, f] != 0:
        _add_offset(data, i, f, span, face)
    pw.deep[f] = largest(span, face.d0)
    return pw.deep[f] > 0.0


@part
def most_of_curve(n, sign, values):
    """Bound of a smooth curve through n stations ``values[1:n + 1]``, times ``sign``.

    Weights of stations sum to one, those that are negative to -1/8 at the most; beyond the outer
    stations the curve goes on straight for half a spacing.
    """
    most = least = sign * values[1]
    for s in range(2, n + 1):
        most, least = max(most, sign * values[s]), min(least, sign * values[s])
    ends = max(
        sign * (1.5 * values[1] - 0.5 * values[2]), sign * (1.5 * values[n] - 0.5 * values[n - 1])
    )
    return max(most + 0.125 * (most - least), ends)


@part
def _block_by_block(n, face):
    """Largest penetration of each block of the n slices into face.top; returns that of all.

    By halves: one after the other, each comparison would wait for the last.
    """
    d, blocks, most = face.d0, (n + BLOCK - 1) // BLOCK, -1.0
    for k in range(n, blocks * BLOCK):
        d[k] = -1.0
    for b in range(blocks):
        k = b * BLOCK
        one = max(max(d[k], d[k + 1]), max(d[k + 2], d[k + 3]))
        two = max(max(d[k + 4], d[k + 5]), max(d[k + 6], d[k + 7]))
        face.top[b] = max(one, two)
        most = max(most, face.top[b])
    return most


@part
def _find_span(n, f, inward, face, pw):
    """What of face f may touch: blocks of slices whose wall may come to the roller by
    ``inward`` and by the residual deflection ``pw.push``; all points of a side beam.

    A share of the penetration is allowed for that deflection at first, to be asked but once.
    """
    if f >= SIDES:
        pw.span[f, 0], pw.span[f, 1], pw.rest[f] = 0, n, -1.0
        return
    allowed = inward + max(pw.push[f], SLACK * pw.deep[f])
    first, end, rest = n, 0, -1.0
    for b in range((n + BLOCK - 1) // BLOCK):
        if face.top[b] + allowed > 0.0:
            first, end = min(first, b * BLOCK), min((b + 1) * BLOCK, n)
        else:
            rest = max(rest, face.top[b] + inward)
    pw.span[f, 0], pw.span[f, 1], pw.rest[f] = first, end, rest


@part(fastmath=VECTORISED)
def _lay_crossbeam(data, f, sgn, X, T, ax, at, face):
    """Place of every slice on an even crossbeam face, in stations, and its penetration."""
    scale = 1.0 / data.dx[f]
    for k in range(data.s.shape[0]):
        s = data.s[k]
        face.x[k] = (X + s * ax - data.x0[f]) * scale
        face.d0[k] = sgn * (T + s * at) - data.drop[k]


@part(fastmath=VECTORISED)
def _lay_side_beam(data, f, sgn, X, T, ax, at, face):
    """The same for the points of the roller's end on a side beam."""
    h = sgn * data.half_roller + data.middle
    for k in range(data.points.shape[0]):
        y, z = data.points[k, 0], data.points[k, 1]
        face.x[k] = (T + h * at[0] + y * at[1] + z * at[2] - data.x0[f]) / data.dx[f]
        face.d0[k] = X + sgn * (h * ax[0] + y * ax[1] + z * ax[2])


@part
def _follow(span, n_st, wall, dx, face):
    """What lies under a slice has moved there along the face: take its motion off the place."""
    for k in range(span[0], span[1]):
        x = face.x[k]
        j = min(max(int(floor(x)), 0), n_st - 2)
        t = min(max(x - j, 0.0), 1.0)
        face.x[k] = x - (wall[1 + j] + t * (wall[2 + j] - wall[1 + j])) / dx


@part(fastmath=VECTORISED)
def _weigh(span, n_st, dx, face):
    """Stations that every slice reads, their weights, and the weights' slopes along the face.

    Beyond its outer stations a wall goes on straight, for half a spacing at the most.
    """
    last = n_st - 1.0
    for k in range(span[0], span[1]):
        x = face.x[k]
        held = min(max(x, -0.5), last + 0.5)
        at = min(max(x, 0.0), last)
        j = min(floor(at), last - 1.0)
        (v0, v1, v2, v3), (d0, d1, d2, d3) = smooth_weights(at - j)
        inside = 1.0 / dx if held == x else 0.0
        over = held - at
        face.j[k] = int(j)
        face.w[0, k], face.ws[0, k] = v0 + over * d0, inside * d0
        face.w[1, k], face.ws[1, k] = v1 + over * d1, inside * d1
        face.w[2, k], face.ws[2, k] = v2 + over * d2, inside * d2
        face.w[LAST, k], face.ws[LAST, k] = v3 + over * d3, inside * d3
    least = most = face.j[span[0]]
    for k in range(span[0], span[1]):
        least, most = min(least, face.j[k]), max(most, face.j[k])
    face.j_least, face.j_most = least, most


@part
def _add_offset(data, i, f, span, face):
    """A defect's offset and its slope, linear between the points of its grid."""
    n_o = data.offset.shape[2]
    for k in range(span[0], span[1]):
        place = (data.x0[f] + data.dx[f] * face.x[k] - data.grid[0, f]) / data.grid[1, f]
        j = min(max(int(floor(place)), 0), n_o - 2)
        here, there = data.offset[i, f, j], data.offset[i, f, j + 1]
        t = min(max(place - j, 0.0), 1.0)
        face.d0[k] -= here + t * (there - here)
        if 0.0 <= place - j <= 1.0:
            face.slope[k] += (there - here) / data.grid[1, f]
