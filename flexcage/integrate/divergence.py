"""Where a run goes wrong: its hardest contact, and one that is deeper than any law holds."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.integrate.recorded import in_plane
from flexcage.modes.basis import FACES
from flexcage.system.ball_model import BallModel
from flexcage.system.layout import Layout
from flexcage.system.model import Model
from flexcage.system.problem import Bearing

# assumption: an overlap of this share of an element's radius is no contact any more. Ten static
# ratings, the largest load that a case may have, press an N1013's rollers in by less than a tenth.
DEEPEST = 0.25
AHEAD = 1e-9 * 2.0 ** np.arange(17)  # [s] after the last good point, where a fault is looked for


@singledispatch
def overlaps(model: Any, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Depths (n, Z, places) [m] of elements in races, faces of their pockets and ribs, negative
    when apart, in states ``y`` (n, size); of balls, too, how far outside the cage's wall they are.

    Bodies are as they were made, without waves and deflection; a wall lies where it is widest.
    """
    raise NotImplementedError(f"{type(model).__name__} has no overlaps")


@overlaps.register
def _(model: Model, layout: Layout, y: np.ndarray) -> np.ndarray:
    q = layout.q(y)
    radius, (cos, sin) = model.bodies.radius, model.pocket.azimuth.T
    x, r, psi = np.moveaxis(q["rollers"][..., :3], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    in_inner, in_outer = at - q["inner"][:, None, :3], at - in_plane(q["outer"])[:, None]
    frames = Rotation.from_quat(q["quaternion"], scalar_first=True).as_matrix()
    seen = np.einsum("nzc,ncd->nzd", at - q["cage"][:, None], frames)
    ahead, end = seen[..., 2] * cos - seen[..., 1] * sin, model.pocket.half_roller
    walls = np.repeat(model.pocket.half, 2) + np.maximum(model.pocket.offset.max(axis=2), 0.0)
    return np.stack(
        [
            model.inner.radius + radius - np.hypot(in_inner[..., 1], in_inner[..., 2]),
            np.hypot(in_outer[..., 1], in_outer[..., 2]) + radius - model.outer.radius,
            ahead + radius - walls[:, 0],
            -ahead + radius - walls[:, 1],
            seen[..., 0] + end - walls[:, 2],
            -seen[..., 0] + end - walls[:, 3],
            in_inner[..., 0] + end - model.rib.half_gap,
            -in_inner[..., 0] + end - model.rib.half_gap,
        ],
        axis=-1,
    )


@overlaps.register
def _(model: BallModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    q, radius = layout.q(y), model.bodies.radius
    x, r, psi = np.moveaxis(q["rollers"][..., :3], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    races = [
        np.hypot(p[..., 0] - race.axial, np.hypot(p[..., 1], p[..., 2]) - race.centre)
        - (race.radius - radius)
        for race, p in (
            (model.inner, at - q["inner"][:, None, :3]),
            (model.outer, at - in_plane(q["outer"])[:, None]),
        )
    ]
    frames = Rotation.from_quat(q["quaternion"], scalar_first=True).as_matrix()
    seen = np.einsum("nzc,ncd->nzd", at - q["cage"][:, None], frames)
    cos, sin = model.pocket.azimuth.T
    ahead = seen[..., 2] * cos - seen[..., 1] * sin - model.pocket.shift[:, 1]
    aside = seen[..., 0] - model.pocket.shift[:, 0]
    free = np.hypot(
        *(np.maximum(np.abs(d) - h, 0.0) for d, h in zip((aside, ahead), model.pocket.slot.T))
    )
    away = np.hypot(seen[..., 1], seen[..., 2])
    outside = np.maximum(model.pocket.wall[0] - away, away - model.pocket.wall[1])
    return np.stack([*races, free - (model.pocket.radius - radius), outside], axis=-1)


def runaway(bearing: Bearing, y: np.ndarray) -> tuple[int, str, str] | None:
    """The first of the states ``y`` (n, size) in which a contact is too deep, which it is, and what
    to look at."""
    model = bearing.data.model
    share = overlaps(model, bearing.layout, y) / model.bodies.radius[:, None]
    bad = np.flatnonzero((share > DEEPEST).any(axis=(1, 2)))
    if not len(bad):
        return None
    first = int(bad[0])
    number, place = np.unravel_index(int(np.argmax(share[first])), share.shape[1:])
    depth = share[first, number, place] * model.bodies.radius[number] * 1e3
    element = f"{bearing.family.element} {number}"
    if place >= 2 + len(bearing.family.faces) + len(bearing.family.ribs):
        what = f"the cage came off, {element} is {depth:.2g} mm outside its pocket"
        if model.pocket.sphere:
            return first, what, "it passed the rim of its pocket; a broader cage would hold it"
        return first, what, "a land (cage.guidance) or spherical pockets would hold it"
    what = f"{element} lies {depth:.2g} mm deep in its {_place(bearing, int(place))}"
    return first, f"a contact ran away: {what}", "look at loads and contact stiffness"


def first_undefined(bearing: Bearing, t: float, y: np.ndarray, yd: np.ndarray) -> str:
    """The contact whose force is the first that is no finite number if the motion goes on as at
    (t, y); the hardest one if none is."""
    for ahead in AHEAD:
        if not np.isfinite(_forces(bearing, t + ahead, y + ahead * yd, yd)).all():
            return hardest(bearing, t + ahead, y + ahead * yd, yd)
    return hardest(bearing, t, y, yd)


def hardest(bearing: Bearing, t: float, y: np.ndarray, yd: np.ndarray) -> str:
    """The contact of an element with the largest normal force, or one that is not a number."""
    force = _forces(bearing, t, y, yd)
    rank = np.where(np.isnan(force), np.inf, force)
    number, place = np.unravel_index(int(np.argmax(rank)), rank.shape)
    where = f"{bearing.family.element} {number} on its {_place(bearing, int(place))}"
    return f"{where} with {force[number, place]:.3g} N"


def _forces(bearing: Bearing, t: float, y: np.ndarray, yd: np.ndarray) -> np.ndarray:
    """Normal forces (Z, places) [N] on every element."""
    bearing.residual(t, y, yd, mode=2)
    report = bearing.data.work.report
    return np.concatenate([report.race[:, :, 0], report.pocket_normal, report.rib], axis=1)


def _place(bearing: Bearing, index: int) -> str:
    name = bearing.family.places[index]
    return f"pocket's face {name}" if name in FACES else name
