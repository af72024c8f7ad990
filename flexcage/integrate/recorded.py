"""What a run records of a bearing at its samples, by name: common to all, and of each family."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

import numpy as np

from flexcage.contacts.pocket_wall import N_LOCAL
from flexcage.results.options import OutputOptions
from flexcage.results.registry import ENERGIES, VARIABLES, variables_of
from flexcage.results.store import MemoryRunStore, RunStore
from flexcage.system.ball_model import BallModel
from flexcage.system.data import POWERS
from flexcage.system.model import Model
from flexcage.system.problem import Bearing

Arrays = dict[str, np.ndarray]


@singledispatch
def own_coords(model: Any) -> dict[str, Any]:
    """Labels of the dimensions that only runs of this model's family have, and places that go
    with them, as ``RunStore.create`` takes both."""
    raise NotImplementedError(f"{type(model).__name__} records nothing")


@singledispatch
def recorded(model: Any, bearing: Bearing, y: np.ndarray, yd: np.ndarray) -> Arrays:
    """Main-grid variables of one block by name, from states (n, size) and the samples kept."""
    raise NotImplementedError(f"{type(model).__name__} records nothing")


def new_store(
    path: Any, bearing: Bearing, *, duration: float, output: OutputOptions, attrs: dict[str, Any]
) -> MemoryRunStore:
    """Allocate a run for this bearing on its sampling grids, at ``path`` or in memory."""
    n, ratio = max(round(duration * output.rate), 2), output.vibration_ratio
    layout, family = bearing.layout, bearing.family
    numbers = np.arange(layout.rollers)
    coords = {
        "time": np.arange(1, n + 1) / output.rate,
        "time_hf": np.arange(1, n * ratio + 1) / output.vibration_rate,
        "element": numbers,
        "pocket": numbers,
        "face": np.array(family.faces),
        "mode": np.arange(layout.modes),
        "constraint": np.array(layout.reactions),
        "multiplier_unit": (
            ("constraint",),
            np.array(bearing.reaction_units),
            {"long_name": "unit of multipliers"},
        ),
        "energy_kind": np.array(ENERGIES),
        "channel": np.array(POWERS),
        "land_station": np.arange(len(bearing.data.model.land.angle)),
        **own_coords(bearing.data.model),
    }
    return RunStore.create(
        path,
        coords=coords,
        variables=recorded_names(bearing),
        n_time=n,
        n_time_hf=n * ratio,
        block=output.block,
        block_hf=output.block_hf,
        attrs={
            **attrs, "family": family.name, "element": family.element,
            "places": list(family.places),
        },
    )  # fmt: skip


def recorded_names(bearing: Bearing) -> list[str]:
    """Names of all that is recorded of this bearing."""
    every = variables_of(bearing.family.name)
    return [name for name in every if bearing.layout.modes or "mode" not in VARIABLES[name].dims]


def common(bearing: Bearing, y: np.ndarray, yd: np.ndarray) -> Arrays:
    """Rings, cage, lands, pockets and energies of any bearing."""
    layout, s, n = bearing.layout, bearing.data.samples, len(y)
    q, u, a = layout.q(y), layout.u(y), layout.u(yd)
    quaternion = q["quaternion"] / np.linalg.norm(q["quaternion"], axis=1, keepdims=True)
    arrays = {
        "inner_position": q["inner"][:, :3],
        "inner_velocity": u["inner"][:, :3],
        "inner_angle": q["inner"][:, 5],
        "inner_speed": u["inner"][:, 3],
        "inner_quaternion": orientation(np.zeros(n), q["inner"][:, 3:]),
        "outer_position": in_plane(q["outer"]),
        "outer_velocity": in_plane(u["outer"]),
        "cage_position": q["cage"],
        "cage_velocity": u["cage"],
        "cage_quaternion": quaternion,
        "cage_omega": u["omega"],
        "cage_acceleration": to_body(quaternion, a["cage"]),
        "cage_angular_acceleration": a["omega"],
        "pocket_force": s.pocket_normal[:n],
        "pocket_peak": s.pocket_peak[:n],
        "pocket_friction": s.pocket_friction[:n],
        "station_force": s.station[:n],
        "land_force": s.land[:n],
        "land_station_force": s.land_station[:n],
        "multiplier": layout.multipliers(y),
        "energy": s.energy[:n],
    }
    if layout.modes:
        arrays["modal_coordinates"] = q["modes"]
        arrays["modal_velocity"] = u["modes"]
        arrays["modal_acceleration"] = a["modes"]
    return arrays


@own_coords.register
def _(model: Model) -> dict[str, Any]:
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


@recorded.register
def _(model: Model, bearing: Bearing, y: np.ndarray, yd: np.ndarray) -> Arrays:
    s, n = bearing.data.samples, len(y)
    q, u = bearing.layout.q(y)["rollers"], bearing.layout.u(y)["rollers"]
    return {
        **common(bearing, y, yd),
        "element_position": q[:, :, :3],
        "element_velocity": u[:, :, :3],
        "element_quaternion": orientation(q[:, :, 2], q[:, :, 3:]),
        "element_tilt": q[:, :, 3:5],
        "element_omega": u[:, :, 3:],
        "race_force": s.race[:n, :, :, 0],
        "race_traction": s.race[:n, :, :, 1],
        "race_moment": s.race[:n, :, :, [3, 2]],
        "race_slip": s.race[:n, :, :, 4],
        "pocket_slice_force": s.slice_normal[:n],
        "pocket_slice_friction": s.slice_friction[:n],
        "pocket_point_force": s.point_normal[:n],
        "pocket_point_friction": s.point_friction[:n],
        "residual_coordinates": np.einsum("zab,tzb->tza", model.pocket.root, s.residual[:n]),
        "rib_force": s.rib[:n],
    }


@own_coords.register
def _(model: BallModel) -> dict[str, Any]:
    return {"station": np.arange(model.pocket.phi.shape[2])}


@recorded.register
def _(model: BallModel, bearing: Bearing, y: np.ndarray, yd: np.ndarray) -> Arrays:
    s, n = bearing.data.samples, len(y)
    q, u = bearing.layout.q(y)["rollers"], bearing.layout.u(y)["rollers"]
    return {
        **common(bearing, y, yd),
        "element_position": q[:, :, :3],
        "element_velocity": u[:, :, :3],
        "element_omega": u[:, :, 3:],
        "race_force": s.race[:n, :, :, 0],
        "contact_angle": s.race[:n, :, :, 1],
        "race_traction": s.race[:n, :, :, 2],
        "race_traction_across": s.race[:n, :, :, 3],
        "race_slip": s.race[:n, :, :, 4],
        "pocket_direction": s.residual[:n, :, 0],
    }


def in_plane(yz: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) in space of components (n, 2) in the plane of rotation."""
    return np.concatenate([np.zeros((len(yz), 1)), yz], axis=1)


def orientation(azimuth: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Unit quaternions (..., 4), scalar first, of bodies at ``azimuth`` (...,) about x, turned by
    ``angles`` (..., 3): skew about the radial, tilt about the tangential axis, and spin [rad]."""
    half = 0.5 * np.stack([azimuth, *np.moveaxis(angles, -1, 0)])
    (c1, c2, c3, c4), (s1, s2, s3, s4) = np.cos(half), np.sin(half)
    w, x, y, z = c1 * c2, s1 * c2, c1 * s2, s1 * s2
    w, x, y, z = w * c3 - z * s3, x * c3 + y * s3, y * c3 - x * s3, z * c3 + w * s3
    return np.stack([w * c4 - x * s4, x * c4 + w * s4, y * c4 + z * s4, z * c4 - y * s4], axis=-1)


def to_body(quaternion: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Space vectors (n, 3) in the body frames of unit quaternions (n, 4), scalar first."""
    w, v = quaternion[:, :1], -quaternion[:, 1:]
    t = 2.0 * np.cross(v, vectors)
    return vectors + w * t + np.cross(v, t)
