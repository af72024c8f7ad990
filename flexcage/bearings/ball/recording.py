"""What runs of balls record."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.bearings.ball.model import BallModel
from flexcage.contacts.ball_pocket import SPHERE
from flexcage.integrate.postures import seen_from_cages
from flexcage.integrate.recording import Recording
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem


def _coords(model: BallModel) -> dict[str, Any]:
    stations = model.pocket.phi.shape[2]
    return {"station": np.arange(stations)} if stations else {}


def _variables(bearing: BearingSystem, y: np.ndarray) -> dict[str, np.ndarray]:
    s, n = bearing.data.samples, len(y)
    q, u = bearing.layout.q(y)["elements"], bearing.layout.u(y)["elements"]
    return {
        "element_position": q[:, :, :3],
        "element_velocity": u[:, :, :3],
        "element_omega": u[:, :, 3:],
        "race_force": s.race[:n, :, :, 0],
        "contact_angle": s.race[:n, :, :, 1],
        "race_traction": s.race[:n, :, :, 2],
        "race_traction_across": s.race[:n, :, :, 3],
        "race_slip": s.race[:n, :, :, 4],
        "neighbour_force": s.rib[:n, :, 0],
        **({"pocket_direction": s.residual[:n, :, 0]} if bearing.layout.has_cage else {}),
        **_spots(bearing.data.model, q),
    }


def _spotted(model: BallModel) -> np.ndarray:
    return np.flatnonzero(model.spot.has)


def _spots(model: BallModel, q: np.ndarray) -> dict[str, np.ndarray]:
    """Directions of spots in space: those of balls that have one are coordinates at their
    azimuth."""
    spotted = _spotted(model)
    if not len(spotted):
        return {}
    x, r, psi = np.moveaxis(q[:, spotted, 3:], -1, 0)
    c, s = np.cos(q[:, spotted, 2]), np.sin(q[:, spotted, 2])
    found = np.stack([x, c * r - s * psi, s * r + c * psi], axis=-1)
    return {"spot_direction": found / np.linalg.norm(found, axis=-1, keepdims=True)}


def overlaps(model: BallModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Depths (n, Z, 5) of balls in races, their pocket and the next ball, and outside the cage's
    wall, without a cage (n, Z, 3) in races and the next ball; see ``Recording``."""
    q, radius = layout.q(y), model.bodies.radius
    x, r, psi = np.moveaxis(q["elements"][..., :3], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    races = [
        np.hypot(p[..., 0] - race.axial, np.hypot(p[..., 1], p[..., 2]) - race.centre)
        - (race.radius - radius)
        for race, p in (
            (model.inner, at - q["inner"][:, None, :3]),
            (model.outer, at - q["outer"][:, None, :3]),
        )
    ]
    gaps = gaps_to_next(q["elements"], radius)
    if not layout.has_cage:
        return np.stack([*races, gaps], axis=-1)
    seen = seen_from_cages(q, at)
    cos, sin = model.pocket.azimuth.T
    ahead = seen[..., 2] * cos - seen[..., 1] * sin - model.pocket.shift[:, 1]
    aside = seen[..., 0] - model.pocket.shift[:, 0]
    free = np.hypot(
        *(np.maximum(np.abs(d) - h, 0.0) for d, h in zip((aside, ahead), model.pocket.slot.T))
    )
    away = np.hypot(seen[..., 1], seen[..., 2])
    outside = np.maximum(model.pocket.wall[0] - away, away - model.pocket.wall[1])
    return np.stack([*races, free - (model.pocket.radius - radius), gaps, outside], axis=-1)


def gaps_to_next(balls: np.ndarray, radius: np.ndarray) -> np.ndarray:
    """How deep (n, Z) [m] balls of coordinates (n, Z, 6) lie in the next one, the last in the
    first; below zero apart."""
    x, r, psi = np.moveaxis(balls[..., :3], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    apart: np.ndarray = np.linalg.norm(np.roll(at, -1, axis=1) - at, axis=-1)
    return radius + np.roll(radius, -1) - apart


def _remedy(model: BallModel) -> str:
    if model.pocket.shape == SPHERE:
        return "it passed the rim of its pocket; a broader cage would hold it"
    return "a land (cage.guidance) or spherical pockets would hold it"


RECORDING = Recording(
    coords=_coords,
    variables=_variables,
    overlaps=overlaps,
    remedy=_remedy,
    spots=_spotted,
    touch=True,
)
