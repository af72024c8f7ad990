"""The energy audit: what is stored must be what was put in.

The imbalance is held against the drive's work, and against what the cage dissipates, at pockets and
lands, in films and in its modes: the drive's work is a thousand times what the cage handles and
would hide what goes wrong there. Lands count because what rollers give the cage goes to them: by
its pockets alone a cage that a land guides would be judged by a part of what it exchanges. What
the balance missed before the cage dissipated anything is not the cage's: in a short run whose cage
is first touched near the end, that is more than the few touches dissipate. So the cage's share
counts the imbalance that arises once the cage has dissipated ``BEGUN`` of what it does in the run.
A cage that dissipates less than ``OF_DRIVE`` of the drive's work has hardly been touched: the
little that its modes lose as they swing freely is no measure of an imbalance within the drive's
bound.

Where little work is done, as in a bearing that stands or within the first instants of one whose
rollers are pinched, neither is a measure: contacts hold more elastic energy than was ever put in,
and the solver's error in how deep they are pressed moves some of that. An imbalance under
``OF_ELASTIC`` of the largest elastic energy is then no leak. In the main job that energy is a
thirtieth of what the drive does within half a millisecond, so that the floor decides nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isnan, nan
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from flexcage.core.errors import InputError

if TYPE_CHECKING:
    import xarray


CAGE_LOSSES = (
    "pocket_damping", "pocket_friction", "modal_damping", "land_damping", "land_friction", "film",
)  # fmt: skip
DRIVES = ("drive", "constraints")  # what puts work in
OF_DRIVE, OF_CAGE = 1e-3, 0.05  # largest imbalance over the drive's work and over the cage's losses
OF_ELASTIC = 1e-3  # of the elastic energy held: what a share must rise above to be one
BEGUN = 0.01  # of the cage's losses in the run: from there on the imbalance may be the cage's
ROUNDING = 1e-12  # of the energy moved: less is no work
PASSED, UNJUDGED, EXCEEDED = "passed", "not judged", "EXCEEDED"


@dataclass(frozen=True)
class EnergyAudit:
    """Balance of a run [J]: stored energy gained less work done, at its worst and at the end.

    ``relative`` is the worst imbalance over the energy that moved (the larger of the gain's
    range and the sum over channels of their ranges). ``channels`` holds each channel's total; the
    drive is what turns the inner ring, and constraints that move bodies.
    ``elastic`` is the largest energy held other than kinetic. ``of_drive`` and ``of_cage`` are the
    worst imbalance over the drive's work and over what the cage dissipates; NaN where there
    was none, or so little that the share exceeds its bound with an imbalance under ``OF_ELASTIC``
    of the elastic energy or, of a cage that has hardly been touched, within the drive's bound.
    ``of_cage`` counts the imbalance since the cage's losses have begun.
    """

    worst: float
    final: float
    relative: float
    moved: float
    stored: dict[str, float]
    channels: dict[str, float]
    elastic: float
    of_drive: float
    of_cage: float

    @property
    def verdict(self) -> str:
        """``EXCEEDED`` where a share is beyond its bound, ``OF_DRIVE`` or ``OF_CAGE``, ``UNJUDGED``
        where neither is known, else ``PASSED``."""
        if self.of_drive > OF_DRIVE or self.of_cage > OF_CAGE:
            return EXCEEDED
        return UNJUDGED if isnan(self.of_drive) and isnan(self.of_cage) else PASSED

    @property
    def passed(self) -> bool:
        return self.verdict == PASSED


def imbalance(ds: xarray.Dataset) -> xarray.DataArray:
    """Energy gained since the first sample less all work done on the bearing since, (time,) [J]."""
    for name in ("energy", "work"):
        if name not in ds:
            raise InputError(f"The dataset has no variable {name!r}: no energy audit is possible.")
    stored, work = ds["energy"].sum("energy_kind"), ds["work"].sum("channel")
    out = (stored - stored[0]) - (work - work[0])
    out.attrs = {"units": "J", "long_name": "energy gained less work done"}
    return out.rename("imbalance")


class Ledger(NamedTuple):
    """What the audit weighs, at every sample [J]; all that counts are differences over time."""

    gap: np.ndarray  # (n,) stored energy less all work done
    drive: np.ndarray  # (n, 2) work of the drive, of constraints
    spent: np.ndarray  # (n,) work of the cage's losses, negative
    elastic: np.ndarray  # (n,) energy held other than kinetic

    @property
    def driven(self) -> float:
        """Work of the drive and of constraints over the whole, each counted positive."""
        return float(np.abs(self.drive[-1] - self.drive[0]).sum())

    @property
    def lost(self) -> float:
        """What the cage dissipates over the whole."""
        return float(self.spent[0] - self.spent[-1])

    @property
    def worst(self) -> float:
        """Largest imbalance since the first sample."""
        return float(np.abs(self.gap - self.gap[0]).max())


def ledger(
    stored: np.ndarray, work: np.ndarray, kinds: Sequence[str], channels: Sequence[str]
) -> Ledger:
    """The ledger of energies (n, kinds) and works (n, channels) [J]."""
    named = list(channels)
    put = [work[:, named.index(k)] if k in named else 0.0 * work[:, 0] for k in DRIVES]
    lost = [i for i, name in enumerate(named) if name in CAGE_LOSSES]
    held = [i for i, kind in enumerate(kinds) if kind != "kinetic"]
    return Ledger(
        stored.sum(axis=1) - work.sum(axis=1),
        np.stack(put, axis=1),
        work[:, lost].sum(axis=1),
        stored[:, held].sum(axis=1),
    )


def shares(book: Ledger, least: float) -> tuple[float, float]:
    """Worst imbalance since the first sample over the drive's work, and over the cage's losses; as
    in :class:`EnergyAudit`. Work of ``least`` [J] or less is none."""
    worst, floor = book.worst, OF_ELASTIC * float(book.elastic.max())
    from_cage = _since(book)
    drive, lost = (work if abs(work) > least else 0.0 for work in (book.driven, book.lost))
    untouched = OF_DRIVE * drive if 0.0 < lost < OF_DRIVE * drive else 0.0
    return (
        _share(worst, drive, OF_DRIVE, floor) if drive or lost or worst <= floor else inf,
        _share(from_cage, lost, OF_CAGE, max(floor, untouched)),
    )


def energy_audit(ds: xarray.Dataset) -> EnergyAudit:
    """Audit a run from its ``energy`` and ``work`` (work done on the bearing, losses negative)."""
    gap = imbalance(ds).values
    stored = ds["energy"].transpose("time", "energy_kind")
    work = ds["work"].transpose("time", "channel")
    gain = float(np.ptp(stored.sum("energy_kind").values))
    moved = max(gain, float(np.ptp(work.values, axis=0).sum()))
    kinds, channels = (
        [str(k) for k in values[dim].values]
        for values, dim in ((stored, "energy_kind"), (work, "channel"))
    )
    book = ledger(stored.values, work.values, kinds, channels)
    worst = float(np.abs(gap).max())
    return EnergyAudit(
        worst,
        float(gap[-1]),
        worst / moved if moved else 0.0,
        moved,
        _change(stored, "energy_kind"),
        _change(work, "channel"),
        float(book.elastic.max()),
        *shares(book, ROUNDING * moved),
    )


def _since(book: Ledger) -> float:
    """Largest imbalance [J] that arises once the cage has dissipated ``BEGUN`` of what it does."""
    begun = book.spent[0] - book.spent > BEGUN * book.lost
    before = int(np.argmax(begun)) - 1 if book.lost > 0.0 else 0
    return Ledger(*(column[max(before, 0) :] for column in book)).worst


def _share(imbalance: float, work: float, bound: float, floor: float) -> float:
    """Imbalance over work; NaN where it exceeds its bound for want of work alone."""
    if not work or bound * abs(work) < imbalance <= floor:
        return nan
    return imbalance / abs(work)


def _change(values: xarray.DataArray, dim: str) -> dict[str, float]:
    change = values.values[-1] - values.values[0]
    return {str(k): float(v) for k, v in zip(values[dim].values, change)}
