"""A tapered roller bearing from its specs to the arrays that kernels read."""

from __future__ import annotations

from math import cos, sin
from typing import Any, NamedTuple

import numpy as np

from flexcage.bearings.cylindrical_roller.model import SpottedRollers, spotted_rollers
from flexcage.bearings.cylindrical_roller.neighbours import roller_roller_data
from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.bearings.tapered_roller.pocket_data import cone_pocket_data, face_frames, no_frames
from flexcage.bearings.tapered_roller.spheres import spheres
from flexcage.bodies.floating_frame import BodyData, no_body
from flexcage.cages.conical.cage import ConicalCage
from flexcage.contacts import laws
from flexcage.contacts.cone import ConeSide
from flexcage.contacts.cone_cone import ConeConeContact
from flexcage.contacts.cone_end import EndData
from flexcage.contacts.cone_pocket import FaceFrames, cone_pocket_work
from flexcage.contacts.land import LandData, no_land
from flexcage.contacts.pocket_wall import PocketData, no_pockets
from flexcage.contacts.race import race_work
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.contacts.state import Q_SKEW, Q_SPIN, Q_TILT
from flexcage.contacts.uneven import is_uneven, spread, uneven_race
from flexcage.geometry.rollers import LINE_EXPONENT
from flexcage.system.bodies import bodies_of, inner_ring_of, outer_ring_of, unbalanced
from flexcage.system.data import Bodies, RingBody, Work, new_work
from flexcage.system.layout import Layout
from flexcage.system.spec import Drive, Load, Mount

RIB_EXPONENT = 1.5  # Hertz
SMALL_RIB, LARGE_RIB = 0, 1  # places of the ribs, at +x and -x, among a roller's two ends


class TaperedModel(NamedTuple):
    """Everything constant that a tapered roller bearing's residual reads."""

    bodies: Bodies
    inner_ring: RingBody
    outer_ring: RingBody
    cage: BodyData
    inner: ConeSide
    outer: ConeSide
    end: EndData
    small_end: EndData  # of radius 0: there is no small rib
    pocket: PocketData
    neighbours: ConeConeContact
    spot: SpottedRollers
    land: LandData
    frames: FaceFrames


def _side(
    b: TaperedRollerBearing, contacts: Contacts, lubricant: Lubricant, *, inner: bool
) -> ConeSide:
    n, k = contacts.race.slices, 0 if inner else 1
    s, reach = spheres(b, n)
    angle, radius, own = b.race_angles[k], 0.5 * b.race_diameters[k], 0.5 * b.roller_diameter
    modulus, length, effective = b.race_modulus, b.effective_length, b.curvature_radii[k]
    x, _ = b.profile.slices(n, diameter=b.roller_diameter, length=length)
    wave, spall = uneven_race(b, "inner" if inner else "outer", radius, effective)
    spot, width = b.roller_spot, length / n
    stiffness = laws.iso_line_stiffness(length, modulus)
    return ConeSide(
        sign=1.0 if inner else -1.0,
        cos=cos(angle),
        sin=sin(angle),
        apex=b.apex_distance * cos(b.axis_angle),
        radius=radius,
        s=s,
        reach=reach,
        whole=b.sphere_at_centre,
        taper=sin(b.half_angle),
        own=own,
        middle=-b.roller.centre,
        normal=laws.normal_parameters(contacts.race.normal, stiffness, LINE_EXPONENT, parts=n),
        friction=laws.friction_parameters(contacts.race.friction),
        rolling=laws.rolling_resistance(lubricant, effective, length, modulus),
        hydro=2.0 * radius / b.pitch_radius,
        wave=wave,
        spall=spall,
        spalled=(b.inner_spall if inner else b.outer_spall).covered(x, width),
        uneven=is_uneven(wave, spall),
        spot=spot.dimensions(own, effective, spread(effective, modulus)),
        spotted=spot.covered(x, width),
    )


def _end(b: TaperedRollerBearing, contacts: Contacts) -> EndData:
    """The rollers' large ends on the rib: where nothing is displaced they just touch."""
    angle, rib = b.axis_angle - b.rib_angle, contacts.rib
    c, sn = -sin(angle), cos(angle)
    along = -0.5 * b.roller_length + b.end_radius  # of the sphere's centre, from mid-length
    x, r = along * cos(b.axis_angle), b.pitch_radius - along * sin(b.axis_angle)
    return EndData(
        place=along - b.roller.centre,
        radius=b.end_radius,
        cos=c,
        sin=sn,
        apex=x + (c * r - b.end_radius) / sn,
        normal=laws.normal_parameters(rib.normal, b.rib_contact.stiffness, RIB_EXPONENT),
        friction=laws.friction_parameters(rib.friction),
    )


def _small_end(b: TaperedRollerBearing, contacts: Contacts) -> EndData:
    """The rollers' small ends, which have their play to the small rib where nothing is displaced:
    spheres about places on the axes as far towards the large ends."""
    if b.small_rib_height is None:
        return EndData(0.0, 0.0, 1.0, 0.0, 0.0, np.zeros(laws.N_NORMAL), np.zeros(laws.N_FRICTION))
    lean, rib = b.axis_angle + b.small_rib_angle, contacts.rib
    c, sn = sin(lean), -cos(lean)
    along = 0.5 * b.roller_length - b.end_radius
    x, r = along * cos(b.axis_angle), b.pitch_radius - along * sin(b.axis_angle)
    gap = b.small_rib_play * cos(b.small_rib_angle)
    return EndData(
        place=along - b.roller.centre,
        radius=b.end_radius,
        cos=c,
        sin=sn,
        apex=x + (c * r - b.end_radius - gap) / sn,
        normal=laws.normal_parameters(rib.normal, b.small_rib_contact.stiffness, RIB_EXPONENT),
        friction=laws.friction_parameters(rib.friction),
    )


def build_tapered_model(
    bearing: TaperedRollerBearing, cage: ConicalCage | None, body: Any, interface: Any, *,
    contacts: Contacts, lubricant: Lubricant, drive: Drive, load: Load, mount: Mount, seed: int = 0,
) -> TaperedModel:  # fmt: skip
    """Arrays of a tapered roller bearing for the kernels; arguments as those of
    ``system.motion.BuildModel``."""
    count, diameter = bearing.roller_count, bearing.roller_diameter
    return TaperedModel(
        bodies=bodies_of(
            bearing, cage, lubricant, drive, load,
            element=np.array([bearing.element_mass, *bearing.roller_inertia]),
            radius=np.full(count, 0.5 * diameter), area=diameter * bearing.roller_length,
        ),
        inner_ring=inner_ring_of(bearing, drive, load, free_axially=load.frees_axially(bearing)),
        outer_ring=outer_ring_of(bearing, mount),
        cage=unbalanced(body, cage).data if cage else no_body().data,
        inner=_side(bearing, contacts, lubricant, inner=True),
        outer=_side(bearing, contacts, lubricant, inner=False),
        end=_end(bearing, contacts),
        small_end=_small_end(bearing, contacts),
        pocket=(
            cone_pocket_data(bearing, cage, contacts, interface) if cage
            else no_pockets(count, 0.5 * bearing.roller_length)
        ),
        neighbours=ConeConeContact(
            *roller_roller_data(bearing, contacts, *spheres(bearing, contacts.race.slices))
        ),
        spot=spotted_rollers(bearing),
        land=no_land(),
        frames=face_frames(bearing, cage) if cage else no_frames(),
    )  # fmt: skip


def tapered_work(model: TaperedModel, layout: Layout) -> Work:
    """Fresh workspaces of a tapered roller bearing for one thread."""
    return leaning_work(model, layout, ribs=2)


def leaning_work(model: Any, layout: Layout, *, ribs: int) -> Work:
    """The same of any rollers whose axes lean, and which meet so many ribs."""
    slices, points, stations = (
        len(model.pocket.s), len(model.pocket.points), model.pocket.phi.shape[2]
    )  # fmt: skip
    work = cone_pocket_work(slices, points, stations, layout.modes)
    return new_work(
        layout, race_work(len(model.inner.s)), work, slices=slices, points=points,
        faces=4 if layout.has_cage else 1, stations=stations, ribs=ribs,
        land_stations=len(model.land.angle), turns=(Q_SPIN, Q_SKEW, Q_TILT),
    )  # fmt: skip
