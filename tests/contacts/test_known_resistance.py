"""Force that rolls a lubricated roller or ball on: elastohydrodynamic, and of a rigid film.

The force on one surface of the most loaded inner contact of an N1013 in oil of 20 mPa s, and the
constant of the film between rigid surfaces that replaces it at light load; the force on one surface
of a 7010C's ball in the same oil, and how it grows. That the bearing in motion feels the latter is
in tests/verification/test_balls_on_a_race.py.

Source: Goksem and Hargreaves, J. Lubr. Technol. 100 (1978) 346, and for balls L. Houpert, J.
Tribol. 109 (1987) 363, F = 2.86 E' R^2 kappa^0.348 G^0.022 U^0.66 W^0.47, both fully flooded and
isothermal, numbers from an independent program; H. M. Martin, Engineering 102 (1916) 119,
integrated here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import log

import numpy as np
from known_rows import check
from law_values import rolling
from scipy.integrate import quad
from scipy.optimize import brentq

from flexcage.contacts import laws
from flexcage.contacts.spec import Lubricant
from flexcage.geometry.hertz import PointContact
from flexcage.verification import Row, Tolerance
from flexcage.verification.bearings import preset

OIL = Lubricant(viscosity=0.02, pressure_coefficient=2e-8, rolling_resistance="goksem_hargreaves")
RADIUS = 4e-3 * 37.25 / 41.25  # roller and inner race of the N1013 [m]
LENGTH, MODULUS = 7.3e-3, 206e9 / (1.0 - 0.3**2)
BALL_LOAD, BALL_SPEED = 255.0, 13.37  # N, m/s: a 7010C at 8000 rpm under 1500 N
# exponents of U, W and G in Houpert's formula
POWERS = {"speed": 0.66, "viscosity": 0.66, "load": 0.47, "pressure coefficient": 0.022}
PRINTED = Tolerance(1e-4, "printed to four digits")
EXACT = Tolerance(1e-9, "arithmetic", absolute=True)
QUADRATURE = Tolerance(1e-9, "quadrature to 1e-8 of Reynolds' equation, and a root")


def martin_constant() -> float:
    """c of F = c sqrt(eta u Q L): Martin's film, dP/dX = (H - H*)/H^3 with H = 1 + X^2.

    P and P' vanish at the exit. Load per length 24 W eta u R/h0, shear 12 sqrt(2) T eta u
    sqrt(R/h0), with W and T the integrals below.
    """

    def slope(x: float, end: float) -> float:
        return (x * x - end * end) / (1.0 + x * x) ** 3

    end = brentq(lambda x: quad(slope, -np.inf, x, args=(x,))[0], 0.1, 1.0)
    load = -quad(lambda x: x * slope(x, end), -np.inf, end)[0]
    shear = quad(lambda x: 0.5 * (1.0 + x * x) * slope(x, end), -np.inf, end)[0]
    return 12.0 * np.sqrt(2.0) * shear / np.sqrt(24.0 * load)


def ball_force(
    oil: Lubricant, contact: PointContact, *, load: float = BALL_LOAD, speed: float = BALL_SPEED
) -> float:
    """Force [N] at one surface of a ball's contact: the moment is that of two, R from the axis."""
    factor, of_rate, of_load = laws.point_rolling_resistance(oil, contact)
    moment = factor * (speed / contact.rolling) ** of_rate * load**of_load
    return float(moment / (2.0 * contact.rolling))


def ball_rows() -> Iterator[Row]:
    contact = preset("7010C-PA66").contacts[0]
    force = ball_force(OIL, contact)
    yield Row("ball, 255 N at 13.37 m/s", "N", 0.1435, force, PRINTED)
    doubled = {
        "speed": ball_force(OIL, contact, speed=2.0 * BALL_SPEED),
        "load": ball_force(OIL, contact, load=2.0 * BALL_LOAD),
        "viscosity": ball_force(replace(OIL, viscosity=2.0 * OIL.viscosity), contact),
        "pressure coefficient": ball_force(
            replace(OIL, pressure_coefficient=2.0 * OIL.pressure_coefficient), contact
        ),
    }
    for name, power in POWERS.items():
        grown = log(doubled[name] / force) / log(2.0)
        yield Row(f"ball, power of {name}", "", power, grown, EXACT)


def test_a_roller():
    c = laws.rolling_resistance(OIL, RADIUS, LENGTH, MODULUS)
    (force,) = rolling(c, 12.837, 185.7)
    check([Row("roller, 185.7 N at 12.837 m/s", "N", 0.7097, force, PRINTED)])


def test_the_constant_of_a_rigid_film():
    check([Row("constant", "", martin_constant(), laws.IVR_CONSTANT, QUADRATURE)])


def test_a_ball():
    check(ball_rows())
