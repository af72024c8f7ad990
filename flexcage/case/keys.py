"""Every key of a case: its unit or kind, default and meaning, read from the specs themselves."""

from __future__ import annotations

import dataclasses
import re
import typing
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

from flexcage.case.case import Case, sections
from flexcage.case.presets import NAMED
from flexcage.case.tables import ALIASES
from flexcage.contacts.spec import FrictionLaw, NormalLaw
from flexcage.core.binding import (
    MISSING,
    choices_of,
    default_of,
    did_you_mean,
    hints,
    join,
    to_table,
    union_members,
)
from flexcage.core.errors import InputError
from flexcage.core.listing import Listing
from flexcage.core.units import describe, format_si
from flexcage.geometry.bearing import BEARING_TYPES
from flexcage.geometry.materials import Material

HEADS = ("key", "unit or kind", "default", "meaning")
REQUIRED = "required"
#: Specs that stand at several places: what a place's row calls them, and their section's name.
SHARED: Mapping[type, tuple[str, str]] = {
    NormalLaw: ("normal law", "normal"),
    FrictionLaw: ("friction law", "friction"),
    Material: ("material", "material"),
}
PAGE = """# Keys of a case: {}

Printed by `flexcage keys {}`.

Values are texts with units ("0.2 mm"). A key shows the unit that errors speak in; any other of its
kind does as well. A preset gives values of its own, which count before these defaults
(`flexcage presets NAME`).
"""
_KINDS = {float: "number", int: "whole number", bool: "true, false", str: "text", Path: "path"}
_HIDDEN = ("given",)  # not for files
_OF_COMMAND = {"static": "static", "heat": "warm"}  # sections of one command


@dataclass(frozen=True)
class Key:
    """One key: its dotted path, the unit or kind of its value, default and meaning."""

    path: str
    kind: str
    default: str
    meaning: str


@dataclass(frozen=True)
class Group:
    """Keys that stand together, of one section of a case."""

    section: str
    title: str
    keys: tuple[Key, ...]

    def listing(self) -> Listing:
        rows = [(key.path, key.kind, key.default, key.meaning) for key in self.keys]
        return Listing(self.title, HEADS, rows)


def groups() -> list[Group]:
    """All keys of a case, in the order of its sections; laws and materials come last."""
    fields = [f for f in sections() if f.name not in _HIDDEN]
    moved = {name: path for path, name in ALIASES.items()}
    plain = [f for f in fields if f.name not in moved and not _specs(Case, f)]
    found = [Group("case", "At the top of the file", tuple(_keys_of(Case, plain, "", None)))]
    for field in fields:
        if _specs(Case, field):
            found += _section(field)
    for cls, (name, section) in SHARED.items():
        known = f": {', '.join(NAMED[cls])}, or values of its own" if cls in NAMED else ""
        found += of_spec(section, "", f"A {name}{known}", cls, None)
    return found


def chosen(wanted: str, more: Iterable[Group] = ()) -> list[Group]:
    """Groups of a section; or of all keys whose path or meaning holds the text, ``more`` among
    them. InputError if there are none."""
    every = [*groups(), *more]
    section = [group for group in every if group.section == wanted]
    if section:
        return section
    pattern = re.compile(re.escape(wanted), re.IGNORECASE)
    found = []
    for group in every:
        keys = tuple(k for k in group.keys if pattern.search(k.path) or pattern.search(k.meaning))
        found += [dataclasses.replace(group, keys=keys)] if keys else []
    if not found:
        hint = did_you_mean(wanted, dict.fromkeys(g.section for g in every), "sections are")
        raise InputError(
            f"No section is called '{wanted}', and no key or meaning has this text; {hint}.",
            where="keys",
            value=wanted,
        )
    return found


def contents() -> Listing:
    """The sections, and how many keys each has."""
    docs = {f.name: str(f.metadata.get("doc", "")) for f in sections()}
    docs |= {section: f"a {name}, wherever one stands" for name, section in SHARED.values()}
    docs |= {"case": "name and seed"}
    count: dict[str, int] = {}
    for group in groups():
        count[group.section] = count.get(group.section, 0) + len(group.keys)
    rows = [(name, str(number), docs[name]) for name, number in count.items()]
    return Listing("Sections of a case", ("section", "keys", "what it holds"), rows)


def _section(field: dataclasses.Field) -> Iterator[Group]:
    name, specs, default = field.name, _specs(Case, field), default_of(field)
    if name == "cage":
        yield from _cages()
    elif _is_list(Case, field):
        yield from _listed(name, specs[0])
    else:
        command = _OF_COMMAND.get(name)
        readers = f", read by `flexcage {command}` alone" if command else ""
        yield from of_spec(name, name, f"[{name}]{readers}", specs[0], default)


def _listed(name: str, cls: type) -> Iterator[Group]:
    """Keys of the entries of a list: the one that chooses their kind, then each kind's own."""
    title, (choice, *_) = f"[[{name}]]", choices_of(cls) or ("",)
    own = [f for f in dataclasses.fields(cls) if f.name == choice]
    yield Group(name, title, tuple(_keys_of(cls, own, "", None)))
    for label, kind in _variants(cls):
        fields = [f for f in dataclasses.fields(kind) if f.init and f.name != choice]
        if fields:
            yield Group(name, f"{title}, {label}", tuple(_keys_of(kind, fields, "", None)))


def _cages() -> Iterator[Group]:
    """The cages of all types of bearings."""
    of: dict[type, list[str]] = {}
    for name, bearing in BEARING_TYPES.items():
        of.setdefault(typing.cast(Any, bearing).cage_spec, []).append(name)
    variants = []
    for cls, names in of.items():
        own = [
            (label or f"of {' or '.join(names)} bearings", kind) for label, kind in _variants(cls)
        ]
        variants += own
    yield from _by_owner("cage", "cage", "[cage]", variants, None)


def of_spec(section: str, path: str, title: str, cls: type, default: Any) -> Iterator[Group]:
    """Groups of a spec's keys, and of lists of specs inside it."""
    variants = _variants(cls)
    yield from _by_owner(section, path, title, variants, default)
    for _, kind in variants:
        for field in dataclasses.fields(kind):
            if field.init and _is_list(kind, field):
                for inner in _specs(kind, field):
                    name = join(path, field.name)
                    yield from of_spec(section, "", f"[[{name}]]", inner, None)


def _variants(cls: type) -> list[tuple[str, type]]:
    """The specs that one of a spec's names may choose, and the names in words; or it alone."""
    found = choices_of(cls)
    if found is None:
        return [("", cls)]
    name, home, choices = found
    kinds: dict[type, list[str]] = {}
    for choice, own in choices.items():
        kinds.setdefault(own or home, []).append(f'"{choice}"')
    return [(f"{name} = {' or '.join(n)}", kind) for kind, n in kinds.items()]


def _by_owner(
    section: str, path: str, title: str, variants: list[tuple[str, type]], default: Any
) -> Iterator[Group]:  # fmt: skip
    """Keys grouped by the variants that have them: those of all of them first."""
    owners: dict[Key, list[str]] = {}
    for alias in (a for a in ALIASES if path and a.rpartition(".")[0] == path):
        owners[_alias(alias)] = [label for label, _ in variants]
    for label, kind in variants:
        fields = [f for f in dataclasses.fields(kind) if f.init]
        given = default if isinstance(default, kind) else None
        for key in _keys_of(kind, fields, path, given):
            owners.setdefault(key, []).append(label)
    sets: dict[tuple[str, ...], list[Key]] = {}
    for key, whose in owners.items():
        sets.setdefault(tuple(whose), []).append(key)
    for labels, keys in sorted(sets.items(), key=lambda item: -len(item[0])):
        words = "" if len(labels) == len(variants) else f", {_either(labels)}"
        yield Group(section, title + words, tuple(keys))


def _either(labels: tuple[str, ...]) -> str:
    """Labels joined; what they all begin with, such as "type = ", stands once."""
    name, sign, _ = labels[0].partition(" = ")
    rest = [label.removeprefix(f"{name} = ") for label in labels[1:]]
    return " or ".join([labels[0], *(rest if sign else labels[1:])])


def _alias(path: str) -> Key:
    field = Case.__dataclass_fields__[ALIASES[path]]
    return _key(Case, field, path, None)


def _keys_of(cls: type, fields: list[dataclasses.Field], path: str, given: Any) -> Iterator[Key]:
    """Keys of a spec's fields, those of specs inside it by dotted path; ``given`` is an instance
    that holds the defaults at this place."""
    for field in fields:
        where, specs = join(path, field.name), _specs(cls, field)
        default = getattr(given, field.name) if given is not None else default_of(field)
        nested = len(specs) == 1 and not _is_list(cls, field) and specs[0] not in SHARED
        if nested and choices_of(specs[0]) is None:
            inner = [f for f in dataclasses.fields(specs[0]) if f.init]
            instance = default if dataclasses.is_dataclass(default) else None
            yield from _under(field, _keys_of(specs[0], inner, where, instance))
        else:
            yield _key(cls, field, where, given)


def _under(field: dataclasses.Field, keys: Iterator[Key]) -> Iterator[Key]:
    """The keys of a spec inside another, those of laws with what the whole spec is."""
    laws = [name for name, _ in SHARED.values()]
    for key in keys:
        law = key.kind in laws and key.meaning == key.kind
        yield dataclasses.replace(key, meaning=str(field.metadata.get("doc"))) if law else key


def _key(cls: type, field: dataclasses.Field, path: str, given: Any) -> Key:
    meta, specs = field.metadata, _specs(cls, field)
    choosing = choices_of(cls)
    if choosing and choosing[0] == field.name and given is None:
        field = choosing[1].__dataclass_fields__[field.name]  # alike for all that it chooses
    default = getattr(given, field.name) if given is not None else default_of(field)
    meaning = "; ".join(filter(None, (str(meta.get("doc", "")), _allowed(meta), _readers(meta))))
    if _is_list(cls, field):
        return Key(path, "list of tables", "none", f"{meaning}; [[{path}]]")
    if len(specs) == 1 and specs[0] in SHARED:
        return Key(path, SHARED[specs[0]][0], _inline(specs[0], default), meaning)
    return Key(path, _kind(cls, field), _default(default, meta), meaning)


def _kind(cls: type, field: dataclasses.Field) -> str:
    hint = next(m for m in union_members(hints(cls)[field.name]) if m is not type(None))
    inner = typing.get_args(hint)
    many = typing.get_origin(hint) is tuple
    single = inner[0] if many else hint
    word = field.metadata.get("unit") or _KINDS.get(single, "table")
    return f"list of {word}" if many else word


def _default(value: Any, meta: Mapping) -> str:
    if value is MISSING:
        return REQUIRED
    if value is None or value in ((), "", inf):
        return ""
    if isinstance(value, tuple):
        return f"[{', '.join(_default(item, meta) for item in value)}]"
    unit = meta.get("unit")
    if unit:
        return format_si(value, unit)
    return str(value).lower() if isinstance(value, bool) else f"{value:g}" if isinstance(
        value, float
    ) else str(value)  # fmt: skip


def _inline(cls: type, value: Any) -> str:
    """A law or a material in a few characters: its name, and what differs from the name's own."""
    if value is MISSING:
        return REQUIRED
    if value is None:
        return ""
    named = NAMED.get(cls, {})
    if getattr(value, "name", None) in named:
        return value.name
    plain = to_table(dataclasses.replace(type(value)(), law=value.law))
    given = to_table(value)
    return ", ".join([value.law, *(f"{k} {v}" for k, v in given.items() if plain[k] != v)])


def _allowed(meta: Mapping) -> str:
    """The values that a key takes, where its kind alone does not say so."""
    choices = meta.get("choices")
    if choices:
        return f"one of {', '.join(map(str, choices))}"
    unit, low, high = meta.get("unit", ""), meta.get("minimum"), meta.get("maximum")
    low = low if low is not None else meta.get("above") or None

    def text(value: float) -> str:
        return describe(value, unit) if unit else f"{value:g}"

    if high is not None and low is not None:
        return f"{text(low)} to {text(high)}"
    if high is not None:
        return f"at most {text(high)}"
    return f"at least {text(low)}" if low else ""


def _readers(meta: Mapping) -> str:
    return f"of {', '.join(meta['of'])}" if meta.get("of") else ""


def _specs(cls: type, field: dataclasses.Field) -> list[type]:
    """Specs that a field holds, one or a list of them."""
    members = union_members(hints(cls)[field.name])
    if _is_list(cls, field, of_specs=False):
        members = union_members(typing.get_args(members[0])[0])
    return [m for m in members if dataclasses.is_dataclass(m) and isinstance(m, type)]


def _is_list(cls: type, field: dataclasses.Field, *, of_specs: bool = True) -> bool:
    first = union_members(hints(cls)[field.name])[0]
    many = typing.get_origin(first) is tuple
    return many and (not of_specs or bool(_specs(cls, field)))
