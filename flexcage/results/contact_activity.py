"""How often the cage is touched, and for how much of the time nothing touches it.

A contact of the cage is one of an element with a face of its pocket (rollers: front, rear and two
sides; balls: the wall), or of a land with a ring. An onset is the instant at which it closes. The
contact frequency counts onsets with pocket faces alone; free flight needs lands open as well.

From the run's events a contact is closed while its normal force is above zero, found to one step of
the solver, and onsets however light count; a land counts where it touches through its film. From
samples a contact is closed at the samples at which its force is above ``TOUCHING``, so that
contacts which open and close again between two of them are missed, and a land's film counts.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results.metrics import TOUCHING

if TYPE_CHECKING:
    import xarray

EVENTS, SAMPLES = "events", "samples"


@dataclass(frozen=True)
class ContactActivity:
    """Contact frequency [Hz], mean of a pocket and total of the cage, and share of the time (0 ..
    1) in which nothing touches the cage; ``source`` is what they follow from."""

    per_pocket: float
    total: float
    free_flight_share: float
    source: str


@dataclass(frozen=True, eq=False)
class ContactSeries:
    """Contacts of the cage in the intervals of ``step`` [s] that end at the samples of a run.

    ``onsets`` (time, pocket) counts those that begin in an interval, ``free`` (time,) is the share
    of it in which nothing touches the cage; ``source`` is "events" or "samples".
    """

    onsets: np.ndarray
    free: np.ndarray
    step: float
    source: str

    @property
    def begun(self) -> np.ndarray:
        """Contacts of all pockets that begin in a second, over time (time,) [Hz]."""
        return self.onsets.sum(axis=1) / self.step

    @property
    def activity(self) -> ContactActivity:
        """The figures of the whole series."""
        total = float(self.onsets.sum()) / (len(self.free) * self.step)
        pockets = self.onsets.shape[1]
        return ContactActivity(total / pockets, total, float(self.free.mean()), self.source)


def contact_activity(ds: xarray.Dataset, events: xarray.Dataset | None = None) -> ContactActivity:
    """Contact frequency and free flight of a run's dataset, or of a part of it.

    ``events`` are the whole run's (``run.events``).
    """
    return contact_series(ds, events).activity


def contact_series(ds: xarray.Dataset, events: xarray.Dataset | None = None) -> ContactSeries:
    """Contacts in the intervals between samples of a run's dataset, or of a part of it.

    From ``events`` of the whole run if they are given and complete, else from samples. Raises
    InputError for fewer than two samples.
    """
    t = ds["time"].values
    if len(t) < 2:
        raise InputError(f"Contacts are counted between samples; there are {len(t)}, not two.")
    step = float(t[-1] - t[0]) / (len(t) - 1)
    if events is not None and complete(events):
        return _from_events(ds, events, np.concatenate([[t[0] - step], t]))
    return _from_samples(ds, step)


def complete(events: xarray.Dataset) -> bool:
    """Whether every contact of an element or land closes and opens by turns.

    They do not where a block of the run had more events than its buffer holds.
    """
    place, of = events["place"].values.astype(str), events["element"].values.astype(str)
    _, contact = np.unique(np.char.add(place, of), return_inverse=True)
    order = np.argsort(contact, kind="stable")
    contact, closed = contact[order], events["closed"].values[order]
    same = contact[1:] == contact[:-1]
    return not np.any(same & (closed[1:] == closed[:-1]))


def _from_events(ds: xarray.Dataset, events: xarray.Dataset, edges: np.ndarray) -> ContactSeries:
    """Contacts in the intervals between ``edges`` (n + 1,) [s], from all events of the run."""
    time, place = events["time"].values, events["place"].values.astype(str)
    closed, pocket = events["closed"].values, events["element"].values
    at_pocket = np.isin(place, ds["face"].values.astype(str))
    at_cage = at_pocket | np.char.startswith(place, "land")
    onsets = np.zeros((len(edges) - 1, ds.sizes["pocket"]), np.int64)
    interval = np.searchsorted(edges, time) - 1  # an edge belongs to the interval that it ends
    counted = at_pocket & closed & (interval >= 0) & (interval < len(onsets))
    np.add.at(onsets, (interval[counted], pocket[counted]), 1)
    free = np.diff(_time_free(edges, time[at_cage], np.where(closed, 1, -1)[at_cage]))
    widths = np.diff(edges)
    return ContactSeries(onsets, free / widths, float(widths.mean()), EVENTS)


def _time_free(at: np.ndarray, time: np.ndarray, change: np.ndarray) -> np.ndarray:
    """Time [s] without any contact from a common beginning to each instant ``at`` (n,).

    ``change`` (m,) is what the number of contacts changes by at the instants ``time`` (m,).
    """
    bounds = np.concatenate([at[[0, -1]], time])
    knots = np.concatenate([[bounds.min()], time, [bounds.max()]])
    free = np.concatenate([[0], np.cumsum(change)]) == 0
    return np.interp(at, knots, np.concatenate([[0.0], np.cumsum(free * np.diff(knots))]))


def _from_samples(ds: xarray.Dataset, step: float) -> ContactSeries:
    """Contacts by forces above ``TOUCHING`` [N] at the samples; none begins at the first."""
    closed = ds["pocket_force"].transpose("time", "pocket", "face").values > TOUCHING
    onsets = np.zeros(closed.shape[:2], np.int64)
    onsets[1:] = (closed[1:] & ~closed[:-1]).sum(axis=2)
    touched = np.asarray(closed.any(axis=(1, 2)))
    if "land_force" in ds:
        force = np.linalg.norm(ds["land_force"].transpose("time", ..., "axis").values, axis=-1)
        touched |= (force > TOUCHING).reshape(len(touched), -1).any(axis=1)
    return ContactSeries(onsets, (~touched).astype(float), step, SAMPLES)
