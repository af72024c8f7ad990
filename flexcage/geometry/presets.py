"""Presets: bearings with their cage and contacts, kept as TOML beside this module.

A preset is a set of tables that a case starts from and overrides; one more .toml file in the
data folder is one more preset.
"""

from __future__ import annotations

import difflib
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Any

from flexcage.core.binding import Binder
from flexcage.core.errors import InputError
from flexcage.core.units import parse
from flexcage.geometry.cages import WindowCage
from flexcage.geometry.catalogue import dynamic_rating, static_rating
from flexcage.geometry.cylindrical_roller import RollerBearing
from flexcage.geometry.materials import MATERIALS, Material

# specs that text may give by name
NAMED: Mapping[type, Mapping[str, Any]] = MappingProxyType({Material: MATERIALS})

_META = ("preset", "assumptions", "sources")


@dataclass(frozen=True)
class Preset:
    """A named starting point: tables as written, and which of their values are assumptions.

    ``static_rating`` and ``dynamic_rating`` are the catalogue's [N]; ``assumptions`` maps a
    dotted path ("cage.pocket_width") to the reason for the value chosen.
    """

    name: str
    title: str
    tables: Mapping[str, Any]
    assumptions: Mapping[str, str]
    sources: Mapping[str, str]
    static_rating: float
    dynamic_rating: float

    def __repr__(self) -> str:
        return f"Preset('{self.name}': {self.title})"

    @property
    def bearing(self) -> RollerBearing:
        return Binder(named=NAMED).bind(RollerBearing, self.tables["bearing"], "bearing")

    @property
    def cage(self) -> WindowCage:
        return Binder(named=NAMED).bind(WindowCage, self.tables["cage"], "cage")

    def ratings(self) -> list[tuple[str, float, float]]:
        """Name, catalogue value and value from the preset's own inside [N] of both ratings."""
        bearing = self.bearing
        return [
            ("static rating C0r, ISO 76", self.static_rating, static_rating(bearing)),
            ("dynamic rating Cr, ISO 281", self.dynamic_rating, dynamic_rating(bearing)),
        ]


def _folder() -> Any:
    return resources.files("flexcage.geometry") / "data"


def preset_names() -> list[str]:
    """Names of all presets."""
    return sorted(p.name.removesuffix(".toml") for p in _folder().iterdir() if p.suffix == ".toml")


@cache
def load_preset(name: str) -> Preset:
    """Preset by name; an unknown name is an InputError that tells the nearest."""
    names = preset_names()
    if name not in names:
        near = difflib.get_close_matches(name.upper(), names, n=1, cutoff=0.5)
        hint = f"the nearest known one is '{near[0]}'" if near else f"known are {', '.join(names)}"
        raise InputError(
            f"bearing.preset '{name}' is not known; {hint}.", where="bearing.preset", value=name
        )
    data = tomllib.loads((_folder() / f"{name}.toml").read_text("utf-8"))
    meta = data["preset"]
    return Preset(
        name=meta["name"],
        title=meta["title"],
        tables=MappingProxyType({k: v for k, v in data.items() if k not in _META}),
        assumptions=MappingProxyType(data.get("assumptions", {})),
        sources=MappingProxyType(data.get("sources", {})),
        static_rating=parse(meta["static_rating"], "kN", where="static_rating"),
        dynamic_rating=parse(meta["dynamic_rating"], "kN", where="dynamic_rating"),
    )
