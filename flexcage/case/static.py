"""The case of a static solution: a bearing of any type, its load and its speed.

A simulation's case (``case.Case``) is one of these with a cage and what moves it; both read the
same files.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Self

from flexcage.case.checks import check_static_case
from flexcage.case.files import file_paths, with_files
from flexcage.case.frozen import explain
from flexcage.case.presets import NAMED
from flexcage.case.read import read_case
from flexcage.case.sections import CaseSections, StaticSections
from flexcage.case.tables import (
    ALIASES,
    as_pairs,
    with_preset,
    without_aliases,
    without_cage,
    words_of_text,
)
from flexcage.core import html
from flexcage.core.binding import (
    Binder,
    check_spec,
    default_of,
    flat,
    set_path,
    to_table,
    unknown_key,
    with_their_choice,
)
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import check_type
from flexcage.geometry.other_kinds import SURROUNDINGS

_STATIC_MOUNT = ("body", "body_nodes", "body_units", "seat", "seat_tie")


@dataclass(frozen=True, kw_only=True)
class StaticCase(StaticSections):
    """What a static solution is asked: bearing, contacts, load, speed and options.

    Of ramps and tables over time the start counts. Without [drive] the bearing stands still.
    """

    def __post_init__(self) -> None:
        explain(self)
        self.check()

    def check(self) -> None:
        """Raise InputError for the first thing in the case that cannot be."""
        check_spec(self)
        check_static_case(self)

    @classmethod
    def from_table(
        cls, table: Mapping[str, Any], *, folder: Path | None = None, si: bool = False
    ) -> StaticCase:
        """Case from nested tables as TOML gives them; ``folder`` is where relative paths start."""
        merged = with_preset(without_aliases(table))
        merged = with_files(merged, folder or Path.cwd(), file_paths(StaticCase))
        own = {f.name for f in dataclasses.fields(StaticCase)}
        known = own | _of_a_simulation()
        for key in merged:
            if key not in known:
                raise unknown_key(
                    key, sorted(known - {*ALIASES.values(), "given"}), "", SURROUNDINGS
                )
        binder = Binder(named=NAMED, si=si)
        bearing = merged.get("bearing")
        if isinstance(bearing, Mapping):
            check_type(bearing.get("type"))
        with words_of_text():
            asked = {k: v for k, v in merged.items() if k in own}
            asked["mount"] = _body_alone(merged.get("mount", {}))
            asked["given"] = _read_paths(without_aliases(table), own)
            case: StaticCase = binder.bind(StaticCase, asked, "")
            if "cage" in without_cage(merged):
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
    ) -> Self:
        """Varied copy: ``replace("load.radial", "2 kN")``, or ``replace({path: value})`` and
        ``replace(**{path: value})`` for several at once.

        A path is dotted ("defects.0.displacement"); a value is text with its unit, an SI number
        (unless ``si`` is False), a spec, or a table. All changes are made before the check.
        """
        pairs = self._given({**as_pairs(path, value), **changes})
        binder = Binder(named=NAMED, si=si)
        kind: Any = type(self)
        bare = _unchecked(kind)(**_values(self))
        for where, new in with_their_choice(bare, pairs).items():
            if where in ("bearing.preset", "preset"):
                raise InputError(
                    "bearing.preset cannot be replaced in a case that has its values already; "
                    "write a case for each preset, and of a study one study for each case.",
                    where="bearing.preset",
                    value=new,
                )
            new = bare._prepared(where, new, binder)
            with words_of_text():
                bare = set_path(bare, ALIASES.get(where, where), new, binder)
        return kind(**bare._agreed(_values(bare)))

    def _given(self, pairs: dict[str, Any]) -> dict[str, Any]:
        """Values to replace, and among them the paths of all that the user gave."""
        if self.given is None or "given" in pairs:
            return pairs
        return {**pairs, "given": tuple(sorted({*self.given, *_given_by(pairs)}))}

    def _prepared(self, where: str, value: Any, binder: Binder) -> Any:
        """A value to replace, as it is set."""
        return value

    def _agreed(self, values: dict[str, Any]) -> dict[str, Any]:
        """Replaced values of all sections, without those of a section that another one excludes."""
        return values

    def to_table(self) -> dict[str, Any]:
        """Nested tables of texts with units, complete but for rings, fits, lives and heat as by
        default."""
        table = to_table(self, named=NAMED)
        for name in ("inner_ring", "outer_ring", "fit", "life", "heat"):
            if getattr(self, name) == default_of(StaticCase.__dataclass_fields__[name]):
                del table[name]
        if not self._in_motion:
            table["mount"] = _body_alone(table["mount"]) if self.mount.body else {}
            table = {name: section for name, section in table.items() if section != {}}
        preset = table.pop("preset")
        if preset:
            table["bearing"] = {"preset": preset, **table["bearing"]}
        return table

    def to_toml(self) -> str:
        """The case as TOML text that reads back to an equal case."""
        from flexcage.case.toml import write_toml

        return write_toml(self.to_table())

    def _repr_html_(self) -> str:
        """For notebooks: what differs from a case of the bearing alone."""
        bare = dict(flat(dataclasses.replace(self, **_asked_nothing()).to_table()))
        rows = [(k, v) for k, v in flat(self.to_table()) if bare.get(k) != v]
        title = f"Static case {self.name}: {self.bearing.designation or self.bearing.kind}"
        return html.block(title, html.table(rows, heads=("key", "value")))


def _body_alone(mount: Any) -> Any:
    """What a static solution reads of [mount]: the housing's body and its seat."""
    if not isinstance(mount, Mapping):
        return mount
    return {name: value for name, value in mount.items() if name in _STATIC_MOUNT}


def _read_paths(table: Mapping[str, Any], own: set[str]) -> list[str]:
    """Paths of the values that were given in a case's tables, those that a static solution reads;
    tables that were written as complete name them."""

    def is_read(path: str) -> bool:
        head, _, name = path.partition(".")
        return head in own and (head != "mount" or name in _STATIC_MOUNT)

    named = table.get("given")  # none: all that stands there was
    return sorted(filter(is_read, [path for path, _ in flat(table)] if named is None else named))


def _asked_nothing() -> dict[str, Any]:
    """Sections as by default."""
    names = (
        "contacts", "lubricant", "drive", "load", "inner_ring", "outer_ring", "mount", "static",
        "fit", "life", "heat",
    )  # fmt: skip
    return {name: default_of(StaticCase.__dataclass_fields__[name]) for name in names}


def _of_a_simulation() -> set[str]:
    """Sections that only a simulation reads; a static solution checks the cage, ignores others."""
    kinds = (CaseSections, StaticCase)
    simulated, still = ({f.name for f in dataclasses.fields(cls)} for cls in kinds)
    return simulated - still


def _given_by(pairs: Mapping[str, Any]) -> Iterator[str]:
    """Paths of the values that changes give, those of a table or a spec one by one."""
    for path, value in pairs.items():
        if isinstance(value, Mapping):
            yield from (inner for inner, _ in flat(value, path))
        elif dataclasses.is_dataclass(value):
            yield from _differing(value, path)
        yield path


def _differing(spec: Any, where: str) -> Iterator[str]:
    """Paths of the values of a spec, and of specs inside it, that are not as by default."""
    for field in dataclasses.fields(spec):
        value, path = getattr(spec, field.name), f"{where}.{field.name}"
        if value != default_of(field):
            inside = dataclasses.is_dataclass(value) and not isinstance(value, type)
            yield from _differing(value, path) if inside else (path,)


def _values(case: StaticCase) -> dict[str, Any]:
    return {f.name: getattr(case, f.name) for f in dataclasses.fields(case)}


@cache
def _unchecked(cls: Any) -> Any:
    """A class for cases between two changes, which are possible only when all changes are made."""
    return type(f"Unchecked{cls.__name__}", (cls,), {"check": lambda self: None})


def load_static(
    source: str | Path | Mapping[str, Any], *, overrides: Mapping[str, Any] | None = None
) -> StaticCase:
    """Case of a static solution from a .toml file, TOML text, or nested tables.

    ``overrides`` maps dotted paths to text with units. A mistake raises InputError.
    """
    table, folder = read_case(source)
    of_a_simulation = _of_a_simulation() - {"cage"}
    for path, value in (overrides or {}).items():
        head, _, name = path.partition(".")
        if head in of_a_simulation or (head == "mount" and name not in _STATIC_MOUNT):
            raise InputError(
                f"'{path}' takes no part in a static solution; leave it out.", where=path
            )
        table = put(table, path.split("."), value, path)
    return StaticCase.from_table(table, folder=folder)


def put(table: Mapping[str, Any], keys: list[str], value: Any, path: str) -> dict[str, Any]:
    """Copy of nested tables with one value replaced, also one of a table in a list."""
    head, *rest = keys
    if not rest:
        return {**table, head: value}
    below = table.get(head, {})
    if isinstance(below, list) and rest[0].isdigit() and int(rest[0]) < len(below):
        places = {str(k): item for k, item in enumerate(below)}
        return {**table, head: [*put(places, rest, value, path).values()]}
    if isinstance(below, str):
        below = {"name": below}  # a material by name, of which a value is overridden
    if not isinstance(below, Mapping):
        raise InputError(
            f"'{path}' leads nowhere here: a table or an entry on its way is not there.", where=path
        )
    return {**table, head: put(below, rest, value, path)}
