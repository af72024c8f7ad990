"""What Ctrl-C does on the command line: it ends the process at once, wherever that is.

An exception would have to pass through imports, compilers and the event loops of libraries, which
swallow it, turn it into another, or print as they are torn down. A run loses nothing by it: what
it has committed is on disk, as after a kill. A section that has processes of its own to end says
so by ``unwinding``, and gets the exception; there SIGTERM and a closed terminal do the same. Python
drops an exception that is raised while an object is finalised, and libraries catch some: a signal
is kept until ``check``, which such a section calls wherever it waits, raises it.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

STOPPED = 130  # exit code
_ALSO = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))

_code = [STOPPED]  # exit code of the signal that came
_command = [False]  # is this the command line?
_unwinding = [0]  # how many sections want the exception
_kept = [False]  # has a signal come that such a section may not have seen?
_DROPS = ("__del__",)  # functions out of which no exception comes
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
    main = threading.current_thread() is threading.main_thread()
    ours = _command[0] and main
    taken: dict[int, Any] = {
        s: signal.SIG_DFL for s in _ALSO if ours and signal.getsignal(s) is signal.SIG_DFL
    }
    for also in taken:
        signal.signal(also, _raise)
    if main and signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # of a script
        taken[signal.SIGINT] = signal.default_int_handler
        signal.signal(signal.SIGINT, lambda _number, frame: _interrupt(frame))
    try:
        yield
        check()
    finally:
        _unwinding[0] = max(_unwinding[0] - 1, 0)
        _kept[0] = _kept[0] and _unwinding[0] > 0
        for also, handler in taken.items():
            signal.signal(also, handler)


def check() -> None:
    """Raise KeyboardInterrupt for a signal that came within ``unwinding`` and was lost."""
    if _kept[0]:
        _kept[0] = False
        raise KeyboardInterrupt


def _interrupt(frame: FrameType | None) -> None:
    """Raise KeyboardInterrupt, or have ``check`` raise it, where the frame would drop it."""
    _kept[0] = True
    while frame is not None:
        if frame.f_code.co_name in _DROPS:
            return
        frame = frame.f_back
    raise KeyboardInterrupt


def _raise(number: int, frame: FrameType | None) -> None:
    _code[0] = 128 + number
    signal.signal(number, signal.SIG_IGN)  # a shell and its terminal may both send one
    _interrupt(frame)


def code() -> int:
    """Exit code of a command that a signal stopped, as shells count them."""
    return _code[0]


def on_interrupt(sentence: Callable[[], str]) -> None:
    """From now on Ctrl-C ends the process with this sentence, in one line."""
    _command[0] = True

    def stop(_signal: int, frame: FrameType | None) -> None:
        if _unwinding[0]:
            _unwinding[0] = 0  # a second one does not wait
            return _interrupt(frame)
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
