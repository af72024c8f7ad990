"""What Ctrl-C does on the command line: it ends the process at once, wherever that is.

An exception would have to pass through imports, compilers and the event loops of libraries, which
swallow it, turn it into another, or print as they are torn down. A run loses nothing by it: what
it has committed is on disk, as after a kill. A section that has processes of its own to end says
so by ``unwinding``, and gets the exception; there SIGTERM and a closed terminal do the same.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

STOPPED = 130  # exit code
_ALSO = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))

_code = [STOPPED]  # exit code of the signal that came
_command = [False]  # is this the command line?
_unwinding = [0]  # how many sections want the exception
# what is tidied up, if it was loaded at all
_TIDY = (
    ("flexcage.core.progress", "clear_line"),
    ("flexcage.core.locks", "abandon"),
    ("flexcage.core.kernel_cache", "remove_spares"),
)


@contextmanager
def unwinding() -> Iterator[None]:
    """Within this, the first Ctrl-C raises KeyboardInterrupt; so do SIGTERM and SIGHUP on the
    command line, unless they are ignored."""
    _unwinding[0] += 1
    ours = _command[0] and threading.current_thread() is threading.main_thread()
    taken = [s for s in _ALSO if ours and signal.getsignal(s) is signal.SIG_DFL]
    for also in taken:
        signal.signal(also, _raise)
    try:
        yield
    finally:
        _unwinding[0] = max(_unwinding[0] - 1, 0)
        for also in taken:
            signal.signal(also, signal.SIG_DFL)


def _raise(number: int, _frame: Any) -> None:
    _code[0] = 128 + number
    signal.signal(number, signal.SIG_IGN)  # a shell and its terminal may both send one
    raise KeyboardInterrupt


def code() -> int:
    """Exit code of a command that a signal stopped, as shells count them."""
    return _code[0]


def on_interrupt(sentence: Callable[[], str]) -> None:
    """From now on Ctrl-C ends the process with this sentence, in one line."""
    _command[0] = True

    def stop(_signal: int, _frame: Any) -> None:
        if _unwinding[0]:
            _unwinding[0] = 0  # a second one does not wait
            raise KeyboardInterrupt
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        leave(sentence())

    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:  # as for a job in the background
        signal.signal(signal.SIGINT, stop)


def leave(sentence: str) -> None:
    """Say it, if there is anything to say, and end this process: no more is heard of it."""
    for module, function in _TIDY:
        with suppress(Exception):  # half imported, say
            getattr(sys.modules[module], function)()
    with suppress(Exception):
        sys.stdout.flush()
    with suppress(OSError):
        os.write(2, f"{sentence}\n".encode(errors="replace") if sentence else b"")
    os._exit(code())
