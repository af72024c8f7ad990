"""Which values of a case count: the files that it names, and what is assumed."""

from __future__ import annotations

import dataclasses
from typing import Any

from flexcage.case.files import file_paths
from flexcage.case.presets import load_preset
from flexcage.case.sections import CaseSections
from flexcage.case.unread import reasons
from flexcage.core.binding import default_of
from flexcage.core.unread import why_unread


def files_of(case: CaseSections) -> dict[str, str]:
    """Files that the case names, by path; none of those of a flexible cage if it is rigid."""
    paths = file_paths(CaseSections)
    named = {path: _at(case, path) for path in paths if _at(case, path)}
    return {path: file for path, file in named.items() if _reads(case, path)}


def assumptions(case: CaseSections) -> dict[str, str]:
    """Values that count, that no source gives and that nobody gave: path to reason."""
    found = dict(_standing_assumptions(case, ""))
    if case.preset:
        preset = load_preset(case.preset)
        for path, reason in preset.assumptions.items():
            room, _, rest = path.partition(".")
            origin = getattr(preset, room)
            if (value := _at(case, path)) is not None and value == _at(origin, rest):
                found[path] = reason
    given = set() if case.given is None else set(case.given)
    return {k: v for k, v in found.items() if k not in given and _reads(case, k)}


def _reads(case: CaseSections, path: str) -> bool:
    """Does anything read the value at a dotted path, in a bearing and cage such as these?"""
    land = case.bearing.land(case.cage) if case.cage else None
    guided = land is not None and case.land.kind != "none"
    if path.startswith("contacts.land") and not guided:
        return False
    return not why_unread(path, reasons(case))


def _at(spec: Any, path: str) -> Any:
    """The value at a dotted path, None where there is none."""
    for key in path.split("."):
        spec = getattr(spec, key, None)
    return spec


def _standing_assumptions(spec: Any, where: str, default: Any = None) -> list[tuple[str, str]]:
    """Path and reason of values that are assumptions, count, and are as ``default`` has them, or
    as their own fields do where the default is a spec of another class."""
    found = []
    for field in dataclasses.fields(spec):
        value = getattr(spec, field.name)
        usual = getattr(default, field.name) if type(default) is type(spec) else default_of(field)
        path = f"{where}.{field.name}" if where else field.name
        reason, laws = field.metadata.get("assumption"), field.metadata.get("of")
        if reason and value == usual and (not laws or spec.law in laws):
            found.append((path, reason))
        if dataclasses.is_dataclass(value):
            found.extend(_standing_assumptions(value, path, usual))
    return found
