"""Epicyclic kinematics: what cage and rolling elements do when nothing slips.

Positive is the positive sense about the bearing axis. Source: pure rolling on both races with a
massless cage (T. A. Harris, Rolling Bearing Analysis, chapter on bearing speeds). At contact angles
that differ between the races, the orbit depends on the pitch angle of the ball's own axis (Harris,
chapter on motions in high-speed ball bearings). Here this axis halves the angle between both
contacts, so that the ball spins alike on both races, neither of which controls it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, radians

from flexcage.core.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Kinematics:
    """Speeds [rad/s] without slip, and the passing frequencies [Hz] that follow from them.

    ``element_spin`` is the element's speed about its own axis in the inertial frame;
    ``element_spin_in_cage`` is relative to the cage. A slip ratio must compare like with like:
    mixing the two fakes 8.8 % of slip in an N1013.
    """

    cage_speed: float
    element_spin: float
    element_spin_in_cage: float
    outer_race_passing: float
    inner_race_passing: float
    cage_frequency: float
    element_frequency: float


@dataclass(frozen=True)
class RollingShares:
    """Pure rolling per unit of speed: the orbit is ``orbit`` w_i + (1 - ``orbit``) w_o, and the
    element turns at ``spin`` (w_o - w_i) about its own axis, relative to the cage."""

    orbit: float
    spin: float


def rolling_shares(
    ratio: float,
    angles: tuple[float, float],
    heights: tuple[float, float] = (0.0, 0.0),
) -> RollingShares:
    """Pure rolling at contact angles [rad] of inner and outer race; ``ratio`` is D/Dpw.

    With r = 1 -+ ratio cos(angle), the radius of a race over that of the pitch circle, the orbit is
    (w_i r_i + w_o r_o)/(r_i + r_o). ``heights``, over the ball's radius, say how far above the
    middle of its contact with each race a ball rolls: the grooves are curved, so that the middle
    slides where the ellipse's strips nearer to its ends roll.
    """
    inner, outer = (ratio * (1.0 - h) for h in heights)
    r_inner, r_outer = 1.0 - inner * cos(angles[0]), 1.0 + outer * cos(angles[1])
    towards = cos(0.5 * (angles[0] - angles[1]))  # the ball's axis and each contact's
    whole = r_inner * outer + r_outer * inner
    return RollingShares(r_inner * outer / whole, r_inner * r_outer / (whole * towards))


def epicyclic(
    *,
    element_diameter: float,
    pitch_diameter: float,
    element_count: int,
    inner_speed: float,
    outer_speed: float = 0.0,
    contact_angle: float | tuple[float, float] = 0.0,
) -> Kinematics:
    """Speeds and frequencies of a bearing whose rings turn at the given speeds [rad/s].

    ``contact_angle`` [rad] is that of both races, or those of inner and outer race.

    ``outer_race_passing`` and ``inner_race_passing`` are BPFO and BPFI, ``cage_frequency`` FTF,
    ``element_frequency`` BSF (one turn of the element relative to the cage; a defect on it strikes
    at twice that). Raises InputError for sizes and angles that no bearing has.
    """
    angles = contact_angle if isinstance(contact_angle, tuple) else (contact_angle,) * 2
    _check_sizes(element_diameter, pitch_diameter, element_count, angles)
    shares = rolling_shares(element_diameter / pitch_diameter, angles)
    cage = shares.orbit * inner_speed + (1.0 - shares.orbit) * outer_speed
    in_cage = -shares.spin * (inner_speed - outer_speed)
    turns = 1.0 / (2.0 * pi)
    return Kinematics(
        cage_speed=cage,
        element_spin=in_cage + cage,
        element_spin_in_cage=in_cage,
        outer_race_passing=element_count * abs(cage - outer_speed) * turns,
        inner_race_passing=element_count * abs(inner_speed - cage) * turns,
        cage_frequency=abs(cage) * turns,
        element_frequency=abs(in_cage) * turns,
    )


def passing_frequencies(speeds: Kinematics, inner_speed: float) -> dict[str, float]:
    """Frequencies [Hz] by the names that diagnosticians use, of a bearing whose inner ring turns at
    a speed [rad/s]. ``FTF``: the cage's turns; ``shaft``: the inner ring's; ``BSF``: those of an
    element relative to the cage, and ``2 BSF``, at which a defect on it strikes the races; ``BPFO``
    and ``BPFI``: the elements' passing of a place on the outer and the inner race."""
    return {
        "FTF": speeds.cage_frequency,
        "shaft": abs(inner_speed) / (2.0 * pi),
        "BSF": speeds.element_frequency,
        "2 BSF": 2.0 * speeds.element_frequency,
        "BPFO": speeds.outer_race_passing,
        "BPFI": speeds.inner_race_passing,
    }


def _check_sizes(element: float, pitch: float, count: int, angles: tuple[float, float]) -> None:
    """InputError for elements that are larger than their circle, and for angles in degrees."""
    if not 0.0 < element < pitch or count < 1:
        raise InputError(
            f"{count} elements with a diameter of {element:g} on a pitch circle of {pitch:g} are "
            "no bearing's; the circle is the larger one, in the same unit.",
            where="element_diameter",
            value=element,
        )
    wide = [angle for angle in angles if abs(angle) > 0.5 * pi]
    if wide:
        raise InputError(
            f"contact_angle is {wide[0]:g} rad, but must be between -pi/2 and pi/2; is "
            f"{wide[0]:g} deg meant, which is {radians(wide[0]):.4g} rad?",
            where="contact_angle",
            value=wide[0],
        )
