"""The equilibrium of a bearing at rest or at a steady speed, as a frozen value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from flexcage.geometry.film import Film
from flexcage.geometry.fits.mounting import Mounting
from flexcage.system.statics.elements import ElementLoads
from flexcage.system.statics.rated import Lives
from flexcage.system.statics.rings import BentRing


@dataclass(frozen=True)
class Ratings:
    """Ratings [N] and lives [10^6 revolutions that nine bearings in ten reach]."""

    static: float  # C0 of ISO 76
    dynamic: float  # C, ISO 281's or the catalogue's
    names: tuple[str, str]  # their symbols
    equivalent_load: float  # P of ISO 281 [N], NaN where the standard has no factors
    life: float  # L10 of ISO 281
    reference_life: float  # L10r of ISO/TS 16281, from every element's load


@dataclass(frozen=True, eq=False)
class StaticState:
    """Equilibrium of one bearing's inner ring, in SI units and radians.

    Arrays of five are x, y, z and the tilts about y and z, of forces and moments on the inner ring
    likewise; they refer to the middle of the plane of ball centres, or of the rollers. ``load`` is
    what was asked, ``reaction`` what holds motions that are held, and what a compliant shaft's
    springs bear. ``elements`` lists every element, inner race before outer, and ``film`` (Z, 2) the
    lubricant's thickness there, of rolling without slip. ``stiffness`` (5, 5) is the exact tangent
    of what the elements bear over displacement, at constant speed, the elements following.
    ``frequencies`` [Hz] by name are those of pure rolling at the mean contact angles of loaded
    elements, ``nominal_frequencies`` at the nominal angle (``geometry.kinematics``).
    ``outer`` (5,) is the displacement of the outer ring, whose seat may yield: ``displacement`` and
    ``stiffness`` have the seat's share in them.
    """

    title: str
    speed: float
    load: np.ndarray
    displacement: np.ndarray
    reaction: np.ndarray
    stiffness: np.ndarray
    elements: ElementLoads
    film: Film
    ratings: Ratings
    warnings: tuple[str, ...]
    unbalanced: float  # largest force left over, as a share of the load
    held: str = ""  # how the inner ring is held, in words
    rings: tuple[BentRing, ...] = ()  # that bend
    outer: np.ndarray = field(default_factory=lambda: np.zeros(5))
    mounting: Mounting | None = None  # of the bearing that this is, if fits were given
    lives: Lives | None = None  # as they are quoted, if the case asks how
    frequencies: Mapping[str, float] = field(default_factory=dict)
    nominal_frequencies: Mapping[str, float] = field(default_factory=dict)

    @property
    def largest_force(self) -> float:
        """Largest force [N] of an element on a race."""
        return float(self.elements.force.max())

    @property
    def largest_pressure(self) -> float:
        """Largest Hertz pressure [Pa]."""
        return float(self.elements.pressure.max())

    @property
    def loaded(self) -> int:
        """Number of elements that bear more than a millionth of the largest force on both races."""
        least = 1e-6 * self.largest_force
        return int(np.count_nonzero((self.elements.force > least).all(axis=1)))

    def life_hours(self) -> float:
        """Basic reference rating life [h] at this speed; infinite at rest."""
        turns = abs(self.speed) / (2.0 * np.pi) * 3600.0
        return 1e6 * self.ratings.reference_life / turns if turns else float("inf")
