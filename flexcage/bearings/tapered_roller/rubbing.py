"""Tapered rollers on the faces of a conical cage's pockets, each of which is a plane."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.bearings.cylindrical_roller.model import points_over
from flexcage.bearings.cylindrical_roller.rubbing import PocketFaces, rub_on
from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.bearings.tapered_roller.pocket_data import face_frames
from flexcage.bearings.tapered_roller.spheres import spheres
from flexcage.cages.conical.cage import ConicalCage
from flexcage.cages.conical.shape import ConeShaped
from flexcage.contacts.pocket_wall import FACES, SIDES
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.stress.rubbing import Rubbing

if TYPE_CHECKING:
    import xarray


def rubbing(ds: xarray.Dataset, bearing: Bearing, cage: Cage) -> Rubbing:
    """Rollers on crossbeams by slices, and on side beams with the mean speed of their ends."""
    assert isinstance(bearing, TaperedRollerBearing) and isinstance(cage, ConicalCage)
    return rub_on(pocket_faces(bearing, cage, ds.sizes["slice"]), ds, bearing, cage)


def pocket_faces(b: TaperedRollerBearing, cage: ConicalCage, slices: int) -> PocketFaces:
    """Where rollers of so many slices rub on their pockets' faces."""
    axes, reach = face_frames(b, cage).axes, spheres(b, slices)[1]
    return plane_faces(b, cage, axes, reach=reach, middle=-b.roller.centre)


def plane_faces(
    b: Any, cage: ConeShaped, axes: np.ndarray, *, reach: np.ndarray, middle: float
) -> PocketFaces:
    """The same of any rollers whose axes lean, by the ``axes`` (4, 3, 3) of the faces, the
    ``reach`` of the slices and the place of mid-length [m]; ends count along +x."""
    sides = np.array([1.0 if f % 2 == 0 else -1.0 for f in range(FACES)])
    across = np.array([axes[f, 2 if f < SIDES else 0] for f in range(FACES)])
    way = np.sign(across[SIDES, 0])
    return PocketFaces(
        normals=sides[:, None] * across, up=axes[:SIDES, 1], reach=reach,
        ends=middle + 0.5 * b.roller_length * way * sides[SIDES:],
        points=points_over(cage.section.inside, cage.section.outside, b.roller_diameter),
    )  # fmt: skip
