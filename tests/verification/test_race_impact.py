"""Rollers that fly against the outer race of a bearing and come back.

All rollers of an N1013 at rest fly outwards at 0.5 m/s between races of 55 um clearance: the whole
bearing's kernels and solver give the impact of one mass on one law.

Source: closed form and numbers as in `impact`; the restitution asked for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from known_rows import check
from law_values import IMPACT_SPEED, IMPACTS
from marching import march
from n1013_states import bearing_of, state_at_rest

from flexcage.verification import Row, Tolerance
from flexcage.verification.runs import LOSSLESS, n1013

FLIGHT = {
    "cage.model": "rigid",
    "bearing.profile.kind": "straight",
    "bearing.radial_clearance": "55 um",
    "contacts.land.kind": "none",
    "drive.speed": "0 rpm",
    "load.radial": "0 N",
    "solver.duration": "60 us",
    "solver.tolerance": "0.00001 um",
    "output.rate": "5 MHz",
    "output.vibration_rate": "5 MHz",
}
STEPS = Tolerance(1e-3, "the solver's step and tolerance in a contact of 12 us")
SAMPLES = Tolerance(0.4, "touch and parting are known to a sample of 0.2 us each", absolute=True)


def flight(*tables: Mapping[str, object]) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Of roller 0: force on the outer race [N], depth in it [m], radial speed [m/s]; sample [s]."""
    case = n1013(LOSSLESS, FLIGHT, *tables)
    bearing = bearing_of(case)
    y, yd = state_at_rest(bearing)
    bearing.layout.u(y)["elements"][:, 1] = bearing.layout.q(yd)["elements"][:, 1] = IMPACT_SPEED
    ds = march(case, bearing, y, yd).isel(element=0)
    return (
        ds["race_force"].sel(race="outer").values,
        ds["element_position"].sel(cyl="r").values
        - (case.bearing.outer_race_radius - 0.5 * case.bearing.element_diameter),
        ds["element_velocity"].sel(cyl="r").values,
        1.0 / case.output.rate,
    )


def rows() -> Iterator[Row]:
    force, depth, speed, sample = flight()
    _, _, _, deepest, time, largest = IMPACTS["N1013 roller, line contact"]
    yield Row("elastic: depth", "um", deepest, 1e6 * depth.max(), STEPS)
    yield Row("elastic: largest force", "N", largest, float(force.max()), STEPS)
    touched = 1e6 * sample * np.count_nonzero(force)
    yield Row("elastic: time in contact", "us", time, touched, SAMPLES)
    yield Row("elastic: speed back", "m/s", IMPACT_SPEED, -float(speed[-1]), STEPS)
    for e in (0.9, 0.5):
        law = {
            "contacts.race.normal.law": "restitution",
            "contacts.race.normal.restitution": e,
        }
        speed = flight(law)[2]
        yield Row(f"restitution {e}: speed back", "m/s", e * IMPACT_SPEED, -float(speed[-1]), STEPS)


def test_rollers_strike_the_outer_race():
    check(rows())
