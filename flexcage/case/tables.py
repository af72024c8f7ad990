"""Nested tables of a case's text: presets, aliases, paths and values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from typing import Any

from flexcage.case.presets import NAMED, Preset, load_preset
from flexcage.case.sections import NO_CAGE
from flexcage.core.binding import chosen_spec, to_table
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import BEARING_TYPES

# In text the cage's model stands with the cage; the preset, with the bearing.
ALIASES = {"cage.model": "cage_model", "bearing.preset": "preset"}


def without_aliases(table: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of a text with its aliases replaced by the fields that they stand for."""
    plain = dict(table)
    for alias, field in ALIASES.items():
        room, key = alias.split(".")
        section = plain.get(room)
        if isinstance(section, Mapping) and key in section:
            plain[room] = {k: v for k, v in section.items() if k != key}
            plain[field] = section[key]
    return plain


def with_preset(table: dict[str, Any]) -> dict[str, Any]:
    """Tables of the preset that a case names, overridden by its own."""
    name, bearing = table.get("preset"), table.get("bearing")
    refuse_name(bearing)
    if isinstance(name, int) and not isinstance(name, bool):
        name = str(name)  # many designations are
        table = {**table, "preset": name}
    if not name:
        return dict(table)
    if not isinstance(name, str):
        raise InputError(f"bearing.preset is {name!r}, but should be text.", where="bearing.preset")
    preset = load_preset(name)
    _refuse_other_type(preset, bearing)
    return merged(_without_other_cage(preset, table), table)


def without_cage(table: dict[str, Any]) -> dict[str, Any]:
    """Tables of a bearing without a cage, if these say so, without its values."""
    if NO_CAGE not in (table.get("cage_model"), table.get("cage")):
        return table
    return {key: value for key, value in table.items() if key != "cage"} | {"cage_model": NO_CAGE}


def _refuse_other_type(preset: Preset, bearing: Any) -> None:
    """InputError for a type of bearing that has not the dimensions of the preset's."""
    own = bearing.get("type") if isinstance(bearing, Mapping) else None
    spec = BEARING_TYPES.get(own) if isinstance(own, str) else None
    if spec is None:
        return  # the preset's, or none that there is
    if preset.tables["bearing"].keys() - {field.name for field in fields(spec)}:
        raise InputError(
            f"bearing.type is '{own}', but the preset {preset.name} is one of type "
            f"'{preset.bearing.type}'; leave out bearing.type, or bearing.preset.",
            where="bearing.type",
            value=own,
        )


def refuse_name(bearing: Any) -> None:
    """InputError for a bearing that is a name alone: it says how a preset is named."""
    if isinstance(bearing, str):
        raise InputError(
            f"bearing is '{bearing}', but should be a table of values; a preset is named as "
            f'bearing.preset = "{bearing}".',
            where="bearing",
            value=bearing,
        )


def _without_other_cage(preset: Preset, table: Mapping[str, Any]) -> Mapping[str, Any]:
    """A preset's tables without values of its cage that the kind a case asks for has not."""
    own, cage = table.get("cage"), preset.tables.get("cage")
    if not isinstance(own, Mapping) or "type" not in own or not isinstance(cage, Mapping):
        return preset.tables
    known = chosen_spec(preset.bearing.cage_spec, own).__dataclass_fields__
    return {**preset.tables, "cage": {k: v for k, v in cage.items() if k in known}}


def merged(low: Mapping[str, Any], high: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of ``low`` overridden by ``high``, table by table; a name in ``low`` is one too."""
    both = dict(low)
    for key, value in high.items():
        below = both.get(key)
        if isinstance(value, Mapping) and isinstance(below, str):
            below = {"name": below}  # a material by name, of which some values are overridden
        deeper = isinstance(value, Mapping) and isinstance(below, Mapping)
        both[key] = merged(below, value) if deeper else value  # type: ignore[arg-type]
    return both


def as_pairs(path: Any, value: Any) -> dict[str, Any]:
    """Values by dotted path, from one path and its value or a mapping of them."""
    table = path if isinstance(path, Mapping) else {path: value}
    if path is None and value is None:
        return {}
    for key in table:
        if not isinstance(key, str):
            raise InputError(
                f"replace needs dotted paths, such as 'drive.speed', not {key!r}.", value=key
            )
    if table is path and value is not None:
        raise InputError(
            f"replace needs a path and its value, or a table of them alone, not also {value!r}.",
            value=value,
        )
    return dict(table)


@contextmanager
def words_of_text() -> Iterator[None]:
    """Name values in errors as the text does: cage.model, not cage_model."""
    try:
        yield
    except InputError as exc:
        for alias, field in ALIASES.items():
            if exc.where == field:
                raise InputError(
                    str(exc).replace(field, alias, 1), where=alias, value=exc.value
                ) from exc
        raise


def as_table(section: Any) -> Mapping[str, Any]:
    return section if isinstance(section, Mapping) else to_table(section, named=NAMED)
