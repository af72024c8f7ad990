"""Elastic impacts: depth, time and force of contact.

A mass flies at 0.5 m/s against the elastic law of a race: how deep, how long, how hard, and that it
leaves as fast as it came.

Source: closed form: depth ((n+1) m v^2/(2K))^(1/(n+1)), time 2 (depth/v) sqrt(pi)
Gamma(1+1/(n+1))/Gamma(1/2+1/(n+1)); numbers from an independent program.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from known_rows import check
from law_values import IMPACT_SPEED, IMPACTS, strike
from scipy.special import gamma

from flexcage.contacts import laws
from flexcage.contacts.spec import NormalLaw
from flexcage.verification import Row, Tolerance

PRINTED = Tolerance(4e-5, "the masses are printed to five digits")
INTEGRATED = Tolerance(1e-7, "closed form against an integration with 1e-10")
ENERGY = Tolerance(1e-6, "an elastic contact keeps the energy", absolute=True)


def rows() -> Iterator[Row]:
    for name, (k, n, mass, depth, time, force) in IMPACTS.items():
        hit = strike(
            laws.elastic, laws.normal_parameters(NormalLaw(law="elastic"), k, n), mass, IMPACT_SPEED
        )
        yield Row(f"{name}, depth", "um", depth, 1e6 * hit.depth, PRINTED)
        yield Row(f"{name}, time in contact", "us", time, 1e6 * hit.time, PRINTED)
        yield Row(f"{name}, largest force", "N", force, hit.force, PRINTED)
        yield Row(f"{name}, energy after over before", "", 1.0, hit.restitution**2, ENERGY)
        share = 1.0 / (n + 1.0)
        factor = 2.0 * np.sqrt(np.pi) * gamma(1.0 + share) / gamma(0.5 + share)
        found = hit.time * IMPACT_SPEED / hit.depth
        yield Row(f"{name}, time x speed / depth", "", factor, found, INTEGRATED)


def test_elastic_impacts():
    check(rows())
