"""Barrels on the faces of their pockets, each of which is a plane; one row after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.bearings.cylindrical_roller.model import points_over
from flexcage.bearings.cylindrical_roller.rubbing import PocketFaces, rub_on
from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.pocket_data import row_frames
from flexcage.bearings.spherical_roller.statics import slice_places
from flexcage.bearings.two_rows import ROWS
from flexcage.cages.barrel.cage import BarrelCage
from flexcage.contacts.cone_pocket import FaceFrames
from flexcage.contacts.pocket_wall import FACES, SIDES
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.stress.rubbing import Rubbing

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
    return _together(rows)


def pocket_faces(
    b: SphericalRollerBearing, cage: BarrelCage, frames: FaceFrames, slices: int
) -> PocketFaces:
    """Where barrels of so many slices rub on the faces of a row's pockets; ends along +x."""
    sides = np.array([1.0 if f % 2 == 0 else -1.0 for f in range(FACES)])
    across = np.array([frames.axes[f, 2 if f < SIDES else 0] for f in range(FACES)])
    way = np.sign(across[SIDES, 0])
    return PocketFaces(
        normals=sides[:, None] * across, up=frames.axes[:SIDES, 1],
        reach=b.roller.spheres(slice_places(b, slices))[1],
        ends=0.5 * b.roller_length * way * sides[SIDES:],
        points=points_over(cage.section.inside, cage.section.outside, b.roller_diameter),
    )  # fmt: skip


def _together(rows: list[Rubbing]) -> Rubbing:
    """The pockets of both rows."""
    first, second = rows
    assert len(rows) == ROWS
    along = {name: np.concatenate([getattr(r, name) for r in rows])
             for name in ("cells", "length", "height")}  # fmt: skip
    return Rubbing(
        power=np.concatenate([first.power, second.power], axis=1), groove=first.groove,
        friction=first.friction + second.friction, **along,
    )  # fmt: skip
