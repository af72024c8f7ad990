"""One checker for every law, ours or a user's: derivatives, zeros, bounds, dissipation."""

from __future__ import annotations

import numpy as np
from law_values import friction
from law_values import normal as at_onset


def check_normal_law(law, p, *, depth=2e-5, speed=0.5, onset=0.2):
    """What every normal law owes its callers; ``depth`` and ``speed`` bound the range looked at."""

    def normal(law, p, d, v):
        return at_onset(law, p, d, v, onset=onset)

    rng = np.random.default_rng(1)
    d, v = depth * rng.uniform(0.02, 1.0, 400), speed * rng.uniform(-1.0, 1.0, 400)
    F, Fe, Fd, Fv = normal(law, p, d, v)
    assert np.all(F >= 0.0)  # contacts do not pull
    h = 1e-4 * d
    for got, (dd, dv), step in ((Fd, (h, 0.0), h), (Fv, (0.0, 1e-6), 1e-6)):
        high, low = normal(law, p, d + dd, v + dv)[0], normal(law, p, d - dd, v - dv)[0]
        smooth = (F > 0.0) & (high > 0.0) & (low > 0.0)
        assert smooth.sum() > 100
        np.testing.assert_allclose(
            got[smooth],
            ((high - low) / (2.0 * step))[smooth],
            rtol=2e-6,
            atol=2e-6 * abs(got).max(),
        )
    for x in normal(law, p, [0.0, -1e-6, -1.0], [0.3, -0.2, 0.1]):
        assert np.all(x == 0.0)
    near = normal(law, p, [1e-15], [0.1])[0]
    assert near[0] < 1e-3 * F.max()  # no jump at touch
    still = normal(law, p, d, np.zeros_like(d))[0]
    np.testing.assert_allclose(Fe, still, rtol=1e-12)
    assert np.all((F - still) * v >= 0.0)  # takes energy, never gives


def check_friction_law(law, p, *, top, speed=3.0):
    """What every friction law owes: mu/u smooth and finite at 0, mu between 0 and ``top``."""
    u = np.geomspace(1e-5, speed, 600)
    g, dg = friction(law, p, u)
    assert np.all(g >= 0.0) and np.all(g * u <= top * (1.0 + 1e-9))
    h = 1e-5 * u
    numeric = (friction(law, p, u + h)[0] - friction(law, p, u - h)[0]) / (2.0 * h)
    error = np.abs(dg - numeric) / (np.abs(numeric) + 1e-3 * (g + 1e-9) / u)
    assert np.mean(error > 1e-3) < 0.01  # corners of piecewise laws aside
    for x in friction(law, p, [0.0]):
        assert np.isfinite(x[0])
