"""Figures of a bearing's rating life, as makers quote it."""

from __future__ import annotations

from math import isfinite, pi

from flexcage.results.figures.figure import FigureTable, Found
from flexcage.system.statics.rated import Lives, RatedLife

_STATIC = "by the static solution at the start"


def _hours(lives: Lives, turns: float) -> Found | None:
    """A life [10^6 revolutions] as a time."""
    speed = abs(lives.here.speed)
    return Found(1e6 * turns * 2.0 * pi / speed, _STATIC) if speed and isfinite(turns) else None


def _oil(point: RatedLife) -> Found | None:
    if not isfinite(point.kappa):
        return None
    both = (1e6 * point.viscosity, 1e6 * point.reference_viscosity)
    return Found(point.kappa, f"{both[0]:.4g} of {both[1]:.4g} mm^2/s")


def _known(value: float, note: str = "") -> Found | None:
    return Found(value, note) if isfinite(value) else None


# fmt: off
#: Of cases with [life].
LIFE = FigureTable[Lives]("Rating life", "section [life]")
LIFE.add("life_kappa", "Viscosity ratio kappa", "", "of the oil's viscosity to ISO 281's nu_1",
         take=lambda lives: _oil(lives.here))
LIFE.add("life_a1", "Reliability factor a1", "", "ISO 281",
         take=lambda lives: Found(lives.reliability_factor, f"at {lives.reliability:g} %"))
LIFE.add("life_a_iso", "Life modification factor a_ISO", "",
         "ISO 281, at the reference load of ISO/TS 16281",
         take=lambda lives: _known(lives.here.reference_modification))
LIFE.add("life_nmh", "Life L_nm, ISO 281", "h", "with a1, and a_ISO if the contamination is given",
         take=lambda lives: _hours(lives, lives.here.life))
LIFE.add("life_nmrh", "Life L_nmr, ISO/TS 16281", "h", "likewise, from every element's load",
         take=lambda lives: _hours(lives, lives.here.reference_life))
LIFE.add("life_spectrum", "Life under the load spectrum", "h",
         "L_nmr of all its points together, Palmgren and Miner",
         take=lambda lives: Found(3600.0 * lives.combined, f"{len(lives.points)} points")
         if isfinite(lives.combined) else None)
