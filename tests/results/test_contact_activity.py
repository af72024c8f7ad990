"""Contact frequency and free flight of on/off contacts whose instants are known."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from flexcage.core.errors import InputError
from flexcage.results.contact_activity import (
    ContactActivity,
    complete,
    contact_activity,
    contact_series,
)

RATE, SAMPLES, POCKETS = 50e3, 5000, 6
FACES = {"roller": ["front", "rear", "side+x", "side-x"], "ball": ["pocket"]}
PERIOD = 4e-3  # of every contact [s]; 25 of them in 0.1 s
SHORT = 0.1e-6  # [s] after a sample, so that events do not fall upon samples


class OnOff:
    """A run in which chosen contacts are closed over chosen times, as samples and as events."""

    def __init__(self, element: str) -> None:
        self.element, self.rows = element, []
        self.time = np.arange(1, SAMPLES + 1) / RATE
        self.force = np.zeros((SAMPLES, POCKETS, len(FACES[element])))
        self.land = np.zeros((SAMPLES, 3))

    def closed(self, begin: float, end: float, *, pocket: int = -1, place: str) -> None:
        """A contact from ``begin`` to ``end`` [s]: 3 N."""
        self.rows += [(begin, pocket, place, True), (end, pocket, place, False)]
        during = (self.time > begin) & (self.time <= end)
        if place in FACES[self.element]:
            self.force[during, pocket, FACES[self.element].index(place)] = 3.0
        elif place.startswith("land"):
            self.land[during, 1] = 3.0

    def every_period(self, begin: float, length: float, **where) -> None:
        for k in range(25):
            at = k * PERIOD + begin + SHORT
            self.closed(at, at + length, **where)

    @property
    def dataset(self) -> xr.Dataset:
        force = ("time", "pocket", "face"), self.force
        coords = {
            "time": self.time, "pocket": np.arange(POCKETS), "face": FACES[self.element],
        }  # fmt: skip
        data = {"pocket_force": force, "land_force": (("time", "axis"), self.land)}
        return xr.Dataset(data, coords=coords, attrs={"element": self.element})

    @property
    def events(self) -> xr.Dataset:
        time, of, place, closed = zip(*sorted(self.rows), strict=True)
        columns = {"time": time, "element": of, "place": place, "closed": closed}
        return xr.Dataset({name: ("event", np.array(c)) for name, c in columns.items()})


def periodic(element: str) -> OnOff:
    """Two pockets touch for 1 ms of every 4, one after the other; a land for another half."""
    run, faces = OnOff(element), FACES[element]
    run.every_period(0.4e-3, 1e-3, pocket=2, place=faces[0])
    run.every_period(2e-3, 1e-3, pocket=5, place=faces[-1])
    run.every_period(3.2e-3, 0.5e-3, place="land +x")
    run.every_period(1.5e-3, 1e-3, pocket=1, place="inner race")  # no contact of the cage
    return run


@pytest.mark.parametrize("element", FACES)
def test_periodic_contacts_by_events_and_by_samples(element):
    """50 onsets in 0.1 s in 6 pockets, and 2.5 of every 4 ms with something closed."""
    run = periodic(element)
    known = ContactActivity(500.0 / POCKETS, 500.0, 1.5 / 4.0, "events")
    found = contact_activity(run.dataset, run.events)
    assert found.total == pytest.approx(known.total, rel=1e-12)
    assert found.per_pocket == pytest.approx(known.per_pocket, rel=1e-12)
    assert found.free_flight_share == pytest.approx(known.free_flight_share, abs=1e-9)
    assert found.source == "events"
    sampled = contact_activity(run.dataset)
    assert sampled.total == pytest.approx(500.0, rel=1e-12) and sampled.source == "samples"
    assert sampled.free_flight_share == pytest.approx(1.5 / 4.0, abs=1e-3)


def test_onsets_lie_in_their_pocket_and_interval():
    run = periodic("roller")
    series = contact_series(run.dataset, run.events)
    assert series.onsets.sum(axis=0).tolist() == [0, 0, 25, 0, 0, 25]
    assert np.flatnonzero(series.onsets[:, 2])[:3].tolist() == [20, 220, 420]
    assert series.step == pytest.approx(1.0 / RATE)
    assert series.free[:20].min() == pytest.approx(1.0) and series.free[20:70].max() < 0.01


def test_contacts_at_the_same_time_end_free_flight_once():
    run = OnOff("roller")
    run.every_period(0.0, 2e-3, pocket=0, place="front")
    run.every_period(1e-3, 2e-3, pocket=0, place="side-x")
    found = contact_activity(run.dataset, run.events)
    assert found.total == pytest.approx(500.0) and found.per_pocket == pytest.approx(500.0 / 6)
    assert found.free_flight_share == pytest.approx(0.25, abs=1e-9)


def test_contacts_between_two_samples_want_events():
    run = OnOff("ball")
    run.every_period(1e-3, 5e-6, pocket=3, place="pocket")
    assert contact_activity(run.dataset, run.events).total == pytest.approx(250.0)
    assert contact_activity(run.dataset, run.events).free_flight_share == pytest.approx(1 - 5 / 4e3)
    assert contact_activity(run.dataset).total == 0.0


def test_a_part_of_a_run_knows_what_was_closed_before():
    run = OnOff("roller")
    run.closed(0.01 + SHORT, 0.06 + SHORT, pocket=4, place="rear")
    part = run.dataset.isel(time=slice(2000, None))  # 0.04 to 0.1 s
    for found in (contact_activity(part, run.events), contact_activity(part)):
        assert found.total == 0.0
        assert found.free_flight_share == pytest.approx(4.0 / 6.0, abs=1e-4)


def test_events_with_gaps_are_not_believed():
    run = periodic("roller")
    whole, gap = run.events, run.events.isel(event=[k for k in range(100) if k != 17])
    assert complete(whole) and not complete(gap)
    assert contact_activity(run.dataset, gap) == contact_activity(run.dataset)


def test_no_events_at_all_are_free_flight():
    run = periodic("ball")
    none = run.events.isel(event=slice(0, 0))
    found = contact_activity(run.dataset, none)
    assert (found.total, found.free_flight_share, found.source) == (0.0, 1.0, "events")


def test_one_sample_is_too_few():
    with pytest.raises(InputError, match="there are 1, not two"):
        contact_activity(periodic("ball").dataset.isel(time=slice(1)))
