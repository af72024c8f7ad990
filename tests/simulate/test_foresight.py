"""Runs that would take days are refused: by the stability bound, or by the steps taken so far."""

from __future__ import annotations

import re

import pytest

from flexcage.core.errors import RunFailed
from flexcage.integrate.foresight import EVERY, IN_A_ROW, Foresight


def test_explicit_steps_are_counted_before_the_first():
    ahead = Foresight(1_000_000, 0.1)
    ahead.explicit(0, 0.0, 1.01e-7)  # 990,099 steps
    with pytest.raises(RunFailed, match=re.escape("about 1.0e+06 steps, more than solver.max_st")):
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
