"""The film of a long elliptical contact, worked out in a textbook.

A roller bearing by B. J. Hamrock and D. Dowson, Lubrication of Machine Elements, NASA RP-1126, from
the formula of points with an axis ratio without bound: least film 50.5e-6 radii, 0.32 um (quoted
from memory; the example's speed, U and W, 10.061 m/s, 6.895e-11 and 5.140e-4, come out as well).
"""

import numpy as np
from known_rows import check

from flexcage.geometry.film import Oil, point_film
from flexcage.geometry.hertz import PointContact
from flexcage.verification import Row, Tolerance

# rollers of 16 by 16 mm between races of 64 and 96 mm, the inner at 524 rad/s
INNER = PointContact(rolling=6.4e-3, transverse=6.4e3, modulus=2.28e11)
OIL, LOAD, SPEED = Oil(0.01, 2.2e-8), 4800.0, 10.061  # N on the hardest pressed, m/s
ROUNDED = Tolerance(2e-3, "printed to three digits")
SHORT = Tolerance(0.015, "printed to two digits")


def test_least_film_of_a_long_ellipse():
    found = 1e6 * float(point_film(INNER, np.array(LOAD), np.array(SPEED), OIL).least)
    check([
        Row("least over radius", "1e-6", 50.5, found / INNER.rolling, ROUNDED),
        Row("least", "um", 0.32, found, SHORT),
    ])  # fmt: skip
