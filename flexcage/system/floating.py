"""A cage: rows of a body in a floating frame, translations in space, rotations in the body.

The equations stand in ``bodies.floating_frame``.
"""

from __future__ import annotations

from flexcage.bodies.floating_frame import inertia_terms, modal_product
from flexcage.contacts.evaluation import REPORT, TANGENT
from flexcage.core.jit import VECTORISED, array_from, copy_into, fields, part
from flexcage.core.rotation import matrix_from_quaternion, quaternion_rate
from flexcage.core.vectors import RIGID, TURN, minus, put, turn_of, turned, turned_back, xyz
from flexcage.system.data import CAGE_SPIN, GRAVITY, KINETIC, MODAL_DAMPING, STRAIN
from flexcage.system.layout import FRAME, QUATERNION, cage_at


@part
def modes_at(first, count):
    """Where so many modes are among coordinates or velocities, the first of them at ``first``."""
    return slice(first, first + count)


@part
def take_cage(k, y, d):
    """Make cage k the one under work: its attitude and spin in ``Scratch``."""
    work, own = fields(d.scratch), cage_at(k, fields(d.places))
    matrix_from_quaternion(array_from(y, own.q + QUATERNION), work.A)
    put(work.vec[CAGE_SPIN], turned(work.A, turn_of(array_from(y, own.u))))


@part(fastmath=VECTORISED)
def cage_equations(k, y, yd, d, out, mode):
    """Rows of cage k, which is under work; what contacts push is in ``Scratch.border``."""
    tan, rep, work = fields(d.tangent), fields(d.report), fields(d.scratch)
    data = fields(d.cage) if k == 0 else fields(d.second)
    at, frame, A, border = fields(d.places), fields(d.frame), work.A, work.border
    own, nm = cage_at(k, at), at.modes
    b = own.b
    quat, qf = array_from(y, own.q + QUATERNION), y[modes_at(own.q + FRAME, nm)]
    Vc, wb = array_from(y, own.u), array_from(y, own.u + TURN)
    qfd, modes = y[modes_at(own.u + RIGID, nm)], yd[modes_at(own.u + RIGID, nm)]
    qd, ud = array_from(yd, own.q), array_from(yd, own.u)
    r_q, r_u = array_from(out, own.q), array_from(out, own.u)
    acc, v, product = frame.w[0], frame.w[1], frame.w[2]
    M, H, h = frame.rigid, frame.coupled, frame.h
    inertia_terms(data, wb, qf, qfd, frame)
    if at.cages > 1:  # kept until all have accelerations
        copy_into(frame.each_rigid[k], M)
        copy_into(frame.each_coupled[k], H)
    # kinematics: R' = v in space, the quaternion by w of the body, modes by their rates
    rate = work.S[0]
    quaternion_rate(quat, wb, rate)
    for c in range(3):
        r_q[c] = qd[c] - Vc[c]
    for c in range(4):
        r_q[QUATERNION + c] = qd[QUATERNION + c] - rate[c]
    for m in range(nm):
        r_q[FRAME + m] = qd[FRAME + m] - qfd[m]
    gb = turned_back(A, xyz(fields(d.bodies).gravity))
    # (A^T (v' - g), w'): gravity is an acceleration of the whole body
    put(acc, minus(turned_back(A, xyz(ud)), gb))
    for c in range(3):
        acc[TURN + c] = ud[TURN + c]
    for l in range(6):  # M (a, w') + H q'' + h, in the body's frame
        x = h[l]
        for c in range(6):
            x += M[l, c] * acc[c]
        for m in range(nm):
            x += H[l, m] * modes[m]
        v[l] = x
    for c in range(3):  # forces to space, moments in the body; less those of contacts
        x = A[c, 0] * v[0] + A[c, 1] * v[1] + A[c, 2] * v[2]
        r_u[c] = x - border[b + c]
        r_u[TURN + c] = v[TURN + c] - border[b + TURN + c]
    # modes: H^T (a, w') + m_ff q'' + h + K q + d q' - Q
    row_of = out[modes_at(own.u + RIGID, nm)]
    for m in range(nm):
        row_of[m] = h[RIGID + m] - border[b + RIGID + m]
        for c in range(6):
            row_of[m] += H[c, m] * acc[c]
    modal_product(data.mff, data.plain, modes, product)
    for m in range(nm):
        row_of[m] += product[m]
    modal_product(data.kff, data.plain, qf, product)
    for m in range(nm):
        row_of[m] += product[m]
    modal_product(data.dff, data.plain, qfd, product)
    for m in range(nm):
        row_of[m] += product[m]
    if mode == TANGENT:
        _slopes(data, A, M, H, b, tan)
    elif mode >= REPORT:
        for m in range(nm):  # the product is that of the damping
            rep.power[MODAL_DAMPING] -= qfd[m] * product[m]
        put(v, turned_back(A, xyz(Vc)))
        for c in range(3):
            v[TURN + c] = wb[c]
        for l in range(6):
            momentum = 0.0
            for m in range(nm):
                momentum += H[l, m] * qfd[m]
            if l < 3:  # what gravity does on the body's first moment of mass
                rep.power[GRAVITY] += gb[l] * momentum
            rep.energy[KINETIC] += v[l] * momentum
            for c in range(6):
                rep.energy[KINETIC] += 0.5 * v[l] * M[l, c] * v[c]
                if c < 3:
                    rep.power[GRAVITY] += v[l] * M[l, c] * gb[c]
        modal_product(data.mff, data.plain, qfd, product)
        for m in range(nm):
            rep.energy[KINETIC] += 0.5 * qfd[m] * product[m]
        modal_product(data.kff, data.plain, qf, product)
        for m in range(nm):
            rep.energy[STRAIN] += 0.5 * qf[m] * product[m]


@part(fastmath=VECTORISED)
def _slopes(data, A, M, H, b, tan):
    """Mass, stiffness and damping of the cage, whose rows of the border begin at b."""
    nm, turn, modes = H.shape[1], b + TURN, b + RIGID
    for a in range(3):  # translations to space
        for e in range(3):
            x = y = 0.0
            for c in range(3):
                x += A[a, c] * M[c, TURN + e]
                y += M[TURN + e, c] * A[a, c]
            tan.Mbb[b + a, b + e] = data.mass if a == e else 0.0
            tan.Mbb[b + a, turn + e] = x
            tan.Mbb[turn + e, b + a] = y
            tan.Mbb[turn + a, turn + e] = M[TURN + a, TURN + e]
    for m in range(nm):
        for a in range(3):
            x = A[a, 0] * H[0, m] + A[a, 1] * H[1, m] + A[a, 2] * H[2, m]
            tan.Mbb[b + a, modes + m] = tan.Mbb[modes + m, b + a] = x
            tan.Mbb[turn + a, modes + m] = tan.Mbb[modes + m, turn + a] = H[TURN + a, m]
        for l in range(nm):
            tan.Mbb[modes + m, modes + l] = data.mff[m, l]
            tan.Kbb[modes + m, modes + l] += data.kff[m, l]
            tan.Cbb[modes + m, modes + l] += data.dff[m, l]


@part(fastmath=VECTORISED)
def push_modes(data, i, pw, modes):
    """Generalised forces of pocket i's station forces on the cage's ``modes`` (n,)."""
    for f in range(pw.st.shape[0]):
        if pw.normal[f] <= 0.0:
            continue
        for s in range(pw.st.shape[1]):
            x, y, z = pw.st[f, s, 0], pw.st[f, s, 1], pw.st[f, s, 2]
            if x == 0.0 and y == 0.0 and z == 0.0:
                continue
            shape = data.phi[i, f, s]
            for m in range(modes.shape[0]):
                modes[m] += x * shape[0, m] + y * shape[1, m] + z * shape[2, m]
