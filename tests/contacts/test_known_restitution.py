"""Impacts with damping in proportion to K d^n: the restitution that a lambda gives.

The law `restitution` gives the coefficient asked for, at any exponent, mass and speed; with other
authors' lambda the same force law misses as much as is known of them.

Source: exact relation ln[(1+lambda)/(1-lambda e)] = lambda (1+e) of F = K d^n (1 + (lambda/v0) d');
Hunt and Crossley 1975, Lankarani and Nikravesh 1990, Flores et al. 2011, Hu and Guo 2015, Zhiying
and Qishao 2006; numbers by direct integration in an independent program.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from known_rows import check
from law_values import strike

from flexcage.contacts import laws
from flexcage.contacts.spec import NormalLaw
from flexcage.verification import Row, Tolerance

BALL = (8.69343e9, 1.5, 2.7173e-3)  # K [N/m^n], n, mass [kg]
ROLLER = (454517.4944 * 1e3 ** (10.0 / 9.0), 10.0 / 9.0, 3.1567e-3)
# restitution asked for: what Hunt-Crossley, Lankarani-Nikravesh, Flores, Hu-Guo and
# Zhiying-Qishao give; lambda of the exact relation
TABLE = {
    0.9: (0.90902, 0.91318, 0.89392, 0.89990, 0.89592, 0.166482),
    0.8: (0.83287, 0.84710, 0.78854, 0.79920, 0.78736, 0.373146),
    0.7: (0.76800, 0.79597, 0.68318, 0.69730, 0.67957, 0.634828),
    0.5: (0.66296, 0.72524, 0.47044, 0.48774, 0.48261, 1.432751),
    0.3: (0.58129, 0.68422, 0.25621, 0.27066, 0.32670, 3.087082),
    0.1: (0.51583, 0.66527, 0.06944, 0.07407, 0.21747, 9.998159),
}
RELATIONS = {
    "Hunt-Crossley": lambda e: 1.5 * (1 - e),
    "Lankarani-Nikravesh": lambda e: 0.75 * (1 - e**2),
    "Flores": lambda e: 1.6 * (1 - e) / e,
    "Hu-Guo": lambda e: 1.5 * (1 - e) / e,
    "Zhiying-Qishao": lambda e: 0.75 * (1 - e**2) * np.exp(2 * (1 - e)),
}
LAMBDA = Tolerance(6e-7, "printed to 1e-6", absolute=True)
PRINTED = Tolerance(1.1e-5, "printed to 1e-5", absolute=True)
EXACT = Tolerance(1e-5, "the relation is exact; what is left is the integration's", absolute=True)


def rows() -> Iterator[Row]:
    for e, (*others, exact) in TABLE.items():
        yield Row(f"lambda for e = {e}", "", exact, laws.exact_dissipation(e), LAMBDA)
        for (k, n, mass), body in ((BALL, "ball"), (ROLLER, "roller")):
            p = laws.normal_parameters(NormalLaw(law="restitution", restitution=e), k, n)
            for speed in (0.06, 0.5):
                found = strike(laws.restitution, p, mass, speed).restitution
                yield Row(f"e = {e}, {body} at {speed} m/s", "", e, found, EXACT)
        for (author, relation), expected in zip(RELATIONS.items(), others):
            p = laws.normal_parameters(NormalLaw(law="restitution"), *BALL[:2])
            p[2] = relation(e)
            found = strike(laws.restitution, p, BALL[2], 0.3).restitution
            yield Row(f"e by {author} for {e}", "", expected, found, PRINTED)


def test_restitution():
    check(rows())
