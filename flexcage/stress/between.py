"""What moves and pushes the cage at the solver's steps between samples.

Contacts last some 30 us, and so do the peaks of stress that they cause: samples every 20 us cut
them. A run keeps modal coordinates and contact forces at steps while anything touches its cage.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from flexcage.results.registry import CAGES
from flexcage.results.store import MemoryRunStore
from flexcage.stress.loads import on_lands
from flexcage.stress.mirrored import Across, in_mirror
from flexcage.stress.recovery import CageLoads

_SAME = 1e-10  # [s] within which a step is a sample
_BLOCKS = 4  # read from disk that stay in memory


@dataclass(frozen=True, eq=False)
class Loads:
    """Modes and forces at n steps, and the sample (n,) that follows each."""

    sample: np.ndarray
    time: np.ndarray  # (n,) [s]
    modes: np.ndarray  # (n, nm)
    stations: np.ndarray  # (n, Z, F, n_st, 3) [N], components (x, r, psi) of the pockets' frames
    lands: np.ndarray  # (n, 2, n_land, 3) [N], components (x, r, psi) of the lands' stations

    def __len__(self) -> int:
        return len(self.time)

    def only(self, chosen: np.ndarray) -> Loads:
        """Those of some of the steps."""
        return Loads(*(each[chosen] for each in self._arrays))

    def off_lands(self) -> Loads:
        """The same without the lands' forces."""
        return replace(self, lands=np.zeros((len(self), 0)))

    @property
    def _arrays(self) -> tuple[np.ndarray, ...]:
        return self.sample, self.time, self.modes, self.stations, self.lands

    def cage_loads(self, spin: np.ndarray) -> CageLoads:
        """Loads at the first step, of a cage that turns with ``spin`` (3,) [rad/s], its frame."""
        return CageLoads(
            station_forces=self.stations[0].astype(float),
            land_forces=self.lands[0].astype(float),
            angular_velocity=spin,
            modal_coordinates=self.modes[0],
        )


def together(parts: Sequence[Loads]) -> Loads:
    """One after the other."""
    return Loads(*(np.concatenate(arrays) for arrays in zip(*(p._arrays for p in parts))))


Steps = Callable[[int, int], Loads | None]  # those from one sample on to before another


def no_steps(first: int, end: int) -> None:
    """No steps between samples."""


class StoredSteps:
    """The loads of a run at steps between its samples at times ``t`` [s], read block by block;
    ``inner``: the cage rides on the inner ring's land. Of several cages those of cage ``k``, and
    with ``across`` (``mirrored.Across``) in the mirror."""

    def __init__(
        self, store: MemoryRunStore, t: np.ndarray, *, inner: bool, k: int = 0,
        across: Across | None = None,
    ) -> None:  # fmt: skip
        self._t, self._inner, self._k, self._across = t, inner, k, across
        pockets, faces = (store.layout.size(dim) for dim in ("pocket", "face"))
        self._cages = store.layout.size(CAGES) if CAGES in store.layout.coords else 1
        self._faces = pockets // self._cages, faces
        self._block = store.layout.block
        self._table = lru_cache(_BLOCKS)(store.loads)

    def __call__(self, first: int, end: int) -> Loads | None:
        """Steps after sample ``first`` - 1 and before sample ``end`` - 1; None without any."""
        t, found = self._t, []
        for block in range(first // self._block, (end - 1) // self._block + 1):
            table = self._table(block)
            if not table:
                continue
            time = table["time"]
            sample = np.searchsorted(t, time - _SAME)
            after = t[np.minimum(sample, len(t) - 1)]
            inside = (sample >= first) & (sample < end) & (np.abs(after - time) > _SAME)
            if inside.any():
                found.append(self._loads(table, sample, inside))
        return together(found) if found else None

    def since(self, sample: int) -> Steps:
        """The same, with samples counted from ``sample`` on."""

        def steps(first: int, end: int) -> Loads | None:
            found = self(first + sample, end + sample)
            return None if found is None else replace(found, sample=found.sample - sample)

        return steps

    def nearest(self, time: float, sample: int) -> Loads | None:
        """The step nearest to ``time`` [s] of those on both sides of a sample, if there are any."""
        steps = self(sample, min(sample + 2, len(self._t)))
        if steps is None:
            return None
        return steps.only(np.array([np.abs(steps.time - time).argmin()]))

    def _loads(self, table: dict[str, np.ndarray], sample: np.ndarray, inside: np.ndarray) -> Loads:
        steps = np.flatnonzero(inside)
        step_of_row = np.repeat(np.arange(len(sample)), table["touched"])
        place = np.full(len(sample), -1)
        place[steps] = np.arange(len(steps))
        force, (pocket, face) = table["force"], table["face"].T
        pocket = pocket - self._k * self._faces[0]
        own = (pocket >= 0) & (pocket < self._faces[0])
        rows = np.flatnonzero((place[step_of_row] >= 0) & own)
        stations = np.zeros((len(steps), *self._faces, *force.shape[1:]), force.dtype)
        stations[place[step_of_row[rows]], pocket[rows], face[rows]] = force[rows]
        if self._across is not None:
            stations = in_mirror(stations, self._across)
        modes, land = (self._own(table[name][steps]) for name in ("modes", "land"))
        return Loads(
            sample[steps], table["time"][steps], modes, stations, on_lands(land, inner=self._inner)
        )

    def _own(self, values: np.ndarray) -> np.ndarray:
        """What is of the cage among values (n, cages m, ...) of one after the other."""
        each = values.shape[1] // self._cages
        return values[:, self._k * each : (self._k + 1) * each]
