"""Pockets of a spherical roller bearing's cage as kernels read them."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.statics import slice_places
from flexcage.bearings.tapered_roller.pocket_data import no_frames, own_axes, plane_pockets
from flexcage.bearings.two_rows import ROWS
from flexcage.cages.conical.walls import pocket_walls
from flexcage.cages.halves import signs_of
from flexcage.contacts.cone_pocket import FaceFrames
from flexcage.contacts.pocket_wall import PocketData
from flexcage.contacts.spec import Contacts
from flexcage.modes.basis import CageInterface


def row_frames(b: SphericalRollerBearing, cage: Any) -> tuple[FaceFrames, FaceFrames]:
    """Axes of the faces of both rows, of which the one at -x is the mirror image of the other."""
    if cage is None:
        return no_frames(), no_frames()
    own = own_axes(pocket_walls(cage)) @ cage.axes
    first, second = (
        FaceFrames(
            axes=np.ascontiguousarray(own * (sign, 1.0, 1.0) * [[1.0], [sign], [1.0]]),
            origin=0.5 * cage.pitch_diameter, whole=0.5 * b.roller_diameter, taper=0.0,
        )
        for sign in signs_of(cage, b.row_places)
    )  # fmt: skip
    return first, second


def barrel_pocket_data(
    b: SphericalRollerBearing, cage: Any, contacts: Contacts, interface: CageInterface
) -> PocketData:
    """Arrays of the pockets, as ``tapered_roller.pocket_data``, the row at -x first."""
    s, reach = b.roller.spheres(slice_places(b, contacts.pocket.slices))
    modes = np.concatenate([
        np.einsum("fab,zfsbm->zfsam", f.axes, own)
        for f, own in zip(row_frames(b, cage), np.split(interface.modes, ROWS))
    ])  # fmt: skip
    return plane_pockets(
        b, cage, contacts, interface, modes,
        place=np.repeat([row.place for row in b.row_places], b.roller_count), s=s,
        drop=0.5 * b.roller_diameter - reach, middle=0.0,
    )  # fmt: skip
