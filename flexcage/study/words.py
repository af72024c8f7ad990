"""Paths of a case in words, as charts and tables of a page name them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from flexcage.geometry.defect import DEFECTS

_TURNED = ("load.radial", "load.axial")  # which read better the other way round


def in_words(path: str, base: Mapping[str, Any], varied: Iterable[str] = ()) -> str:
    """A path in words: "crossbeam 5 displacement" for "defects.0.displacement", "radial load" for
    "load.radial". ``base`` are the case's tables; the part of a defect has no number where its
    number is one of the paths that are ``varied``."""
    parts = path.split(".")
    if path in _TURNED:
        return " ".join(reversed(parts))
    if parts[0] == "defects" and len(parts) == 3 and parts[1].isdigit():
        entries = base.get("defects") or []
        number = int(parts[1])
        entry = entries[number] if number < len(entries) else None
        if isinstance(entry, Mapping):
            return _of_defect(entry, parts, set(varied))
    return " ".join(parts).replace("_", " ")


def _of_defect(entry: Mapping[str, Any], parts: list[str], varied: set[str]) -> str:
    kind = str(entry.get("type", "defect"))
    part = str(getattr(DEFECTS.get(kind), "part", ""))
    if parts[2] == part:
        return f"number of the {part}"
    known = part in entry and ".".join([*parts[:2], part]) not in varied
    place = f"{part} {entry[part]}" if known else part
    what = kind.replace("_", " ") if kind != part else ""
    return " ".join(filter(None, (place, what, parts[2].replace("_", " "))))
