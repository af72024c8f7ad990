"""Stiffness of a roller on a race, on a cage wall, and of its flat end.

Stiffness and approach on a race by the standard, and by Palmgren; on a cage wall against quadrature
of the stress under a Hertzian pressure; of a flat end as a rigid punch on a half-space.

Source: ISO/TS 16281:2008 (c_L = 35948 Lwe^(8/9)); A. Palmgren, d = 3.84e-5 Q^0.9/L^0.8 (N, mm),
which a stiffness factor stands for; numbers from an independent program; K. L. Johnson, Contact
Mechanics (1985), 3.4, 5.6; Flamant's and Boussinesq's answers, integrated here.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from known_rows import check
from scipy.integrate import dblquad, quad

from flexcage.contacts import laws
from flexcage.contacts.spec import NormalLaw
from flexcage.verification import Row, Tolerance

STEEL, BRASS, RIGID = (206e9, 0.3), (105e9, 0.34), (1e16, 0.3)
LENGTH, RADIUS, DEPTH = 7.3e-3, 4e-3, 1.5e-3
MM = 1e3 ** (10.0 / 9.0)  # N/mm^(10/9) to N/m^(10/9)
PALMGREN = 8.06e4 / (35948.0 * 2.0 ** (10.0 / 9.0))  # of the ISO stiffness of one contact
# load [N]: approach [um] of a roller and one race by the standard, and by Palmgren
APPROACH = {185.3: (0.8898, 0.8605), 1000.0: (4.06, 3.92)}
PRINTED = Tolerance(1e-6, "printed to seven digits")
SHORT = Tolerance(1e-4, "8.06e4 is 3.84e-5^(-10/9) = 80593 in three digits")
ROUNDED = Tolerance(1.3e-3, "printed to three or four digits; 8.06e4 to three")
POWER_LAW = Tolerance(0.025, "a power law fitted to a logarithm over 0.5 to 500 N")
PUNCH = Tolerance(1e-6, "quadrature; the roller is 5e6 times as stiff as the wall")


def softness(body: tuple[float, float]) -> float:
    return (1.0 - body[1] ** 2) / body[0]


def half_width(q: float, soft: float) -> float:
    """Hertzian half-width [m] of a roller under q [N/m]; ``soft`` = sum (1 - nu^2)/E."""
    return float(np.sqrt(4.0 * q * RADIUS * soft / np.pi))


def wall_by_quadrature(q: float, wall: tuple[float, float]) -> float:
    """How far [m] a half-plane's surface under Hertz's pressure yields against a point inside.

    Stresses under line loads (Flamant) on the Hertzian semi-ellipse give the strain along the
    axis, in plane strain; its sum from the surface to the depth is the approach.
    """
    nu, b = wall[1], half_width(q, softness(wall))

    def strain(z: float, s: float) -> float:
        r2 = s * s + z * z
        load = 2.0 * q / (np.pi * b) * np.sqrt(1.0 - (s / b) ** 2)
        down, across = z**3, s * s * z
        factor = 2.0 * load / (np.pi * r2 * r2)
        return softness(wall) * factor * (down - nu / (1.0 - nu) * across)

    return 2.0 * dblquad(strain, 0.0, b, 0.0, DEPTH, epsrel=1e-6)[0]


def johnson_roller(q: float, body: tuple[float, float]) -> float:
    """Approach [m] of a roller's axis to a rigid flat (Johnson 5.6)."""
    soft = softness(body)
    return q * soft / np.pi * (2.0 * np.log(4.0 * RADIUS / half_width(q, soft)) - 1.0)


def punch_by_quadrature(radius: float, body: tuple[float, float]) -> float:
    """How far [m/N] the surface yields under the middle of a rigid punch of 1 N.

    Boussinesq's (1 - nu^2)/(pi E) p/r under the pressure p = 1/(2 pi a sqrt(a^2 - r^2)), over the
    circle; with r = a sin(t) the integrand is smooth.
    """

    def ring(t: float) -> float:
        r, depth = radius * np.sin(t), radius * np.cos(t)
        pressure = 1.0 / (2.0 * np.pi * radius * depth)
        return softness(body) / (np.pi * r) * pressure * 2.0 * np.pi * r * depth

    return quad(ring, 0.0, 0.5 * np.pi)[0]


def wall_law(roller: tuple[float, float], wall: tuple[float, float]) -> tuple[float, float]:
    return laws.pocket_line_law(radius=RADIUS, length=LENGTH, depth=DEPTH, roller=roller, wall=wall)


def approach(law: Sequence[float] | np.ndarray, force: float) -> float:
    """Penetration [m] of F = K d^n at a force [N]."""
    return (force / law[0]) ** (1.0 / law[1])


def rows() -> Iterator[Row]:
    one = laws.iso_line_stiffness(LENGTH, 1.0 / softness(STEEL)) / MM
    yield Row("roller on one race, K", "N/mm^(10/9)", 454517.5, one, PRINTED)
    series = one * 2.0 ** (-10.0 / 9.0)
    yield Row("both races in series, c_L", "N/mm^(10/9)", 210413.1, series, PRINTED)
    by_iso, by_palmgren = (
        laws.normal_parameters(NormalLaw(stiffness_factor=f), one * MM, 10.0 / 9.0)[:2]
        for f in (1.0, PALMGREN)
    )
    yield Row("the same by Palmgren, K", "N/mm^(10/9)", 471733.5, by_palmgren[0] / MM, SHORT)
    for load, both in APPROACH.items():
        for author, law, expected in zip(("ISO", "Palmgren"), (by_iso, by_palmgren), both):
            found = 1e6 * approach(law, load)
            yield Row(f"approach at {load:g} N, {author}", "um", expected, found, ROUNDED)
    wall = wall_law(RIGID, BRASS)
    for force in (1.0, 30.0, 300.0):
        expected = wall_by_quadrature(force / LENGTH, BRASS)
        name = f"brass wall under a rigid roller, {force:g} N"
        yield Row(name, "um", 1e6 * expected, 1e6 * approach(wall, force), POWER_LAW)
    roller = wall_law(STEEL, RIGID)
    for force in (1.0, 30.0, 300.0):
        expected = johnson_roller(force / LENGTH, STEEL)
        name = f"steel roller on a rigid wall, {force:g} N"
        yield Row(name, "um", 1e6 * expected, 1e6 * approach(roller, force), POWER_LAW)
    found = 1e-6 * laws.flat_end_stiffness(2e-3, (1e18, 0.3), STEEL)
    expected = 1e-6 / punch_by_quadrature(2e-3, STEEL)
    yield Row("flat end of 2 mm radius on steel", "N/um", expected, found, PUNCH)


def test_line_contact():
    check(rows())
