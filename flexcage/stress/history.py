"""Equivalent stress over a history: followed places, the peak of every sample, the envelope."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from flexcage.core.progress import Silent
from flexcage.core.threads import on_all_cores
from flexcage.stress.fields import StressFields, TensorFields, UnitFields

_BLOCK = 256  # samples at a time: their stresses stay near the processor
_READ = 4096  # samples at a time of what is read and reduced only


class Sliced(Protocol):
    """Values along samples, an array or what reads one from disk slice by slice."""

    def __len__(self) -> int: ...
    def __getitem__(self, part: slice, /) -> Any: ...


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


@dataclass(frozen=True)
class _Block:
    """What is kept of one block of samples."""

    places: np.ndarray  # (block, n_places)
    peak: np.ndarray  # (block,)
    where: np.ndarray  # (block,) mesh vertex of the peak
    envelope: np.ndarray  # (n_surface,) largest over the settled samples; 0 if there is none
    when: np.ndarray  # (n_surface,) sample of it


def equivalent_stress(
    fields: StressFields,
    q: np.ndarray,
    station_forces: np.ndarray,
    land_forces: np.ndarray | None = None,
) -> np.ndarray:
    """Equivalent stress (n_surface, nt) [Pa].

    Over nt samples: modal coordinates (nt, n), station forces (nt, Z, F, n_st, 3) and land forces
    (nt, 2, n_land, 3) [N], components (x, r, psi) of the pockets' and land stations' frames.
    """
    parts = _superposed(
        fields, slice(None), q, fields.reduced_forces(station_forces), _land(land_forces, len(q))
    )
    return fields.equivalent(parts)


def tensor_histories(
    fields: TensorFields,
    q: Sliced,
    station_forces: Sliced,
    land_forces: Sliced | None = None,
    *,
    places: Iterable[str],
) -> Iterator[tuple[str, np.ndarray]]:
    """Name and stresses (6, n, nt) [Pa] of every place, at its n points: xx, yy, zz, xy, yz, xz
    in the cage's frame. Other arguments as in ``equivalent_stress``."""
    parts = [slice(first, first + _READ) for first in range(0, len(q), _READ)]
    loads = np.concatenate([fields.reduced_forces(np.asarray(station_forces[p])) for p in parts])
    moved, land = np.asarray(q[:]), None
    if land_forces is not None:
        land = _land(np.asarray(land_forces[:]), len(q))
    for name in places:
        yield name, _superposed(fields, fields.places[name], moved, loads, land)


def _land(forces: np.ndarray | None, samples: int) -> np.ndarray | None:
    """Land forces (nt, m) of the fields' columns; None without any."""
    return forces.reshape(samples, -1) if forces is not None and np.any(forces) else None


def _superposed(
    fields: UnitFields,
    points: slice | np.ndarray,
    q: np.ndarray,
    loads: np.ndarray,
    land: np.ndarray | None,
) -> np.ndarray:
    """Parts (parts, n, nt) of the stress at some of the fields' points."""

    def at(table: np.ndarray) -> np.ndarray:
        columns = table.shape[1]
        return table.reshape(fields.parts, -1, columns)[:, points].reshape(-1, columns)

    sums = at(fields.modes) @ q.T.astype(np.float32)
    sums += _loaded(at(fields.forces), loads)
    if land is not None:
        sums += _loaded(at(fields.land_forces), land)
    return sums.reshape(fields.parts, -1, sums.shape[1])


def _loaded(fields: np.ndarray, loads: np.ndarray) -> np.ndarray:
    """Fields (rows, m) times loads (nt, m), over those columns alone that carry a load."""
    used = np.flatnonzero(np.any(loads, axis=0))
    if len(used) < 0.7 * fields.shape[1]:
        fields, loads = fields[:, used], loads[:, used]
    return fields @ loads.T.astype(np.float32)


def stress_history(
    fields: StressFields,
    q: Sliced,
    station_forces: Sliced,
    land_forces: Sliced | None = None,
    *,
    settled: int = 0,
    progress: Callable[..., Any] = Silent,
) -> StressHistory:
    """Places and peaks over samples, the envelope from sample ``settled`` on.

    Other arguments as in ``equivalent_stress``, but read block by block, so that a long run may
    stay on disk. Blocks of samples are spread over the cores; ``progress`` is a context like
    ``core.progress.Progress``.
    """
    slots = [np.searchsorted(fields.surface, v) for v in fields.places.values()]

    def work(first: int) -> _Block:
        part = slice(first, min(first + _BLOCK, len(q)))
        land = None if land_forces is None else np.asarray(land_forces[part])
        values = equivalent_stress(
            fields, np.asarray(q[part]), np.asarray(station_forces[part]), land
        )
        places = np.zeros((values.shape[1], len(slots)), np.float32)
        for i, slot in enumerate(slots):
            places[:, i] = values[slot].max(axis=0)
        searched = values[fields.searched]
        where = fields.surface[fields.searched[np.argmax(searched, axis=0)]]
        skip = max(settled - first, 0)
        bar.advance()
        if skip >= values.shape[1]:
            none = np.zeros(len(values))
            return _Block(places, searched.max(axis=0), where, none, none.astype(int))
        best = skip + np.argmax(values[:, skip:], axis=1)
        envelope = values[np.arange(len(values)), best]
        return _Block(places, searched.max(axis=0), where, envelope, first + best)

    starts = range(0, len(q), _BLOCK)
    with progress(len(starts), "stress") as bar:
        _ = fields.modes, fields.forces  # once, not in every thread
        if land_forces is not None:
            _ = fields.land_forces
        blocks = on_all_cores(work, starts)
    envelopes = np.stack([block.envelope for block in blocks])
    largest = (np.argmax(envelopes, axis=0), np.arange(len(fields.surface)))
    return StressHistory(
        surface=fields.surface,
        place_names=tuple(fields.places),
        places=np.concatenate([block.places for block in blocks]),
        peak=np.concatenate([block.peak for block in blocks]),
        peak_vertex=np.concatenate([block.where for block in blocks]),
        envelope=envelopes[largest],
        envelope_sample=np.stack([block.when for block in blocks])[largest],
        settled=settled,
    )
