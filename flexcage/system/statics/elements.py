"""What a bearing family supplies to the static solution: its rolling elements between two rings.

An element feels the displacement v of the inner ring at its azimuth and has coordinates w of its
own: n of them, mostly two. It answers with the forces that the ring must exert on it, with the
unbalance of its own forces, and with their exact derivatives. Nothing else here knows balls from
rollers.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from flexcage.contacts.spec import Contacts
from flexcage.system.statics.options import StaticOptions


@dataclass(frozen=True)
class Response:
    """Forces of all elements at given displacements; Z elements, n coordinates w each.

    v: axial and radial displacement [m] of the inner ring at the element's azimuth and its tilt
    [rad] about the tangent there. ``ring``: what the ring exerts along v; ``unbalance``: of the
    element, along w, zero in equilibrium. ``energy`` [J] has both as its gradients while ``share``
    is 0.
    """

    energy: np.ndarray  # (Z,)
    ring: np.ndarray  # (Z, 3)
    unbalance: np.ndarray  # (Z, n)
    ring_v: np.ndarray  # (Z, 3, 3)
    ring_w: np.ndarray  # (Z, 3, n)
    unbalance_v: np.ndarray  # (Z, n, 3)
    unbalance_w: np.ndarray  # (Z, n, n)


@dataclass(frozen=True)
class ElementLoads:
    """Loads of all elements at inner (0) and outer (1) race, NaN where there is no contact."""

    azimuth: np.ndarray  # (Z,) rad
    force: np.ndarray  # (Z, 2) N
    angle: np.ndarray  # (Z, 2) contact angle, rad
    pressure: np.ndarray  # (Z, 2) largest, Pa
    across: np.ndarray  # (Z, 2) half of the contact's extent across the rolling direction, m
    along: np.ndarray  # (Z, 2) half of its extent in rolling direction, m
    edge: np.ndarray  # (Z, 2) contact's outermost angle less its groove's edge, rad (> 0: over it)
    centrifugal: np.ndarray  # (Z,) N
    gyroscopic: np.ndarray  # (Z,) moment, N m
    orbital_speed: np.ndarray  # (Z,) rad/s
    friction: np.ndarray  # (Z, 2) coefficient that the gyroscopic moment asks of each race
    # (Z,) N that ribs carry through an element towards +x; None without ribs that do
    axial: np.ndarray | None = None
    # (Z,) N on each arc of races that have two, by name: "inner -x" is that at -x of the inner
    # race's middle; None of races of one arc. All else is then of the arc that bears most
    arcs: Mapping[str, np.ndarray] | None = None


class Elements(Protocol):
    """The rolling elements of one bearing at one speed."""

    @property
    def azimuth(self) -> np.ndarray: ...  # (Z,)
    @property
    def carries(self) -> tuple[bool, ...]:
        """Which of x, y, z and tilts about y, z find resistance."""
        ...

    @property
    def scale(self) -> float:
        """A displacement that presses elements hard [m]."""
        ...

    @property
    def conservative(self) -> bool:
        """Have all forces the potential that they have while ``share`` is 0?"""
        ...

    @property
    def pressure_limit(self) -> float:
        """Where ISO 76 sets the static rating [Pa]."""
        ...

    def guesses(self, v: np.ndarray) -> list[np.ndarray]:
        """Coordinates w (Z, n) from which equilibrium at v (Z, 3) may be near, one or more."""
        ...

    def moved(self, w: np.ndarray, step: np.ndarray) -> np.ndarray:
        """Coordinates (Z, n) after a step of Newton's method from w, along the way that forces
        leave free; w + step to first order."""
        ...

    def respond(self, v: np.ndarray, w: np.ndarray, share: float) -> Response:
        """Response at v (Z, 3) and w (Z, n); ``share`` of what is not conservative, 0 to 1."""
        ...

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        """Loads in equilibrium."""
        ...

    def check(self, loads: ElementLoads) -> None:
        """Raise InputError if what balances could not be: a contact where there is no race."""
        ...

    def reference_life(self, v: np.ndarray, w: np.ndarray) -> float:
        """Basic reference rating life L10r of ISO/TS 16281 [10^6 revolutions]."""
        ...


class ElementsOf(Protocol):
    """What a bearing family supplies: the elements of a bearing whose inner ring turns at
    ``speed`` [rad/s]."""

    def __call__(
        self, bearing: Any, *, speed: float, contacts: Contacts, options: StaticOptions
    ) -> Elements: ...


def azimuths(count: int) -> np.ndarray:
    """Azimuths (Z,) [rad] of evenly spaced elements, the first on the y axis."""
    return 2.0 * np.pi * np.arange(count) / count
