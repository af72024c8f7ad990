"""Runs that would take days are refused: by the stability bound, or by the steps taken so far."""

from __future__ import annotations

import re
from types import SimpleNamespace

import numpy as np
import pytest
from simulate_cases import n1013

from flexcage.core.errors import RunFailed
from flexcage.integrate import foresight, integration
from flexcage.integrate.foresight import EVERY, IN_A_ROW, Foresight
from flexcage.integrate.integration import Integration
from flexcage.simulate import simulate
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
    run.system = SimpleNamespace(
        stable_step=lambda t, y, yd: 1e-15, cheaper=lambda step, least: "explicit"
    )
    run.repeated = 0
    run._foresight = Foresight(run.solver.max_steps, 0.1)
    with pytest.raises(RunFailed, match=re.escape("1.0e+14 steps")):
        run._choose()


def test_looks_come_as_often_as_steps_are_slow():
    """Windows of ``EVERY`` steps are put together of short looks."""
    ahead, time = Foresight(50_000_000, 0.1), 0.0
    with pytest.raises(RunFailed, match=re.escape("1.0e+11 steps, more than solver.max_steps (5")):
        for look in range(1, 100 * IN_A_ROW):
            time += EVERY / 50 * 1e-12
            ahead.look(EVERY // 50 * look, time)
    assert look == 50 * IN_A_ROW


def test_slow_steps_tell_their_pace_within_half_a_minute(monkeypatch, caplog):
    """Steps of 4 s and 1 us: four days for 0.1 s; no block is done for long."""
    now = [0.0]
    monkeypatch.setattr(foresight.clocks, "perf_counter", lambda: now[0])
    ahead = Foresight(50_000_000, 0.1)
    with caplog.at_level("INFO", logger="flexcage"):
        ahead.look(0, 0.0)
        for step in range(1, 20):
            now[0] += 4.0
            ahead.look(step, 1e-6 * step)
            if caplog.messages:
                break
    (line,) = caplog.messages
    assert now[0] == 20.0 and "the run takes about 111 h 6 min more" in line
    assert "solver.duration = 0.08 ms would take 5 min 00 s more" in line


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_how_often_it_is_looked_changes_no_bit(monkeypatch, method):
    case = n1013({"cage.model": "rigid", "solver.duration": "0.4 ms", "solver.method": method})
    often, seldom = (run_with(monkeypatch, case, rows) for rows in (1, 20_000))
    for name in ("cage_position", "element_velocity", "work"):
        np.testing.assert_array_equal(often.dataset[name], seldom.dataset[name])
    for name, values in often.steps.items():
        np.testing.assert_array_equal(values, seldom.steps[name])


def run_with(monkeypatch, case, rows):
    monkeypatch.setattr(integration, "_FIRST_ROWS", rows)
    return simulate(case)


def test_a_run_that_becomes_slow_later_says_so(monkeypatch, caplog):
    """Its first tenth in 20 s, then a thousandth of it every 20 s."""
    now = [0.0]
    monkeypatch.setattr(foresight.clocks, "perf_counter", lambda: now[0])
    ahead = Foresight(50_000_000, 0.1)
    with caplog.at_level("INFO", logger="flexcage"):
        ahead.pace(0.0)
        now[0] = 20.0
        ahead.pace(0.01)
        assert not caplog.messages  # three minutes more
        for step in range(1, 4):
            now[0] += 20.0
            ahead.pace(0.01 + 1e-5 * step)
    assert len(caplog.messages) == 1 and "6 min" in caplog.messages[0]


def test_loading_of_kernels_is_no_pace(monkeypatch):
    """The clock begins behind the first steps, which load them."""
    looks = []

    class Watched(Foresight):
        def pace(self, time):
            looks.append(time)

    monkeypatch.setattr(integration, "Foresight", Watched)
    simulate(n1013({"cage.model": "rigid", "solver.duration": "1 ms"}), stress=False)
    assert looks[0] > 0.0 and looks[-1] == pytest.approx(1e-3, rel=0.1)
