"""Barrels between a groove of the inner ring and the outer ring's sphere, in slices: ISO/TS 16281.

A row's rollers are alone between the rings; ``rows`` makes two of them a bearing. Races and barrels
are arcs of circles in a roller's plane: a slice's gap is that of a barrel in the middle of its
clearance, and its force goes along the race's normal, through the arc's centre. So the sphere bears
no moment about the bearing's middle. Races that touch in an ellipse are sliced alike: it is a
slender one, and reaches the barrel's ends under moderate loads. No rib bears: a guide ring floats
between the rows, and barrels that lean away bear with an end of their groove. Friction and skew are
left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.two_rows import ROWS, rows_from
from flexcage.contacts.spec import Contacts
from flexcage.geometry.kinematics import Kinematics
from flexcage.geometry.rollers import LINE_EXPONENT
from flexcage.system.statics.equilibrium import Problem, nearest, settle
from flexcage.system.statics.laws import check_law
from flexcage.system.statics.options import AT_START, StaticOptions
from flexcage.system.statics.rows import Rows
from flexcage.system.statics.slices import Meeting, RollerPlane, SlicedRollers, rolling_of
from flexcage.system.statics.state import StaticState


def rollers_of(
    bearing: SphericalRollerBearing, *, speed: float, contacts: Contacts, options: StaticOptions
) -> Rows:
    """Rollers of both rows, in the slices and with the stiffness of ``contacts.race``."""
    from flexcage.contacts.laws import iso_line_stiffness  # its kernels take seconds to load

    race = contacts.race.normal
    check_law(race.law, "contacts.race.normal.law", "rollers on races by ISO/TS 16281")
    n = contacts.race.slices
    line = iso_line_stiffness(bearing.effective_length, bearing.race_modulus)
    stiffness = np.full(2 * n, line * race.stiffness_factor / n)
    return barrel_rows(bearing, stiffness, speed=speed, options=options)


def barrel_rows(
    bearing: SphericalRollerBearing, stiffness: np.ndarray, *, speed: float,
    options: StaticOptions = AT_START,
) -> Rows:  # fmt: skip
    """Rollers of both rows with slices of such ``stiffness`` (2n,) [N/m^(10/9)]."""
    rating = options.dynamic_rating or bearing.dynamic_rating
    row = Barrels(
        bearing=bearing, meeting=meeting(bearing, len(stiffness) // 2), stiffness=stiffness,
        rolling=rolling_of(bearing, speed, options.cage_speed),
        rating=rating / ROWS**bearing.row_power,
    )  # fmt: skip
    return rows_from(bearing, row)


def settled_in(rows: Rows, ring: np.ndarray, load: np.ndarray) -> np.ndarray:
    """Coordinates w (2Z, 3) of rollers in equilibrium with the inner ring displaced by (5,), under
    a load (5,) by which forces are measured."""
    problem = Problem(rows, load, np.zeros(5, bool), ring, np.zeros(5))
    at = problem.at_azimuths @ ring
    return settle(problem, at, nearest(problem, at, None, 0.0), 0.0)[0]


def slice_forces(
    bearing: SphericalRollerBearing, solution: StaticState, contacts: Contacts
) -> np.ndarray:
    """Forces (2Z, 2, n) [N] of the slices of all rollers on inner and outer race, from the
    bearing's -x to its +x in the row there, and in the other one the other way."""
    rows = rollers_of(bearing, speed=solution.speed, contacts=contacts, options=AT_START)
    ring = solution.displacement - solution.outer
    own, found = settled_in(rows, ring, solution.load), []
    at = Problem(rows, solution.load, np.zeros(5, bool), ring, np.zeros(5)).at_azimuths @ ring
    for k, row in enumerate(rows.rows):
        part = slice(k * bearing.roller_count, (k + 1) * bearing.roller_count)
        barrels: Any = row.elements
        found.append(np.stack(barrels.slice_forces(row.own(at[part]), own[part]), axis=1))
    return np.concatenate(found)


def roller_plane(b: SphericalRollerBearing) -> RollerPlane:
    """Of the row at +x."""
    return RollerPlane(b.axis_angle, b.pitch_radius, 0.5 * b.effective_length)


def slice_places(b: SphericalRollerBearing, slices: int) -> np.ndarray:
    """Middles (n,) [m] of slices along a barrel, from its own."""
    return (np.arange(slices) + 0.5) / slices * b.effective_length - 0.5 * b.effective_length


def meeting(b: SphericalRollerBearing, slices: int) -> Meeting:
    """The contacts of a roller of the row at +x."""
    x = slice_places(b, slices)
    radius = b.roller.radius(x)
    below, above = np.column_stack([x, -radius]), np.column_stack([x, radius])
    # centres of both races' arcs, across from the roller's middle
    centres = b.inner_groove_radius - 0.5 * b.roller_diameter - b.gap, -b.reach
    inner, outer = (place - [0.0, t] for place, t in zip((below, above), centres))
    place, line = np.vstack([below, above]), np.vstack([inner, outer])
    far = np.hypot(*line.T)
    normal = -line / far[:, None]  # of the race, towards the roller
    plane = roller_plane(b)
    ring = plane.pressed_by_ring(place, normal)
    ring[slices:] = 0.0  # the outer ring stands
    races = np.repeat([b.inner_groove_radius, b.sphere_radius], slices)
    return Meeting(
        ring=ring, own=plane.pressed_by_roller(place, normal), gap=races - far,
        exponent=np.full(2 * slices, LINE_EXPONENT),
        races=(slice(0, slices), slice(slices, 2 * slices)),
    )  # fmt: skip


@dataclass(frozen=True)
class Barrels(SlicedRollers):
    """The rollers of one row at one speed; implements ``elements.Elements``."""

    bearing: SphericalRollerBearing
    meeting: Meeting
    stiffness: np.ndarray  # (2n,) of slices [N/m^(10/9)]
    rolling: Kinematics
    rating: float

    @cached_property
    def plane(self) -> RollerPlane:
        return roller_plane(self.bearing)

    def bears(self, v: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Resultants of slices' forces, which fan out as the races do."""
        m, force = self.meeting, self.forces(v, w)
        parts = [
            sign * (force[:, part] @ m.own[part, :2]) @ self.plane.frame
            for part, sign in zip(m.races, (-1.0, 1.0))
        ]
        along = np.stack(parts, axis=1)  # (Z, 2, 2): x and r
        return np.hypot(along[..., 0], along[..., 1]), np.arctan2(along[..., 0], along[..., 1])
