"""What runs of tapered rollers record."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.bearings.cylindrical_roller.recording import RECORDING as OF_ROLLERS
from flexcage.bearings.cylindrical_roller.recording import on_races, spot_directions
from flexcage.bearings.tapered_roller.model import TaperedModel
from flexcage.contacts.cone import ConeSide
from flexcage.contacts.cone_end import EndData
from flexcage.contacts.cone_pocket import FaceFrames
from flexcage.contacts.pocket_wall import FACES, SIDES, PocketData
from flexcage.integrate.postures import seen_from_cages
from flexcage.integrate.recording import Recording
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem


def _variables(bearing: BearingSystem, y: np.ndarray) -> dict[str, np.ndarray]:
    return {
        **on_races(bearing, y),
        "rib_force": bearing.data.samples.rib[: len(y)],
        **spot_directions(bearing.data.model, bearing.layout.q(y)["elements"]),
    }


def overlaps(model: TaperedModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Depths (n, Z, places) of rollers in races, faces of their pockets or next rollers, and the
    rib; see ``Recording``. Rollers count as spheres about their centres of mass."""
    q = layout.q(y)
    x, r, psi, skew, tilt = np.moveaxis(q["elements"][..., :5], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    in_inner = at - q["inner"][:, None, :3]
    in_outer = at - q["outer"][:, None, :3]
    if layout.has_cage:
        others = in_walls(model.pocket, model.frames, seen_from_cages(q, at))
    else:
        away = np.linalg.norm(np.roll(at, -1, axis=1) - at, axis=-1)
        others = [2.0 * model.inner.whole - away]
    lean = np.cos(skew) * np.cos(tilt), np.sin(tilt)
    depths = [
        _in_race(model.inner, in_inner), _in_race(model.outer, in_outer),
        *others,
        *(_on_rib(end, in_inner, lean) for end in (model.small_end, model.end)),
    ]  # fmt: skip
    return np.stack(depths, axis=-1)


def _in_race(side: ConeSide, at: np.ndarray) -> np.ndarray:
    """Depths of spheres about centres of mass at places (..., 3) from the ring's centre."""
    distance = np.hypot(at[..., 1], at[..., 2])
    gap: np.ndarray = distance * side.cos + (at[..., 0] - side.apex) * side.sin
    return side.whole - side.sign * gap


def _on_rib(end: EndData, at: np.ndarray, lean: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Depths of ends in a rib, of rollers at places (..., 3) from the ring's centre whose axes are
    ``lean`` along and across the bearing's."""
    if end.radius == 0.0:
        return np.full(at.shape[:-1], -np.inf)
    reach = at[..., 0] + end.place * lean[0]
    height = np.hypot(at[..., 1], at[..., 2]) + end.place * lean[1]
    depth: np.ndarray = end.radius - end.cos * height - end.sin * (reach - end.apex)
    return depth


def in_walls(pocket: PocketData, frames: FaceFrames, seen: np.ndarray) -> list[np.ndarray]:
    """Depths (n, Z) of rollers at places (n, Z, 3) in the cage in the four faces of their pockets,
    where those are widest; with axes s along these."""
    cos, sin = pocket.azimuth.T
    out = seen[..., 1] * cos + seen[..., 2] * sin - frames.origin
    across = seen[..., 2] * cos - seen[..., 1] * sin
    place = np.stack([seen[..., 0] - pocket.place, out, across], axis=-1)
    found = []
    for f in range(FACES):
        sgn, side = (1.0 if f % 2 == 0 else -1.0), f >= SIDES
        reach = sgn * place @ frames.axes[f, 0 if side else 2]
        reach += pocket.half_roller + sgn * pocket.middle if side else frames.whole
        widest = np.maximum(pocket.offset[:, f].max(axis=1), 0.0)
        found.append(reach - pocket.half[int(side)] - widest)
    return found


_ROLLERS: Any = OF_ROLLERS
RECORDING: Recording[Any] = Recording(
    coords=_ROLLERS.coords, variables=_variables, overlaps=overlaps, spots=_ROLLERS.spots
)
