"""Barrels between circles by solvers that know nothing of levers.

``Centres``: arcs touch arcs along the line of their centres, so that a barrel without inertia is
two springs between the sphere's centre and the groove's, wherever rotations of any size take that.
``energy_of`` places a barrel by rotation matrices and measures how deep its points lie in circles.
"""

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
from scipy.optimize import brentq, root
from scipy.spatial.transform import Rotation

from flexcage.contacts.laws import iso_line_stiffness
from flexcage.contacts.spec import Contacts


@dataclass
class Centres:
    """Barrels as two springs each along lines from the sphere's centre to the grooves'."""

    bearing: object
    slices: int

    def __post_init__(self):
        b = self.bearing
        half, across = 0.5 * b.effective_length, b.contact_angle
        self.x = (np.arange(self.slices) + 0.5) / self.slices * 2.0 * half - half
        self.line = iso_line_stiffness(2.0 * half, b.race_modulus) / self.slices
        far = b.reach + b.inner_groove_radius - 0.5 * b.roller_diameter - b.gap
        self.grooves = []
        for side, turned in ((-1.0, 0.0), (1.0, pi / b.roller_count)):
            for k in range(b.roller_count):
                psi = 2.0 * pi * k / b.roller_count + (turned if b.staggered else 0.0)
                out = np.array([0.0, cos(psi), sin(psi)])
                self.grooves.append(far * (sin(across) * np.array([side, 0.0, 0.0])
                                           + cos(across) * out))  # fmt: skip

    def on_race(self, radius, depth):
        """Resultant [N] of a barrel's slices, ``depth`` deep in an arc of ``radius`` amid them."""
        own = self.bearing.barrel_radius
        apart = radius - own + depth
        along = np.sqrt(1.0 - (self.x / own) ** 2)
        far = np.sqrt(apart**2 + own**2 + 2.0 * apart * own * along)
        pressed = np.maximum(far - radius, 0.0) ** (10 / 9)
        return self.line * (pressed * (apart + own * along) / far).sum()

    def force(self, pressed):
        """Of a barrel [N] that is pressed together by so much [m] between both races."""
        if pressed <= 0.0:
            return 0.0
        radii = self.bearing.inner_groove_radius, self.bearing.sphere_radius
        inner = brentq(
            lambda d: self.on_race(radii[0], d) - self.on_race(radii[1], pressed - d),
            0.0, pressed, xtol=1e-18,
        )  # fmt: skip
        return self.on_race(radii[0], inner)

    def forces(self, u, turn):
        """Forces (2 Z,) of all barrels, and their directions (2 Z, 3), with the inner ring moved
        by u (3,) and turned by a matrix."""
        b, found, lines = self.bearing, [], []
        for groove in self.grooves:
            line = turn @ groove + u
            far = np.linalg.norm(line)
            pressed = far - (b.sphere_radius + b.inner_groove_radius - b.roller_diameter)
            found.append(self.force(pressed))
            lines.append(line / far)
        return np.array(found), np.array(lines)

    def solved(self, load, turn, near):
        best = root(
            lambda um: self.forces(um * 1e-6, turn)[0] @ self.forces(um * 1e-6, turn)[1] - load,
            near * 1e6, tol=1e-9,
        )  # fmt: skip
        assert best.success, best.message
        return best.x * 1e-6


def rotated(y, z):
    """Rotation about the vector (0, y, z)."""
    return Rotation.from_rotvec([0.0, y, z]).as_matrix()


def energy_of(b, ring, barrel, push):
    """Of one barrel of the row at +x in its plane, placed by rotations."""
    slices = Contacts().race.slices
    half, angle = 0.5 * b.effective_length, b.contact_angle
    line = iso_line_stiffness(2.0 * half, b.race_modulus) / slices
    frame = np.array([[cos(angle), sin(angle)], [-sin(angle), cos(angle)]])  # columns s, t
    middle = b.reach * frame[:, 1]
    x = (np.arange(slices) + 0.5) / slices * 2.0 * half - half
    radius = 0.5 * b.roller_diameter - b.barrel_radius + np.sqrt(b.barrel_radius**2 - x**2)
    turn = flat(barrel[2] / half)
    below, above = (
        middle[:, None] + frame @ (turn @ np.stack([x, sign * radius]) + barrel[:2, None])
        for sign in (-1.0, 1.0)
    )
    groove = middle + frame[:, 1] * (b.inner_groove_radius - 0.5 * b.roller_diameter - b.gap)
    moved = flat(ring[2]) @ groove + ring[:2]
    inner = np.hypot(*(below - moved[:, None])) - b.inner_groove_radius
    outer = np.hypot(*above) - b.sphere_radius
    deep = np.maximum(np.stack([inner, outer]), 0.0)
    stored = line * (deep ** (19 / 9)).sum() * 9 / 19
    return stored - push @ barrel, line * (deep ** (10 / 9)).sum(axis=1)


def flat(angle):
    return np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])
