"""What runs of rollers record."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.bearings.cylindrical_roller.model import RollerModel, rib_columns
from flexcage.contacts.pocket_wall import N_LOCAL
from flexcage.integrate.postures import orientation, seen_from_cages, to_body
from flexcage.integrate.recording import Recording
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem


def _coords(model: RollerModel) -> dict[str, Any]:
    if not len(model.pocket.s):  # no cage
        return {}
    pocket, stations = model.pocket, np.arange(model.pocket.phi.shape[2])
    along = pocket.x0[:, None] + pocket.dx[:, None] * stations
    return {
        "slice": (("slice",), pocket.s, {"units": "m", "long_name": "place along the roller"}),
        "end_point": np.arange(len(pocket.points)),
        "end_point_place": (
            ("end_point", "polar"),
            pocket.points,
            {"units": "m", "long_name": "place on the roller's end, along r and psi"},
        ),
        "station": stations,
        "station_place": (
            ("face", "station"),
            along,
            {"units": "m", "long_name": "place along the face: x on crossbeams, else tangential"},
        ),
        "residual": np.arange(N_LOCAL),
    }


def _variables(bearing: BearingSystem, y: np.ndarray) -> dict[str, np.ndarray]:
    s, n = bearing.data.samples, len(y)
    return {
        **on_races(bearing, y),
        "rib_force": s.rib[:n, :, :2],
        "counter_rib_force": s.rib[:n, :, 2:] if s.rib.shape[2] > 2 else np.zeros_like(s.rib[:n]),
        **spot_directions(bearing.data.model, bearing.layout.q(y)["elements"]),
    }


def on_races(bearing: BearingSystem, y: np.ndarray) -> dict[str, np.ndarray]:
    """Motion of rollers, and their contacts with races, pockets or next ones."""
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
        **(in_pockets(bearing, n) if bearing.layout.has_cage else neighbour_forces(bearing, n)),
    }


def in_pockets(bearing: BearingSystem, n: int) -> dict[str, np.ndarray]:
    s, root = bearing.data.samples, bearing.data.model.pocket.root
    return {
        "pocket_slice_force": s.slice_normal[:n],
        "pocket_slice_friction": s.slice_friction[:n],
        "pocket_point_force": s.point_normal[:n],
        "pocket_point_friction": s.point_friction[:n],
        "residual_coordinates": np.einsum("zab,tzb->tza", root, s.residual[:n]),
    }


def neighbour_forces(bearing: BearingSystem, n: int) -> dict[str, np.ndarray]:
    """Of rollers without a cage: next ones stand for walls of pockets (``Motion.uncaged``)."""
    return {"neighbour_force": bearing.data.samples.pocket_normal[:n, :, 0]}


def _spotted(model: Any) -> np.ndarray:
    return np.flatnonzero(model.spot.has)


def spot_directions(model: Any, q: np.ndarray) -> dict[str, np.ndarray]:
    """Directions of spots in space, which turn with their rollers."""
    spotted, angle = _spotted(model), model.spot.angle
    if not len(spotted):
        return {}
    turned = orientation(q[:, spotted, 2], q[:, spotted, 3:]).reshape(-1, 4)
    own = np.tile([0.0, np.cos(angle), np.sin(angle)], (len(turned), 1))
    found = to_body(turned * (1.0, -1.0, -1.0, -1.0), own)  # and back into space
    return {"spot_direction": found.reshape(len(q), len(spotted), 3)}


def overlaps(model: RollerModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Depths (n, Z, places) of rollers in races, faces of their pockets or next rollers, and ribs;
    see ``Recording``. A face lies where it is widest."""
    q, radius = layout.q(y), model.bodies.radius
    x, r, psi = np.moveaxis(q["elements"][..., :3], -1, 0)
    at = np.stack([x, r * np.cos(psi), r * np.sin(psi)], axis=-1)
    in_inner, in_outer = at - q["inner"][:, None, :3], at - q["outer"][:, None, :3]
    end = model.pocket.half_roller
    none = np.full_like(x, -np.inf)
    ribs = [none] * rib_columns(model)
    for data, place in ((model.rib, in_inner), (model.outer_rib, in_outer)):
        for f in range(data.first, data.end):
            beside = place[..., 0] - model.rows.place
            ribs[data.column + f] = beside * (1.0, -1.0)[f] + end - data.half_gap
    if layout.has_cage:
        others = _in_walls(model, q, at)
    else:
        count = model.rows.each
        following = np.arange(len(radius)) + 1
        following[count - 1 :: count] -= count
        away = (at[:, following] - at)[..., 1:]
        others = [radius + radius[following] - np.linalg.norm(away, axis=-1)]
    return np.stack(
        [
            model.inner.radius + radius - np.hypot(in_inner[..., 1], in_inner[..., 2]),
            np.hypot(in_outer[..., 1], in_outer[..., 2]) + radius - model.outer.radius,
            *others,
            *ribs,
        ],
        axis=-1,
    )


def _in_walls(model: RollerModel, q: dict[str, np.ndarray], at: np.ndarray) -> list[np.ndarray]:
    """Depths (n, Z) of rollers at places (n, Z, 3) in the four faces of their pockets."""
    radius, end, (cos, sin) = model.bodies.radius, model.pocket.half_roller, model.pocket.azimuth.T
    seen = seen_from_cages(q, at)
    ahead = seen[..., 2] * cos - seen[..., 1] * sin
    beside = seen[..., 0] - model.pocket.place
    walls = np.repeat(model.pocket.half, 2) + np.maximum(model.pocket.offset.max(axis=2), 0.0)
    return [
        ahead + radius - walls[:, 0], -ahead + radius - walls[:, 1],
        beside + end - walls[:, 2], -beside + end - walls[:, 3],
    ]  # fmt: skip


RECORDING = Recording(coords=_coords, variables=_variables, overlaps=overlaps, spots=_spotted)
