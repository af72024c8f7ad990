"""Which values of a spec does nothing read while its other values are as they are?

Fields say so themselves (``core.spec``: ``when``, and ``of`` for laws); a user who gives a value
that is not read is told.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any

from flexcage.core.binding import join
from flexcage.core.spec import GIVEN, OtherThan, Presence


def unread(spec: Any, where: str = "") -> Iterator[tuple[str, str]]:
    """Dotted paths of values that nothing reads, in a spec and the specs inside it, and why: half a
    sentence. The path of a spec stands for all values in it."""
    for field in dataclasses.fields(spec):
        here, value = join(where, field.name), getattr(spec, field.name)
        if reason := _why_not(spec, field.metadata, where):
            yield here, reason
            continue
        inside = enumerate(value) if isinstance(value, tuple) else [(None, value)]
        for i, item in inside:
            if dataclasses.is_dataclass(item) and not isinstance(item, type):
                yield from unread(item, here if i is None else join(here, i))


def why_unread(path: str, reasons: Mapping[str, str]) -> str:
    """Why nothing reads the value at a path, by the reasons that ``unread`` gave; empty if it is
    read."""
    parts = path.split(".")
    heads = (".".join(parts[: k + 1]) for k in range(len(parts)))
    return next((reasons[head] for head in heads if head in reasons), "")


def _why_not(spec: Any, meta: Mapping[str, Any], where: str) -> str:
    laws = meta.get("of")
    if laws and spec.law not in laws:
        return f"{join(where, 'law')} is '{spec.law}'"
    when = meta.get("when")
    conditions = [when] if isinstance(when, Mapping) else list(when or ())
    broken = [_broken(spec, condition, where) for condition in conditions]
    return broken[-1] if broken and all(broken) else ""


def _broken(spec: Any, condition: Mapping[str, Any], where: str) -> str:
    """Which part of a condition does not hold, in words; empty if it holds."""
    for name, wanted in condition.items():
        value, here = getattr(spec, name), join(where, name)
        if isinstance(wanted, Presence):
            there = value not in (None, "", ()) and value != 0
            if there != (wanted is GIVEN):
                return f"{here} is {'given' if there else 'not given'}"
        elif (value in wanted) is isinstance(wanted, OtherThan):
            return f"{here} is {_shown(value)}"
    return ""


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"'{value}'" if isinstance(value, str) else f"{value}"
