"""Pure rolling: strong traction, no resistance, no friction on the cage. Speeds are epicyclic.

Known answers at 6000 rpm on a fixed outer ring: cage 2709.0909 rpm, rollers 27,937.5 rpm in the
inertial frame and 30,646.59 rpm relative to the cage.
"""

import numpy as np
import pytest
from verification_bearing import FRICTIONLESS, NO_OIL, bearing_of, log, march, n1013

from flexcage.results import metrics
from flexcage.simulate import simulate
from flexcage.system.start import find_start

RPM = np.pi / 30.0
CAGE, SPIN, IN_CAGE = 2709.0909 * RPM, 27937.5 * RPM, 30646.59 * RPM
ROLLING = {
    **FRICTIONLESS,
    **NO_OIL,
    "contacts.race.friction.law": "traction",
    "contacts.race.friction.peak": 0.3,
    "contacts.race.friction.high_speed": 0.29,
    "contacts.race.friction.peak_speed": "0.01 m/s",
    "contacts.land.kind": "none",
    "load.gravity": "0 m/s^2",
}


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_cage_and_rollers_turn_at_the_epicyclic_speeds(model):
    """20 ms: cage and rollers within 0.05 %, loaded or not."""
    run = simulate(n1013(ROLLING, {"cage.model": model, "solver.duration": "20 ms"}))
    ds = metrics.settled(run.dataset, 0.3)
    cage = metrics.cage_speed(ds, run.numbers).mean
    spin = np.abs(ds["roller_omega"].values[:, :, 0])
    loaded = ds["race_force"].values[:, :, 0] > 1.0
    log.info("%s: cage %.3f rpm, spin %.2f rpm", model, cage / RPM, spin.mean() / RPM)
    assert cage == pytest.approx(CAGE, rel=5e-4)
    assert spin[loaded].mean() == pytest.approx(SPIN, rel=5e-4)
    assert spin.mean() == pytest.approx(SPIN, rel=5e-4)
    assert spin.mean() + cage == pytest.approx(IN_CAGE, rel=5e-4)


def test_a_loaded_roller_finds_its_speeds():
    """Started 2 % slow in orbit and 3 % in spin, the most loaded roller ends epicyclic."""
    fine = {"output.vibration_rate": "500 kHz", "output.rate": "500 kHz"}
    case = n1013(ROLLING, fine, {"cage.model": "rigid", "solver.duration": "3 ms"})
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=2e4)
    layout, y, yd = bearing.layout, start.y.copy(), start.yd.copy()
    orbit, spin = 0.98 * CAGE, -0.97 * SPIN
    u, rate = layout.u(y)["rollers"], layout.q(yd)["rollers"]
    u[0, 2], u[0, 3] = orbit * layout.q(y)["rollers"][0, 1], spin
    rate[0, 2], rate[0, 5] = orbit, spin - orbit
    ds = march(case, bearing, y, yd)
    end = ds.isel(time=slice(-400, None), roller=0)
    radius = end["roller_position"].sel(cyl="r")
    found = (end["roller_velocity"].sel(cyl="psi") / radius).mean()
    assert float(found) == pytest.approx(CAGE, rel=5e-4)
    turning = float(end["roller_omega"].sel(spin_axis="axial").mean())
    assert turning == pytest.approx(-SPIN, rel=5e-4)
    assert np.abs(ds["race_slip"].values[0, 0]).max() > 0.1  # it did slide at first
