"""A cage that drops on the inner ring's ribs and comes back."""

from __future__ import annotations

from collections.abc import Iterator
from math import atan2, degrees
from typing import Any

import numpy as np

from flexcage import RunFailed
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.runs import LOSSLESS, n1013, run_of

RESTITUTION = 0.7
SEEDS = (0, 2)  # of pushes in directions in which no roller is touched
GUIDED = {
    "cage.model": "rigid",
    "cage.guidance": "inner",
    "bearing.rib_diameter": "78.74 mm",
    "contacts.land.clearance": "0.08 mm",
    "contacts.land.normal.law": "restitution",
    "contacts.land.normal.restitution": RESTITUTION,
    "drive.speed": "0 rpm",
    "load.radial": "0 N",
    "solver.tolerance": "0.00002 um",
    "solver.max_step": "2 us",
    "output.rate": "500 kHz",
    "output.vibration_rate": "500 kHz",
}
REBOUND = Tolerance(
    1e-3, "the step that meets the land sets its onset; falls with the solver's tolerance"
)


def rebounds(ds: Any) -> list[float]:
    """Speed after over before along every blow on the lands in which nothing else is touched."""
    force = ds["land_force"].values[:, 1:]
    others = ds["race_force"].max(("element", "race")) + ds["pocket_force"].max(("pocket", "face"))
    velocity = (ds["cage_velocity"] - ds["inner_velocity"]).values[:, 1:]
    touching = np.flatnonzero(force.any(axis=1))
    found = []
    for blow in np.split(touching, np.flatnonzero(np.diff(touching) > 1) + 1):
        if not len(blow):
            continue
        before, after = blow[0] - 2, min(blow[-1] + 2, len(force) - 1)
        along = force[blow].sum(axis=0)
        speed = velocity @ along / np.linalg.norm(along)
        if others[before : after + 1].max() == 0.0 and abs(speed[before]) > 0.05:
            found.append(float(-speed[after] / speed[before]))
    return found


def rows() -> Iterator[Row]:
    for speed in (0.1, 0.4):
        for seed in SEEDS:
            push = {"start.push": f"{speed} m/s", "start.seed": seed,
                    "solver.duration": f"{0.1 / speed!r} ms"}  # fmt: skip
            ds = run_of(n1013(LOSSLESS, GUIDED, push)).dataset
            found = rebounds(ds)
            if not found:
                raise RunFailed(f"the cage at {speed} m/s struck no land, or rollers as well")
            y, z = ds["cage_velocity"].values[0, 1:]
            for k, value in enumerate(found):
                name = f"{speed} m/s towards {degrees(atan2(z, y)):.0f} deg, blow {k + 1}"
                yield Row(name, "", RESTITUTION, value, REBOUND)


CASE: KnownAnswer = KnownAnswer(
    name="land_rebound",
    title="Rebound of a cage on its lands",
    source="the coefficient of restitution that the case asks for",
    checks="A rigid cage guided by the inner ring, all else at rest, is pushed against the ribs at "
    "0.1 and 0.4 m/s: 0.7 of its speed along the blow comes back, in the integrated bearing.",
    rows=rows,
    quick=False,
)
