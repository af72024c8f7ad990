"""Balls between races of two arcs as an energy in space, whose minimum scipy seeks.

Nothing here is taken from flexcage's static solution but Hertz stiffnesses: balls and ring are
points in Cartesian coordinates, arcs circles of centres on two rigid rings, and a cage that turns
at a given speed adds -m (omega r)^2/2 a ball.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares, minimize

MICRON, TILT = 1e-6, 1e-4  # units of the search


@dataclass
class LeastEnergy:
    bearing: object
    load: np.ndarray  # (5,) forces along x, y, z and moments about y, z on the inner ring
    cage_speed: float = 0.0

    def __post_init__(self):
        b = self.bearing
        self.azimuth = 2.0 * np.pi * np.arange(b.ball_count) / b.ball_count
        self.out = np.stack([0.0 * self.azimuth, np.cos(self.azimuth), np.sin(self.azimuth)])
        self.along = np.array([[1.0], [0.0], [0.0]])
        self.radii = b.inner_groove_centre[1], b.outer_groove_centre[1]

    def springs(self, u):
        """Per race and arc: from the arc's centre to the ball's (3, Z), seen from inner and outer
        race towards where the ball rolls; of displacements u of ring and balls."""
        shift, turn = u[:3, None], np.array([0.0, *u[3:5]])
        balls = self.out * (self.radii[1] + u[5::2]) + self.along * u[6::2]
        for race, sign in (("inner", 1.0), ("outer", -1.0)):
            shim = getattr(self.bearing, f"{race}_shim")
            for side in (1.0, -1.0) if shim else (0.0,):
                centre = (
                    self.out * self.radii[race == "outer"] + self.along * 0.5 * sign * side * shim
                )
                moved = shift + np.cross(turn, centre.T).T if race == "inner" else 0.0
                yield race, side, centre, balls - centre - moved

    def force(self, race, line):
        """Contact forces (Z,) and stored energies of balls at ``line`` from an arc's centre."""
        b, k = self.bearing, int(race == "outer")
        contact, radius = b.contacts[k], getattr(b, f"{race}_groove_radius")
        flat = np.hypot(line[0], (line * self.out).sum(axis=0))  # in the ball's own plane
        depth = np.maximum(flat - radius + 0.5 * b.ball_diameter, 0.0)
        return contact.stiffness * depth**1.5, 0.4 * contact.stiffness * depth**2.5, flat

    def energy(self, z):
        """Total energy [N um] and its gradient over coordinates in units of the search."""
        units = np.array([MICRON] * 3 + [TILT] * 2 + [MICRON] * (2 * len(self.azimuth)))
        u, mass = z * units, self.bearing.ball_mass
        total, slope = -self.load @ u[:5], np.zeros(len(z))
        slope[:5] = -self.load
        for race, _, centre, line in self.springs(u):
            force, stored, flat = self.force(race, line)
            total += stored.sum()
            axial = force * line[0] / flat
            radial = force * (line * self.out).sum(axis=0) / flat
            slope[6::2] += axial
            slope[5::2] += radial
            if race == "inner":
                pull = self.along * axial + self.out * radial  # on the ball; the ring's is minus
                slope[:3] -= pull.sum(axis=1)
                slope[3:5] -= np.cross(centre.T, pull.T).sum(axis=0)[1:]
        away = self.radii[1] + u[5::2]
        total -= 0.5 * mass * (self.cage_speed * away) ** 2 @ np.ones_like(away)
        slope[5::2] -= mass * self.cage_speed**2 * away
        return total / MICRON, slope * units / MICRON

    def solved(self):
        """Displacement (5,) of the ring, and forces (Z,) by race and side of the contact angle."""
        b = self.bearing
        start = np.zeros(5 + 2 * b.ball_count)
        seat = b.lengths[1] * np.cos(b.shim_angles[1])
        start[5::2] = seat / MICRON
        push = np.sign(self.load[:3]) * (np.abs(self.load[:3]) > 0.0)
        start[:3] = push * [0.5 * b.axial_clearance, 0.5 * b.clearance, 0.5 * b.clearance] / MICRON
        near = minimize(self.energy, start, jac=True, method="BFGS", options={"maxiter": 4000})
        gradient = least_squares(
            lambda z: self.energy(z)[1], near.x, xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=40
        )
        assert np.abs(gradient.fun).max() < 1e-4, gradient.message
        units = np.array([MICRON] * 3 + [TILT] * 2 + [MICRON] * (2 * b.ball_count))
        u = gradient.x * units
        forces = {
            (race, side): self.force(race, line)[0] for race, side, _, line in self.springs(u)
        }
        return u[:5], forces
