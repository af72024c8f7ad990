"""A bearing of given specs, a moving state for it, and runs of it that hand back what happened."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.solve import bdf
from flexcage.system.layout import Layout
from flexcage.system.model import POWERS
from flexcage.system.problem import Bearing, new_samples
from flexcage.system.scales import error_weights
from flexcage.system.start import geometric_guess, rolling_velocities


def assembled(model, memory, contacts) -> Bearing:
    layout = Layout(len(model.bodies.radius), model.cage.mff.shape[0])
    return Bearing(model, memory, contacts, layout)


def rolling_start(bearing):
    """(y, y') of the geometric guess at the speeds of pure rolling."""
    y = geometric_guess(bearing.data.model, bearing.layout)
    return y, rolling_velocities(bearing.data.model, bearing.layout, y)


@dataclass
class History:
    """States on a grid, their reports, integrals of power, and the solver's log."""

    time: np.ndarray
    y: np.ndarray
    yd: np.ndarray
    samples: object
    work: np.ndarray
    log: np.ndarray
    outcome: int
    state: object

    def power(self, name):
        return self.work[:, POWERS.index(name)]


def march(bearing, y0, yd0, *, duration, rate=100e3, tolerance=1e-8, max_order=2, h_max=5e-5):
    """Integrate and sample at ``rate``; every sample is a main one."""
    layout = bearing.layout
    times = np.arange(1, int(round(duration * rate)) + 1) / rate
    n, quads = len(times), np.zeros((int(round(duration * rate)), len(POWERS)))
    samples = new_samples(n, 1, bearing.data.model)
    args = bearing.arguments(bearing.data._replace(samples=samples), bearing.laws)
    weight = error_weights(bearing.data.model, layout, tolerance)
    state = bdf.new_state(0.0, y0, yd0, weight=weight, h0=1e-8, n_quad=len(POWERS))
    bearing.functions[4](0.0, y0, yd0, args, state.power[0])
    options = bdf.Options(max_order, h_max, 1e-14, 0.3, 10**9)
    ys, yds = np.zeros((n, layout.size)), np.zeros((n, layout.size))
    log = np.zeros((400_000, 5))
    outcome, done, rows = bearing._advance(
        bearing.functions, args, state, options, times[-1], times, ys, yds, 0, log, quads
    )
    assert done == n or outcome != bdf.DONE
    return History(
        times[:done], ys[:done], yds[:done], samples, quads[:done], log[:rows], outcome, state
    )
