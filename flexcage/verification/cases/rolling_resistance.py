"""Force that rolls a lubricated roller on: elastohydrodynamic, and of a rigid film."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from flexcage.contacts import laws
from flexcage.contacts.spec import Lubricant
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.law_values import rolling

RADIUS = 4e-3 * 37.25 / 41.25  # roller and inner race of the N1013 [m]
LENGTH, MODULUS = 7.3e-3, 206e9 / (1.0 - 0.3**2)
PRINTED = Tolerance(1e-4, "printed to four digits")
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


def rows() -> Iterator[Row]:
    oil = Lubricant(
        viscosity=0.02, pressure_coefficient=2e-8, rolling_resistance="goksem_hargreaves"
    )
    c = laws.rolling_resistance(oil, RADIUS, LENGTH, MODULUS)
    (force,) = rolling(c, 12.837, 185.7)
    yield Row("elastohydrodynamic, 185.7 N at 12.837 m/s", "N", 0.7097, force, PRINTED)
    yield Row("rigid film, constant", "", martin_constant(), laws.IVR_CONSTANT, QUADRATURE)


CASE = KnownAnswer(
    name="rolling_resistance",
    title="Rolling resistance of a lubricated roller",
    source="Goksem and Hargreaves, J. Lubr. Technol. 100 (1978) 346, fully flooded and isothermal, "
    "number from an independent program; H. M. Martin, Engineering 102 (1916) 119, integrated here",
    checks="The force on one surface of the most loaded inner contact of an N1013 in oil of 20 mPa "
    "s, and the constant of the film between rigid surfaces that replaces it at light load.",
    rows=rows,
)
