"""Where the walls of round pockets are, and how thick what they leave of the cage is."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

from flexcage.cages.round_pocket.cage import BallCage


@dataclass(frozen=True)
class PocketShapes:
    """Where the wall of every pocket is, with its defects."""

    centre: np.ndarray  # (Z, 2) axial and circumferential shift of the axis [m] at pitch radius
    radius: np.ndarray  # (Z,) [m]
    slot: np.ndarray  # (Z, 2) half straight lengths along x and psi [m]


def wall_reach(direction: np.ndarray, radius: float | np.ndarray, slot: np.ndarray) -> np.ndarray:
    """Distance (n,) [m] from a slot's middle to its wall along unit directions (n, 2) in x, psi.

    ``radius`` [m] is that of all or of each direction (n,).
    """
    along, half = np.abs(direction), np.asarray(slot, float)
    radius = np.broadcast_to(radius, len(along))
    with np.errstate(
        divide="ignore", invalid="ignore"
    ):  # to the straight walls at +-psi and at +-x
        flat = (half[::-1] + radius[:, None]) / along[:, ::-1]
    straight = [flat[:, i] * along[:, i] <= half[i] for i in range(2)]
    middle = along @ half
    corner = middle + np.sqrt(np.maximum(middle**2 - half @ half + radius**2, 0.0))
    return np.where(straight[0], flat[:, 0], np.where(straight[1], flat[:, 1], corner))


def is_sphere(cage: BallCage) -> bool:
    """Are the pockets spherical?"""
    return cage.pocket_shape == "spherical"


def level_radius(
    cage: BallCage, radius: float, height: np.ndarray, pitch_radius: float
) -> np.ndarray:
    """Radius [m] of a pocket's circle at heights [m] along its axis from the cage's axis."""
    if not is_sphere(cage):
        return np.full(np.shape(height), radius)
    return np.sqrt(np.maximum(radius**2 - (height - pitch_radius) ** 2, 0.0))


def web_thickness(cage: BallCage, shapes: PocketShapes, *, pitch_diameter: float) -> np.ndarray:
    """Least thickness (Z,) [m] of each web along the circumference, at any radius; < 0: none."""
    pitch_radius = 0.5 * pitch_diameter
    radii = np.linspace(0.5 * cage.bore, 0.5 * cage.outside_diameter, 21)[:, None]
    x = np.linspace(-0.5, 0.5, 2001) * cage.width
    ahead, behind = [], []
    for (shift, arc), hole, slot in zip(shapes.centre, shapes.radius, shapes.slot):
        circle = level_radius(cage, hole, radii, pitch_radius)
        inside = circle**2 - np.maximum(np.abs(x - shift) - slot[0], 0.0) ** 2
        half = np.where(inside > 0.0, slot[1] + np.sqrt(np.maximum(inside, 0.0)), 0.0)
        reach = np.arcsin(np.minimum(half / radii, 1.0))
        ahead.append(arc / pitch_radius + reach)
        behind.append(arc / pitch_radius - reach)
    gap = 2.0 * pi / len(ahead) + np.array(behind) - np.roll(ahead, 1, axis=0)
    return (radii * gap).min(axis=(1, 2))
