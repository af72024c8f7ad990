"""A bearing that nothing holds: its momentum stays, whatever strikes what.

No load, no weight, no oil, no friction, and an outer ring on a bushing of 1e-6 N/m: a cage thrown
at 0.3 m/s and turning at 10 rad/s strikes rollers at rest, and they the races. The flexible cage's
momentum is summed over the nodes of its mesh: leaving its deformation out would cost 1e-4 of the
angular momentum.

Source: conservation of momentum and of angular momentum about the bearing's axis.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest
from free_cages import TURNED, of_flexible_cage, of_rigid_cage
from known_rows import check
from marching import march
from n1013_states import bearing_of, cage_of, state_at_rest, throw_cage

from flexcage.core.errors import RunFailed
from flexcage.system.problem import BearingSystem
from flexcage.verification import Row, Tolerance
from flexcage.verification.runs import FRICTIONLESS, NO_OIL, n1013

SPEED, DIRECTION, SPIN = 0.3, 0.4, 10.0  # m/s, rad, rad/s of the cage
FREE = {
    "cage.model": "rigid",
    "drive.speed": "0 rpm",
    "load.radial": "0 N",
    "load.gravity": "0 m/s^2",
    "mount.kind": "bushing",  # as good as none
    "mount.stiffness": "1e-6 N/m",
    "mount.damping": "0 N*s/m",
    "solver.duration": "4 ms",
    "solver.tolerance": "0.0001 um",
    "output.rate": "100 kHz",
    "output.vibration_rate": "200 kHz",
}
ELASTIC = {f"contacts.{p}.normal.law": "elastic" for p in ("race", "pocket", "side", "rib")}
FLEXIBLE = {"cage.model": "flexible", "solver.tolerance": "0.000001 um"}
TABLES = {
    "elastic contacts": ELASTIC,
    "contacts with losses": {},
    "flexible cage, elastic contacts": {**ELASTIC, **FLEXIBLE},
    "flexible cage, contacts with losses": FLEXIBLE,
}
KEPT = Tolerance(2e-9, "share of the throw's; falls with solver.tolerance", absolute=True)


def of_rollers_and_rings(bearing: BearingSystem, ds: Any) -> tuple[np.ndarray, np.ndarray]:
    """Momentum across the axis (time, 2) [kg m/s] and angular momentum about it (time,)."""
    model = bearing.data.model
    mass, axial, transverse = model.bodies.element
    psi, r = (ds["element_position"].sel(cyl=c).values for c in ("psi", "r"))
    radial, around = (ds["element_velocity"].sel(cyl=c).values for c in ("r", "psi"))
    cos, sin = np.cos(psi), np.sin(psi)
    linear = (
        mass * np.stack([radial * cos - around * sin, radial * sin + around * cos]).sum(axis=2).T
    )
    spin = ds["element_omega"].values * [axial, transverse, transverse]
    # own axes' share along the bearing's
    skew, tilt = np.moveaxis(ds["element_tilt"].values, -1, 0)
    shares = (np.cos(skew) * np.cos(tilt), -np.cos(skew) * np.sin(tilt), np.sin(skew))
    angular = (mass * r * around + (spin * np.stack(shares, axis=-1)).sum(axis=-1)).sum(axis=1)
    for name, ring in (("inner", model.inner_ring), ("outer", model.outer_ring)):
        m = ring.inertia[0]
        at, v = (ds[f"{name}_{what}"].values[:, 1:] for what in ("position", "velocity"))
        linear = linear + m * v
        angular = angular + m * (at[:, 0] * v[:, 1] - at[:, 1] * v[:, 0])
    return linear, angular


def rows(table: Mapping[str, object]) -> Iterator[Row]:
    case = n1013(FRICTIONLESS, NO_OIL, FREE, table)
    bearing = bearing_of(case)
    y, yd = state_at_rest(bearing)
    bearing.layout.u(y)["omega"][0] = SPIN
    bearing.layout.q(yd)["quaternion"][1] = 0.5 * SPIN
    throw_cage(bearing, y, yd, SPEED, DIRECTION)
    ds = march(case, bearing, y, yd)
    if min(float(ds[f].max()) for f in ("pocket_force", "race_force")) < 1.0:
        raise RunFailed("the cage struck no pocket, or no roller a race: nothing was tried")
    flexible = case.cage_model == "flexible"
    cage = of_flexible_cage(cage_of(case)[1], ds) if flexible else of_rigid_cage(bearing, ds)
    linear, angular = (a + b for a, b in zip(of_rollers_and_rings(bearing, ds), cage))
    thrown = bearing.data.model.cage.mass * SPEED
    drift = np.abs(linear - linear[0]).max() / thrown
    yield Row("drift of momentum", "", 0.0, float(drift), KEPT)
    drift = np.abs(angular - angular[0]).max() / abs(angular[0])
    kept = TURNED if flexible else KEPT
    yield Row("drift of angular momentum", "", 0.0, float(drift), kept)


@pytest.mark.parametrize("name", TABLES)
def test_momentum_stays(name):
    check(rows(TABLES[name]))
