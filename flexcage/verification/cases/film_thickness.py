"""The lubricant's film between rolling elements and races."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import log
from typing import Any

import numpy as np

from flexcage.spec import Lubricant
from flexcage.verification.bearings import preset
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

OIL = Lubricant(viscosity=0.02, pressure_coefficient=2e-8).oil
# exponents of U, G and W in the formulas: central and least, of points (balls) and lines (rollers)
POWERS = {
    "7010C-PA66": ((0.67, 0.53, -0.067), (0.68, 0.49, -0.073)),
    "N1013": ((0.69, 0.56, -0.10), (0.70, 0.54, -0.13)),
}
SAMPLE = Tolerance(3e-4, "speeds and loads of the samples are given to three to five digits")
EXACT = Tolerance(1e-9, "arithmetic", absolute=True)


def film(name: str, load: float, speed: float, oil: Any = OIL) -> Any:
    """Film at both races of a preset under a load [N] at an entrainment speed [m/s]."""
    both = np.ones(2)
    return preset(name).race_film(load * both, speed * both, oil)


def rows() -> Iterator[Row]:
    least = 1e6 * film("N1013", 185.7, 12.837).least[0]
    yield Row("N1013, 185.7 N: least, inner race", "um", 0.7743, least, SAMPLE)
    central = 1e6 * film("7010C-PA66", 255.0, 13.37).central[0]
    yield Row("7010C, 255 N: centre, inner race", "um", 0.7104, central, SAMPLE)
    for name in POWERS:
        yield from _power_rows(name)


def _power_rows(name: str) -> Iterator[Row]:
    """How films grow as speed, pressure coefficient and load double."""
    doubled = replace(OIL, pressure_coefficient=2.0 * OIL.pressure_coefficient)
    base = film(name, 9.0, 2.0)
    for what, other, k in (
        ("speed", film(name, 9.0, 4.0), 0),
        ("pressure coefficient", film(name, 9.0, 2.0, doubled), 1),
        ("load", film(name, 18.0, 2.0), 2),
    ):
        for place, powers in zip(("central", "least"), POWERS[name]):
            grown = log(float(getattr(other, place)[0] / getattr(base, place)[0])) / log(2.0)
            yield Row(f"{name}, {place}: power of {what}", "", powers[k], grown, EXACT)


CASE: KnownAnswer = KnownAnswer(
    name="film_thickness",
    title="Film thickness of races",
    source="formulas of Hamrock and Dowson (1977), Dowson (1968), Dowson and Toyoda (1978); "
    "samples of an independent program",
    checks="Least film of a roller and central film of a ball at the inner race, and all "
    "exponents, by doubling.",
    rows=rows,
)
