"""The lubricant's film between rolling elements and races."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import log

import numpy as np

from flexcage.case.presets import load_preset
from flexcage.geometry.film import Film, Oil, line_film, point_film
from flexcage.geometry.hertz import PointContact
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

OIL = Oil(viscosity=0.02, pressure_coefficient=2e-8)
# Hamrock and Dowson's roller bearing: rollers of 16 by 16 mm between races of 64 and 96 mm, the
# inner at 524 rad/s; 4800 N on the hardest pressed
INNER = PointContact(rolling=6.4e-3, transverse=6.4e3, modulus=2.28e11)
ROLLER_OIL, ROLLER_LOAD, ROLLER_SPEED = Oil(0.01, 2.2e-8), 4800.0, 10.061
# exponents of U, G and W in the formulas: central and least, of points and of lines
POWERS = {
    "point": ((0.67, 0.53, -0.067), (0.68, 0.49, -0.073)),
    "line": ((0.69, 0.56, -0.10), (0.70, 0.54, -0.13)),
}
SAMPLE = Tolerance(3e-4, "speeds and loads of the samples are given to three to five digits")
ROUNDED = Tolerance(2e-3, "printed to three digits")
SHORT = Tolerance(0.015, "printed to two digits")
EXACT = Tolerance(1e-9, "arithmetic", absolute=True)


def rows() -> Iterator[Row]:
    race = np.ones(2)
    roller = load_preset("N1013").bearing.race_film(185.7 * race, 12.837 * race, OIL)
    yield Row("N1013, 185.7 N: least, inner race", "um", 0.7743, 1e6 * roller.least[0], SAMPLE)
    ball = load_preset("7010C-PA66").bearing.race_film(255.0 * race, 13.37 * race, OIL)
    yield Row("7010C, 255 N: centre, inner race", "um", 0.7104, 1e6 * ball.central[0], SAMPLE)
    film = point_film(INNER, np.array(ROLLER_LOAD), np.array(ROLLER_SPEED), ROLLER_OIL)
    found = float(film.least)
    yield Row("long ellipse, 4800 N: least over radius", "1e-6", 50.5,
              1e6 * found / INNER.rolling, ROUNDED)  # fmt: skip
    yield Row("long ellipse, 4800 N: least", "um", 0.32, 1e6 * found, SHORT)
    yield from _power_rows("point", _of_point)
    yield from _power_rows("line", _of_line)


def _of_point(load: float, speed: float, oil: Oil) -> Film:
    return point_film(INNER, np.array(load), np.array(speed), oil)


def _of_line(load: float, speed: float, oil: Oil) -> Film:
    return line_film(INNER.rolling, INNER.modulus, np.array(load), np.array(speed), oil)


def _power_rows(kind: str, film: Callable[[float, float, Oil], Film]) -> Iterator[Row]:
    """How films grow as speed, pressure coefficient and load double."""
    doubled = replace(OIL, pressure_coefficient=2.0 * OIL.pressure_coefficient)
    base = film(9.0, 2.0, OIL)
    for name, other, k in (
        ("speed", film(9.0, 4.0, OIL), 0), ("pressure coefficient", film(9.0, 2.0, doubled), 1),
        ("load", film(18.0, 2.0, OIL), 2),
    ):  # fmt: skip
        for place, powers in zip(("central", "least"), POWERS[kind]):
            grown = log(float(getattr(other, place) / getattr(base, place))) / log(2.0)
            yield Row(f"{kind}, {place}: power of {name}", "", powers[k], grown, EXACT)


CASE = KnownAnswer(
    name="film_thickness",
    title="Film thickness of races",
    source="formulas of Hamrock and Dowson (1977), Dowson (1968), Dowson and Toyoda (1978); "
    "samples of an independent program; the roller bearing worked out by B. J. Hamrock and D. "
    "Dowson, Lubrication of Machine Elements, NASA RP-1126, from the formula of points with an "
    "axis ratio without bound: least film 50.5e-6 radii, 0.32 um (quoted from memory; the "
    "example's speed, U and W, 10.061 m/s, 6.895e-11 and 5.140e-4, come out as well)",
    checks="Least film of a roller and central film of a ball at the inner race; the worked "
    "example; and all exponents, by doubling.",
    rows=rows,
)
