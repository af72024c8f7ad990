"""Equivalent stress over a history: followed places, peaks between samples, the envelope.

Stress is computed at samples, and at steps of the solver between them: there at the named places
alone, and over the whole surface at the step at which the places' largest is greatest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import scipy.sparse as sp

from flexcage.core.progress import Silent
from flexcage.core.threads import on_all_cores
from flexcage.stress.between import Loads, Steps, no_steps, together
from flexcage.stress.fields import NamedFields, StressFields, Tables

_BLOCK = 256  # samples at a time: their stresses stay near the processor
_READ = 512  # samples at a time of what is read and reduced only


class Sliced(Protocol):
    """Values along samples, an array or what reads one from disk slice by slice."""

    def __len__(self) -> int: ...
    def __getitem__(self, part: slice, /) -> Any: ...


@dataclass(frozen=True)
class StressHistory:
    """Equivalent stresses [Pa] over samples; ``surface`` numbers the mesh vertices looked at.

    With steps between samples, ``places`` and ``peak`` are the largest since the sample before, and
    so is the envelope. Off the places, these two are of samples, of the steps at which the places
    show most, and of those at which any of them does.
    """

    surface: np.ndarray  # (n_surface,) vertex numbers
    place_names: tuple[str, ...]
    places: np.ndarray  # (nt, n_places) largest at each place
    peak: np.ndarray  # (nt,) largest outside the contact zone of ``places.contact_zone``
    peak_vertex: np.ndarray  # (nt,) mesh vertex of it
    peak_time: np.ndarray  # (nt,) [s] of a step between samples at which it is; else NaN
    at_sample: np.ndarray  # (nt,) largest at the sample itself
    envelope: np.ndarray  # (n_surface,) largest over the settled part
    edges: np.ndarray  # (n_edges, 2) vertices of the edges that cross a face of the body
    middles: np.ndarray  # (n_edges,) the envelope in their middles
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
    when: np.ndarray  # (block,) [s] of a step between samples, or NaN
    sampled: np.ndarray  # (block,)
    envelope: np.ndarray  # (n_surface,) as of the whole; 0 if nothing is settled
    middles: np.ndarray  # (n_edges,) likewise


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
    return fields.equivalent(_parts(fields, q, station_forces, land_forces))


def _parts(
    fields: StressFields, q: np.ndarray, station_forces: np.ndarray, land_forces: np.ndarray | None
) -> np.ndarray:
    """Deviators (5, n_points, nt) of the same."""
    loads = fields.reduced_forces(station_forces)
    return _superposed(fields, q, loads, _land(land_forces, len(q)))


def histories_at(
    fields: NamedFields,
    q: Sliced,
    station_forces: Sliced,
    land_forces: Sliced | None = None,
    *,
    places: Iterable[str],
    between: Steps = no_steps,
) -> tuple[np.ndarray, Iterator[tuple[str, np.ndarray]]]:
    """Samples (n,) that end the intervals of n instants, and by name what the fields are of at a
    place's m points (6, m, n): stresses xx, yy, zz, xy, yz, xz [Pa] in the cage's frame.

    Instants are samples and the steps between them; arguments as in ``stress_history``.
    """
    samples, moved, pushed, lands = [], [], [], []
    for first in range(0, len(q), _READ):
        part = slice(first, min(first + _READ, len(q)))
        number = np.arange(part.start, part.stop)
        land = np.zeros((len(number), 0)) if land_forces is None else np.asarray(land_forces[part])
        every = Loads(
            number, np.full(len(number), np.inf), np.asarray(q[part]),
            np.asarray(station_forces[part]), land,
        )  # fmt: skip
        if (steps := between(part.start, part.stop)) is not None:
            every = together([every, steps if land_forces is not None else steps.off_lands()])
        every = every.only(np.lexsort((every.time, every.sample)))  # steps, then their sample
        samples.append(every.sample)
        moved.append(every.modes)
        loads = fields.reduced_forces(every.stations)
        pushed.append(sp.csr_array(loads.astype(np.float32)))  # few pockets are touched at a time
        lands.append(every.lands.astype(np.float32))
    modes, loads, land = (
        np.concatenate(moved),
        sp.vstack(pushed, format="csr"),
        np.concatenate(lands),
    )
    of_lands = _land(land, len(land))

    def histories() -> Iterator[tuple[str, np.ndarray]]:
        for name in places:
            yield name, _superposed(fields.at(fields.places[name]), modes, loads, of_lands)

    return np.concatenate(samples), histories()


def _land(forces: np.ndarray | None, samples: int) -> np.ndarray | None:
    """Land forces (nt, m) of the fields' columns; None without any."""
    return forces.reshape(samples, -1) if forces is not None and np.any(forces) else None


def _superposed(
    fields: Tables, q: np.ndarray, loads: np.ndarray | sp.csr_array, land: np.ndarray | None
) -> np.ndarray:
    """Parts (parts, n_points, nt) of the stress."""
    sums = fields.modes @ q.T.astype(np.float32)
    sums += _loaded(fields.forces, loads)
    if land is not None:
        sums += _loaded(fields.land_forces, land)
    return sums.reshape(fields.parts, -1, sums.shape[1])


def _stress_of(
    fields: Tables, reduced: Callable[[np.ndarray], np.ndarray], steps: Loads
) -> np.ndarray:
    """Parts (parts, n_points, nt) of the stress at steps."""
    return _superposed(fields, steps.modes, reduced(steps.stations), _land(steps.lands, len(steps)))


def _loaded(fields: np.ndarray, loads: np.ndarray | sp.csr_array) -> np.ndarray:
    """Fields (rows, m) times loads (nt, m), over those columns alone that carry a load."""
    if isinstance(loads, sp.csr_array):
        return (loads @ np.ascontiguousarray(fields.T)).T
    used = np.flatnonzero(np.any(loads, axis=0))
    if len(used) < 0.7 * fields.shape[1]:
        fields, loads = fields[:, used], loads[:, used]
    return fields @ loads.T.astype(np.float32)


class _Search:
    """Looks for the largest stresses in blocks of samples, and at the steps between them."""

    def __init__(self, fields: StressFields, settled: int) -> None:
        self.fields, self.settled = fields, settled
        self._slots = [np.searchsorted(fields.surface, v) for v in fields.places.values()]

    def at_samples(self, values: np.ndarray, middles: np.ndarray, first: int) -> _Block:
        """The block of samples from ``first`` on that have these stresses (n_surface, nt), and
        these in the middles of edges (n_edges, nt)."""
        count = values.shape[1]
        peak, where = self._peaks(values)
        none = np.full(count, np.nan)
        block = _Block(
            self._places(values), peak, where, none, peak.copy(), np.zeros(len(values)),
            np.zeros(len(middles)),
        )  # fmt: skip
        self._keep_envelope(block, values, middles, first + np.arange(count))
        return block

    def between(self, block: _Block, values: np.ndarray, steps: Loads, first: int) -> None:
        """Add steps to a block, of whose samples these were the stresses.

        Places are looked at first, and of these the vertices that are largest at any sample. The
        whole surface is looked at where they show most before a sample, if more than at it, and
        where any of them shows most of the block.
        """
        at = steps.sample - first
        watched = [slot[np.unique(np.argmax(values[slot], axis=0))] for slot in self._slots]
        if not watched:
            return
        gauges = self.fields.gauges(watched)
        found = gauges.largest(_stress_of(gauges, self.fields.reduced_forces, steps))
        chosen = self._chosen(found, at, block.places, first)
        np.maximum.at(block.places, at, found)
        if not len(chosen):
            return
        steps, at, fields = steps.only(chosen), at[chosen], self.fields
        parts = _stress_of(fields, fields.reduced_forces, steps)
        middles, values = fields.middles(parts), fields.equivalent(parts)
        np.maximum.at(block.places, at, self._places(values))
        self._keep_envelope(block, values, middles, steps.sample)
        peak, where = self._peaks(values)
        rising = np.argsort(peak)  # where a sample has two, the larger comes last and stays
        higher = rising[peak[rising] > block.peak[at[rising]]]
        block.peak[at[higher]], block.where[at[higher]] = peak[higher], where[higher]
        block.when[at[higher]] = steps.time[higher]

    def _chosen(
        self, found: np.ndarray, at: np.ndarray, sampled: np.ndarray, first: int
    ) -> np.ndarray:
        """Numbers of the steps before the samples ``at`` (n,) at which the whole surface is looked
        at, by the places' stresses there, ``found`` (n, n_places), and at samples."""
        largest = found.max(axis=1)
        order = np.lexsort((largest, at))
        most = order[np.append(np.diff(at[order]) > 0, True)]  # before each sample
        most = most[largest[most] > sampled.max(axis=1)[at[most]]]
        settled = max(self.settled - first, 0)
        late = np.where((at >= settled)[:, None], found, 0.0)
        own = np.argmax(late, axis=0)  # of each place
        own = own[late.max(axis=0) > sampled[settled:].max(axis=0, initial=0.0)]
        return np.union1d(most, own)

    def _places(self, values: np.ndarray) -> np.ndarray:
        """Largest of stresses (n_surface, nt) at every place (nt, n_places)."""
        places = np.zeros((values.shape[1], len(self._slots)), np.float32)
        for i, slot in enumerate(self._slots):
            places[:, i] = values[slot].max(axis=0)
        return places

    def _peaks(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Largest of the searched vertices' stresses, and the vertices, all (nt,)."""
        fields = self.fields
        searched = values[fields.searched]
        vertex = fields.surface[fields.searched[np.argmax(searched, axis=0)]]
        return searched.max(axis=0), vertex

    def _keep_envelope(
        self, block: _Block, values: np.ndarray, middles: np.ndarray, sample: np.ndarray
    ) -> None:
        if (late := sample >= self.settled).any():
            np.maximum(block.envelope, values[:, late].max(axis=1), out=block.envelope)
            np.maximum(block.middles, middles[:, late].max(axis=1), out=block.middles)


def stress_history(
    fields: StressFields,
    q: Sliced,
    station_forces: Sliced,
    land_forces: Sliced | None = None,
    *,
    settled: int = 0,
    between: Steps = no_steps,
    progress: Callable[..., Any] = Silent,
) -> StressHistory:
    """Places and peaks over samples, the envelope from sample ``settled`` on.

    Other arguments as in ``equivalent_stress``, but read block by block, so that a long run may
    stay on disk. ``between`` gives the steps between samples (``between.Between``). Blocks of
    samples are spread over the cores; ``progress`` is a context like ``core.progress.Progress``.
    """
    search = _Search(fields, settled)

    def work(first: int) -> _Block:
        part = slice(first, min(first + _BLOCK, len(q)))
        land = None if land_forces is None else np.asarray(land_forces[part])
        parts = _parts(fields, np.asarray(q[part]), np.asarray(station_forces[part]), land)
        middles, values = fields.middles(parts), fields.equivalent(parts)
        block = search.at_samples(values, middles, first)
        steps = between(part.start, part.stop)
        if steps is not None:
            steps = steps if land_forces is not None else steps.off_lands()
            search.between(block, values, steps, first)
        bar.advance()
        return block

    starts = range(0, len(q), _BLOCK)
    with progress(len(starts), "stress") as bar:
        _ = fields.modes, fields.forces  # once, not in every thread
        if land_forces is not None:
            _ = fields.land_forces
        blocks = on_all_cores(work, starts)
    return StressHistory(
        surface=fields.surface,
        place_names=tuple(fields.places),
        places=np.concatenate([block.places for block in blocks]),
        peak=np.concatenate([block.peak for block in blocks]),
        peak_vertex=np.concatenate([block.where for block in blocks]),
        peak_time=np.concatenate([block.when for block in blocks]),
        at_sample=np.concatenate([block.sampled for block in blocks]),
        envelope=np.max([block.envelope for block in blocks], axis=0),
        edges=fields.edges,
        middles=np.max([block.middles for block in blocks], axis=0),
        settled=settled,
    )
