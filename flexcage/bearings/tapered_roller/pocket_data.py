"""Pockets of a conical cage as kernels read them."""

from __future__ import annotations

from math import sin
from typing import Any

import numpy as np

from flexcage.bearings.cylindrical_roller.model import (
    laws_in_pockets,
    pocket_arrays,
    points_over,
)
from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.bearings.tapered_roller.spheres import spheres
from flexcage.cages.conical.cage import ConicalCage
from flexcage.cages.conical.shape import ConeShaped
from flexcage.cages.conical.walls import PocketWalls, pocket_walls
from flexcage.contacts.cone_pocket import FaceFrames
from flexcage.contacts.pocket_wall import FACES, SIDES, PocketData
from flexcage.contacts.spec import Contacts
from flexcage.modes.basis import CageInterface


def no_frames() -> FaceFrames:
    """Those of a bearing without a cage."""
    return FaceFrames(np.zeros((FACES, 3, 3)), 0.0, 0.0, 0.0)


def face_frames(b: TaperedRollerBearing, cage: ConicalCage) -> FaceFrames:
    """Axes of the faces, each right-handed with its normal across a bar or along the roller."""
    own = own_axes(pocket_walls(cage))
    return FaceFrames(
        axes=np.ascontiguousarray(own @ cage.axes), origin=0.5 * cage.pitch_diameter,
        whole=b.sphere_at_centre, taper=sin(b.half_angle),
    )  # fmt: skip


def own_axes(walls: PocketWalls) -> np.ndarray:
    """The same (4, 3, 3) in the pocket's own frame (s, n, t)."""
    found = np.zeros((FACES, 3, 3))
    for f in range(FACES):
        normal = walls.normal[f] * (1.0 if f % 2 == 0 else -1.0)
        along = walls.along[f] - (walls.along[f] @ normal) * normal
        along /= np.linalg.norm(along)
        first, third = (along, normal) if f < SIDES else (normal, along)
        found[f] = first, np.cross(third, first), third
    return found


def cone_pocket_data(
    b: TaperedRollerBearing, cage: ConicalCage, contacts: Contacts, interface: CageInterface
) -> PocketData:
    """Arrays of the pockets, whose stations count from mid-pocket along the roller's axis or round
    the cage; contacts count along the faces."""
    s, reach = spheres(b, contacts.pocket.slices)
    modes = np.einsum("fab,zfsbm->zfsam", face_frames(b, cage).axes, interface.modes)
    return plane_pockets(
        b, cage, contacts, interface, modes, place=np.zeros(b.roller_count), s=s,
        drop=b.sphere_at_centre - reach, middle=-b.roller.centre,
    )  # fmt: skip


def plane_pockets(
    b: Any, cage: ConeShaped, contacts: Contacts, interface: CageInterface, modes: np.ndarray,
    **known: Any,
) -> PocketData:  # fmt: skip
    """Arrays of pockets whose faces are planes, with ``modes`` in the axes of these, and of rollers
    whose axes lean: ``known`` are places of pockets, spheres of slices (``s``, ``drop``), and where
    a roller's mid-length is (``middle``)."""
    walls = pocket_walls(cage)
    points = points_over(cage.section.inside, cage.section.outside, b.roller_diameter)
    bar = cage.bar_width(0.0, cage.bar_height, b.roller_count)
    at = interface.stations if interface.offset_at is None else interface.offset_at
    depth = (walls.middle * walls.normal).sum(axis=1)
    return pocket_arrays(
        interface, modes, on_faces(walls, interface.stations), on_faces(walls, at), contacts,
        b.element_azimuths, half=depth[[0, SIDES]], points=points,
        half_roller=0.5 * b.roller_length,
        normal=laws_in_pockets(b, cage, bar, len(points), contacts, interface), **known,
    )  # fmt: skip


def on_faces(walls: PocketWalls, places: np.ndarray) -> np.ndarray:
    """Places (4, n) along the roller's axis, or round the cage, as places along the faces [m]."""
    own, found = own_axes(walls), places.copy()
    for f in range(SIDES):
        sunk = (walls.middle[f] @ walls.normal[f]) * walls.normal[f, 0]
        found[f] = (places[f] - sunk) / own[f, 0, 0]
    return found
