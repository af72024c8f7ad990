"""Reading TOML text: cases, studies, presets, and values on the command line."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from flexcage.core.errors import InputError

_ESCAPE = re.compile(r"backslash|[Ee]scape|hex")  # of tomllib's reasons
_DEEPEST = 20  # tables and lists in one another; a case has five


def read_toml(text: str, name: str, *, where: str = "") -> dict[str, Any]:
    """Tables of a TOML text; ``name`` is what a sentence calls it. Raises InputError."""
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as exc:
        reason = str(exc).rstrip(".")
        if _ESCAPE.search(reason):
            reason += (
                "; in double quotes a backslash begins a special character: write a path as "
                "'C:\\folder\\file' in single quotes, or with '/'"
            )
        raise InputError(f"{name} is not valid TOML: {reason}.", where=where) from exc
    except ValueError as exc:  # Python reads whole numbers of up to 4300 digits
        raise InputError(
            f"{name} has a whole number of thousands of digits; no value is as large.", where=where
        ) from exc
    except RecursionError as exc:
        raise _too_deep(name, where) from exc
    level: list[Any] = [table]
    for _ in range(_DEEPEST):
        level = [inner for outer in level for inner in _inside(outer)]
    if level:
        raise _too_deep(name, where)
    return table


def _inside(value: Any) -> list[Any]:
    """Tables and lists directly inside a table or list."""
    items = value.values() if isinstance(value, dict) else value
    return [item for item in items if isinstance(item, (dict, list))]


def _too_deep(name: str, where: str) -> InputError:
    return InputError(
        f"{name} has tables or lists more than {_DEEPEST} deep in one another; a bracket may be "
        "missing.",
        where=where,
    )
