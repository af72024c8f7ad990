"""Tapered rollers between two cones and on the inner ring's large rib, in slices: ISO/TS 16281.

A roller's own coordinates are those of ``system.statics.slices``, s towards the apex. Both races
push it towards its large end, whose sphere bears on the rib by Hertz without friction: the rib's
force follows from the equilibrium of the wedge. Skew and roundness are left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin, tan

import numpy as np

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.contacts.spec import Contacts
from flexcage.geometry.kinematics import Kinematics
from flexcage.geometry.rollers import LINE_EXPONENT
from flexcage.system.statics.laws import check_law
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.slices import Meeting, RollerPlane, SlicedRollers, rolling_of

_RIB_EXPONENT = 1.5  # Hertz


def rollers_of(
    bearing: TaperedRollerBearing, *, speed: float, contacts: Contacts, options: StaticOptions
) -> TaperedRollers:
    """Rollers of a bearing, in the slices and with the stiffness of ``contacts.race``, on a rib as
    stiff as Hertz and ``contacts.rib`` have it."""
    from flexcage.contacts.laws import iso_line_stiffness  # its kernels take seconds to load

    race, rib = contacts.race.normal, contacts.rib.normal
    check_law(race.law, "contacts.race.normal.law", "rollers on races by ISO/TS 16281")
    check_law(rib.law, "contacts.rib.normal.law", "rollers' ends on the rib by Hertz")
    n = contacts.race.slices
    line = iso_line_stiffness(bearing.effective_length, bearing.race_modulus)
    on_race = line * race.stiffness_factor / n
    on_rib = bearing.rib_contact.stiffness * rib.stiffness_factor
    return TaperedRollers(
        bearing=bearing,
        meeting=meeting(bearing, n),
        stiffness=np.array([on_race] * 2 * n + [on_rib]),
        rolling=rolling_of(bearing, speed, options.cage_speed),
        rating=options.dynamic_rating or bearing.dynamic_rating,
    )


def meeting(b: TaperedRollerBearing, slices: int) -> Meeting:
    """The contacts of a bearing's roller."""
    x, drop = b.profile.slices(slices, diameter=b.roller_diameter, length=b.effective_length)
    radius, eps = 0.5 * b.roller_diameter - x * tan(b.half_angle), b.half_angle
    places = [np.stack([x, t], axis=1) for t in (-radius, radius)]
    normals = [np.tile([-sin(eps), sign * cos(eps)], (slices, 1)) for sign in (1.0, -1.0)]
    rib = np.array([cos(b.rib_angle), sin(b.rib_angle)])
    place = np.vstack([*places, b.rib_place])
    normal = np.vstack([*normals, rib])  # of the partner, towards the roller
    plane = roller_plane(b)
    ring = plane.pressed_by_ring(place, normal)
    ring[slices : 2 * slices] = 0.0  # the outer ring stands
    return Meeting(
        ring=ring, own=plane.pressed_by_roller(place, normal),
        gap=np.concatenate([drop, drop, [0.0]]),
        exponent=np.array([LINE_EXPONENT] * 2 * slices + [_RIB_EXPONENT]),
        races=(slice(0, slices), slice(slices, 2 * slices)),
    )  # fmt: skip


def roller_plane(b: TaperedRollerBearing) -> RollerPlane:
    """Its axis leans towards the apex."""
    return RollerPlane(b.axis_angle, b.pitch_radius, 0.5 * b.effective_length)


@dataclass(frozen=True)
class TaperedRollers(SlicedRollers):
    """The rollers of a bearing at one speed; implements ``elements.Elements``."""

    bearing: TaperedRollerBearing
    meeting: Meeting
    stiffness: np.ndarray  # (2n+1,) of slices [N/m^(10/9)] and the rib [N/m^(3/2)]
    rolling: Kinematics
    rating: float

    @cached_property
    def plane(self) -> RollerPlane:
        return roller_plane(self.bearing)

    def rib_forces(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Forces (Z,) [N] of the rib on the rollers' ends, normal to its face."""
        return self.forces(v, w)[:, -1]

    def axial(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        b = self.bearing
        return self.rib_forces(v, w) * cos(b.axis_angle - b.rib_angle)
