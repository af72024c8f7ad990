"""Reading TOML text: cases, studies, presets, and values on the command line."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable
from typing import Any

from flexcage.core.errors import InputError

_ESCAPE = re.compile(r"backslash|[Ee]scape|hex")  # of tomllib's reasons
_PLACE = re.compile(r"at line (\d+)")
_BARE = re.compile(r"\s*([\w.]+)\s*=\s*([-+.\d]+\s*[^\W\d][^\"'#]*)(?:#.*)?$")  # name = 1 kN
_VALUE = r"""(?:"[^"]*"|'[^']*'|[-+.\w]+|\[[^\]]*\])"""
#: What a line is that TOML does not read, and what to write.
_SLIPS: tuple[tuple[re.Pattern, Callable[[re.Match], str]], ...] = (
    (re.compile(r"[^#]*[\u00a0\u2007\u2009\u202f]"),
     lambda m: "; the line has a blank of another kind (a no-break space): write plain blanks"),
    (re.compile(r"\s*//"), lambda m: "; a comment begins with #"),
    (re.compile(r"\s*[{<]"), lambda m: "; TOML is no JSON or XML: [load] begins a section there, "
     'and radial = "1 kN" gives a value'),
    (re.compile(rf"\s*([\w.]+)\s*:\s*({_VALUE}.*)?$"), lambda m: f"; '=' stands between a name and "
     f"its value: {m[1]} = {m[2]}" if m[2] else "; a section begins in brackets: " f"[{m[1]}]"),
    (re.compile(rf"\s*[\w.]+\s*=\s*{_VALUE}\s*[,;]\s*(?:#.*)?$"),
     lambda m: "; nothing stands after a value: leave out the mark at the line's end"),
    (re.compile(rf"\s*[\w.]+\s*=\s*{_VALUE}[\s,;]+([\w.]+\s*=.*)$"),
     lambda m: f"; each value has a line of its own: begin a new one at {m[1].strip()}"),
    (re.compile(r"\s*([\w.]+)\s*=\s*([^\W\d][^\"'#=\[\]{}]*)(?:#.*)?$"),
     lambda m: f'; text stands in quotes: {m[1]} = "{m[2].strip()}"'),
)  # fmt: skip
_CURLY = "\u201c\u201d\u201e\u00ab\u00bb\u2018\u2019"
_DEEPEST = 20  # tables and lists in one another; a case has five


def read_toml(text: str, name: str, *, where: str = "") -> dict[str, Any]:
    """Tables of a TOML text; ``name`` is what a sentence calls it. Raises InputError."""
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as exc:
        reason = str(exc).rstrip(".")
        reason += _remedy(reason, text)
        raise InputError(f"{name} is not valid TOML: {reason}.", where=where) from exc
    except ValueError as exc:  # Python reads whole numbers of up to 4300 digits
        raise InputError(
            f"{name} has a whole number of thousands of digits; no value is as large.", where=where
        ) from exc
    except RecursionError as exc:
        raise _too_deep(name, where) from exc
    level: list[Any] = [table]
    for _ in range(_DEEPEST):
        level = [inner for outer in level for inner in _nested(outer)]
    if level:
        raise _too_deep(name, where)
    return table


def _remedy(reason: str, text: str) -> str:
    """What to write where TOML stopped, by the mistakes that people make most."""
    if _ESCAPE.search(reason):
        return (
            "; in double quotes a backslash begins a special character: write a path as "
            "'C:\\folder\\file' in single quotes, or with '/'"
        )
    place = _PLACE.search(reason)
    line = _lines(text)[int(place[1]) - 1 :][:1] if place else []
    stopped = line[0] if line else ""
    if twice := re.search(r"Cannot declare \((.*?),?\) twice", reason):
        name = ".".join(part.strip(" '\"") for part in twice[1].split(","))
        return f"; [{name}] stands twice: write all its values under one"
    if any(quote in stopped for quote in _CURLY):
        return '; its quotes are typographic ones: write straight ones, as "1 kN"'
    if bare := _BARE.match(stopped):
        return f'; a value with a unit stands in quotes: {bare[1]} = "{bare[2].strip()}"'
    if stopped.count('"') % 2 or stopped.count("'") % 2:
        return "; a quote is missing at the end of a value"
    return next((said(found) for slip, said in _SLIPS if (found := slip.match(stopped))), "")


def _lines(text: str) -> list[str]:
    return text.replace("\r\n", "\n").split("\n")


def _nested(value: Any) -> list[Any]:
    """Tables and lists directly inside a table or list."""
    items = value.values() if isinstance(value, dict) else value
    return [item for item in items if isinstance(item, (dict, list))]


def _too_deep(name: str, where: str) -> InputError:
    return InputError(
        f"{name} has tables or lists more than {_DEEPEST} deep in one another; a bracket may be "
        "missing.",
        where=where,
    )
