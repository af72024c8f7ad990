"""Modified rating life by ISO 281:2007: a_1, a_ISO, the viscosity ratio and the fatigue load limit.

Equations 31 to 42 of the standard, and its annex B. a_ISO of radial ball bearings, for instance, is
0.1 [1 - (2.5671 - 2.2649/kappa^0.054381)^0.83 (e_C C_u/P)^(1/3)]^-9.3 for kappa of 0.1 to 0.4.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, pi, sqrt

from flexcage.core.errors import InputError

#: a_1 by reliability in percent, ISO 281:2007, table 12.
RELIABILITIES: Mapping[float, float] = {
    90.0: 1.0, 95.0: 0.64, 96.0: 0.55, 97.0: 0.47, 98.0: 0.37, 99.0: 0.25, 99.2: 0.22, 99.4: 0.19,
    99.6: 0.16, 99.8: 0.12, 99.9: 0.093, 99.92: 0.087, 99.94: 0.080, 99.95: 0.077,
}  # fmt: skip
LEAST, MOST = 0.1, 50.0  # of a_ISO
KAPPAS = (0.1, 4.0)  # between which the standard has a_ISO
_WITH_ADDITIVES = 3.0  # of a_ISO, at most, where additives stand for viscosity
_CLEAN_ENOUGH = 0.2  # e_C from which they may


@dataclass(frozen=True)
class Endurance:
    """Constants of a_ISO and of C_u of a kind of rolling elements in radial bearings: 0.1 [1 -
    (base - slope/kappa^power)^outer (e_C C_u/P)^inner]^-exponent, and C_u = C0/limit, less above
    100 mm of pitch diameter; ``thrust``: what P is multiplied by of thrust bearings."""

    life: float  # exponent p of (C/P)^p
    base: float
    slopes: tuple[float, float]  # kappa below 0.4, and above
    outer: float
    inner: float
    exponent: float
    limit: float
    large: float
    thrust: float


BALLS = Endurance(3.0, 2.5671, (2.2649, 1.9987), 0.83, 1.0 / 3.0, 9.3, 22.0, 0.5, 3.0)
ROLLERS = Endurance(10.0 / 3.0, 1.5859, (1.3993, 1.2348), 1.0, 0.4, 9.185, 8.2, 0.3, 2.5)
_POWERS = (0.054381, 0.19087, 0.071739)  # of kappa below 0.4, to 1, and beyond


def reliability_factor(percent: float) -> float:
    """a_1; InputError for a reliability that is not in the standard's table."""
    if percent in RELIABILITIES:
        return RELIABILITIES[percent]
    known = ", ".join(f"{value:g}" for value in RELIABILITIES)
    share = "; it is in percent" if 0.0 < percent <= 1.0 else ""
    raise InputError(
        f"life.reliability is {percent:g}, but ISO 281 has a_1 for {known} %{share}.",
        where="life.reliability",
        value=percent,
    )


def modification(
    kind: Endurance, kappa: float, loading: float, *, thrust: bool = False
) -> float:  # fmt: skip
    """a_ISO at a viscosity ratio and at e_C C_u/P; kappa is taken between 0.1 and 4."""
    kappa = min(max(kappa, KAPPAS[0]), KAPPAS[1])
    power = _POWERS[0] if kappa < 0.4 else _POWERS[1] if kappa < 1.0 else _POWERS[2]
    oil = kind.base - kind.slopes[0 if kappa < 0.4 else 1] / kappa**power
    left = 1.0 - oil**kind.outer * (loading / (kind.thrust if thrust else 1.0)) ** kind.inner
    found = inf if left <= 0.0 else 0.1 * left**-kind.exponent
    return min(max(found, LEAST), MOST)


def with_additives(
    kind: Endurance, kappa: float, loading: float, contamination: float, *, thrust: bool = False
) -> float:
    """a_ISO of an oil with proven additives: below kappa = 1 as at 1, at most 3, where it is clean
    enough (ISO 281, 9.3.3)."""
    own = modification(kind, kappa, loading, thrust=thrust)
    if kappa >= 1.0 or contamination < _CLEAN_ENOUGH:
        return own
    return max(own, min(modification(kind, 1.0, loading, thrust=thrust), _WITH_ADDITIVES))


def reference_viscosity(speed: float, pitch_diameter: float) -> float:
    """nu_1 [m^2/s] at a speed [rad/s] on a pitch diameter [m]."""
    n, size = abs(speed) * 30.0 / pi, 1e3 * pitch_diameter
    found = 45000.0 * n**-0.83 if n < 1000.0 else 4500.0 * n**-0.5
    return 1e-6 * found / sqrt(size)


def fatigue_limit(kind: Endurance, static_rating: float, pitch_diameter: float) -> float:
    """C_u [N] from C0 [N], annex B."""
    size = 1e3 * pitch_diameter
    return static_rating / kind.limit * min(100.0 / size, 1.0) ** kind.large
