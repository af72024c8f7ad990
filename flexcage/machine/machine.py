"""The spec of a machine, from TOML or tables: shaft, bearings in their places, drive, gravity.

Bearings are cases (``case.StaticCase``): of a file, of a preset, of the catalogue, or described in
place. What stands in [[bearings]] beside the place is a section of that case and counts before it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from flexcage.case.catalogue import find
from flexcage.case.files import absolute, with_files
from flexcage.case.new import new_case
from flexcage.case.presets import NAMED
from flexcage.case.read import is_machine, read_machine
from flexcage.case.static import StaticCase, put
from flexcage.case.tables import merged, without_aliases
from flexcage.case.toml import write_toml
from flexcage.core.binding import Binder, check_spec, default_of, flat, to_table, unknown_key
from flexcage.core.errors import InputError
from flexcage.core.spec import option
from flexcage.core.toml import read_toml
from flexcage.machine.checks import check_machine
from flexcage.machine.seated import SeatedBearing
from flexcage.machine.spec import BearingPlace, Gravity, Housing, Shaft, Whirl
from flexcage.results.options import OutputOptions
from flexcage.solve.options import SolverOptions
from flexcage.system.spec import Drive, Mount

__all__ = ["Machine", "SeatedBearing", "is_machine", "load_machine"]

_OWN_PLACE = {f.name for f in dataclasses.fields(BearingPlace)}
_TABLES = ("drive", "gravity", "shaft", "housing", "whirl", "solver", "output")
_FILES = ("housing.body", "housing.body_nodes", "shaft.body", "shaft.body_nodes")
_NOT_OF_A_BEARING = ("name", "description", "drive", "load")
#: Sections of a bearing that its run alone reads.
_OF_MOTION = ("cage", "mesh", "modes", "defects", "start", "limits", "seed")
_SECTIONS = {f.name for f in dataclasses.fields(StaticCase)} - {*_NOT_OF_A_BEARING, "preset"}
_SECTIONS |= {*_OF_MOTION}
_ELSEWHERE = {
    r"loads?|forces?": "loads are [[shaft.loads]]",
    r"discs?|disks?|wheels?": "discs are [[shaft.discs]]",
    r"sections?": "sections are [[shaft.sections]]",
    r"bearing": "a machine's bearings are a list, [[bearings]]",
    r"speed": "it is drive.speed",
    r"housings|mount": "a housing of one bearing is [bearings.mount], one of several [housing]",
    r"fits?|contacts|lubricant|static|life": "it stands with a bearing, as [bearings.NAME_OF_IT]",
}


@dataclass(frozen=True, kw_only=True)
class Machine:
    """A shaft in its bearings. Raises InputError for what cannot be."""

    called: ClassVar[str] = "The machine"
    elsewhere: ClassVar[Mapping[str, str]] = _ELSEWHERE

    name: str = option("machine", doc="name, for titles and folders")
    description: str = option("", doc="what this machine is for")
    drive: Drive = option(Drive(speed=0.0), doc="what turns the shaft")
    gravity: Gravity = option(Gravity(), doc="gravity on shaft and discs")
    shaft: Shaft = option(doc="the shaft, what it carries, what loads it")
    bearings: tuple[SeatedBearing, ...] = option(doc="the bearings, one table each")
    housing: Housing = option(Housing(), doc="one body with the seats of several bearings")
    whirl: Whirl = option(Whirl(), doc="speeds of the linearised machine")
    solver: SolverOptions = option(SolverOptions(), doc="the integrator of a run")
    output: OutputOptions = option(OutputOptions(), doc="what is kept of a run")

    def __post_init__(self) -> None:
        for name in _TABLES:
            check_spec(getattr(self, name), name)
        for bearing in self.bearings:
            check_spec(bearing.place, f"bearings.{bearing.place.name}")
        check_machine(self)

    @property
    def speed(self) -> float:
        """Speed of the shaft [rad/s] at the start of the drive."""
        return self.drive.at_start

    @classmethod
    def from_table(
        cls, table: Mapping[str, Any], *, folder: Path | None = None, si: bool = False
    ) -> Machine:
        """Machine of nested tables; ``folder`` is where relative paths start."""
        binder, paths = Binder(named=NAMED, si=si), _FILES
        table = with_files(dict(table), folder or Path.cwd(), paths)
        known = {f.name: f for f in dataclasses.fields(cls)}
        for key in table:
            if key not in known:
                raise unknown_key(key, known, "", _ELSEWHERE)
        rows = table.get("bearings", [])
        if not isinstance(rows, list) or not all(isinstance(row, Mapping) for row in rows):
            raise InputError(
                "bearings should be a list of tables: write [[bearings]] before each.",
                where="bearings",
            )
        if "shaft" not in table or not rows:
            lacking = "[shaft]" if "shaft" not in table else "[[bearings]]"
            raise InputError(f"The machine lacks {lacking}; give it.", where=lacking.strip("[]"))
        values = {
            name: binder.bind(kind, table[name], name, base=base)
            for name, kind, base in (
                ("drive", Drive, Drive(speed=0.0)), ("gravity", Gravity, None),
                ("shaft", Shaft, None), ("whirl", Whirl, None), ("housing", Housing, None),
                ("solver", SolverOptions, None), ("output", OutputOptions, None),
            )
            if name in table
        }  # fmt: skip
        for name in ("name", "description"):
            if name in table:
                values[name] = binder.field_value(known[name], str, table[name], name)
        drive = values.get("drive", default_of(known["drive"]))
        reader = _Reader(binder, drive, folder or Path.cwd())
        values["bearings"] = tuple(reader.bearing(row, k) for k, row in enumerate(rows))
        return cls(**values)

    @property
    def files(self) -> dict[str, str]:
        """Files that the machine itself names, beside those of its bearings, by path."""
        tables = {"housing": self.housing, "shaft": self.shaft}
        found = {path: getattr(tables[path.partition(".")[0]], path.partition(".")[2])
                 for path in _FILES}  # fmt: skip
        return {path: file for path, file in found.items() if file}

    def replace(self, changes: Mapping[str, Any]) -> Machine:
        """Varied copy by dotted path, values as text with units: ``{"drive.speed": "3000 rpm",
        "bearings.A.axial_offset": "5 um", "shaft.loads.0.force": ["0 N", "1 kN", "0 N"]}``."""
        return Machine.from_table(_with(self.to_table(), changes))

    def to_table(self) -> dict[str, Any]:
        """Nested tables of texts with units that read back to an equal machine."""
        table: dict[str, Any] = {"name": self.name, "description": self.description}
        for name in _TABLES if self.housing.body else (n for n in _TABLES if n != "housing"):
            table[name] = to_table(getattr(self, name), named=NAMED)
        rows = []
        for seated in self.bearings:
            own = to_table(seated.place)
            case = seated.case.to_table()
            case["mount"] = to_table(seated.case.mount)
            own = {k: v for k, v in own.items() if k not in ("case", "preset", "designation")}
            own |= {k: v for k, v in case.items() if k not in _NOT_OF_A_BEARING}
            rows.append(own | {k: v for k, v in seated.table.items() if k in _OF_MOTION})
        return {**table, "bearings": rows}

    def to_toml(self) -> str:
        """The machine as TOML text that reads back to an equal one."""
        return write_toml(self.to_table())


@dataclass(frozen=True)
class _Reader:
    """Reads [[bearings]]; ``drive`` is the machine's."""

    binder: Binder
    drive: Drive
    folder: Path

    def bearing(self, row: Mapping[str, Any], k: int) -> SeatedBearing:
        where = f"bearings.{k}"
        for key in row:
            if key not in _OWN_PLACE | _SECTIONS:
                known = sorted({*_OWN_PLACE, *_SECTIONS} - {"given"})
                raise unknown_key(key, known, where, BearingPlace.elsewhere)
        own = {"name": chr(ord("A") + k % 26), **{k: v for k, v in row.items() if k in _OWN_PLACE}}
        for key in ("preset", "designation", "name"):  # many are digits alone
            if isinstance(own.get(key), int) and not isinstance(own[key], bool):
                own[key] = str(own[key])
        place: BearingPlace = self.binder.bind(BearingPlace, own, where)
        try:
            own_tables = {key: v for key, v in row.items() if key in _SECTIONS}
            case, table, folder = self._case(place, own_tables)
        except InputError as exc:
            if str(exc.where or "").startswith("drive."):  # the machine's
                raise
            raise InputError(
                f"In [[bearings]] '{place.name}': {exc}", where=where, value=exc.value
            ) from exc
        return SeatedBearing(place=place, case=case, table=table, folder=folder)

    def _case(
        self, place: BearingPlace, sections: dict[str, Any]
    ) -> tuple[StaticCase, dict[str, Any], Path]:
        """The case, its tables, and where their relative paths start."""
        named = [key for key in ("case", "preset", "designation") if getattr(place, key)]
        if len(named) > 1:
            raise InputError(f"{' and '.join(named)} both name the bearing; keep one of them.")
        if not named and "bearing" not in sections:
            raise InputError(
                "the bearing is not named; give case, preset or designation, or its dimensions in "
                "[bearings.bearing]."
            )
        table, folder = self._named(place)
        table = {
            k: v for k, v in table.items() if k not in ("name", "description", "drive", "load")
        }
        table = merged(table, sections)
        mount = table.get("mount", {})
        own = sections if place.designation else table  # of which the rest is inferred
        turning = {"given": [path for path, _ in flat(without_aliases(own))], **table}
        turning["drive"] = to_table(self.drive, named=NAMED)
        case = StaticCase.from_table(turning, folder=folder, si=self.binder.si)
        whole: Mount = self.binder.bind(Mount, mount, "mount") if mount else case.mount
        body = {f: getattr(case.mount, f) for f in ("body", "body_nodes")}
        case = dataclasses.replace(
            case, drive=self.drive, mount=dataclasses.replace(whole, **body),
            name=place.name, given=case.given,
        )  # fmt: skip
        return case, table, folder

    def _named(self, place: BearingPlace) -> tuple[dict[str, Any], Path]:
        """Tables of the case that a place names, and where their relative paths start."""
        if place.case:
            from flexcage.case.read import read_case

            table, folder = read_case(Path(absolute(place.case, self.folder, "case")))
            return table, folder or self.folder
        if place.preset:
            return {"bearing": {"preset": place.preset}}, self.folder
        if place.designation:
            entry = find(place.designation)
            text = new_case(entry.outline, entry.source).text
            return read_toml(text, place.designation), self.folder
        return {}, self.folder


def load_machine(
    source: str | Path | Mapping[str, Any], *, overrides: Mapping[str, Any] | None = None
) -> Machine:
    """Machine from a .toml file, TOML text, or nested tables.

    ``overrides`` maps dotted paths to text with units; a bearing is meant by its number from 0 or
    its name (``bearings.A.axial_offset``). A mistake raises InputError.
    """
    table, folder = read_machine(source)
    return Machine.from_table(_with(table, overrides or {}), folder=folder)


def _with(table: Mapping[str, Any], changes: Mapping[str, Any]) -> Mapping[str, Any]:
    """Tables with values at dotted paths replaced."""
    for path, value in changes.items():
        keys = path.split(".")
        rows = table.get("bearings", [])
        if keys[0] == "bearings" and len(keys) > 2 and not keys[1].isdigit():
            names = [str(r.get("name", chr(ord("A") + k))) for k, r in enumerate(rows)]
            if keys[1] not in names:
                raise InputError(
                    f"'{path}' names no bearing of the machine; they are {', '.join(names)}.",
                    where=path,
                )
            keys[1] = str(names.index(keys[1]))
        table = put(table, keys, value, path)
    return table
