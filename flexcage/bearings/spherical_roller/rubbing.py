"""Barrels on the faces of their pockets, each of which is a plane; one row after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.bearings.cylindrical_roller.rubbing import PocketFaces, rub_on
from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.pocket_data import row_frames
from flexcage.bearings.spherical_roller.statics import slice_places
from flexcage.bearings.tapered_roller.rubbing import plane_faces
from flexcage.cages.barrel.cage import BarrelCage
from flexcage.contacts.cone_pocket import FaceFrames
from flexcage.contacts.pocket_wall import SIDES
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.stress.rubbing import Rubbing, joined

if TYPE_CHECKING:
    import xarray


def rubbing(ds: xarray.Dataset, bearing: Bearing, cage: Cage) -> Rubbing:
    """Barrels on crossbeams by slices, and on side beams with the mean speed of their ends."""
    assert isinstance(bearing, SphericalRollerBearing) and isinstance(cage, BarrelCage)
    rows, each = [], bearing.roller_count
    for k, frames in enumerate(row_frames(bearing, cage)):
        own, way = slice(k * each, (k + 1) * each), float(np.sign(frames.axes[SIDES, 0, 0]))
        row = ds.isel(element=own, pocket=own).assign_coords(slice=way * ds["slice"])
        faces = pocket_faces(bearing, cage, frames, ds.sizes["slice"])
        rows.append(rub_on(faces, row, bearing, cage, bearing.element_azimuths[own]))
    return joined(rows)


def pocket_faces(
    b: SphericalRollerBearing, cage: BarrelCage, frames: FaceFrames, slices: int
) -> PocketFaces:
    """Where barrels of so many slices rub on the faces of a row's pockets."""
    reach = b.roller.spheres(slice_places(b, slices))[1]
    return plane_faces(b, cage, frames.axes, reach=reach, middle=0.0)
