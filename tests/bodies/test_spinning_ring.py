"""A thin ring that spins, in the floating frame: split frequencies, their mean, and growth.

Frequencies of a steel ring (R 50, 2 by 10 mm) as the cage's frame sees them. Coriolis forces split
each pair rightly with and without geometric stiffening; only with it is the pair's mean right.
Growth and hoop stress rho w^2 R^2 come from the breathing shape.

Source: rotating inextensional ring, w = sqrt(w_n^2 + W^2 n^2 (n^2-1)^2/(n^2+1)^2) +- 2 n W/(n^2+1):
M. Endo, K. Hatamura, M. Sakata and O. Taniguchi, J. Sound Vib. 92 (1984) 261; without stiffening an
extensible Galerkin ring of an independent program.
"""

from __future__ import annotations

import numpy as np
import pytest
from known_rows import check
from thin_ring import LINEAR, REST, RPM, STIFFENED, E, R, frequencies, ring

from flexcage.bodies.floating_frame import frame_work, inertia_terms
from flexcage.verification import Row, Tolerance

GROWTH = {6000: 1.859491, 10_000: 5.165252, 20_000: 20.661008}  # um
HOOP = {6000: 7.698291, 10_000: 21.384143, 20_000: 85.536571}  # MPa
PRINTED = Tolerance(1e-6, "closed form, printed to eight digits; derivatives by differences")
BREATHING = Tolerance(3e-6, "closed form, printed to six digits")
STRETCH = Tolerance(1.5e-3, "the reference ring stretches a little, these shapes do not")
SPLIT = Tolerance(1e-4, "2 x 2 n W/(n^2+1); one frequency less the other")


def growth(speed: float) -> float:
    """Radial growth [m] under the centrifugal load of the undeformed ring."""
    body = ring([0])
    work = frame_work(1)
    inertia_terms(body.data, np.array([speed, 0.0, 0.0]), np.zeros(1), np.zeros(1), work)
    return float(-work.h[6] / body.data.kff[0, 0])


def test_at_rest():
    for n, expected in REST.items():
        check([Row(f"f_{n}", "Hz", expected, frequencies(ring([n]), 0.0)[0], PRINTED)])
    breathing = frequencies(ring([0]), 0.0)[0]
    check([Row("breathing", "Hz", 16397.9, breathing, BREATHING)])


@pytest.mark.parametrize(
    ("table", "stiffened", "near"), [(STIFFENED, True, PRINTED), (LINEAR, False, STRETCH)]
)
def test_split_frequencies_with_and_without_stiffening(table, stiffened, near):
    for (rpm, n), pair in table.items():
        found = frequencies(ring([n], stiffened=stiffened), rpm * RPM)
        assert len(found) == 2
        for which, expected, value in zip(("higher", "lower"), pair, found):
            check([Row(f"{which} f_{n} at {rpm} rpm", "Hz", expected, value, near)])


def test_splitting():
    found = frequencies(ring([2], stiffened=True), 6000 * RPM)
    check([Row("splitting of f_2 at 6000 rpm", "Hz", 160.0, found[0] - found[1], SPLIT)])


def test_growth_and_hoop_stress():
    for rpm, expected in GROWTH.items():
        u = growth(rpm * RPM)
        check([
            Row(f"growth at {rpm} rpm", "um", expected, 1e6 * u, PRINTED),
            Row(f"hoop stress at {rpm} rpm", "MPa", HOOP[rpm], 1e-6 * E * u / R, PRINTED),
        ])  # fmt: skip
