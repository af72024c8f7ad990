"""A ball bearing that nothing holds across its axis: its momentum stays; nothing is lost.

No load, no weight, no oil, and an outer ring on a bushing of 1e-6 N/m: a cage thrown at 0.3 m/s and
turning at 10 rad/s strikes balls at rest and shoulders, and balls the races; the inner ring may
tilt. The flexible cage's momentum is summed over the nodes of its mesh.

Source: conservation of momentum, of angular momentum about the bearing's axis, and of energy.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest
from c7010_states import balls_on_outer
from free_cages import TURNED, of_flexible_cage, of_rigid_cage
from known_rows import check
from marching import march

from flexcage.case import Case
from flexcage.compiling import build_bearing
from flexcage.core.errors import RunFailed
from flexcage.modes.reduction import CageReduction
from flexcage.stages import cage_mesh, cage_reduction
from flexcage.system.problem import BearingSystem
from flexcage.verification import Row, Tolerance
from flexcage.verification.runs import ELASTIC, NO_OIL, SMOOTH, c7010

SPEED, DIRECTION, SPIN = 0.3, 0.4, 10.0  # m/s, rad, rad/s of the cage
FREE = {
    "drive.speed": "0 rpm",
    "load.axial": "0 N",
    "load.tilt": "free",
    "mount.kind": "bushing",  # as good as none
    "mount.stiffness": "1e-6 N/m",
    "mount.damping": "0 N*s/m",
    "contacts.race.friction.law": "none",  # the outer ring does not turn
    "contacts.land.friction.law": "none",
    "solver.duration": "10 ms",
    "solver.tolerance": "0.00002 um",
    "output.rate": "100 kHz",
    "output.vibration_rate": "200 kHz",
}
LOSSLESS = {**ELASTIC, **SMOOTH, "modes.damping": 0.0}
FLEXIBLE = {"cage.model": "flexible", "solver.tolerance": "0.000001 um"}
TABLES = {
    "elastic contacts": LOSSLESS,
    "contacts with losses": {},
    "flexible cage, elastic contacts": {**LOSSLESS, **FLEXIBLE},
    "flexible cage, contacts with losses": FLEXIBLE,
}
KEPT = Tolerance(1e-8, "share of the throw's; falls with solver.tolerance", absolute=True)
STORED = Tolerance(1e-3, "share of the throw's energy, in several blows", absolute=True)


def of_balls_and_rings(bearing: BearingSystem, ds: Any) -> tuple[np.ndarray, np.ndarray]:
    """Momentum across the axis (time, 2) [kg m/s] and angular momentum about it (time,)."""
    model = bearing.data.model
    mass, inertia, _ = model.bodies.element
    r, psi = (ds["element_position"].sel(cyl=c).values for c in ("r", "psi"))
    radial, around = (ds["element_velocity"].sel(cyl=c).values for c in ("r", "psi"))
    cos, sin = np.cos(psi), np.sin(psi)
    across = np.stack([radial * cos - around * sin, radial * sin + around * cos])
    linear = mass * across.sum(axis=2).T
    spin = ds["element_omega"].sel(spin_axis="axial").values
    angular = (mass * r * around + inertia * spin).sum(axis=1)
    for name, ring in (("inner", model.inner_ring), ("outer", model.outer_ring)):
        m = ring.inertia[0]
        at, v = (ds[f"{name}_{what}"].values[:, 1:] for what in ("position", "velocity"))
        linear = linear + m * v
        angular = angular + m * (at[:, 0] * v[:, 1] - at[:, 1] * v[:, 0])
    return linear, angular


def built(case: Case) -> tuple[BearingSystem, CageReduction | None]:
    """The case's bearing, and the reduction of its cage if that is flexible."""
    mesh = cage_mesh(case)
    reduction = cage_reduction(case, mesh)
    return build_bearing(case, mesh, reduction), reduction


def rows(table: Mapping[str, object]) -> Iterator[Row]:
    case = c7010(NO_OIL, FREE, table)
    bearing, reduction = built(case)
    y, yd = balls_on_outer(bearing)
    layout = bearing.layout
    layout.u(y)["omega"][0], layout.q(yd)["quaternion"][1] = SPIN, 0.5 * SPIN
    thrown = SPEED * np.array([np.cos(DIRECTION), np.sin(DIRECTION)])
    layout.u(y)["cage"][1:] = layout.q(yd)["cage"][1:] = thrown
    ds = march(case, bearing, y, yd)
    if min(float(ds[f].max()) for f in ("pocket_force", "race_force")) < 1.0:
        raise RunFailed("the cage struck no ball, or no ball a race: nothing was tried")
    cage = of_flexible_cage(reduction, ds) if reduction else of_rigid_cage(bearing, ds)
    linear, angular = (a + b for a, b in zip(of_balls_and_rings(bearing, ds), cage))
    throw = bearing.data.model.cage.mass * SPEED
    drift = np.abs(linear - linear[0]).max() / throw
    yield Row("drift of momentum", "", 0.0, float(drift), KEPT)
    drift = np.abs(angular - angular[0]).max() / abs(angular[0])
    kept = TURNED if reduction else KEPT
    yield Row("drift of angular momentum", "", 0.0, float(drift), kept)
    if LOSSLESS.items() <= table.items():
        energy = ds["energy"].sum("energy_kind").values
        drift = np.abs(energy - energy[0]).max() / (0.5 * throw * SPEED)
        yield Row("drift of energy", "", 0.0, float(drift), STORED)


@pytest.mark.parametrize("name", TABLES)
def test_momentum_and_energy_stay(name):
    check(rows(TABLES[name]))
