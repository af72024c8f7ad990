"""A long step says what it will take and how far it is, in the log."""

import logging

import pytest

from flexcage.core import pace
from flexcage.core.pace import Pace


@pytest.fixture
def clock(monkeypatch):
    """clock(t): it is t seconds now."""
    now = [0.0]
    monkeypatch.setattr(pace.time, "monotonic", lambda: now[0])
    return lambda t: now.__setitem__(0, t)


def test_a_long_step_tells_its_time_and_what_is_left(clock, caplog):
    with caplog.at_level(logging.INFO, "flexcage"):
        with Pace("modes of cage.msh", 25.0) as step:
            clock(5.0)
            step.to(0.2)  # too early for another line
            clock(12.0)
            step.to(0.4)
            clock(13.0)
            step.to(0.5)
            clock(22.0)
            step.to(1.7)
            clock(30.0)
    assert caplog.messages == [
        "modes of cage.msh: about 25 s, once",
        "modes of cage.msh: 40 %, about 18 s left",
        "modes of cage.msh: 99 %, about 0 s left",
        "modes of cage.msh: done after 30 s",
    ]


def test_a_step_of_no_told_length_says_nothing(clock, caplog):
    with caplog.at_level(logging.INFO, "flexcage"):
        with Pace("modes", None) as step:
            clock(60.0)
            step.to(0.5)
    assert not caplog.messages


def test_a_short_step_says_nothing_at_its_end(clock, caplog):
    with caplog.at_level(logging.INFO, "flexcage"):
        with Pace("modes", 0.2):
            clock(3.0)
    assert caplog.messages == ["modes: about 1 s, once"]
