"""What runs of barrels record."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.bearings.cylindrical_roller.recording import RECORDING as OF_ROLLERS
from flexcage.bearings.cylindrical_roller.recording import on_races
from flexcage.bearings.spherical_roller.model import SphericalModel
from flexcage.bearings.tapered_roller.recording import in_walls
from flexcage.bearings.two_rows import row_labels
from flexcage.contacts.barrel import BarrelSide
from flexcage.integrate.postures import seen_from_cages
from flexcage.integrate.recording import Recording
from flexcage.system.layout import Layout

_ROLLERS: Any = OF_ROLLERS


def _coords(model: SphericalModel) -> dict[str, Any]:
    return {**_ROLLERS.coords(model), **row_labels(model.rows.each)}


def overlaps(model: SphericalModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Depths (n, 2Z, places) of barrels in races and next ones; see ``Recording``. Barrels count as
    spheres about their middles."""
    q, each = layout.q(y), model.rows.each
    x, r, psi = np.moveaxis(q["elements"][..., :3], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    in_inner, in_outer = (at - q[name][:, None, :3] for name in ("inner", "outer"))
    inner = [
        _in_race(side, in_inner[:, row])
        for side, row in ((model.inner, slice(each)), (model.inner_other, slice(each, None)))
    ]
    depths = [np.concatenate(inner, axis=1), _in_race(model.outer, in_outer)]
    others = _in_pockets(model, q, at) if layout.has_cage else [_in_next(model, at)]
    return np.stack([*depths, *others], axis=-1)


def _in_next(model: SphericalModel, at: np.ndarray) -> np.ndarray:
    """Depths (n, 2Z) of barrels at places (n, 2Z, 3) in the next ones of their row."""
    each = model.rows.each
    following = np.arange(at.shape[1]) + 1
    following[each - 1 :: each] -= each
    found: np.ndarray = np.linalg.norm(at[:, following] - at, axis=-1)
    return 2.0 * model.inner.own - found


def _in_pockets(
    model: SphericalModel, q: dict[str, np.ndarray], at: np.ndarray
) -> list[np.ndarray]:
    """Depths (n, 2Z) in the four faces of their pockets."""
    seen, each = seen_from_cages(q, at), model.rows.each
    one, other = (in_walls(model.pocket, f, seen) for f in (model.frames, model.frames_other))
    pairs = zip(one, other)
    return [np.concatenate([a[:, :each], b[:, each:]], axis=1) for a, b in pairs]


def _in_race(side: BarrelSide, at: np.ndarray) -> np.ndarray:
    """Depths of spheres about middles at places (..., 3) from the ring's centre."""
    above = np.hypot(at[..., 1], at[..., 2]) - side.centre
    found: np.ndarray = np.hypot(at[..., 0] - side.axial, above) + side.own - side.arc
    return found


RECORDING: Recording[Any] = Recording(coords=_coords, variables=on_races, overlaps=overlaps)
