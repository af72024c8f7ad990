"""What runs of tapered rollers record."""

from __future__ import annotations

import numpy as np

from flexcage.bearings.tapered_roller.model import TaperedModel
from flexcage.contacts.cone import ConeSide
from flexcage.integrate.postures import orientation
from flexcage.integrate.recording import Recording
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem


def _coords(model: TaperedModel) -> dict[str, object]:
    return {}


def _variables(bearing: BearingSystem, y: np.ndarray) -> dict[str, np.ndarray]:
    s, n = bearing.data.samples, len(y)
    q, u = bearing.layout.q(y)["elements"], bearing.layout.u(y)["elements"]
    return {
        "element_position": q[:, :, :3],
        "element_velocity": u[:, :, :3],
        "element_quaternion": orientation(q[:, :, 2], q[:, :, 3:]),
        "element_tilt": q[:, :, 3:5],
        "element_omega": u[:, :, 3:],
        "race_force": s.race[:n, :, :, 0],
        "race_traction": s.race[:n, :, :, 1],
        "race_moment": s.race[:n, :, :, [3, 2]],
        "race_slip": s.race[:n, :, :, 4],
        "neighbour_force": s.pocket_normal[:n, :, 0],
        "rib_force": s.rib[:n],
    }


def overlaps(model: TaperedModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Depths (n, Z, places) of rollers in races, next rollers and the rib; see ``Recording``."""
    q = layout.q(y)
    x, r, psi, skew, tilt = np.moveaxis(q["elements"][..., :5], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    in_inner = at - q["inner"][:, None, :3]
    in_outer = at - q["outer"][:, None, :3]
    end = model.end
    away = np.linalg.norm(np.roll(at, -1, axis=1) - at, axis=-1)
    none = np.full_like(x, -np.inf)
    reach = in_inner[..., 0] + end.place * np.cos(skew) * np.cos(tilt)
    height = np.hypot(in_inner[..., 1], in_inner[..., 2]) + end.place * np.sin(tilt)
    depths = [
        _in_race(model.inner, in_inner), _in_race(model.outer, in_outer),
        2.0 * model.inner.whole - away, none,
        end.radius - end.cos * height - end.sin * (reach - end.apex),
    ]  # fmt: skip
    return np.stack(depths, axis=-1)


def _in_race(side: ConeSide, at: np.ndarray) -> np.ndarray:
    """Depths of spheres about centres of mass at places (..., 3) from the ring's centre."""
    distance = np.hypot(at[..., 1], at[..., 2])
    gap: np.ndarray = distance * side.cos + (at[..., 0] - side.apex) * side.sin
    return side.whole - side.sign * gap


RECORDING = Recording(coords=_coords, variables=_variables, overlaps=overlaps)
