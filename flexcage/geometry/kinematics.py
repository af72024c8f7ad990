"""Epicyclic kinematics: what cage and rolling elements do when nothing slips.

Positive is the positive sense about the bearing axis. Source: pure rolling on both races with a
massless cage (T. A. Harris, Rolling Bearing Analysis, chapter on bearing speeds).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi


@dataclass(frozen=True, kw_only=True)
class Kinematics:
    """Speeds [rad/s] without slip, and the passing frequencies [Hz] that follow from them.

    ``roller_spin`` is the element's speed about its own axis in the inertial frame;
    ``roller_spin_in_cage`` is relative to the cage. A slip ratio must compare like with like:
    mixing the two fakes 8.8 % of slip in an N1013.
    """

    cage_speed: float
    roller_spin: float
    roller_spin_in_cage: float
    outer_race_passing: float
    inner_race_passing: float
    cage_frequency: float
    roller_frequency: float


def epicyclic(
    *,
    roller_diameter: float,
    pitch_diameter: float,
    roller_count: int,
    inner_speed: float,
    outer_speed: float = 0.0,
    contact_angle: float = 0.0,
) -> Kinematics:
    """Speeds and frequencies of a bearing whose rings turn at the given speeds [rad/s].

    ``outer_race_passing`` and ``inner_race_passing`` are BPFO and BPFI, ``cage_frequency`` FTF,
    ``roller_frequency`` BSF (one turn of the element relative to the cage; a defect on it strikes
    at twice that).
    """
    gamma = roller_diameter * cos(contact_angle) / pitch_diameter
    cage = 0.5 * (inner_speed * (1.0 - gamma) + outer_speed * (1.0 + gamma))
    ratio = pitch_diameter / roller_diameter
    in_cage = -0.5 * (inner_speed - outer_speed) * ratio * (1.0 - gamma**2)
    turns = 1.0 / (2.0 * pi)
    return Kinematics(
        cage_speed=cage,
        roller_spin=in_cage + cage,
        roller_spin_in_cage=in_cage,
        outer_race_passing=roller_count * abs(cage - outer_speed) * turns,
        inner_race_passing=roller_count * abs(inner_speed - cage) * turns,
        cage_frequency=abs(cage) * turns,
        roller_frequency=abs(in_cage) * turns,
    )
