"""Equivalent stress over a history: followed places, the peak of every sample, the envelope."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from flexcage.stress.fields import StressFields

_BLOCK = 256  # samples at a time: their stresses stay near the processor


@dataclass(frozen=True)
class StressHistory:
    """Equivalent stresses [Pa] over samples; ``surface`` numbers the mesh vertices looked at."""

    surface: np.ndarray  # (n_surface,) vertex numbers
    place_names: tuple[str, ...]
    places: np.ndarray  # (nt, n_places) largest at each place
    peak: np.ndarray  # (nt,) largest outside the contact zone of ``places.contact_zone``
    peak_vertex: np.ndarray  # (nt,) mesh vertex of it
    envelope: np.ndarray  # (n_surface,) largest over the settled samples
    envelope_sample: np.ndarray  # (n_surface,) sample of it
    settled: int = 0  # first sample of the settled part

    @property
    def peak_sample(self) -> int:
        """The sample of the largest peak of the settled part."""
        return self.settled + int(np.argmax(self.peak[self.settled :]))

    def summary(self) -> str:
        """Where and when the largest equivalent stress is, in one sentence."""
        sample = self.peak_sample
        place = (
            self.place_names[int(np.argmax(self.places[sample]))] if self.place_names else "none"
        )
        return (
            f"peak equivalent stress {self.peak[sample] / 1e6:.3g} MPa at sample {sample}, vertex "
            f"{self.peak_vertex[sample]}; the most stressed named place is {place}"
        )


def equivalent_stress(
    fields: StressFields,
    q: np.ndarray,
    station_forces: np.ndarray,
    land_forces: np.ndarray | None = None,
) -> Iterator[tuple[slice, np.ndarray]]:
    """Blocks (samples, (n_surface, block)) of equivalent stress [Pa].

    Over nt samples: modal coordinates (nt, n), station forces (nt, Z, 4, n_st, 3) and land forces
    (nt, 2, n_land, 3) [N], components (x, r, psi) of the pockets' and land stations' frames.
    """
    for first in range(0, len(q), _BLOCK):
        part = slice(first, min(first + _BLOCK, len(q)))
        sums = fields.modes @ q[part].T.astype(np.float32)
        sums += _loaded(fields.forces, fields.reduced_forces(station_forces[part]))
        if land_forces is not None and np.any(land_forces[part]):
            flat = land_forces[part].reshape(part.stop - part.start, -1)
            sums += _loaded(fields.land_forces, flat)
        parts = sums.reshape(5, -1, sums.shape[1])
        np.square(parts, out=parts)
        yield part, np.sqrt(parts.sum(axis=0))


def _loaded(fields: np.ndarray, loads: np.ndarray) -> np.ndarray:
    """Fields (rows, m) times loads (nt, m), over those columns alone that carry a load."""
    used = np.flatnonzero(np.any(loads, axis=0))
    if len(used) < 0.7 * fields.shape[1]:
        fields, loads = fields[:, used], loads[:, used]
    return fields @ loads.T.astype(np.float32)


def stress_history(
    fields: StressFields,
    q: np.ndarray,
    station_forces: np.ndarray,
    land_forces: np.ndarray | None = None,
    *,
    settled: int = 0,
) -> StressHistory:
    """Places and peaks over samples, the envelope from sample ``settled`` on.

    Other arguments as in ``equivalent_stress``.
    """
    slots = [np.searchsorted(fields.surface, v) for v in fields.places.values()]
    places = np.zeros((len(q), len(slots)), np.float32)
    peak, where = np.zeros(len(q), np.float32), np.zeros(len(q), int)
    envelope = np.zeros(len(fields.surface), np.float32)
    when = np.zeros(len(fields.surface), int)
    for part, values in equivalent_stress(fields, q, station_forces, land_forces):
        for i, slot in enumerate(slots):
            places[part, i] = values[slot].max(axis=0)
        searched = values[fields.searched]
        where[part] = fields.surface[fields.searched[np.argmax(searched, axis=0)]]
        peak[part] = searched.max(axis=0)
        skip = max(settled - part.start, 0)
        if skip >= values.shape[1]:
            continue
        best = skip + np.argmax(values[:, skip:], axis=1)
        largest = values[np.arange(len(values)), best]
        when = np.where(largest > envelope, part.start + best, when)
        envelope = np.maximum(envelope, largest)
    names = tuple(fields.places)
    return StressHistory(fields.surface, names, places, peak, where, envelope, when, settled)
