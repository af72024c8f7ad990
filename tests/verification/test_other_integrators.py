"""Other integrators on flexcage's residual: the same trajectory until chaos sets in, then the same
statistics.

The main job from its settled state, by SUNDIALS IDA up to order 5 (``tests/benchmarks/peers.py``
says how it is driven), and by the BDF and the explicit method of flexcage. Differences are in
units of 10 nm of every position, and of the same in every other scale. Measured, IDA against
flexcage's BDF at 1e-4 of a tolerance of 10 nm, largest of all unknowns so far:

    IDA's share of 10 nm                    0.1 ms   0.25 ms   0.5 ms     1 ms     2 ms
    1e-1                                       2.0       8.4       33      126      760
    1e-2                                      0.23      0.95      8.1       44      115
    1e-3                                      0.03      0.13     0.52      4.5       33
    1e-4                                      0.01      0.06     0.21      1.4       34

So both approach one solution, and from 2 ms on no tolerance helps. Statistics over 20 ms are chance
as well: eight runs that differ by their tolerance alone scatter, as standard deviations, by 0.004 %
(load of the most loaded roller), 0.4 % (sum of crossbeam forces; IDA's by 2.2 %) and 0.0006 % (cage
speed). So means over eight runs of each are compared; they differ by 0.004 %, 1.5 % and 0.0003 %.
Bounds are seven standard errors of these differences, and more of the cage speed's.
"""

from __future__ import annotations

from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from peers import Peers
from settled import SETTLE, Settled
from verification_bearing import log

import flexcage

needs_ida = pytest.mark.skipif(
    find_spec("sksundae") is None, reason="scikit-sundae is not installed (the extra 'peer')"
)
pytestmark = pytest.mark.slow
CASE = Path(__file__).resolve().parents[2] / "examples" / "n1013.toml"
UNIT = 1e-8  # [m] of the differences
EVERY = 4  # of the samples at 200 kHz: what statistics are made of
SHARES = np.linspace(0.86, 1.0, 8)  # of the tolerance: each gives another chaotic motion


@pytest.fixture(scope="module")
def settled():
    return Settled(flexcage.load_case(CASE))


@pytest.fixture(scope="module")
def start(settled):
    """Peers over the first half millisecond, a tight explicit solution, and its forces."""
    peers = Peers(settled, 0.5e-3)
    reference = settled.integrate(0.5e-3, stride=EVERY, share=1e-4, method="explicit")
    return peers, reference, settled.forces(reference.ys, reference.yds, peers.times)


def test_the_ode_form_is_the_same_problem(settled, start):
    """Its rates leave no residual but the forces that hold the inner ring's four coordinates."""
    peers = start[0]
    y, _ = settled.restore()
    x = y[: peers.ode.size]
    yd = peers.ode.full(peers.ode.rates(SETTLE, x.copy()))
    left = np.abs(settled.bearing.residual(SETTLE, peers.ode.full(x), yd))
    ring = settled.bearing.layout.n_q + 6 * settled.bearing.layout.elements
    held = ring + np.array([0, 3, 4, 5])
    forces = np.abs(settled.bearing.layout.multipliers(y))[[0, 3, 1, 2]]
    # those of y are as good as Newton's method left them
    np.testing.assert_allclose(left[held], forces, rtol=1e-3, atol=1e-4 * forces.max())
    left[held] = 0.0
    assert left[: peers.ode.size].max() < 1e-12


def test_both_methods_find_the_same_forces(settled, start):
    """One of them without constraints, Newton's method or a tangent."""
    peers, _, forces = start
    path = settled.integrate(0.5e-3, stride=EVERY, share=1e-4, method="bdf")
    race, cage = settled.forces(path.ys, path.yds, peers.times).error(forces)
    assert race < 1e-4
    assert cage < 1e-2


@needs_ida
def test_same_trajectory(settled, start):
    """Over the first half millisecond, and the closer the tighter the tolerance: by a hundred in
    three steps of ten. One step may gain less, where a contact begins at another moment."""
    peers, reference, forces = start
    weight = settled.bearing.error_weights(UNIT)
    misses = []
    for share in (1e-1, 1e-2, 1e-3, 1e-4):
        path = peers.ida(share, max_order=5)
        misses.append(np.abs((path.ys - reference.ys) * weight).max())
    assert misses[3] < 0.5
    assert all(after < 0.5 * before for before, after in pairwise(misses))
    assert misses[3] < 0.02 * misses[0]
    race, cage = settled.forces(path.ys, path.yds, peers.times).error(forces)
    assert race < 1e-4
    assert cage < 1e-2


@needs_ida
def test_same_statistics(settled):
    """Over 20 ms, long after both have parted."""
    peers = Peers(settled, 20e-3)

    def mean(integrate):
        runs = [statistics(settled, peers.times, integrate(share)) for share in SHARES]
        log.info("load, crossbeam forces, cage speed: %s", np.round(runs, 3).tolist())
        return np.mean(runs, axis=0)

    theirs = mean(lambda share: peers.ida(share, max_order=5))
    ours = mean(lambda share: settled.integrate(20e-3, stride=EVERY, share=share))
    np.testing.assert_allclose(theirs[0], ours[0], rtol=1.4e-4)
    np.testing.assert_allclose(theirs[1], ours[1], rtol=0.056)
    np.testing.assert_allclose(theirs[2], ours[2], rtol=4e-5)


def statistics(settled, times, run) -> tuple[float, float, float]:
    """Means of largest inner race force [N], summed crossbeam forces [N], cage speed [rad/s]."""
    Z = settled.bearing.layout.elements
    forces = settled.forces(run.ys[::EVERY], run.yds[::EVERY], times[::EVERY])
    inner = forces.race.reshape(len(forces.race), Z, 2, 2)[:, :, 0, 0]
    faces = forces.cage[:, :-1].reshape(len(forces.cage), Z, 4, 3)
    crossbeams = np.linalg.norm(faces[:, :, :2], axis=3).sum(axis=(1, 2))
    speed = settled.bearing.layout.u(run.ys)["omega"][:, 0]
    return float(inner.max(axis=1).mean()), float(crossbeams.mean()), float(speed.mean())
