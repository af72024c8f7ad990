"""Tables that a user may add to from outside: laws, bases, outputs, pictures, presets, materials.

A table maps names to values and is a plain dictionary; every kind of thing has its own public
``register...`` function, which ends here. A name once taken stays taken.
"""

from __future__ import annotations

import hashlib
import inspect
import re
from collections.abc import Callable, Mapping, MutableMapping
from pathlib import Path
from typing import Any, TypeVar

from flexcage.core.binding import check_spec
from flexcage.core.errors import InputError

T = TypeVar("T")

_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.+-]*")


_sources: dict[str, str] = {}  # name: fingerprint of what stands behind it


def add(
    table: MutableMapping[str, T],
    name: str,
    value: T,
    *,
    what: str,
    source: Callable[..., Any] | None = None,
) -> T:
    """Put a value under a free name into a table, and return it.

    Raises InputError if the name is taken, or is not a word that a case file can hold. ``what``
    says in errors what the table holds ("normal law"). ``source`` is the function behind a name
    that cases choose: their hashes then change when its file does.
    """
    check_free(table, name, what=what)
    table[name] = value
    if source is not None:
        note_source(name, source)
    return value


def add_sourced(
    table: MutableMapping[str, T], name: str, spec: T, *, what: str, where: str, unsourced: str
) -> T:
    """Put a spec of measured values under a free name into a table, and return it.

    Raises InputError as ``add`` does, for a value out of its bounds, and with the sentence
    ``unsourced`` for a spec without its ``source``.
    """
    check_spec(spec, where)
    if not spec.source:  # type: ignore[attr-defined]
        raise InputError(unsourced, where=f"{where}.source")
    return add(table, name, spec, what=what)


def note_source(name: str, source: Callable[..., Any]) -> None:
    """Remember what stands behind a name from outside: a function, or a class."""
    _sources[name] = _sources.get(name, "") + fingerprint(source)


def source_of(name: str) -> str:
    """Fingerprint of the file behind a name from outside; empty for the program's own names."""
    return _sources.get(name, "")


def check_word(name: str, *, what: str) -> None:
    """Raise InputError unless ``name`` is one word of letters, digits and '_'."""
    if not isinstance(name, str) or not re.fullmatch(r"\w+", name, re.ASCII):
        raise InputError(
            f"The name of a {what} is {name!r}, but must be one word of letters, digits and '_'.",
            where=what,
            value=name,
        )


def check_free(table: Mapping[str, Any], name: str, *, what: str) -> None:
    """Raise InputError unless ``name`` is a word that the table does not hold yet."""
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        raise InputError(
            f"The name of a {what} is {name!r}, but must be one word of letters, digits and '_'.",
            where=what,
            value=name,
        )
    if name in table:
        raise InputError(
            f"A {what} '{name}' exists already; choose another name.", where=what, value=name
        )


def fingerprint(function: Callable[..., Any]) -> str:
    """16 digits that change when the file that defines a function or a class does (or, without
    one, its code).

    For caches that must not outlive a user's edit.
    """
    function = getattr(function, "py_func", function)  # of a compiled one
    source = _source_file(function)
    if source and Path(source).is_file():
        content = Path(source).read_bytes()
    else:
        inside = vars(function).values() if isinstance(function, type) else ()
        found = [getattr(getattr(f, "fget", f), "__code__", None) for f in (function, *inside)]
        codes = [(code.co_code, code.co_consts) for code in found if code]
        content = repr((codes if inside else codes[0]) if codes else function).encode()
    return hashlib.sha256(content).hexdigest()[:16]


def _source_file(function: Callable[..., Any]) -> str | None:
    try:
        return inspect.getsourcefile(function)
    except (TypeError, OSError):  # a class that was typed in
        return None
