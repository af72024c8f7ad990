"""Presets: bearings with their cage and contacts, kept as TOML in the folder data.

A preset is a set of tables that a case starts from and overrides; one more .toml file in the
data folder is one more preset, and ``register_preset`` adds a user's own file.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Any

from flexcage.case.sections import CaseSections
from flexcage.core.binding import (
    Binder,
    expect,
    near_names,
    path_of,
    replacement_of,
    unknown_key,
)
from flexcage.core.errors import InputError
from flexcage.core.registry import add, check_free
from flexcage.core.texts import text_of
from flexcage.core.toml import read_toml
from flexcage.core.units import parse
from flexcage.geometry.bearing import OTHER_DESIGNS, Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.geometry.other_kinds import kind_of

# specs that text may give by name
NAMED: Mapping[type, Mapping[str, Any]] = MappingProxyType({Material: MATERIALS})

_META = ("preset", "assumptions", "sources")
_ABOUT = ("name", "title", "static_rating", "dynamic_rating", "mass")  # keys of [preset]
_ALIKE = 0.65  # of a name and a preset's, from which on the preset may be meant
_ADDED: dict[str, Preset] = {}  # by register_preset


@dataclass(frozen=True)
class Preset:
    """A named starting point: tables as written, and which of their values are assumptions.

    ``static_rating`` and ``dynamic_rating`` are the catalogue's [N], None where it gives none;
    ``assumptions`` maps a dotted path ("cage.pocket_width") to the reason for the value chosen.
    """

    name: str
    title: str
    tables: Mapping[str, Any]
    assumptions: Mapping[str, str]
    sources: Mapping[str, str]
    static_rating: float | None
    dynamic_rating: float | None

    def __repr__(self) -> str:
        return f"Preset('{self.name}': {self.title})"

    @property
    def bearing(self) -> Bearing:
        """The bearing: the spec that its ``type`` chooses."""
        return Binder(named=NAMED).bind(Bearing, self.tables["bearing"], "bearing")

    @property
    def cage(self) -> Cage:
        """The cage: the spec that goes with the bearing's type."""
        return Binder(named=NAMED).bind(self.bearing.cage_spec, self.tables["cage"], "cage")

    def ratings(self) -> list[tuple[str, float, float]]:
        """Name, catalogue value and value from the preset's own inside [N] of both ratings."""
        bearing = self.bearing
        static, dynamic = bearing.rating_names
        rows = (
            (f"static rating {static}, ISO 76", self.static_rating, bearing.static_rating),
            (f"dynamic rating {dynamic}, ISO 281", self.dynamic_rating, bearing.dynamic_rating),
        )
        return [(name, stated, own) for name, stated, own in rows if stated is not None]


def _folder() -> Any:
    return resources.files("flexcage.case") / "data"


def _shipped() -> list[str]:
    return [p.name.removesuffix(".toml") for p in _folder().iterdir() if p.suffix == ".toml"]


def preset_names() -> list[str]:
    """Names of all presets, those registered included."""
    return sorted([*_shipped(), *_ADDED])


def load_preset(name: str) -> Preset:
    """Preset by name; an unknown name is an InputError that tells the nearest."""
    expect(name, str, "preset")
    if name in _ADDED:
        return _ADDED[name]
    names = preset_names()
    if name not in names:
        raise InputError(
            f"bearing.preset '{name}' is not known; {_near_preset(name, names)}presets are "
            f"{', '.join(names)}, and any other bearing is described by its dimensions in "
            f"[bearing] and [cage]{_instead_of_preset(name)}.",
            where="bearing.preset",
            value=name,
        )
    return _load_shipped(name)


def _near_preset(name: str, names: list[str]) -> str:
    close = near_names(name, names, 2, cutoff=_ALIKE)
    return f"the nearest is {' or '.join(repr(n) for n in close)}; " if close else ""


def _instead_of_preset(name: str) -> str:
    """What else there is of a bearing that no preset describes, as the end of a sentence."""
    from flexcage.case.catalogue import find, known  # late: it imports what needs presets

    instead = replacement_of(name, OTHER_DESIGNS)
    design = f"; {instead}" if instead else ""
    try:
        designation = find(name).outline.designation
    except InputError:
        declined = kind_of(name)
        if not declined and known(name):
            return f": 'flexcage new {name}' writes such a case, from your maker's ratings"
        return design if instead or not declined else f"; '{name}' {declined}"
    return f": 'flexcage new {designation}' writes such a case{design}"


@cache
def _load_shipped(name: str) -> Preset:
    return _preset(
        read_toml((_folder() / f"{name}.toml").read_text("utf-8"), f"The preset '{name}'")
    )


def register_preset(path: str | Path) -> Preset:
    """Add a user's own preset, a TOML file like those in the data folder; returns it.

    The file has [preset] with ``name`` and ``title`` (and the catalogue's ``static_rating`` and
    ``dynamic_rating``, if it gives any), complete [bearing] and [cage] tables, further tables of
    a case where wanted, and [assumptions] and [sources]. ``bearing.preset = "name"`` in a case
    then starts from it. Raises InputError for a file that cannot be read, a name that is taken, or
    a bearing and cage that cannot be.
    """
    path = path_of(path, "preset")
    try:
        text = text_of(path, "a preset is TOML", where="preset")
    except OSError as exc:
        reason = exc.strerror or exc
        raise InputError(f"The preset '{path}' cannot be read: {reason}.", where="preset") from exc
    table = read_toml(text, f"The preset '{path}'", where="preset")
    try:
        _check_keys(table)
        preset = _preset(table)
        check_free(dict.fromkeys(_shipped()), preset.name, what="preset")
        preset.bearing.check(preset.cage)
        _check_assumptions(preset)
    except InputError as exc:
        raise InputError(f"In preset '{path}': {exc}", where=exc.where, value=exc.value) from exc
    return add(_ADDED, preset.name, preset, what="preset")


def _check_keys(data: dict[str, Any]) -> None:
    """InputError for a table that no preset has, and for what [preset] does not say."""
    sections = [field.name for field in dataclasses.fields(CaseSections)]
    known = {"": [*_META, *sections], "preset": _ABOUT}
    for where, table in (("", data), ("preset", data.get("preset", {}))):
        if unknown := [key for key in table if key not in known[where]]:
            raise unknown_key(unknown[0], known[where], where)


def _preset(data: dict[str, Any]) -> Preset:
    meta = data.get("preset", {})
    for table, key in (("preset", "name"), ("preset", "title"), ("bearing", ""), ("cage", "")):
        if not isinstance(data.get(table), dict) or (key and not isinstance(meta.get(key), str)):
            what = f"'{key}' in [{table}]" if key else f"[{table}]"
            raise InputError(f"{what} is missing.", where=table)
    ratings = {
        key: parse(meta[key], "kN", where=f"preset.{key}") if key in meta else None
        for key in ("static_rating", "dynamic_rating")
    }
    return Preset(
        name=meta["name"],
        title=meta["title"],
        tables=MappingProxyType({k: v for k, v in data.items() if k not in _META}),
        assumptions=MappingProxyType(data.get("assumptions", {})),
        sources=MappingProxyType(data.get("sources", {})),
        static_rating=ratings["static_rating"],
        dynamic_rating=ratings["dynamic_rating"],
    )


def _check_assumptions(preset: Preset) -> None:
    for path in preset.assumptions:
        value: Any = preset
        for key in path.split("."):
            value = getattr(value, key, None)
        if path.partition(".")[0] not in ("bearing", "cage") or value is None:
            raise InputError(
                f"[assumptions] names '{path}', but should name values of [bearing] or [cage], "
                'such as "cage.pocket_width".',
                where=f"assumptions.{path}",
            )
