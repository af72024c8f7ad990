"""Progress is drawn on a terminal, and nowhere else."""

import io
import logging
import sys

import pytest

from flexcage.core import logs, progress
from flexcage.core.progress import Progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    return now


def test_quiet_when_not_on_a_terminal():
    stream = io.StringIO()
    with Progress(1.0, "solving", stream=stream) as bar:
        bar.note("compiling")
        bar.to(0.5)
    assert stream.getvalue() == ""


def test_percentage_and_estimate(clock):
    stream = Terminal()
    with Progress(200.0, "solving", stream=stream) as bar:
        clock[0] += 30.0
        bar.to(50.0)
        assert bar.remaining() == pytest.approx(90.0)
    text = stream.getvalue()
    assert " 25 %, about 1 min 30 s left" in text
    assert "done at 100 % after 30 s" in text


def test_estimate_of_a_resumed_run_counts_only_its_own_part(clock):
    bar = Progress(100.0, "solving", stream=Terminal())
    bar.begin_at(50.0)
    clock[0] += 10.0
    bar.to(75.0)
    assert bar.remaining() == pytest.approx(10.0)


def test_a_failure_is_not_called_done(clock):
    stream = Terminal()
    with pytest.raises(KeyboardInterrupt), Progress(10.0, "solving", stream=stream) as bar:
        bar.advance(3.0)
        raise KeyboardInterrupt
    assert "stopped at 30 %" in stream.getvalue() and "done" not in stream.getvalue()


def test_notes_have_a_line_of_their_own():
    stream = Terminal()
    with Progress(1.0, "solving", stream=stream) as bar:
        bar.note("compiling kernels for the first time")
    lines = stream.getvalue().split("\n")
    assert lines[0].endswith("\rcompiling kernels for the first time")
    assert lines[1].startswith("\rsolving:")


def test_log_records_have_a_line_of_their_own(monkeypatch):
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    logger = logging.getLogger("flexcage")
    kept = logger.handlers[:], logger.level, logger.propagate
    try:
        logs.setup()
        with Progress(None, "modes", stream=stream):
            logger.warning("a slow solver")
        logger.warning("done")
    finally:
        logger.handlers[:], logger.propagate = kept[0], kept[2]
        logger.setLevel(kept[1])
    shown = [line.rsplit("\r", 1)[-1] for line in stream.getvalue().split("\n")]
    assert shown[0] == "warning: a slow solver"
    assert shown[1].startswith("modes: done") and shown[2] == "warning: done"


def test_a_step_of_unknown_length_is_named_without_an_estimate(clock):
    stream = Terminal()
    with Progress(None, "modes", stream=stream) as bar:
        clock[0] += 3.0
        bar.advance()
        assert bar.remaining() is None
    assert "\rmodes ..." in stream.getvalue() and "%" not in stream.getvalue()
    assert "modes: done after 3 s" in stream.getvalue()
