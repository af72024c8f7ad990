"""Runs that would take days are refused: by the stability bound, or by the steps taken so far."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.core.errors import RunFailed
from flexcage.integrate.foresight import EVERY, IN_A_ROW, Foresight
from flexcage.integrate.integration import Integration
from flexcage.solve.contract import COUNTS
from flexcage.solve.options import SolverOptions


def test_explicit_steps_are_counted_before_the_first():
    ahead = Foresight(1_000_000, 0.1)
    ahead.explicit(0, 0.0, 1.01e-7)  # 990,099 steps
    with pytest.raises(
        RunFailed, match=re.escape("about 1,010,101 steps, more than solver.max_st")
    ):
        ahead.explicit(0, 0.0, 0.99e-7)
    with pytest.raises(RunFailed, match="stable up to 101 ns; look for a mass"):
        ahead.explicit(20_000, 0.0, 1.01e-7)  # with those that are behind


def marched(ahead: Foresight, means: list[float]) -> float:
    """Time reached by so many looks, each after ``EVERY`` steps of a mean length [s]."""
    time = 0.0
    for look, mean in enumerate(means, start=1):
        time += EVERY * mean
        ahead.after(EVERY * look, time, mean)
    return time


def test_a_slow_run_is_refused_after_a_hundred_thousand_steps():
    """1 ps a step: 1e11 steps for 0.1 s."""
    with pytest.raises(RunFailed, match=re.escape("1.0e+11 steps, more than solver.max_steps (5")):
        marched(Foresight(50_000_000, 0.1), [1e-12] * IN_A_ROW)


def test_a_slow_start_is_waited_for():
    """Four looks at 1 ps, then steps of 1 us; and a run that is slow but may be."""
    slow, usual = [1e-12] * (IN_A_ROW - 1), [1e-6]
    assert marched(Foresight(50_000_000, 0.1), (slow + usual) * 3) > 0.05
    assert marched(Foresight(50_000_000, 0.1), [3e-9] * 20) > 1e-3


def test_a_run_looks_ahead_before_its_first_step():
    """Explicit steps that are stable up to 1 fs: 1e14 for 0.1 s; nothing is advanced."""
    run = Integration.__new__(Integration)
    run.solver, run.bound = SolverOptions(method="explicit"), np.inf
    run.state = SimpleNamespace(real=np.zeros(2), count=np.zeros(len(COUNTS), int))
    run.integrator = SimpleNamespace(name="explicit", bounded=True, last=lambda state: (None, None))
    free = SimpleNamespace(free=np.zeros(9))
    data = SimpleNamespace(model=SimpleNamespace(bodies=free))
    run.bearing = SimpleNamespace(stable_step=lambda t, y, yd: 1e-15, data=data)
    run.repeated = 0
    run._foresight = Foresight(run.solver.max_steps, 0.1)
    with pytest.raises(RunFailed, match=re.escape("1.0e+14 steps")):
        run._choose()
