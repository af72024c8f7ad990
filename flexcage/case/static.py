"""The case of a static solution: a bearing of any type, its load and its speed.

It reads the same files as a simulation's case; sections that only a simulation wants are passed
over, and the cage is checked against the bearing but takes no part.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from flexcage.case.case import (
    Case,
    as_pairs,
    varied,
    with_preset,
    without_aliases,
    words_of_text,
)
from flexcage.case.checks import check_static_case
from flexcage.case.load import read_case
from flexcage.case.presets import NAMED
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.core.binding import Binder, check_spec, to_table, unknown_key
from flexcage.core.errors import InputError
from flexcage.core.spec import option
from flexcage.geometry.bearing import Bearing, check_type
from flexcage.system.spec import Drive, Load
from flexcage.system.statics.options import StaticOptions


@dataclass(frozen=True, kw_only=True)
class StaticCase:
    """What a static solution is asked: bearing, contacts, load, speed and options.

    Of ramps and tables over time the start counts. Without [drive] the bearing stands still.
    """

    name: str = option("case", doc="name, for titles and folders")
    description: str = option("", doc="what this case is for")
    preset: str = option("", doc="preset that the case started from")
    bearing: Bearing = option(doc="the bearing")
    contacts: Contacts = option(Contacts(), doc="rollers' slices and stiffness factor at races")
    lubricant: Lubricant = option(Lubricant(), doc="what makes a film where the bearing turns")
    drive: Drive = option(Drive(speed=0.0), doc="speed of the inner ring")
    load: Load = option(Load(), doc="what loads the inner ring")
    static: StaticOptions = option(StaticOptions(), doc="how equilibrium is meant")

    def __post_init__(self) -> None:
        check_spec(self)
        check_static_case(self)

    @property
    def speed(self) -> float:
        """Speed of the inner ring [rad/s] at the start."""
        return self.drive.at_start

    @classmethod
    def from_table(cls, table: Mapping[str, Any], *, si: bool = False) -> StaticCase:
        """Case from nested tables as TOML gives them."""
        merged = with_preset(without_aliases(table))
        own = {f.name for f in dataclasses.fields(cls)}
        known = own | {f.name for f in dataclasses.fields(Case)}
        for key in merged:
            if key not in known:
                raise unknown_key(key, [*known - {"cage_model", "preset"}], "")
        binder = Binder(named=NAMED, si=si)
        bearing = merged.get("bearing")
        if isinstance(bearing, Mapping):
            check_type(bearing.get("type"))
        with words_of_text():
            case = binder.bind(cls, {k: v for k, v in merged.items() if k in own}, "")
            if "cage" in merged:
                cage = binder.bind(case.bearing.cage_spec, merged["cage"], "cage")
                check_spec(cage, "cage")
                case.bearing.check(cage)
        return case

    def replace(
        self,
        path: str | Mapping[str, Any] | None = None,
        value: Any = None,
        /,
        *,
        si: bool = True,
        **changes: Any,
    ) -> StaticCase:
        """Varied copy, as by ``Case.replace``: ``replace("load.radial", "2 kN")``, or
        ``replace({path: value})`` and ``replace(**{path: value})`` for several at once."""
        return varied(self, _Unchecked, {**as_pairs(path, value), **changes}, si=si)

    def to_table(self) -> dict[str, Any]:
        """Nested tables of texts with units, complete."""
        table = to_table(self, named=NAMED)
        preset = table.pop("preset")
        if preset:
            table["bearing"] = {"preset": preset, **table["bearing"]}
        return table

    def to_toml(self) -> str:
        """The case as TOML text that ``load_static`` reads back to an equal case."""
        from flexcage.case.toml import write_toml

        return write_toml(self.to_table())


class _Unchecked(StaticCase):
    """A case between two changes: possible only when all of them are made."""

    def __post_init__(self) -> None:
        pass


_CASE_ONLY = {f.name for f in dataclasses.fields(Case)} - {
    f.name for f in dataclasses.fields(StaticCase)
}


def load_static(
    source: str | Path | Mapping[str, Any], *, overrides: Mapping[str, Any] | None = None
) -> StaticCase:
    """Case of a static solution from a .toml file, TOML text, or nested tables.

    ``overrides`` maps dotted paths to text with units. A mistake raises InputError.
    """
    table, _ = read_case(source)
    for path, value in (overrides or {}).items():
        head = path.partition(".")[0]
        if head in _CASE_ONLY and head != "cage":
            raise InputError(
                f"'{path}' takes no part in a static solution; leave it out.", where=path
            )
        table = _put(table, path.split("."), value, path)
    return StaticCase.from_table(table)


def _put(table: Mapping[str, Any], keys: list[str], value: Any, path: str) -> dict[str, Any]:
    """Copy of nested tables with one value replaced; lists are not part of static cases."""
    head, *rest = keys
    if not rest:
        return {**table, head: value}
    below = table.get(head, {})
    if isinstance(below, str):
        below = {"name": below}  # a material by name, of which a value is overridden
    if not isinstance(below, Mapping):
        raise InputError(f"'{path}' leads nowhere in the case of a static solution.", where=path)
    return {**table, head: _put(below, rest, value, path)}
