"""What runs of barrels record."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.bearings.cylindrical_roller.recording import RECORDING as OF_ROLLERS
from flexcage.bearings.cylindrical_roller.recording import on_races
from flexcage.bearings.spherical_roller.model import SphericalModel
from flexcage.bearings.two_rows import row_labels
from flexcage.contacts.barrel import BarrelSide
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
    following = np.arange(layout.elements) + 1
    following[each - 1 :: each] -= each
    away = np.linalg.norm(at[:, following] - at, axis=-1)
    in_inner, in_outer = (at - q[name][:, None, :3] for name in ("inner", "outer"))
    inner = [
        _in_race(side, in_inner[:, row])
        for side, row in ((model.inner, slice(each)), (model.inner_other, slice(each, None)))
    ]
    depths = [np.concatenate(inner, axis=1), _in_race(model.outer, in_outer)]
    return np.stack([*depths, 2.0 * model.inner.own - away], axis=-1)


def _in_race(side: BarrelSide, at: np.ndarray) -> np.ndarray:
    """Depths of spheres about middles at places (..., 3) from the ring's centre."""
    above = np.hypot(at[..., 1], at[..., 2]) - side.centre
    found: np.ndarray = np.hypot(at[..., 0] - side.axial, above) + side.own - side.arc
    return found


RECORDING: Recording[Any] = Recording(coords=_coords, variables=on_races, overlaps=overlaps)
