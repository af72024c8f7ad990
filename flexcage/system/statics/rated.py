"""Lives as they are quoted, as values."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan


@dataclass(frozen=True)
class RatedLife:
    """Life at one speed and load. Lives in 10^6 revolutions, of ``reliability`` percent: ``life``
    is L_nm of ISO 281, ``reference_life`` L_nmr of ISO/TS 16281; ``hours`` is the latter. What is
    not known is NaN: a_ISO without a contamination, P where the standard has no factors."""

    speed: float
    radial: float
    axial: float
    temperature: float | None
    equivalent_load: float
    viscosity: float  # m^2/s
    reference_viscosity: float
    starved: float  # share of the flooded film
    kappa: float
    modification: float  # a_ISO at P
    reference_modification: float  # at the reference load of the elements' own loads
    life: float
    reference_life: float
    hours: float


@dataclass(frozen=True)
class Lives:
    """Lives as they are quoted: at the case's own speed and load, and of a spectrum's ``points``
    with their ``shares`` of the time and the life of all of them together [h]."""

    reliability: float
    reliability_factor: float
    contamination: float | None
    fatigue_limit: float
    here: RatedLife
    shares: tuple[float, ...] = ()
    points: tuple[RatedLife | None, ...] = ()  # None: standing still
    combined: float = nan

    @property
    def symbol(self) -> str:
        """n of L_n: percent of bearings that fail, in the digits of the standard."""
        return f"{100.0 - self.reliability:.2f}".rstrip("0").rstrip(".")
