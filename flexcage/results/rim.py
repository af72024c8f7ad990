"""The outside of a cage that lasers look at: how far it is from a circle about the cage's axis."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.units import mm

ITERATIONS = 20  # of where a line leaves a lobed rim; it gains two digits or more in each
CLOSE = 1e-13  # m, at which they end
STEEPEST = 0.1  # slope of the rim against a circle
_LARGEST = 1e-2  # m, of what a rim is out by


@dataclass(frozen=True, kw_only=True)
class Rim:
    """Roundness and eccentricity of a cage's outside: its radius is R + a cos(n (angle - phase))
    about a centre beside the cage's axis. Lengths in metres, angles in radians, seen from pocket 0
    and turning with the cage.

    The out-of-roundness that a drawing gives, highest less lowest, is twice the amplitude. Raises
    InputError for values that are no numbers in SI, and for fewer than two lobes.
    """

    lobes: int = 2  # n
    amplitude: float = 0.0  # a
    phase: float = 0.0  # angle of a lobe's top
    eccentricity: float = 0.0  # of the rim's centre from the cage's axis
    eccentricity_phase: float = 0.0  # angle towards which it lies

    def __post_init__(self) -> None:
        if not isinstance(self.lobes, int | np.integer) or self.lobes < 2:
            raise InputError(
                f"lobes is {self.lobes}, but should be a whole number from 2 on; one lobe is an "
                "eccentricity.",
                where="lobes",
                value=self.lobes,
            )
        for name in ("amplitude", "eccentricity"):
            self._check(name, 0.0, _LARGEST, "a length in metres, from 0 m to 0.01 m")
        for name in ("phase", "eccentricity_phase"):
            self._check(name, -2.0 * pi, 2.0 * pi, "in radians, up to 2 pi")

    def _check(self, name: str, least: float, most: float, wanted: str) -> None:
        value = getattr(self, name)
        number = isinstance(value, int | float | np.number) and not isinstance(value, bool)
        if not number or not least <= value <= most:
            shown = value if number else repr(value)
            raise InputError(f"{name} is {shown}, but should be {wanted}.", where=name, value=value)

    @property
    def round(self) -> bool:
        """Is it a circle about the cage's axis?"""
        return self.amplitude == 0.0 and self.eccentricity == 0.0

    def check_on(self, radius: float) -> None:
        """Raise InputError for lobes that are too steep on a cage of this radius [m]."""
        if self.amplitude * self.lobes > STEEPEST * radius:
            raise InputError(
                f"The rim has {self.lobes} lobes of {mm(self.amplitude)}, which are steeper than "
                f"1 in 10 on a radius of {mm(radius)}; give a smaller amplitude.",
                where="rim",
                value=self.amplitude,
            )

    def distances(
        self, line: Line, centre: np.ndarray, axis: np.ndarray, mark: np.ndarray, radius: float
    ) -> np.ndarray:
        """Distance (n,) along a line at which it leaves the rim of cages at ``centre`` (n, 3) [m]
        with unit ``axis`` (n, 3), whose pocket 0 lies towards the unit vector ``mark`` (n, 3)."""
        aside = np.cross(axis, mark)
        turn = self.eccentricity_phase
        middle = centre + self.eccentricity * (np.cos(turn) * mark + np.sin(turn) * aside)
        found = leaves(line, middle, axis, radius)
        for _ in range(ITERATIONS if self.amplitude else 0):
            point = line.start + found[:, None] * line.direction - middle
            angle = np.arctan2((point * aside).sum(axis=1), (point * mark).sum(axis=1))
            lift = self.amplitude * np.cos(self.lobes * (angle - self.phase))
            last, found = found, leaves(line, middle, axis, radius + lift)
            if np.nanmax(np.abs(found - last), initial=0.0) < CLOSE:
                break
        return found


@dataclass(frozen=True)
class Line:
    """A line of sight: where it starts (3,) [m], and its unit direction (3,)."""

    start: np.ndarray
    direction: np.ndarray


def leaves(
    line: Line, centre: np.ndarray, axis: np.ndarray, radius: float | np.ndarray
) -> np.ndarray:
    """Distance (n,) [m] along a line at which it leaves each of the cylinders."""
    from_centre = line.start - centre
    d = line.direction - (axis @ line.direction)[:, None] * axis
    o = from_centre - np.einsum("ni,ni->n", from_centre, axis)[:, None] * axis
    a, b = (d * d).sum(axis=1), (d * o).sum(axis=1)
    root = np.sqrt(b * b - a * ((o * o).sum(axis=1) - radius**2))
    return (root - b) / a
