"""A cage that drops on the inner ring's ribs and comes back."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from flexcage.core.errors import RunFailed
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.n1013 import (
    LOSSLESS,
    bearing_of,
    march,
    n1013,
    state_at_rest,
    throw_cage,
)

CLEARANCE, RESTITUTION = 0.08e-3, 0.7
GUIDED = {
    "cage.model": "rigid",
    "cage.guidance": "inner",
    "bearing.rib_diameter": "78.74 mm",
    "contacts.land.clearance": "0.08 mm",
    "contacts.land.normal.law": "restitution",
    "contacts.land.normal.restitution": RESTITUTION,
    "drive.speed": "0 rpm",
    "load.radial": "0 N",
    "solver.duration": "0.8 ms",
    "solver.tolerance": "0.00002 um",
    "solver.max_step": "2 us",
    "output.rate": "500 kHz",
    "output.vibration_rate": "500 kHz",
}
REBOUND = Tolerance(
    5e-3, "the step that meets the land sets its onset; falls with the solver's tolerance"
)


def rebounds(ds: Any, along: np.ndarray) -> list[float]:
    """Speed after over before of every blow on the lands in which nothing else is touched."""
    force = np.linalg.norm(ds["land_force"].values, axis=1)
    others = ds["race_force"].max(("element", "race")) + ds["pocket_force"].max(("pocket", "face"))
    apart = (ds["cage_velocity"] - ds["inner_velocity"]).values[:, 1:] @ along
    touching = np.flatnonzero(force > 0.0)
    found = []
    for blow in np.split(touching, np.flatnonzero(np.diff(touching) > 1) + 1):
        if not len(blow):
            continue
        before, after = blow[0] - 2, min(blow[-1] + 2, len(force) - 1)
        if others[before : after + 1].max() == 0.0 and abs(apart[before]) > 0.05:
            found.append(float(-apart[after] / apart[before]))
    return found


def rows() -> Iterator[Row]:
    case = n1013(LOSSLESS, GUIDED)
    for speed in (0.1, 0.4):
        for direction in (0.0, 2.9):
            bearing = bearing_of(case)
            y, yd = state_at_rest(bearing)
            along = np.array([np.cos(direction), np.sin(direction)])
            throw_cage(bearing, y, yd, speed, direction)
            bearing.layout.q(y)["cage"][1:] = (CLEARANCE - 5e-6) * along
            found = rebounds(march(case, bearing, y, yd), along)
            if not found:
                raise RunFailed(f"the cage at {speed} m/s struck no land, or rollers as well")
            for k, value in enumerate(found):
                name = f"{speed} m/s towards {direction} rad, blow {k + 1}"
                yield Row(name, "", RESTITUTION, value, REBOUND)


CASE = KnownAnswer(
    name="land_rebound",
    title="Rebound of a cage on its lands",
    source="the coefficient of restitution that the case asks for",
    checks="A rigid cage guided by the inner ring, all at rest, is thrown against the ribs at 0.1 "
    "and 0.4 m/s: 0.7 of its speed against the ring comes back, in the integrated bearing.",
    rows=rows,
    quick=False,
)
