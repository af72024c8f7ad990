"""A spherical roller bearing from its specs to the arrays that kernels read."""

from __future__ import annotations

from math import cos, sin
from typing import Any, NamedTuple

import numpy as np

from flexcage.bearings.cylindrical_roller.model import RollerRows, SpottedRollers
from flexcage.bearings.cylindrical_roller.neighbours import roller_roller_data
from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.pocket_data import barrel_pocket_data, row_frames
from flexcage.bearings.spherical_roller.statics import slice_places
from flexcage.bearings.tapered_roller.model import leaning_work
from flexcage.bodies.floating_frame import BodyData, no_body
from flexcage.contacts import laws
from flexcage.contacts.barrel import BarrelSide
from flexcage.contacts.cone_cone import ConeConeContact
from flexcage.contacts.cone_pocket import FaceFrames
from flexcage.contacts.land import LandData, no_land
from flexcage.contacts.pocket_wall import PocketData, no_pockets
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.geometry.rollers import LINE_EXPONENT
from flexcage.system.bodies import bodies_of, inner_ring_of, outer_ring_of, unbalanced
from flexcage.system.data import Bodies, RingBody, Work
from flexcage.system.layout import Layout
from flexcage.system.spec import Drive, Load, Mount


class SphericalModel(NamedTuple):
    """Everything constant that a spherical roller bearing's residual reads: ``inner`` is the groove
    of the row at -x, ``inner_other`` that of the other one; both rows share the sphere."""

    bodies: Bodies
    inner_ring: RingBody
    outer_ring: RingBody
    cage: BodyData
    inner: BarrelSide
    inner_other: BarrelSide
    outer: BarrelSide
    pocket: PocketData
    neighbours: ConeConeContact
    spot: SpottedRollers
    land: LandData
    rows: RollerRows
    frames: FaceFrames  # of the pockets at -x
    frames_other: FaceFrames


def _sphere(b: SphericalRollerBearing, contacts: Contacts, lubricant: Lubricant) -> BarrelSide:
    """The outer race, whose arc's centre is the bearing's middle."""
    return _side(b, contacts, lubricant, inner=False)._replace(
        sign=-1.0, axial=0.0, centre=0.0, arc=b.sphere_radius
    )


def _groove(
    b: SphericalRollerBearing, contacts: Contacts, lubricant: Lubricant, way: float
) -> BarrelSide:
    """The inner race of the row ``way`` of the bearing's middle, -1 or 1."""
    far = b.reach + b.inner_groove_radius - 0.5 * b.roller_diameter - b.gap
    return _side(b, contacts, lubricant, inner=True)._replace(
        sign=1.0, axial=way * far * sin(b.contact_angle), centre=far * cos(b.contact_angle),
        arc=b.inner_groove_radius,
    )  # fmt: skip


def _side(
    b: SphericalRollerBearing, contacts: Contacts, lubricant: Lubricant, *, inner: bool
) -> BarrelSide:
    """A race without its arc."""
    n, k, modulus, length = contacts.race.slices, int(not inner), b.race_modulus, b.effective_length
    s, reach = b.roller.spheres(slice_places(b, n))
    stiffness, radius = laws.iso_line_stiffness(length, modulus), 0.5 * b.race_diameters[k]
    return BarrelSide(
        sign=0.0, axial=0.0, centre=0.0, arc=0.0, radius=radius, s=s, reach=reach,
        own=0.5 * b.roller_diameter, middle=0.0,
        normal=laws.normal_parameters(contacts.race.normal, stiffness, LINE_EXPONENT, parts=n),
        friction=laws.friction_parameters(contacts.race.friction),
        rolling=laws.rolling_resistance(lubricant, b.curvature_radii[k], length, modulus),
        hydro=2.0 * radius / b.pitch_radius,
    )  # fmt: skip


def build_spherical_model(
    bearing: SphericalRollerBearing, cage: Any, body: Any, interface: Any, *,
    contacts: Contacts, lubricant: Lubricant, drive: Drive, load: Load, mount: Mount, seed: int = 0,
) -> SphericalModel:  # fmt: skip
    """Arrays of a spherical roller bearing for the kernels; arguments as those of
    ``system.motion.BuildModel``."""
    count, each, diameter = bearing.total_elements, bearing.roller_count, bearing.roller_diameter
    inner, other = (_groove(bearing, contacts, lubricant, way) for way in (-1.0, 1.0))
    spheres = bearing.roller.spheres(slice_places(bearing, contacts.race.slices))
    frames, frames_other = row_frames(bearing, cage)
    return SphericalModel(
        bodies=bodies_of(
            bearing, cage, lubricant, drive, load,
            element=np.array([bearing.element_mass, *bearing.roller_inertia]),
            radius=np.full(count, 0.5 * diameter), area=diameter * bearing.roller_length,
        ),
        inner_ring=inner_ring_of(bearing, drive, load, free_axially=load.frees_axially(bearing)),
        outer_ring=outer_ring_of(bearing, mount),
        cage=unbalanced(body, cage).data if cage else no_body().data,
        inner=inner,
        inner_other=other,
        outer=_sphere(bearing, contacts, lubricant),
        pocket=(
            barrel_pocket_data(bearing, cage, contacts, interface) if cage
            else no_pockets(count, 0.5 * bearing.roller_length)
        ),
        neighbours=ConeConeContact(*roller_roller_data(bearing, contacts, *spheres)),
        spot=SpottedRollers(np.zeros(count, np.int64), 0.0, np.arange(count) // each),
        land=no_land(),
        rows=RollerRows(
            each, np.repeat([row.place for row in bearing.row_places], each),
            bearing.element_azimuths,
        ),
        frames=frames,
        frames_other=frames_other,
    )  # fmt: skip


def spherical_work(model: SphericalModel, layout: Layout) -> Work:
    """Fresh workspaces of a spherical roller bearing for one thread."""
    return leaning_work(model, layout, ribs=0)
