"""Threads: BLAS gets one (two that wait for busy cores took twenty times longer), solves many."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from contextvars import ContextVar
from functools import wraps
from typing import Any, ParamSpec, TypeVar

_CORES: ContextVar[int] = ContextVar("cores", default=os.cpu_count() or 1)
P = ParamSpec("P")
R = TypeVar("R")


def one_blas_thread(function: Callable[P, R]) -> Callable[P, R]:
    """The function, with BLAS held to one thread while it runs."""

    @wraps(function)
    def limited(*args: P.args, **kwargs: P.kwargs) -> R:
        from threadpoolctl import threadpool_limits

        with threadpool_limits(limits=1, user_api="blas"):
            return function(*args, **kwargs)

    return limited


def on_one_core(function: Callable[P, R]) -> Callable[P, R]:
    """The function, with one thread for BLAS and for ``on_all_cores``: others use the machine."""

    @wraps(function)
    def alone(*args: P.args, **kwargs: P.kwargs) -> R:
        token = _CORES.set(1)
        try:
            return one_blas_thread(function)(*args, **kwargs)
        finally:
            _CORES.reset(token)

    return alone


def on_all_cores(work: Callable[[Any], Any], items: Iterable[Any]) -> list[Any]:
    """Results of ``work`` for every item, in order, by a thread a core.

    For work that spends its time in libraries that let other threads run meanwhile.
    """
    with ThreadPoolExecutor(max_workers=_CORES.get()) as pool:
        return list(pool.map(work, items))
