"""Warnings of a run: what a reader of its figures must know. One list, made once.

``warnings_at_start`` looks at what is to be computed, ``warnings_at_end`` at what was found; each
entry is a function of values that yields warnings, and one line adds one. Terminal,
``summary.txt``, ``summary.json``, pages and studies show the list as it is.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict
from typing import Any, TypeVar

from flexcage.contacts.spec import LandSpec
from flexcage.core.errors import InputError
from flexcage.core.reading import json_of
from flexcage.core.warning import RunWarning
from flexcage.geometry.cage import Cage

Facts = TypeVar("Facts")


def warnings_of(
    checks: Iterable[Callable[[Facts], Iterator[RunWarning]]], facts: Facts
) -> tuple[RunWarning, ...]:
    """What the checks have to say, in their order."""
    return tuple(warning for check in checks for warning in check(facts))


def to_text(warnings: Iterable[RunWarning]) -> str:
    """Warnings as JSON, for attributes of a store."""
    return json.dumps([asdict(warning) for warning in warnings])


def from_attrs(attrs: Mapping[str, Any]) -> tuple[RunWarning, ...]:
    """Those that a run's store holds from its start."""
    try:
        return tuple(RunWarning(**values) for values in json_of(attrs["warnings"]))
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            f"The warnings that the run's results hold cannot be read ({error}); bring the folder "
            "back from a copy, or run the case again.",
            where="path",
        ) from error


def has_land(cage: Cage, land: LandSpec) -> bool:
    """Can the cage touch a ring's land?"""
    return land.kind != "none" and cage.has_land
