"""How many threads work is spread over."""

from __future__ import annotations

import threading
import time

from flexcage.core.threads import on_all_cores, on_one_core


def _threads() -> int:
    """Threads that took part in work which waits."""

    def name(_):
        time.sleep(0.02)
        return threading.current_thread().name

    return len(set(on_all_cores(name, range(8))))


def test_results_keep_their_order():
    assert on_all_cores(lambda x: x * x, range(20)) == [x * x for x in range(20)]


def test_a_worker_among_others_takes_one_thread():
    before = _threads()
    assert on_one_core(_threads)() == 1
    assert _threads() == before
