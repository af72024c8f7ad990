"""Ctrl-C within a section that ends processes of its own: raised there, and never lost."""

import os
import signal
import subprocess
import sys
import threading
from types import SimpleNamespace

import pytest

from flexcage.core import stopping
from flexcage.study.desk import Desk

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of this process")


@pytest.fixture(autouse=True)
def plain():
    """As a script begins, also where the tests run in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler  # given back
    signal.signal(signal.SIGINT, before)
    stopping.check()  # nothing is left of it


def press() -> None:
    os.kill(os.getpid(), signal.SIGINT)


class Finalised:
    """Something like a future of Dask's, which tells its client when it goes."""

    def __del__(self):
        press()
        sum(range(1000))  # signals are seen between two steps of Python


def lose() -> None:
    """Ctrl-C while an object is finalised, of which Python drops the exception."""
    thing = Finalised()
    del thing


def swallow() -> None:
    """Ctrl-C while a library catches everything."""
    try:
        press()
        sum(range(1000))
    except BaseException:
        return


def test_it_is_raised_where_it_comes():
    with pytest.raises(KeyboardInterrupt), stopping.unwinding():
        press()
        raise AssertionError("it went on")


@pytest.mark.parametrize("come", [lose, swallow])
def test_one_that_was_lost_is_raised_by_the_next_look(come, capfd):
    reached = []
    with pytest.raises(KeyboardInterrupt), stopping.unwinding():
        come()
        reached.append("after it")
        stopping.check()
        reached.append("after the look")
    assert reached == ["after it"]
    assert capfd.readouterr().err == ""  # no "Exception ignored in"


@pytest.mark.parametrize("come", [lose, swallow])
def test_one_that_was_lost_is_raised_at_the_end_at_last(come):
    with pytest.raises(KeyboardInterrupt), stopping.unwinding():
        come()


def test_an_error_on_the_way_stays_that_error():
    with pytest.raises(ZeroDivisionError), stopping.unwinding():
        lose()
        _ = 1 / 0


def test_a_study_that_waits_for_its_cases_ends():
    """No case ever comes back."""
    desk = Desk.__new__(Desk)
    desk._back = []
    waiting = SimpleNamespace(next_batch=lambda block: lose() or [])
    with pytest.raises(KeyboardInterrupt), stopping.unwinding():
        desk._take(waiting)


def test_other_threads_take_no_signals():
    found = []

    def aside():
        with stopping.unwinding():
            found.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=aside)
    thread.start()
    thread.join()
    assert found == [signal.default_int_handler]


COMMAND = """
import os, signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
from flexcage.core import stopping

class Finalised:
    def __del__(self):
        os.kill(os.getpid(), signal.{name})
        sum(range(1000))

stopping.on_interrupt(lambda: "at once")
try:
    with stopping.unwinding():
        thing = Finalised()
        del thing
        while True:
            stopping.check()
            time.sleep(0.01)
except KeyboardInterrupt:
    stopping.leave("in order")
"""


@pytest.mark.parametrize("name, code", [("SIGINT", 130), ("SIGTERM", 143)])
def test_on_the_command_line(name, code):
    done = subprocess.run(
        [sys.executable, "-c", COMMAND.format(name=name)],
        capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (code, "in order\n")
