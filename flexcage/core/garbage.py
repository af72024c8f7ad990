"""Python's search for unused objects, paused where many objects are made that live on."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_NEW_OBJECTS = 50_000  # after which they are looked at


@contextmanager
def uncollected() -> Iterator[None]:
    """Python's search for unused objects pauses while something is compiled.

    A compiler makes many objects that live until it is done: a sixth of its time (measured).
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


@contextmanager
def while_loading() -> Iterator[None]:
    """The search pauses while modules are imported, and from then on leaves out what they made:
    it would look through that again and again, for a fifth of the time of all imports (measured).

    For a program's start; once in a process, as what is unused by then is never freed.
    """
    if gc.get_freeze_count():
        yield
        return
    with uncollected():
        yield
    gc.freeze()


@contextmanager
def few_collections() -> Iterator[None]:
    """The search runs less often, and looks at what is new alone: figures are many small objects,
    and it would look again and again through all that a run holds."""
    usual = gc.get_threshold()
    gc.freeze()
    gc.set_threshold(_NEW_OBJECTS, *usual[1:])
    try:
        yield
    finally:
        gc.set_threshold(*usual)
        gc.unfreeze()
