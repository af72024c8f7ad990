"""What a run records of a bearing at its samples, by name."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.contacts.evaluation import DAMPED, ROLLED
from flexcage.core.wings import FAMILIES
from flexcage.integrate.postures import orientation, to_body
from flexcage.integrate.recording import Recording
from flexcage.integrate.rings import ring_records
from flexcage.results.options import OutputOptions
from flexcage.results.registry import (
    CAGES,
    ENERGIES,
    NEIGHBOURS,
    VARIABLES,
    of_each_cage,
    own_variables,
    variables_of,
)
from flexcage.results.store import MemoryRunStore, RunStore
from flexcage.system.data import POWERS
from flexcage.system.problem import BearingSystem


def new_store(
    path: Any,
    bearing: BearingSystem,
    recording: Recording[Any],
    *,
    duration: float,
    output: OutputOptions,
    attrs: dict[str, Any],
) -> MemoryRunStore:
    """Allocate a run for this bearing on its sampling grids, at ``path`` or in memory."""
    n, ratio = max(round(duration * output.rate), 2), output.vibration_ratio
    layout, spec = bearing.layout, bearing.spec
    numbers = np.arange(layout.elements)
    coords = {
        "time": np.arange(1, n + 1) / output.rate,
        "time_hf": np.arange(1, n * ratio + 1) / output.vibration_rate,
        "element": numbers,
        **(_of_cage(bearing) if layout.has_cage else {}),
        "constraint": np.array(layout.reactions),
        "multiplier_unit": (
            ("constraint",),
            np.array(bearing.reaction_units),
            {"long_name": "unit of multipliers"},
        ),
        **_supports(bearing),
        **_spotted(bearing, recording),
        "energy_kind": np.array(ENERGIES),
        "channel": np.array(POWERS),
        **recording.coords(bearing.data.model),
    }
    return RunStore.create(
        path,
        coords=coords,
        variables=[
            of_each_cage(VARIABLES[name]) if layout.cages > 1 else VARIABLES[name]
            for name in recorded_names(bearing, recording)
        ],
        n_time=n,
        n_time_hf=n * ratio,
        block=output.block,
        block_hf=output.block_hf,
        attrs={
            **attrs, "family": spec.family, "element": spec.element,
            "places": list(bearing.places),
        },
    )  # fmt: skip


def _of_cage(bearing: BearingSystem) -> dict[str, Any]:
    """Labels of cages' pockets, faces, modes and stations of their lands."""
    layout, stations = bearing.layout, len(bearing.data.work.report.land_station)
    attrs = {"long_name": "cage; 0 of the row at -x"}
    return {
        **({CAGES: ((CAGES,), np.arange(layout.cages), attrs)} if layout.cages > 1 else {}),
        "pocket": np.arange(layout.elements),
        "face": np.array(bearing.motion.faces),
        "mode": np.arange(layout.modes),
        "land_station": np.arange(stations // max(layout.cages, 1)),
    }


def _supports(bearing: BearingSystem) -> dict[str, Any]:
    """Azimuths of supports that hold an outer ring that bends."""
    azimuth = bearing.rings.modes[1].azimuth if bearing.rings else ()
    if not len(azimuth):
        return {}
    attrs = {"units": "rad", "long_name": "azimuth of supports"}
    return {
        "support": np.arange(len(azimuth)), "support_azimuth": (("support",), azimuth, attrs)
    }  # fmt: skip


def _spotted(bearing: BearingSystem, recording: Recording[Any]) -> dict[str, Any]:
    """Numbers of the elements that have a spot."""
    spotted = recording.spots(bearing.data.model)
    attrs = {"long_name": "element that has a spot"}
    return {"spotted": (("spotted",), spotted, attrs)} if len(spotted) else {}


def recorded_names(bearing: BearingSystem, recording: Recording[Any]) -> list[str]:
    """Names of all that is recorded of this bearing."""
    layout = bearing.layout
    supports = bearing.rings is not None and len(bearing.rings.modes[1].azimuth)
    spots = len(recording.spots(bearing.data.model))
    counted = (
        ("mode", layout.modes), ("bending", layout.bends), ("support", supports),
        ("spotted", spots),
    )  # fmt: skip
    without = {dim for dim, has in counted if not has}
    every = variables_of(bearing.spec.family)
    if not layout.has_cage:
        own = own_variables(FAMILIES[bearing.spec.family]).counted
        without |= {*_of_cage(bearing), "station", *own}
        every = [name for name in every if not VARIABLES[name].of_cage]
    elif not recording.touch:
        every = [name for name in every if name != NEIGHBOURS]
    return [name for name in every if without.isdisjoint(VARIABLES[name].dims)]


def recorded(
    bearing: BearingSystem, recording: Recording[Any], y: np.ndarray, yd: np.ndarray
) -> dict[str, np.ndarray]:
    """Main-grid variables of one block by name, from states (n, size) and the samples kept."""
    return {**_common(bearing, y, yd), **recording.variables(bearing, y)}


def _common(bearing: BearingSystem, y: np.ndarray, yd: np.ndarray) -> dict[str, np.ndarray]:
    """Rings, cage and energies of any bearing."""
    layout, s, n = bearing.layout, bearing.data.samples, len(y)
    q, u = layout.q(y), layout.u(y)
    arrays = {
        "inner_position": q["inner"][:, :3],
        "inner_velocity": u["inner"][:, :3],
        "inner_angle": q["inner"][:, 5],
        "inner_speed": u["inner"][:, 3],
        "inner_quaternion": orientation(np.zeros(n), q["inner"][:, 3:]),
        "outer_position": q["outer"][:, :3],
        "outer_velocity": u["outer"][:, :3],
        "outer_quaternion": orientation(np.zeros(n), q["outer"][:, 3:]),
        "outer_force": s.outer_wrench[:n, :3],
        "outer_moment": s.outer_wrench[:n, 3:],
        **(_cage(bearing, y, yd) if layout.has_cage else {}),
        "multiplier": layout.multipliers(y),
        "race_power": s.race[:n, :, :, DAMPED : ROLLED + 1].sum(axis=(1, 3)),
        "energy": s.energy[:n],
    }
    if layout.bends:
        arrays |= ring_records(bearing, y)
    return arrays


def _cage(bearing: BearingSystem, y: np.ndarray, yd: np.ndarray) -> dict[str, np.ndarray]:
    """The motion of cages, and the forces of their pockets and lands."""
    layout, s, n = bearing.layout, bearing.data.samples, len(y)
    q, u, a = layout.q(y), layout.u(y), layout.u(yd)
    quaternion = q["quaternion"] / np.linalg.norm(q["quaternion"], axis=-1, keepdims=True)
    each = (layout.cages,) if layout.cages > 1 else ()
    arrays = {
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
        "land_force": s.land[:n].reshape(n, *each, 3),
        "land_station_force": s.land_station[:n].reshape(n, *each, -1, 2),
    }
    if layout.modes:
        arrays["modal_coordinates"] = q["modes"]
        arrays["modal_velocity"] = u["modes"]
        arrays["modal_acceleration"] = a["modes"]
    return arrays
