"""What rotation does to balls: centrifugal force, and the gyroscopic moment under race control.

A. B. Jones, J. Basic Eng. 82 (1960) 309; T. A. Harris, Rolling Bearing Analysis, ball motions
and forces at high speed. All functions take arrays of complex numbers as well, so that a step along
the imaginary axis gives derivatives exact to rounding (W. Squire and G. Trapp, SIAM Rev. 40 (1998)
110).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

STEP = 1e-30  # along the imaginary axis, as a share of the quantity: nothing cancels


@dataclass(frozen=True)
class BallMotion:
    """Mass, inertia and path of a ball, and how it is driven round."""

    mass: float
    inertia: float
    diameter: float
    pitch_diameter: float
    groove_radius: float  # of the outer groove's centres about the bearing axis
    speed: float  # of the inner ring, rad/s
    cage_speed: float | None  # prescribed, rad/s
    gyroscopic: tuple[float, float]  # shares of the gyroscopic moment at inner and outer race

    def orbital_speed(self, inner: np.ndarray, outer: np.ndarray) -> np.ndarray:
        """Speed (Z,) [rad/s] about the bearing axis; (cos, sin) (2, Z) of both contact angles."""
        if self.cage_speed is not None:
            return self.cage_speed + 0.0 * inner[0]
        ratio = self.diameter / self.pitch_diameter
        difference = inner[0] * outer[0] + inner[1] * outer[1]
        return self.speed * (1.0 - ratio * inner[0]) / (1.0 + difference)

    def spin(self, inner: np.ndarray, outer: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Ball speed (Z,) [rad/s] about its own axis, and sin of that axis' pitch angle beta.

        tan beta = sin(a_o)/(cos(a_o) + D/dm): no spin on the outer race.
        """
        ratio = self.diameter / self.pitch_diameter
        slope = outer[1] / (outer[0] + ratio)
        cosine = 1.0 / np.sqrt(1.0 + slope * slope)
        on_outer = (outer[0] + slope * outer[1]) / (1.0 + ratio * outer[0])
        on_inner = (inner[0] + slope * inner[1]) / (1.0 - ratio * inner[0])
        return -self.speed / ((on_outer + on_inner) * ratio * cosine), slope * cosine

    def centrifugal(self, inner: np.ndarray, outer: np.ndarray, radial: np.ndarray) -> np.ndarray:
        """Centrifugal force (Z,) [N] where balls are, ``radial`` [m] from the groove's centre."""
        turn = self.orbital_speed(inner, outer)
        return self.mass * (self.groove_radius + radial) * turn * turn

    def moment(self, inner: np.ndarray, outer: np.ndarray) -> np.ndarray:
        """Gyroscopic moment (Z,) [N m], > 0 for a contact angle > 0."""
        spin, pitch = self.spin(inner, outer)
        return -self.inertia * spin * self.orbital_speed(inner, outer) * pitch


def directions(ball: np.ndarray, groove: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(cos, sin) (2, Z) of inner and outer contact angle.

    ``ball`` and ``groove`` (2, Z): ball's centre and inner groove's centre from the outer one's,
    axially and radially.
    """
    found = []
    for line in (groove - ball, ball):
        length = np.sqrt(line[0] * line[0] + line[1] * line[1])
        found.append(np.stack([line[1], line[0]]) / length)
    return found[0], found[1]


def inertia_forces(
    motion: BallMotion, ball: np.ndarray, groove: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Centrifugal and gyroscopic forces (2, Z) on balls, and gyroscopic ones on them from the
    inner ring (2, Z), axially and radially [N].

    Friction T = lambda M/D at each race, along its tangent, balances the moment M.
    """
    inner, outer = directions(ball, groove)
    push = motion.centrifugal(inner, outer, ball[1])
    unit = motion.moment(inner, outer) / motion.diameter if any(motion.gyroscopic) else 0.0 * push
    from_inner, from_outer = (2.0 * share * unit for share in motion.gyroscopic)
    ring = np.stack([-from_inner * inner[0], from_inner * inner[1]])
    rest = np.stack([from_outer * outer[0], push - from_outer * outer[1]])
    return ring + rest, ring


def with_derivatives(
    motion: BallMotion, ball: np.ndarray, groove: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Inertia forces (4, Z), those on the ball before the ring's, and their derivatives (4, Z, 4).

    The derivatives are along ball's and groove's axial and radial place, in this order.
    """
    value = np.concatenate(inertia_forces(motion, ball, groove))
    slopes = np.empty((*value.shape, 4))
    for k in range(4):
        place = np.concatenate([ball, groove]).astype(complex)
        place[k] += 1j * STEP
        moved = np.concatenate(inertia_forces(motion, place[:2], place[2:]))
        slopes[:, :, k] = moved.imag / STEP
    return value, slopes
