"""Energy: what is stored against what came in, nothing lost without losses, a land's rebound."""

import numpy as np
import pytest
from verification_bearing import FRICTIONLESS, NO_OIL, bearing_of, log, march, n1013, state_at_rest

from flexcage.results.audit import imbalance
from flexcage.simulate import simulate
from flexcage.system.start import find_start

SHORT = {"solver.duration": "5 ms", "output.rate": "100 kHz", "output.vibration_rate": "200 kHz"}
TIGHT = {"solver.tolerance": "0.0001 um", "solver.max_step": "5 us"}
CAGE_SIDE = ("pocket_damping", "pocket_friction", "modal_damping", "land")


def audited(*tables) -> tuple[float, float]:
    """Worst imbalance of a default run over the drive's work, and over the cage's losses."""
    ds = simulate(n1013(SHORT, *tables)).dataset
    gap = float(np.abs(imbalance(ds)).max())
    drive = float(np.abs(ds["work"].sel(channel="drive")).max())
    lost = -float(ds["work"].sel(channel=list(CAGE_SIDE))[-1].sum())
    assert drive > 0.1 and lost > 1e-4 and float(ds["pocket_force"].max()) > 5.0
    log.info("%s: imbalance %.2e J, drive %.3f J, cage side loses %.2e J", tables, gap, drive, lost)
    return gap / drive, gap / lost


def test_audit_of_a_default_run():
    over_drive, over_cage = audited()
    assert over_drive < 2e-3  # 5e-4 measured
    assert over_cage < 0.05


@pytest.mark.slow
def test_audit_tightens_with_the_tolerance():
    over_drive, over_cage = audited(TIGHT)
    assert over_drive < 4e-5
    assert over_cage < 1e-3


LOSSLESS = {
    **FRICTIONLESS,
    **NO_OIL,
    **{f"contacts.{p}.normal.law": "elastic" for p in ("race", "pocket", "side", "rib", "land")},
    "modes.damping": 0.0,
    "load.gravity": "0 m/s^2",
}


@pytest.mark.parametrize(
    ("model", "land"),
    [
        ("rigid", "none"),
        ("rigid", "dry"),
        ("flexible", "none"),
        ("flexible", "dry"),
    ],
)
def test_nothing_is_lost_without_losses(model, land):
    """A cage thrown at 0.3 m/s between turning rollers: kinetic, strain, contact and load's."""
    case = n1013(
        LOSSLESS,
        SHORT,
        TIGHT,
        {"cage.model": model, "contacts.land.kind": land, "solver.duration": "2 ms"},
    )
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=2e4)
    y, yd = start.y.copy(), start.yd.copy()
    for part in (bearing.layout.u(y)["cage"], bearing.layout.q(yd)["cage"]):
        part[1:] = 0.3 * np.cos(0.4), 0.3 * np.sin(0.4)
    ds = march(case, bearing, y, yd)
    thrown = 0.5 * bearing.data.model.cage.mass * 0.3**2
    total = ds["energy"].sum("energy_kind") - 1000.0 * ds["inner_position"].sel(axis="y")
    drift = float(np.abs(total - total[0]).max())
    touched = np.count_nonzero(ds["pocket_force"].values.max(axis=0) > 1.0)
    log.info(
        "%s, land %s: %d faces touched, up to %.0f N; energy drifts by %.1e of the throw",
        model, land, touched, float(ds["pocket_force"].max()), drift / thrown,
    )  # fmt: skip
    assert touched > 8
    assert float(np.abs(ds["work"].sel(channel="drive")).max()) < 1e-6 * thrown
    assert drift < 2e-3 * thrown


@pytest.mark.parametrize("speed", [0.1, 0.4])
@pytest.mark.parametrize("direction", [0.0, 2.9])
def test_a_land_gives_back_its_restitution(speed, direction):
    """A cage dropped on the inner ring's ribs: 0.7 of the speed comes back."""
    case = n1013(
        LOSSLESS,
        {
            "cage.model": "rigid",
            "cage.guidance": "inner",
            "bearing.rib_diameter": "78.74 mm",
            "contacts.land.clearance": "0.08 mm",
            "contacts.land.normal.law": "restitution",
            "contacts.land.normal.restitution": 0.7,
            "drive.speed": "0 rpm",
            "load.radial": "0 N",
            "solver.duration": "0.8 ms",
            "solver.tolerance": "0.001 um",
            "solver.max_step": "2 us",
            "output.rate": "500 kHz",
            "output.vibration_rate": "500 kHz",
        },
    )
    bearing = bearing_of(case)
    y, yd = state_at_rest(bearing)
    velocity = speed * np.array([np.cos(direction), np.sin(direction)])
    for part in (bearing.layout.u(y)["cage"], bearing.layout.q(yd)["cage"]):
        part[1:] = velocity
    bearing.layout.q(y)["cage"][1:] = (0.08e-3 - 5e-6) * velocity / speed
    ds = march(case, bearing, y, yd)
    force = np.linalg.norm(ds["land_force"].values, axis=1)
    others = ds["race_force"].max(("roller", "race")) + ds["pocket_force"].max(("pocket", "face"))
    apart = (ds["cage_velocity"] - ds["inner_velocity"]).values[:, 1:] @ velocity / speed
    touching = np.flatnonzero(force > 0.0)
    rebounds = []
    for blow in np.split(touching, np.flatnonzero(np.diff(touching) > 1) + 1):
        before, after = blow[0] - 2, min(blow[-1] + 2, len(force) - 1)
        if others[before : after + 1].max() == 0.0 and abs(apart[before]) > 0.05:
            rebounds.append(-apart[after] / apart[before])
    log.info("%g m/s: rebounds %s, peak %.0f N", speed, np.round(rebounds, 4), force.max())
    assert len(rebounds) >= 1 and others[: touching[0] + 10].max() == 0.0
    np.testing.assert_allclose(rebounds, 0.7, rtol=0.02)
