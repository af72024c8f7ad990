"""From plain tables (TOML) to frozen specs and back, by the metadata that ``core.spec`` wrote.

A spec knows its units, bounds and choices; this module reads them, so that no room writes a
parser. Values of text carry units; values that are numbers are SI, accepted only from Python.
"""

from __future__ import annotations

import dataclasses
import difflib
import numbers
import os
import re
import types
import typing
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from math import inf, log10
from pathlib import Path
from types import MappingProxyType
from typing import Any, Union

import numpy as np

from flexcage.core.errors import InputError, shown
from flexcage.core.units import describe, format_si, limits_of, parse

MISSING = dataclasses.MISSING
_NUMBERS = {float: numbers.Real, int: numbers.Integral}  # numpy's as well
_PUNCTUATION = re.compile(r"[\s_/.-]")
_LARGEST = 2**63 - 1  # whole number
_IN_WORDS = {
    float: "a number", int: "a whole number", bool: "true or false", str: "text", Path: "a path",
    tuple: "a tuple",
}  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Binder:
    """How tables become specs.

    ``named`` maps a spec type to values that a name may stand for (materials); ``si`` accepts bare
    numbers as SI (from Python, not from text files).
    """

    named: Mapping[type, Mapping[str, Any]] = dataclasses.field(default_factory=dict)
    si: bool = False

    def bind(self, cls: type, table: Any, where: str, *, base: Any = None) -> Any:
        """Spec of type ``cls`` from a table; what the table leaves out comes from ``base``."""
        if dataclasses.is_dataclass(table) and isinstance(table, cls):
            return table
        if not isinstance(table, Mapping):
            if isinstance(table, list) and all(isinstance(row, Mapping) for row in table):
                raise _brackets(where, "a list of tables", "one table", "[{}]", "[[{}]]")
            raise wrong_type(table, "a table of values", where)
        cls = chosen_spec(cls, table, base)
        known = {f.name: f for f in dataclasses.fields(cls) if f.init}
        values = {}
        choosing = choices_of(cls)
        if choosing is not None:  # before its keys, which nothing else explains
            name = known[choosing[0]]
            if name.name in table:
                self.field_value(name, str, table[name.name], join(where, name.name))
            elif base is None and default_of(name) is MISSING:
                raise missing_keys([name], where)
        if base is not None and type(base) is not cls:
            values, base = common_values(base, cls), None
        for key, value in table.items():
            if key not in known:
                raise unknown_key(key, _shown(known), where, _elsewhere(cls, key, where))
            default = getattr(base, key) if base is not None else default_of(known[key])
            path = join(where, key)
            values[key] = self.field_value(known[key], hints(cls)[key], value, path, base=default)
        if base is not None:
            return dataclasses.replace(base, **values)
        lacking = [f for n, f in known.items() if n not in values and default_of(f) is MISSING]
        if lacking:
            raise missing_keys(lacking, where, getattr(cls, "called", "The case"))
        return cls(**values)

    def field_value(
        self, field: dataclasses.Field, hint: Any, value: Any, where: str, *, base: Any = MISSING
    ) -> Any:
        """Value of one field, converted and checked against its bounds and choices."""
        bound = self._value(hint, field.metadata, value, where, base)
        check_value(bound, field.metadata, where)
        return bound

    def _value(self, hint: Any, meta: Mapping, value: Any, where: str, base: Any) -> Any:
        options = union_members(hint)
        if type(None) in options:
            if value is None or value == "none":
                return None
            options = tuple(o for o in options if o is not type(None))
        only = options[0]
        origin = typing.get_origin(only)
        if origin is tuple:
            return self._sequence(typing.get_args(only), meta, value, where)
        if origin in (dict, Mapping):
            if not isinstance(value, Mapping):
                raise wrong_type(value, "a table of values", where)
            inner = typing.get_args(only)[1]
            return {
                k: self._value(inner, meta, v, join(where, k), MISSING) for k, v in value.items()
            }
        if dataclasses.is_dataclass(only):
            return self._spec(typing.cast(type, only), value, where, base)
        return self._scalar(only, meta, value, where)

    def _spec(self, cls: type, value: Any, where: str, base: Any) -> Any:
        names = self.named.get(cls)
        if names and isinstance(value, str):
            if value not in names:
                known_as = replacement_of(value, getattr(cls, "elsewhere", {}))
                hint = known_as or did_you_mean(value, names, "known are")
                raise InputError(
                    f"{where} '{value}' is not known; {hint}.", where=where, value=value
                )
            return names[value]
        if names and isinstance(value, Mapping) and value.get("name") in names:
            return self.bind(cls, value, where, base=names[value["name"]])
        if names:
            base = None if isinstance(value, Mapping) and "name" in value else base
        return self.bind(cls, value, where, base=base if isinstance(base, cls) else None)

    def _sequence(self, kinds: tuple, meta: Mapping, value: Any, where: str) -> tuple:
        if isinstance(value, (str, Mapping)) or not isinstance(value, Iterable):
            if isinstance(value, Mapping) and kinds and dataclasses.is_dataclass(kinds[0]):
                raise _brackets(where, "one table", "a list of tables", "[[{}]]", "[{}]")
            raise wrong_type(value, "a list", where)
        items = list(value)
        if len(kinds) == 2 and kinds[1] is Ellipsis:
            kinds = (kinds[0],) * len(items)
        if len(items) != len(kinds):
            raise InputError(
                f"{where} has {len(items)} values, but needs {len(kinds)}.",
                where=where,
                value=value,
            )
        return tuple(
            self._value(kind, meta, item, join(where, i), MISSING)
            for i, (kind, item) in enumerate(zip(kinds, items))
        )

    def _scalar(self, kind: Any, meta: Mapping, value: Any, where: str) -> Any:
        if isinstance(value, np.generic):
            value = value.item()
        _check_size(value, where)
        unit = meta.get("unit")
        if unit and kind in (float, int):
            number = isinstance(value, (int, float)) and not isinstance(value, bool)
            return float(value) if self.si and number else parse(value, unit, where=where)
        if kind is bool:
            if isinstance(value, bool):
                return value
            raise wrong_type(value, "true or false", where)
        if kind is float:
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                return float(value)
            raise wrong_type(value, "a number", where)
        if kind is int:
            if isinstance(value, int) and not isinstance(value, bool):
                return value
            raise wrong_type(value, "a whole number", where)
        if kind in (str, Path):
            if isinstance(value, (str, Path)):
                return kind(value)
            raise wrong_type(value, "text", where)
        return value


def set_path(spec: Any, path: str, value: Any, binder: Binder, *, where: str = "") -> Any:
    """Copy of a frozen spec with the value at a dotted path ("defects.0.displacement") replaced."""
    head, _, rest = path.partition(".")
    if not dataclasses.is_dataclass(spec) or isinstance(spec, type):
        raise InputError(f"{where} is a single value; '{path}' leads nowhere.", where=where)
    known = {f.name: f for f in dataclasses.fields(spec) if f.init}
    if head not in known:
        raise unknown_key(head, _shown(known), where, _elsewhere(type(spec), head, where))
    here, old = join(where, head), getattr(spec, head)
    field, hint = known[head], hints(type(spec))[head]
    if not rest:
        new = binder.field_value(field, hint, value, here, base=old)
    elif isinstance(old, tuple):
        new = _set_item(old, field, hint, rest, value, binder, here)
    else:
        new = set_path(old, rest, value, binder, where=here)
    return _replaced(spec, head, new, where)


def with_their_choice(spec: Any, changes: Mapping[str, Any]) -> dict[str, Any]:
    """Changes by dotted path, those of a spec joined in one table if one of them is the name that
    chooses the spec: the others may be values that only the chosen one has."""
    joined: dict[str, Any] = {}
    for path, value in changes.items():
        parent, _, key = path.rpartition(".")
        own = _spec_at(spec, parent) if parent else None
        found = choices_of(type(own))
        chosen = changes.get(join(parent, found[0])) if found else None
        same = found is not None and chosen == getattr(own, found[0])
        if chosen is None or same or parent in changes:  # else in the order given
            joined[path] = value
        else:
            joined.setdefault(parent, {})[key] = value
    return joined


def _spec_at(spec: Any, path: str) -> Any:
    """The spec at a dotted path, or None."""
    for key in filter(None, path.split(".")):
        if isinstance(spec, tuple):
            spec = spec[int(key)] if key.isdigit() and int(key) < len(spec) else None
        else:
            spec = getattr(spec, key, None)
    return spec if dataclasses.is_dataclass(spec) else None


def unit_at(spec: Any, path: str) -> str:
    """Unit of the value at a dotted path of a spec; empty if it has none, or is not there."""
    head, _, rest = path.partition(".")
    if isinstance(spec, tuple):
        inside = head.isdigit() and int(head) < len(spec) and bool(rest)
        return unit_at(spec[int(head)], rest) if inside else ""
    fields = getattr(spec, "__dataclass_fields__", {})
    if head not in fields:
        return ""
    return unit_at(getattr(spec, head), rest) if rest else fields[head].metadata.get("unit") or ""


def _replaced(spec: Any, name: str, value: Any, where: str) -> Any:
    """Copy with one value replaced, of another class if the value is a name that brings its own."""
    cls = chosen_spec(type(spec), {name: value}, spec)
    if cls is type(spec):
        return dataclasses.replace(spec, **{name: value})
    values = {**common_values(spec, cls), name: value}
    lacking = [f for f in dataclasses.fields(cls) if f.init and f.name not in values]
    lacking = [f for f in lacking if default_of(f) is MISSING]
    if lacking:
        raise missing_keys(lacking, where)
    return cls(**values)


def chosen_spec(cls: Any, table: Mapping[str, Any], base: Any = None) -> Any:
    """The spec that a table of ``cls`` asks for: one of its names may bring a spec of its own.

    Such a name is a choice from a mapping (``spec.option``); a table without it takes the name
    from ``base``, or the default.
    """
    found = choices_of(cls)
    if found is None:
        return cls
    key, home, choices = found
    default = cls.__dataclass_fields__[key].default if base is None else getattr(base, key)
    name = table.get(key, default)
    own = choices.get(name) if isinstance(name, str) else None
    return own or home


def choices_of(cls: Any) -> tuple[str, Any, Mapping[str, Any]] | None:
    """Field whose name chooses the spec, the class that declared it first, and its choices."""
    for field in dataclasses.fields(cls) if dataclasses.is_dataclass(cls) else ():
        holders = [c for c in cls.__mro__ if field.name in c.__dict__.get("__annotations__", {})]
        home = holders[-1] if holders else cls
        choices = home.__dataclass_fields__[field.name].metadata.get("choices")
        if isinstance(choices, Mapping):
            return field.name, home, choices
    return None


def chosen_names(spec: Any) -> Iterator[str]:
    """The names in a spec, and in all specs inside it, that choose from growing tables."""
    found = choices_of(type(spec))
    if found is not None:
        yield getattr(spec, found[0])
    for field in dataclasses.fields(spec):
        value = getattr(spec, field.name)
        for item in value if isinstance(value, tuple) else (value,):
            if dataclasses.is_dataclass(item) and not isinstance(item, type):
                yield from chosen_names(item)


def common_values(spec: Any, cls: Any) -> dict[str, Any]:
    """Values of a spec that another class of spec has as well."""
    known = {f.name for f in dataclasses.fields(cls) if f.init}
    return {f.name: getattr(spec, f.name) for f in dataclasses.fields(spec) if f.name in known}


def _set_item(
    old: tuple,
    field: dataclasses.Field,
    hint: Any,
    path: str,
    value: Any,
    binder: Binder,
    where: str,
) -> tuple:
    head, _, rest = path.partition(".")
    if not head.isdigit() or int(head) >= len(old):
        have = f"0 to {len(old) - 1}" if old else "none"
        tables = dataclasses.is_dataclass(next(iter(typing.get_args(hint)), None))
        remedy = f", and the case must have [[{where}]] first" if tables and not old else ""
        raise InputError(
            f"{where} has no entry '{head}'; there are {have}{remedy}.", where=where, value=head
        )
    i = int(head)
    items = list(old)
    if rest:
        items[i] = set_path(old[i], rest, value, binder, where=join(where, head))
    else:
        items[i] = value
    return binder.field_value(field, hint, items, where)


def check_spec(spec: Any, where: str = "") -> None:
    """Check kinds, bounds and choices of a spec built from objects, and of all specs inside it."""
    _check_class(spec, where)
    kinds = hints(typing.cast(Any, type(spec)))
    for field in dataclasses.fields(spec):
        value = getattr(spec, field.name)
        here = join(where, field.name)
        _check_kind(value, kinds[field.name], field.metadata, here)
        check_value(value, field.metadata, here)
        items = value if isinstance(value, tuple) else (value,)
        for i, item in enumerate(items):
            if dataclasses.is_dataclass(item) and not isinstance(item, type):
                check_spec(item, join(here, i) if isinstance(value, tuple) else here)


def expect(value: Any, kinds: type | tuple[type, ...], where: str, remedy: str = "") -> None:
    """Raise InputError unless an argument ``where`` is of a kind; ``remedy`` makes one of it."""
    if not isinstance(value, kinds):
        names = " or ".join(k.__name__ for k in (kinds if isinstance(kinds, tuple) else (kinds,)))
        raise wrong_type(value, f"a {names}{'; ' if remedy else ''}{remedy}", where)


def path_of(file: Any, where: str) -> Path:
    """An argument ``where`` as a path, with the home folder in the place of ``~``."""
    expect(file, (str, os.PathLike), where, "the path of a file or folder")
    try:
        return Path(file).expanduser()
    except RuntimeError as exc:
        raise InputError(
            f"{where} is '{file}', but there is no user whose home folder that begins with.",
            where=where,
            value=str(file),
        ) from exc


def _check_kind(value: Any, hint: Any, meta: Mapping, where: str) -> None:
    """Raise InputError if a value of a spec is not of the kind that its field declares."""
    options = union_members(hint)
    kinds = [typing.get_origin(option) or option for option in options]
    if isinstance(value, tuple) and tuple in kinds:
        items = typing.get_args(options[kinds.index(tuple)])
        if items[1:] == (Ellipsis,):
            items = items[:1] * len(value)
        if len(items) != len(value):
            raise wrong_type(value, f"{len(items)} values", where)
        for i, (item, kind) in enumerate(zip(value, items)):
            _check_kind(item, kind, meta, join(where, i))
        return
    if any(_is_of(value, kind) for kind in kinds):
        return
    words = (_IN_WORDS.get(k, f"a {k.__name__}") for k in kinds if k is not type(None))
    wanted = " or ".join(words)
    if meta.get("choices"):
        wanted = f"one of {', '.join(meta['choices'])}"
    if meta.get("unit") and isinstance(value, str):
        wanted += " in SI; text with a unit is for replace, tables and files"
    raise wrong_type(value, wanted, where)


def _is_of(value: Any, kind: Any) -> bool:
    if kind is Any:
        return True
    if isinstance(value, (bool, np.bool_)):
        return kind is bool
    return isinstance(value, _NUMBERS.get(kind, kind))


def _check_class(spec: Any, where: str) -> None:
    """Raise InputError if a name in a spec needs values that this class of spec does not hold."""
    found = choices_of(type(spec))
    wanted = chosen_spec(type(spec), {}, spec)
    if found is None or type(spec) is wanted:
        return
    here, name = join(where, found[0]), getattr(spec, found[0])
    check_value(name, {"choices": found[2]}, here)
    raise InputError(
        f"{here} is '{name}', whose values are those of {wanted.__name__}, not of "
        f"{type(spec).__name__}.",
        where=here,
        value=name,
    )


def check_value(value: Any, meta: Mapping, where: str) -> None:
    """Raise InputError if a value is outside its field's bounds or choices."""
    if isinstance(value, tuple):
        for item in value:
            check_value(item, meta, where)
        return
    choices = meta.get("choices")
    if choices and isinstance(value, str) and value not in choices:
        hint = replacement_of(value, meta.get("elsewhere", {}))
        hint = hint or did_you_mean(value, choices, "choose from")
        if _grows(choices) and hint.startswith("choose"):
            hint += ", or load the file that registers it (--use FILE)"
        raise InputError(f"{where} '{value}' is not known; {hint}.", where=where, value=value)
    if isinstance(value, str) and "\0" in value:
        raise InputError(
            f"{where} is {value!r}, but text has no NUL characters.", where=where, value=value
        )
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return
    _check_size(value, where)
    unit = meta.get("unit", "")
    least, most = limits_of(unit) if value not in (inf, -inf) else (0.0, inf)
    text = (lambda v: describe(v, unit)) if unit else (lambda v: f"{v:g}")
    above, low, high = meta.get("above"), meta.get("minimum"), meta.get("maximum")
    wrong = ""
    if value != value:
        wrong = "be a number"
    elif above is not None and not value > above:
        wrong = f"be greater than {text(above)}"
    elif low is not None and value < low:
        wrong = f"be {text(low)} or more"
    elif high is not None and value > high:
        wrong = f"be {text(high)} or less"
    elif above == 0.0 and value < least:
        wrong = f"be {text(least)} or more"
    elif abs(value) > most:
        wrong = f"be {text(most)} or less" if value > 0.0 else f"be {text(-most)} or more"
    if wrong:
        raise InputError(f"{where} is {text(value)}, but must {wrong}.", where=where, value=value)


def _grows(choices: Any) -> bool:
    """Whether a user's file may add to these choices."""
    return isinstance(choices, Mapping) and not isinstance(choices, MappingProxyType)


def _check_size(value: Any, where: str) -> None:
    """Raise InputError for a whole number that no computer word holds."""
    if isinstance(value, int) and abs(value) > _LARGEST:
        raise InputError(
            f"{where} is a whole number of about {round(value.bit_length() * log10(2.0))} digits, "
            f"but must be {_LARGEST} or less.",
            where=where,
        )


def to_table(spec: Any, *, named: Mapping[type, Mapping[str, Any]] | None = None) -> dict[str, Any]:
    """Plain table of a spec: texts with units, names for registered values; None is left out."""
    named = named or {}
    table = {}
    for field in dataclasses.fields(spec):
        if not field.init:
            continue
        value = getattr(spec, field.name)
        if value is None:
            if default_of(field) is not None:
                table[field.name] = "none"
            continue
        table[field.name] = _plain(value, field.metadata, named)
    return table


def _plain(value: Any, meta: Mapping, named: Mapping) -> Any:
    if isinstance(value, tuple):
        return [_plain(v, meta, named) for v in value]
    if isinstance(value, Mapping):
        return {k: _plain(v, meta, named) for k, v in value.items()}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        registered = named.get(type(value), {})
        name = getattr(value, "name", None)
        if name in registered and registered[name] == value:
            return name
        return to_table(value, named=named)
    if isinstance(value, np.generic):
        value = value.item()
    unit = meta.get("unit")
    if unit and isinstance(value, (int, float)) and not isinstance(value, bool):
        return format_si(value, unit)
    return str(value) if isinstance(value, Path) else value


@cache
def hints(cls: Any) -> dict[str, Any]:
    """Resolved annotations of a spec's fields."""
    return typing.get_type_hints(cls)


def union_members(hint: Any) -> tuple:
    """Members of a union annotation, or the annotation alone."""
    if typing.get_origin(hint) in (Union, types.UnionType):
        return typing.get_args(hint)
    return (hint,)


def default_of(field: dataclasses.Field) -> Any:
    """Default of a field, MISSING if it has none."""
    if field.default is not MISSING:
        return field.default
    return field.default_factory() if field.default_factory is not MISSING else MISSING


def join(where: str, key: object) -> str:
    """Dotted path."""
    return f"{where}.{key}" if where else str(key)


def flat(table: Any, where: str = "") -> list[tuple[str, Any]]:
    """Dotted path and value of every entry of nested tables; entries of lists of tables are
    numbered, as "defects.0.displacement"."""
    rows: list[tuple[str, Any]] = []
    for key, value in table.items():
        path = join(where, str(key))
        if isinstance(value, list) and value and all(hasattr(entry, "items") for entry in value):
            value = dict(enumerate(value))
        rows += flat(value, path) if hasattr(value, "items") else [(path, value)]
    return rows


def _shown(fields: Mapping[str, dataclasses.Field]) -> list[str]:
    """Names of the fields that files may have."""
    return [name for name, field in fields.items() if not field.metadata.get("hidden")]


def _elsewhere(cls: Any, key: str, where: str) -> dict[str, str]:
    """What there is in the place of a key, by pattern; at the root, the sections that have it."""
    found = dict(getattr(cls, "elsewhere", {}))
    kinds = {} if where else hints(cls)
    rooms = [
        f"{name}.{key}"
        for name, hint in kinds.items()
        if any(key in _names_below(kind) for kind in union_members(hint))
    ]
    if rooms:
        found[re.escape(key)] = f"it stands in a section, as {' or '.join(rooms)}"
    return found


def _names_below(kind: Any) -> set[str]:
    """Names of the fields of a dataclass and of those derived from it; none of other types."""
    if not (isinstance(kind, type) and dataclasses.is_dataclass(kind)):
        return set()
    own = {field.name for field in dataclasses.fields(kind)}
    return own.union(*map(_names_below, kind.__subclasses__()))


def unknown_key(
    key: str, known: Iterable[str], where: str, elsewhere: Mapping[str, str] = MappingProxyType({})
) -> InputError:
    """Error for a key that a table does not have, with the nearest that it has, or with what there
    is ``elsewhere``, by pattern of the key."""
    place = f" in [{where}]" if where else ""
    hint = replacement_of(key, elsewhere) or did_you_mean(key, known, "known keys are")
    return InputError(
        f"Unknown key '{key}'{place}; {hint}.",
        where=join(where, key),
        value=key,
    )


def missing_keys(
    fields: Sequence[dataclasses.Field], where: str, called: str = "The case"
) -> InputError:
    """Error for all values of one table that must be given and are not; ``called``: the root."""
    place = f"[{where}]" if where else called
    first, names = fields[0], [_in_words(field) for field in fields]
    text = f"{', '.join(names[:-1])} and {names[-1]}" if names[1:] else names[0]
    choices = first.metadata.get("choices") if not names[1:] else None
    remedy = f"choose from {', '.join(sorted(choices))}" if choices else "give "
    remedy += "" if choices else "them" if names[1:] else "it"
    return InputError(f"{place} lacks {text}; {remedy}.", where=join(where, first.name))


def _in_words(field: dataclasses.Field) -> str:
    """Name of a field, what it is and a unit that it may have."""
    doc, unit = field.metadata.get("doc"), field.metadata.get("unit")
    about = ", ".join(filter(None, (doc, unit and f"in {unit}")))
    return f"'{field.name}' ({about})" if about else f"'{field.name}'"


def _brackets(where: str, found: str, wanted: str, right: str, wrong: str) -> InputError:
    """Error for a table where a list of tables belongs, or the other way round."""
    return InputError(
        f"{where} is {found}, but should be {wanted}: write {right.format(where)} in place of "
        f"{wrong.format(where)}.",
        where=where,
    )


def wrong_type(value: Any, wanted: str, where: str) -> InputError:
    """Error for a value of another kind than its field or argument."""
    return InputError(
        f"{where} is {shown(value)}, but should be {wanted}.", where=where, value=value
    )


def replacement_of(name: str, elsewhere: Mapping[str, str]) -> str:
    """What flexcage has in the place of a name; empty if no pattern matches it."""
    found = (text for pattern, text in elsewhere.items() if re.fullmatch(pattern, name, re.I))
    return next(found, "")


def did_you_mean(text: str, known: Iterable[str], otherwise: str) -> str:
    """The nearest of known names, or ``otherwise`` and all of them."""
    names = [str(k) for k in known]
    close = near_names(text, names, 1)
    return f"the nearest known one is '{close[0]}'" if close else f"{otherwise} {', '.join(names)}"


def near_names(text: str, known: Iterable[str], most: int = 3, *, cutoff: float = 0.6) -> list[str]:
    """At most so many known names that are like a text, the nearest first, whatever their case; if
    none is, those that are when spaces and strokes do not count either."""
    names = list(known)
    for plain in (str.casefold, lambda name: _PUNCTUATION.sub("", name.casefold())):
        meant: dict[str, list[str]] = {}
        for name in names:
            meant.setdefault(plain(name), []).append(name)
        if close := difflib.get_close_matches(plain(text), meant, n=most, cutoff=cutoff):
            return [name for key in close for name in meant[key]][:most]
    return []


def parts_of_length(spec: Any) -> list[float]:
    """Values [m] of a spec's fields whose unit is a length, as it is given or by default."""
    lengths = ("m", "mm", "um", "nm")
    values = [
        getattr(spec, f.name) for f in dataclasses.fields(spec) if f.metadata.get("unit") in lengths
    ]
    return [value for value in values if isinstance(value, float)]
