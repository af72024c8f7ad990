"""Equivalent stress over a history: followed places, peaks between samples, the envelope.

Stress is computed at samples, and at steps of the solver between them: there at the named places
alone, and over the whole surface at the step at which the places' largest is greatest.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
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
_TYPICAL = 512  # samples by whose loads bounds are made narrow


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
    peak: np.ndarray  # (nt,) largest outside the contact zone of ``recovery.contact_zone``
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


@dataclass(frozen=True, eq=False)
class _Look:
    """What is seen at some instants: the largest at places (nt, n_places), the peak (nt,) and its
    mesh vertex, and by place the rows (n,) that are largest in it at any instant."""

    places: np.ndarray
    peak: np.ndarray
    where: np.ndarray
    watched: list[np.ndarray]


@dataclass(frozen=True, eq=False)
class _Late:
    """Loads (nt, n) of some columns at settled instants, and bounds (n_rows,) on the largest stress
    that they make."""

    columns: np.ndarray
    loads: np.ndarray
    low: np.ndarray
    high: np.ndarray


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


def _loaded(fields: np.ndarray, loads: np.ndarray | sp.csr_array) -> np.ndarray:
    """Fields (rows, m) times loads (nt, m), over those columns alone that carry a load."""
    if isinstance(loads, sp.csr_array):
        return (loads @ np.ascontiguousarray(fields.T)).T
    used = np.flatnonzero(np.any(loads, axis=0))
    if len(used) < 0.7 * fields.shape[1]:
        fields, loads = fields[:, used], loads[:, used]
    return fields @ loads.T.astype(np.float32)


class _Search:
    """Looks for the largest stresses in blocks of samples, and at the steps between them.

    At most points bounds say that they are not largest; the others are evaluated.
    """

    def __init__(self, fields: StressFields, settled: int, typical: np.ndarray, lands: bool):
        self.fields, self.settled = fields, settled
        self._screen, self._row = fields.screen(typical, lands=lands)
        count = len(fields.vertices)
        self._vertex = np.full(len(self._row), -1)
        self._vertex[self._row[:count]] = fields.vertices
        searched = np.isin(fields.vertices, fields.surface[fields.searched])
        self._searched = slice(0, int(searched.sum()))
        self._places = [_side_by_side(self._rows_of(v)) for v in fields.places.values()]

    def _rows_of(self, vertices: np.ndarray) -> np.ndarray:
        """Rows (n,), rising, of the points of mesh vertices."""
        own = np.isin(self.fields.vertices, vertices)
        return np.sort(self._row[: len(own)][own])

    def look(self, loads: np.ndarray, late: np.ndarray) -> tuple[_Look, list[_Late]]:
        """What is seen under loads (nt, columns), and what to keep for the envelope of those that
        are ``late`` (nt,)."""
        low, high = self._screen.bounds(loads)
        wanted = np.zeros(len(low), bool)
        for rows in (self._searched, *self._places):
            wanted[rows] |= _may_be_largest(low[rows], high[rows])
        rows = np.flatnonzero(wanted)
        values = self._screen.stress(rows, loads)
        places, watched = _at_places(values, rows, [_among(rows, place) for place in self._places])
        peaks = values[: np.searchsorted(rows, self._searched.stop)]
        top = np.argmax(peaks, axis=0)
        look = _Look(places, peaks.max(axis=0), self._vertex[rows[top]], watched)
        if not late.all():
            loads, low, high = loads[late], low[:, late], high[:, late]
        return look, [_kept(loads, low, high)] if len(loads) else []

    def between(self, look: _Look, steps: Loads, loads: np.ndarray, first: int) -> np.ndarray:
        """Numbers of the steps under ``loads`` at which the whole surface is to be looked at.

        Places are looked at, of these the vertices that are largest at any sample, and the looks
        there are added to ``look``, that at the samples from ``first`` on. The whole surface is
        looked at where they show most before a sample, if more than at it, and where any of them
        shows most of the block.
        """
        if not look.watched:
            return np.zeros(0, int)
        at = steps.sample - first
        rows = self._rows_of(self._vertex[np.concatenate(look.watched)])
        low, high = self._screen.bounds(loads, rows)
        wanted, gauges = np.zeros(len(rows), bool), []
        for i, (place, watched) in enumerate(zip(self._places, look.watched)):
            own = np.arange(len(rows))[_among(rows, place)]
            own = own[np.isin(self._vertex[rows[own]], self._vertex[watched])]
            may = own[_may_be_largest(low[own], high[own], look.places[at, i])]
            wanted[may] = True
            gauges.append(may)
        kept = np.cumsum(wanted) - 1
        values = self._screen.stress(rows[wanted], loads)
        found, _ = _at_places(values, rows[wanted], [kept[may] for may in gauges])
        chosen = self._chosen(found, at, look.places, first)
        np.maximum.at(look.places, at, found)
        return chosen

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

    def envelope(self, kept: Sequence[_Late]) -> tuple[np.ndarray, np.ndarray]:
        """Largest stresses (n_surface,) at the vertices, and (n_edges,) in the middles of edges."""
        largest = np.zeros(len(self._row))
        if kept:
            floor = np.max([each.low for each in kept], axis=0)
        for each in kept:
            rows = np.flatnonzero(each.high >= floor)
            values = self._screen.stress(rows, each.loads, each.columns)
            largest[rows] = np.maximum(largest[rows], values.max(axis=1))
        points, middles = np.split(largest[self._row], [len(self.fields.vertices)])
        return self.fields.largest(points), middles


def _at_places(
    values: np.ndarray, rows: np.ndarray, places: Sequence[np.ndarray | slice]
) -> tuple[np.ndarray, list[np.ndarray]]:
    """Largest (nt, n_places) of values (n, nt) in rows (n,) at places, which say where among these
    their own are; and by place the rows that are largest at any instant."""
    largest, watched = np.zeros((values.shape[1], len(places)), np.float32), []
    for i, own in enumerate(places):
        top = np.zeros(0, int)
        if len(rows[own]):
            top = np.argmax(values[own], axis=0)
            largest[:, i] = values[own][top, np.arange(len(top))]
        watched.append(np.unique(rows[own][top]))
    return largest, watched


def _may_be_largest(low: np.ndarray, high: np.ndarray, floor: np.ndarray | float = 0.0):
    """Which of points (n,) with these bounds (n, nt) may be the largest at any instant, and reach
    ``floor`` (nt,)."""
    if not len(low):
        return np.zeros(0, bool)
    return (high >= np.maximum(low.max(axis=0), floor)).any(axis=1)


def _side_by_side(rows: np.ndarray) -> np.ndarray | slice:
    """Rows (n,), rising, as a slice if none is left out between: their values need no copy."""
    one_by_one = len(rows) and rows[-1] - rows[0] == len(rows) - 1
    return slice(int(rows[0]), int(rows[-1]) + 1) if one_by_one else rows


def _among(rows: np.ndarray, place: np.ndarray | slice) -> np.ndarray | slice:
    """Where among rows (n,), rising, those of a place are."""
    if isinstance(place, slice):
        return slice(*np.searchsorted(rows, [place.start, place.stop]))
    return np.flatnonzero(np.isin(rows, place, assume_unique=True))


def _kept(loads: np.ndarray, low: np.ndarray, high: np.ndarray) -> _Late:
    """What the envelope needs of instants: those that may make any point's largest stress."""
    floor = low.max(axis=1)
    may = (high >= floor[:, None]).any(axis=0)
    columns = np.flatnonzero(loads[may].any(axis=0))
    return _Late(columns, loads[np.ix_(may, columns)], floor, high.max(axis=1))


@dataclass(frozen=True, eq=False)
class _Instants:
    """What loads the fields at samples and at the steps between them."""

    fields: StressFields
    q: Sliced
    station_forces: Sliced
    land_forces: Sliced | None
    between: Steps

    def samples(self, part: slice) -> np.ndarray:
        """Loads (nt, columns) at samples."""
        land = None if self.land_forces is None else np.asarray(self.land_forces[part])
        q, stations = np.asarray(self.q[part]), np.asarray(self.station_forces[part])
        return self.fields.loads(q, stations, land)

    def steps(self, part: slice) -> tuple[Loads, np.ndarray] | None:
        """The steps of samples, and loads (n, columns) at these; None without any."""
        steps = self.between(part.start, part.stop)
        if steps is None:
            return None
        land = None if self.land_forces is None else steps.lands
        return steps, self.fields.loads(steps.modes, steps.stations, land)


def stress_bound(
    fields: StressFields,
    q: Sliced,
    station_forces: Sliced,
    land_forces: Sliced | None = None,
    *,
    between: Steps = no_steps,
) -> float:
    """What no peak [Pa] of ``stress_history`` passes, at a tenth of its cost: the largest
    stress of every load alone, added up, the most at any instant. Arguments as there."""
    instants = _Instants(fields, q, station_forces, land_forces, between)
    each = fields.largest_each(lands=land_forces is not None)
    bound = np.float64(0.0)
    for first in range(0, len(q), _BLOCK):
        part = slice(first, min(first + _BLOCK, len(q)))
        steps = instants.steps(part)
        for loads in (instants.samples(part), *([steps[1]] if steps is not None else [])):
            bound = np.maximum(bound, (np.abs(loads) @ each).max(initial=0.0))
    return float(bound)


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
    stay on disk. ``between`` gives the steps between samples (``between.StoredSteps``). Blocks of
    samples are spread over the cores; ``progress`` is a context like ``core.progress.Progress``.
    """

    instants = _Instants(fields, q, station_forces, land_forces, between)

    def work(first: int) -> tuple[_Look, np.ndarray, np.ndarray, list[_Late]]:
        part = slice(first, min(first + _BLOCK, len(q)))
        loads = instants.samples(part)
        look, kept = search.look(loads, np.arange(part.start, part.stop) >= settled)
        sampled, when = look.peak.copy(), np.full(len(loads), np.nan)
        if (found := instants.steps(part)) is not None:
            steps, pushes = found
            chosen = search.between(look, steps, pushes, first)
            if len(chosen):
                kept += _add(search, look, when, steps.only(chosen), pushes[chosen], first)
        bar.advance()
        return look, sampled, when, kept

    starts = range(0, len(q), _BLOCK)
    with progress(len(starts), "stress") as bar:
        some = slice(0, len(q), max(1, len(q) // _TYPICAL))
        search = _Search(fields, settled, instants.samples(some), land_forces is not None)
        looks, sampled, when, kept = zip(*on_all_cores(work, starts))
        envelope, middles = search.envelope([each for own in kept for each in own])
    return StressHistory(
        surface=fields.surface,
        place_names=tuple(fields.places),
        places=np.concatenate([look.places for look in looks]),
        peak=np.concatenate([look.peak for look in looks]),
        peak_vertex=np.concatenate([look.where for look in looks]),
        peak_time=np.concatenate(when),
        at_sample=np.concatenate(sampled),
        envelope=envelope,
        edges=fields.edges,
        middles=middles,
        settled=settled,
    )


def _add(
    search: _Search, look: _Look, when: np.ndarray, steps: Loads, loads: np.ndarray, first: int
) -> list[_Late]:
    """Add to a look at samples, of which ``first`` is the first, what is seen at steps; what to
    keep of these for the envelope."""
    at = steps.sample - first
    seen, kept = search.look(loads, steps.sample >= search.settled)
    np.maximum.at(look.places, at, seen.places)
    rising = np.argsort(seen.peak)  # where a sample has two, the larger comes last and stays
    higher = rising[seen.peak[rising] > look.peak[at[rising]]]
    look.peak[at[higher]], look.where[at[higher]] = seen.peak[higher], seen.where[higher]
    when[at[higher]] = steps.time[higher]
    return kept
