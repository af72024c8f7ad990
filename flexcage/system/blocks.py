"""Tangent blocks: what each pair of a roller and its partner adds to them."""

from __future__ import annotations

from flexcage.core.jit import outlined, part, zero


@part
def _of(tan, m):
    """Blocks of the stiffness (m = 0) or the damping: between elements and border."""
    if m == 0:
        return tan.Krr, tan.Krb, tan.Kbr, tan.Kbb
    return tan.Crr, tan.Crb, tan.Cbr, tan.Cbb


@outlined
def scatter(pair, S, i, start, tan, T6):
    """Add a roller-partner pair's tangent; the partner's columns begin at ``start``."""
    for m in range(2):
        M, (rr, rb, br, bb) = pair.K if m == 0 else pair.C, _of(tan, m)
        MS, SM = T6[0], T6[1]
        for a in range(6):
            for b in range(6):
                rr[i, a, b] += M[a, b]
                x = y = 0.0
                for c in range(6):
                    x += M[a, c] * S[c, b]
                    y += S[c, a] * M[c, b]
                MS[a, b], SM[a, b] = x, y
        for a in range(6):
            for b in range(6):
                rb[i, a, start + b] -= MS[a, b]
                br[i, start + a, b] -= SM[a, b]
                x = 0.0
                for c in range(6):
                    x += SM[a, c] * S[c, b]
                bb[start + a, start + b] += x


@outlined
def scatter_outer(pair, F, i, tan):
    """The same for the outer ring, which only moves in y and z (columns 6 and 7)."""
    for m in range(2):
        M, (rr, rb, br, bb) = pair.K if m == 0 else pair.C, _of(tan, m)
        for a in range(6):
            for b in range(6):
                rr[i, a, b] += M[a, b]
            for b in range(2):
                x = y = 0.0
                for c in range(1, 3):
                    x += M[a, c] * F[c, 1 + b]
                    y += F[c, 1 + b] * M[c, a]
                rb[i, a, 6 + b] -= x
                br[i, 6 + b, a] -= y
        for a in range(2):
            for b in range(2):
                for c in range(1, 3):
                    for e in range(1, 3):
                        bb[6 + a, 6 + b] += F[c, 1 + a] * M[c, e] * F[e, 1 + b]


@outlined
def scatter_modes(data, i, pw, S, tan, Lm, Bm, PR):
    """Stiffness between pocket i's roller, the cage's rigid motion and its modes."""
    n_m = data.phi.shape[4]
    n_st = data.phi.shape[2]
    zero(Lm)
    zero(Bm)
    zero(PR)
    for f in range(4):
        if pw.near[f] == 0:
            continue
        sgn = 1.0 if f % 2 == 0 else -1.0
        comp = 2 if f < 2 else 0
        for s in range(n_st):
            if pw.H[f, s, s] == 0.0:
                continue
            for m in range(n_m):
                phi = sgn * data.phi[i, f, s, comp, m]
                for c in range(6):
                    Lm[c, m] += pw.LV[f, s, c] * phi
                    Bm[m, c] += phi * pw.BW[f, s, c]
                for t in range(max(s - 3, 0), min(s + 4, n_st)):
                    h = pw.H[f, s, t] * phi
                    if h != 0.0:
                        for o in range(n_m):
                            tan.Kbb[14 + m, 14 + o] += h * sgn * data.phi[i, f, t, comp, o]
            for l in range(pw.size[0]):
                h = sgn * pw.HR[f, s, l]
                if h != 0.0:
                    for m in range(n_m):
                        PR[l, m] += h * data.phi[i, f, s, comp, m]
    if pw.X[0, 0] != 0.0:  # less what the residual flexibility yields
        for m in range(n_m):
            for l in range(pw.size[0]):
                h = 0.0
                for k in range(pw.size[0]):
                    h += PR[k, m] * pw.X[k, l]
                if h != 0.0:
                    for o in range(n_m):
                        tan.Kbb[14 + m, 14 + o] -= h * PR[l, o]
    for c in range(6):
        for m in range(n_m):
            tan.Krb[i, c, 14 + m] += Lm[c, m]
            tan.Kbr[i, 14 + m, c] += Bm[m, c]
            for e in range(6):
                tan.Kbb[8 + e, 14 + m] -= S[c, e] * Lm[c, m]
                tan.Kbb[14 + m, 8 + e] -= Bm[m, c] * S[c, e]
