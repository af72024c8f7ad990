"""Losses of a run by place: mean powers of its settled part."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results.metrics import settled

if TYPE_CHECKING:
    import xarray

_RACES = ("race_damping", "race_friction", "rolling_resistance")
_PLACES: Mapping[str, tuple[str, ...]] = {
    "pockets": ("pocket_damping", "pocket_friction"),
    "neighbours": ("neighbour_damping", "neighbour_friction"),
    "ribs": ("rib_damping", "rib_friction"),
    "lands": ("land_damping", "land_friction", "film"),
    "drag": ("drag",),
    "cage modes": ("modal_damping",),
    "mount": ("mount",),
}


def losses_of_run(ds: xarray.Dataset, settle: float = 0.0) -> tuple[dict[str, float], float]:
    """Losses [W] by place, and the drive's power [W]: means over a run without the share ``settle``
    of its beginning.

    Powers are those that the solver integrated; samples say how races share theirs. Raises
    InputError for a run that does not record work, or not that of its races.
    """
    for name in ("work", "race_power"):
        if name not in ds:
            raise InputError(
                f"The run has no variable '{name}': its losses are not known by place.",
                where=name,
            )
    part = settled(ds, settle)
    time, work = part["time"].values, part["work"].transpose("time", "channel")
    change = work.values[-1] - work.values[0]
    power = dict(zip(map(str, work["channel"].values), change / (time[-1] - time[0])))
    races = -sum(power[name] for name in _RACES)
    shares = np.abs(part["race_power"].transpose("time", "race").values.mean(axis=0))
    shares = shares / shares.sum() if shares.any() else np.array([0.5, 0.5])
    places = dict(zip(("inner race", "outer race"), map(float, races * shares)))
    for place, channels in _PLACES.items():
        loss = -float(sum(power.get(name, 0.0) for name in channels))
        if loss != 0.0:
            places[place] = loss
    return places, float(power["drive"])
