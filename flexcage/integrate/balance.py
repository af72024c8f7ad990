"""Blocks whose energy does not balance are computed again, with a tighter tolerance.

An error estimate sees what happens at a step's ends: a gap that closes and opens within a step, a
wall that begins there, or fast motion that long steps of a BDF damp, can pass below it. The books
tell: what is stored must be what was put in. Where a run's imbalance has used up ``TAKEN`` of what
the audit allows, and the last block's own share is as large, that block is done again from its
start with ``TIGHTER`` of the tolerance, at most ``AGAIN`` times in a row. The next blocks keep the
tolerance until one needs less than ``SPARE`` of what it may.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np

from flexcage.results.audit import OF_CAGE, OF_DRIVE, ROUNDING, Ledger, ledger, shares
from flexcage.results.registry import ENERGIES
from flexcage.results.store import MemoryRunStore
from flexcage.system.data import POWERS

BOUNDS = (OF_DRIVE, OF_CAGE)
TAKEN, SPARE = 0.8, 0.1
TIGHTER, AGAIN = 0.1, 2


class Weighed(NamedTuple):
    """What a block did to the balance: it must be done ``over``, or had room to ``spare``."""

    over: bool
    spare: bool


NEITHER = Weighed(over=False, spare=False)


class Balance:
    """The books of a run, from those of the blocks that its store has."""

    def __init__(self, store: MemoryRunStore) -> None:
        n = store.layout.n_time
        self._book = Ledger(np.zeros(n), np.zeros((n, 2)), np.zeros(n), np.zeros(n))
        self._kept = min(store.blocks * store.layout.block, n)
        if self._kept:
            ds = store.dataset()
            energy, work = (ds[k].transpose("time", ...).values for k in ("energy", "work"))
            self._enter(energy[: self._kept], work[: self._kept], 0)

    def _enter(self, stored: np.ndarray, work: np.ndarray, first: int) -> int:
        entries = ledger(stored, work, ENERGIES, POWERS)
        last = first + len(stored)
        for column, values in zip(self._book, entries, strict=True):
            column[first:last] = values
        return last

    def weigh(self, stored: np.ndarray, work: np.ndarray) -> Weighed:
        """Weigh the next block, of energies (n, kinds) and works (n, channels) [J]."""
        first, last = self._kept, self._enter(stored, work, self._kept)
        run = Ledger(*(column[:last] for column in self._book))
        own = Ledger(*(column[max(first - 1, 0) : last] for column in self._book))
        moved = float(run.elastic.max()) + run.driven
        of_run = (s / b for s, b in zip(shares(run, ROUNDING * moved), BOUNDS, strict=True))
        of_own, touched = _own_shares(own)
        over = any(r > TAKEN and o > TAKEN for r, o in zip(of_run, of_own, strict=True))
        return Weighed(over, max(of_own if touched else of_own[:1]) < SPARE)

    def keep(self, samples: int) -> None:
        """Go on behind the block of so many samples that was weighed last."""
        self._kept += samples


def _own_shares(own: Ledger) -> tuple[tuple[float, float], bool]:
    """A block's own imbalance over the bounds that the drive's work and the cage's losses in it
    give, and whether the cage lost enough to be judged by that."""
    of_drive, of_cage = (
        own.worst / (bound * work) if work > 0.0 else inf
        for bound, work in zip(BOUNDS, (own.driven, own.lost), strict=True)
    )
    return (of_drive, of_cage), own.lost > OF_DRIVE * own.driven
