"""What happened to a shaft: its motion at named places, and what it did to its bearings."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from flexcage.core.output_folders import SHAFT_RESULTS
from flexcage.integrate.machine import MachineIntegration
from flexcage.machine.rotor import TurningShaft
from flexcage.results.metrics import settled
from flexcage.system.shaft.data import RIGID_ROTOR, SHAFT_POWERS

_AXES = ("x", "y", "z")
_SAME = 1e-4  # m: an end that is so near to a bearing or disc is one place with it
_COMPONENTS = (*_AXES, "about y", "about z")


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
    def of(cls, integration: MachineIntegration, shaft: TurningShaft) -> ShaftRecord:
        """What an integration has kept."""
        kept = {name: _joined(blocks) for name, blocks in integration.rotor.items()}
        n = len(kept["position"])
        system, places = integration.machine.shaft, _places(shaft)
        q, v = kept["position"], kept["velocity"]
        moved = np.array([shaft.at(x) for x in places.values()])  # (places, 5, 5 + m)
        force = kept["force"].reshape(n, len(system.place), RIGID_ROTOR) * system.sign
        mass, _, turning = system.inertia
        energy = 0.5 * mass * (v[:, :3] ** 2).sum(axis=1)
        energy += 0.5 * turning * (v[:, 3:RIGID_ROTOR] ** 2).sum(axis=1)
        own, rate = q[:, RIGID_ROTOR:], v[:, RIGID_ROTOR:]
        energy += 0.5 * (rate**2 + system.stiffness * own**2).sum(axis=1)
        names = [b.place.name for b in shaft.machine.bearings]
        data = {
            "displacement": (("time", "place", "component"), np.einsum("tm,pcm->tpc", q, moved)),
            "force": (("time", "bearing", "component"), force),
            "work": (("time", "channel"), kept["work"]),
            "energy": (("time",), energy),
        }
        if own.shape[1]:  # an empty dimension cannot be read back
            data["mode"] = (("time", "mode_number"), own)
        coords = {
            "time": np.arange(1, n + 1) / integration.output.rate,
            "place": list(places), "position": ("place", list(places.values())),
            "component": list(_COMPONENTS), "bearing": names, "channel": list(SHAFT_POWERS),
        }  # fmt: skip
        return cls(xr.Dataset(data, coords))

    @classmethod
    def read(cls, folder: Path) -> ShaftRecord:
        """That of a run's folder."""
        with xr.open_dataset(folder / SHAFT_RESULTS, engine="scipy") as found:
            return cls(found.load())

    def write(self, folder: Path | None) -> None:
        """Write it into a run's folder, as NetCDF."""
        if folder is not None:
            self.dataset.to_netcdf(folder / SHAFT_RESULTS, engine="scipy")

    def settled(self, share: float) -> xr.Dataset:
        """Without the first share of the time."""
        return settled(self.dataset, share)


def _places(shaft: TurningShaft) -> dict[str, float]:
    """Named places along the shaft [m]: bearings, discs, ends."""
    machine = shaft.machine
    found = {b.place.name: b.place.position for b in machine.bearings}
    for k, disc in enumerate(machine.shaft.discs):
        found[disc.name or f"disc {k}"] = disc.position
    for name, end in (("left end", 0.0), ("right end", machine.shaft.whole_length)):
        if all(abs(end - place) > _SAME for place in found.values()):
            found[name] = end
    return found


def _joined(blocks: list[np.ndarray]) -> np.ndarray:
    return np.concatenate(blocks) if blocks else np.zeros((0, RIGID_ROTOR))


def imbalance(record: ShaftRecord) -> tuple[float, float]:
    """What the shaft's books miss at the most [J], and the most that it exchanged [J]."""
    ds = record.dataset
    done = ds["work"].sum("channel").values
    stored = ds["energy"].values
    missed = (stored - stored[0]) - (done - done[0])
    return float(np.abs(missed).max()), float(np.abs(ds["work"].values).max())
