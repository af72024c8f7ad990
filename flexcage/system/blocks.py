"""Tangent blocks: what each pair of a roller and its partner adds to them."""

from __future__ import annotations

from flexcage.core.jit import outlined, part
from flexcage.core.vectors import RIGID


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
def scatter_modes(i, pw, S, start, tan, n_m):
    """Add what couples pocket i's roller and the cage's rigid motion to the cage's n_m modes; the
    cage's columns begin at ``start``."""
    modes = start + RIGID
    for m in range(2):
        M, (_rr, rb, br, bb) = pw.K if m == 0 else pw.C, _of(tan, m)
        for c in range(6):
            for o in range(n_m):
                rb[i, c, modes + o] += M[c, RIGID + o]
                br[i, modes + o, c] += M[RIGID + o, c]
            for e in range(6):
                for o in range(n_m):
                    bb[start + e, modes + o] -= S[c, e] * M[c, RIGID + o]
                    bb[modes + o, start + e] -= M[RIGID + o, c] * S[c, e]
        for o in range(n_m):
            for l in range(n_m):
                bb[modes + o, modes + l] += M[RIGID + o, RIGID + l]
