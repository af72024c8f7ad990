"""Forces between a roller and the four walls of its pocket, slice by slice or point by point.

The normal force inclines with the wall's slope along the face, so that it is the slope of an
energy; a crossbeam's slope acts at the roller's axis. Crossbeams (faces 0, 1) are touched at any
time and evaluated in pocket axes, all slices at once; side beams (2, 3) rarely, one point after
another.
"""

from __future__ import annotations

from math import sqrt

from flexcage.contacts.pocket_wall import SIDES
from flexcage.contacts.state import add_end_generator, add_generator, approach
from flexcage.core.jit import VECTORISED, part, zero
from flexcage.core.vectors import (
    MOMENT,
    combine,
    cross,
    dot,
    minus,
    plus,
    row,
    times,
    turned,
    turned_back,
    xyz,
)


@part(fastmath=VECTORISED)
def crossbeam_rates(data, f, span, Rw, a, rel, spin, face, sl, pw):
    """Approach speed and sliding of every slice on crossbeam face f.

    a: roller's axis; rel, spin: its velocity and angular velocity less those of the cage there.
    """
    sgn = 1.0 if f % 2 == 0 else -1.0
    v0 = turned(pw.G, rel)  # of the roller's axis at s, in pocket axes: v0 + s v1
    v1 = turned(pw.G, cross(spin, a))
    v2 = turned(pw.G, cross(spin, row(pw.G, 2)))  # what the surface adds, per distance from it
    for k in range(span[0], span[1]):
        s, h, slope = data.s[k], sgn * (Rw - data.drop[k]), face.slope[k]
        along = v0[0] + s * v1[0] - face.rate[0, k]
        # d' = sgn (v_psi - wall's) - slope (v_x - wall's); then sliding along x and r
        sl.v[k] = sgn * (v0[2] + s * v1[2] - face.rate[2, k]) - slope * along
        sl.t1[k] = along + h * v2[0]
        sl.t2[k] = v0[1] + s * v1[1] + h * v2[1] - face.rate[1, k]
        sl.u[k] = sqrt(sl.t1[k] * sl.t1[k] + sl.t2[k] * sl.t2[k])


@part(fastmath=VECTORISED)
def add_crossbeam_forces(data, f, span, Rw, a, face, sl, pw, wrench):
    """Add the forces of crossbeam face f to the roller's wrench and to the face's sums."""
    sgn = 1.0 if f % 2 == 0 else -1.0
    axis = turned(pw.G, a)
    force = moment = (0.0, 0.0, 0.0)
    normal = tangential = 0.0
    for k in range(span[0], span[1]):
        N, slope = sl.N[k], face.slope[k]
        on_axis = times(data.s[k], axis)
        r = (on_axis[0], on_axis[1], on_axis[2] + sgn * (Rw - data.drop[k]))
        # N (-sgn e_psi - (mu/u) (t1 e_x + t2 e_r)) at the surface, N slope e_x at the axis
        f_surface = times(N, (-sl.g[k] * sl.t1[k], -sl.g[k] * sl.t2[k], -sgn))
        f_axis = (N * slope, 0.0, 0.0)
        force = plus(force, plus(f_surface, f_axis))
        moment = plus(moment, plus(cross(r, f_surface), cross(on_axis, f_axis)))
        normal += N
        tangential += N * sl.g[k] * sl.u[k]
    force, moment = turned_back(pw.G, force), turned_back(pw.G, moment)
    for c in range(3):
        wrench[c] += force[c]
        wrench[MOMENT + c] += moment[c]
    pw.normal[f] = normal
    pw.tangential[f] = tangential


@part
def spread_over_stations(span, f, face, sl, pw):
    """Forces of face f on the cage, shared among the stations that each slice reads."""
    sgn = 1.0 if f % 2 == 0 else -1.0
    zero(pw.spread)
    across, first, second = (2, 0, 1) if f < SIDES else (0, 1, 2)
    for k in range(span[0], span[1]):
        N = sl.N[k]
        if N <= 0.0:
            continue
        f1, f2 = N * sl.g[k] * sl.t1[k], N * sl.g[k] * sl.t2[k]
        if f < SIDES:
            f1 -= N * face.slope[k]
        else:
            f2 -= N * face.slope[k]
        j = face.j[k]
        for s in range(4):
            w = face.w[s, k]
            pw.spread[across, j + s] += sgn * N * w
            pw.spread[first, j + s] += f1 * w
            pw.spread[second, j + s] += f2 * w


@part
def axes_of_face(pw, f):
    """Normal on the roller and the two tangents of face f, in F."""
    sgn = 1.0 if f % 2 == 0 else -1.0
    if f < SIDES:
        return times(-sgn, row(pw.G, 2)), row(pw.G, 0), row(pw.G, 1)
    return times(-sgn, row(pw.G, 0)), row(pw.G, 1), row(pw.G, 2)


@part
def lever_of_slice(pose, data, Rw, f, k, pw):
    """Lever from the roller's centre to slice or point k of face f, in F."""
    sgn, a = 1.0 if f % 2 == 0 else -1.0, row(pose.axis, 0)
    if f < SIDES:
        return combine(times(data.s[k], a), sgn * (Rw - data.drop[k]), row(pw.G, 2))
    r = times(sgn * data.half_roller + data.middle, a)
    r = combine(r, data.points[k, 0], row(pose.axis, 1))
    return combine(r, data.points[k, 1], row(pose.axis, 2))


@part
def normal_generator(pose, data, distance, f, k, n, r, pw, out):
    """Generator of the normal force of slice k of face f, inclined by the wall's slope."""
    slope = pw.face[f].slope[k]
    if f >= SIDES:
        inclined = combine(n, slope, row(pw.G, 2))
        add_end_generator(inclined, r, row(pose.axis, 0), distance, out)
        return
    add_generator(n, r, out)
    along = times(slope, row(pw.G, 0))
    moment = cross(times(data.s[k], row(pose.axis, 0)), along)
    for c in range(3):
        out[c] += along[c]
        out[MOMENT + c] += moment[c]


@part
def side_beam_rates(pose, data, f, distance, rel, spin, sl, pw, pair):
    """Approach speed and sliding of every point of the roller's end that side beam f touches.

    ``distance`` of the roller's centre from the bearing's axis; rel, spin as for a crossbeam.
    """
    sgn = 1.0 if f % 2 == 0 else -1.0
    n, e1, e2 = axes_of_face(pw, f)
    Wn, face = pair.W[0], pw.face[f]
    for k in range(data.points.shape[0]):
        sl.v[k] = sl.u[k] = 0.0
        if sl.d[k] <= 0.0:
            continue
        r = lever_of_slice(pose, data, 0.0, f, k, pw)
        v = plus(rel, cross(spin, r))
        normal_generator(pose, data, distance, f, k, n, r, pw, Wn)
        sl.v[k] = approach(Wn, rel, spin) + face.slope[k] * face.rate[2, k] - sgn * face.rate[0, k]
        sl.t1[k], sl.t2[k] = dot(e1, v) - face.rate[1, k], dot(e2, v) - face.rate[2, k]
        sl.u[k] = sqrt(sl.t1[k] ** 2 + sl.t2[k] ** 2)


@part
def add_side_beam_forces(pose, data, f, distance, sl, pw, pair):
    """Add the forces of side-beam face f to the roller's wrench and to the face's sums."""
    n, e1, e2 = axes_of_face(pw, f)
    Wn = pair.W[0]
    for k in range(data.points.shape[0]):
        N = sl.N[k]
        if N <= 0.0:
            continue
        r = lever_of_slice(pose, data, 0.0, f, k, pw)
        normal_generator(pose, data, distance, f, k, n, r, pw, Wn)
        t = combine(times(sl.t1[k], e1), sl.t2[k], e2)
        moment = cross(r, t)
        for c in range(3):
            pair.wrench[c] += N * (Wn[c] - sl.g[k] * t[c])
            pair.wrench[MOMENT + c] += N * (Wn[MOMENT + c] - sl.g[k] * moment[c])
        pw.normal[f] += N
        pw.tangential[f] += N * sl.g[k] * sl.u[k]


@part
def relative_motion(pose, Vc, wc, centre):
    """Velocity and angular velocity of the roller less those of the cage at its centre, in F."""
    rel = minus(minus(xyz(pose.V), Vc), cross(wc, centre))
    return rel, minus(xyz(pose.w), wc)
