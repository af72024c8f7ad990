"""What happened to a shaft: its motion at named places, and what it did to its bearings."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from flexcage.core.output_folders import SHAFT_RESULTS
from flexcage.integrate.machine import COMPONENTS
from flexcage.machine_run.turning import kept_turning
from flexcage.results.metrics import settled
from flexcage.results.store import MemoryRunStore
from flexcage.system.shaft.data import RIGID_ROTOR, SHAFT_POWERS, Rotor


@dataclass(frozen=True, eq=False)
class ShaftRecord:
    """Samples of a shaft as an xarray dataset, SI units, in the machine's axes.

    ``displacement`` (time, place, component) of the shaft's axis at bearings, discs and ends;
    ``force`` (time, bearing, component) of the shaft on each inner ring; ``work`` (time, channel)
    what loads, gravity, modal damping and bearings did on it; ``energy`` (time) its own, of
    motion and strain; ``mode`` coordinates, if it is elastic.
    """

    dataset: xr.Dataset

    @classmethod
    def of(cls, store: MemoryRunStore) -> ShaftRecord:
        """What a run has stored of its rotor so far (``integrate.machine.rotor_store``)."""
        turning, kept = kept_turning(store), store.dataset()
        q, v, force, work = (
            kept[f"rotor_{name}"].transpose("time", ...).values
            for name in ("position", "velocity", "force", "work")
        )
        data = {
            "displacement": (
                ("time", "place", "component"), np.einsum("tm,pcm->tpc", q, turning.moved),
            ),
            "force": (("time", "bearing", "component"), force * turning.sign),
            "work": (("time", "channel"), work),
            "energy": (("time",), _energy(turning.rotor, q, v)),
        }  # fmt: skip
        if q.shape[1] > RIGID_ROTOR:  # an empty dimension cannot be read back
            data["mode"] = (("time", "mode_number"), q[:, RIGID_ROTOR:])
        coords = {
            "time": kept["time"].values,
            "place": list(turning.places), "position": ("place", list(turning.places.values())),
            "component": list(COMPONENTS), "bearing": kept["bearing"].values.tolist(),
            "channel": list(SHAFT_POWERS),
        }  # fmt: skip
        return cls(xr.Dataset(data, coords))

    def write(self, folder: Path | None) -> None:
        """Write it into a run's folder, as NetCDF."""
        if folder is not None:
            self.dataset.to_netcdf(folder / SHAFT_RESULTS, engine="scipy")

    def settled(self, share: float) -> xr.Dataset:
        """Without the first share of the time."""
        return settled(self.dataset, share)


def _energy(rotor: Rotor, q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Energy (n,) of motion and strain of a rotor alone, by its coordinates and velocities."""
    mass, _, turning = rotor.inertia
    energy = 0.5 * mass * (v[:, :3] ** 2).sum(axis=1)
    energy += 0.5 * turning * (v[:, 3:RIGID_ROTOR] ** 2).sum(axis=1)
    own, rate = q[:, RIGID_ROTOR:], v[:, RIGID_ROTOR:]
    energy += 0.5 * (rate**2 + rotor.stiffness * own**2).sum(axis=1)
    return np.asarray(energy)


def imbalance(record: ShaftRecord) -> tuple[float, float]:
    """What the shaft's books miss at the most [J], and the most that it exchanged [J]."""
    ds = record.dataset
    done = ds["work"].sum("channel").values
    stored = ds["energy"].values
    missed = (stored - stored[0]) - (done - done[0])
    return float(np.abs(missed).max()), float(np.abs(ds["work"].values).max())
