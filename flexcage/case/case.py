"""The case: all that is asked of one simulation, composed of the rooms' own specs.

``Case`` is the registry: one field more is one section more, in TOML, in ``replace``, in the hash.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import pi
from pathlib import Path
from typing import Any

from flexcage.case.checks import check_case, refuse_without_motion
from flexcage.case.files import absolute, bytes_of, file_paths, with_files
from flexcage.case.presets import NAMED
from flexcage.case.read import read_case
from flexcage.case.read_values import assumptions, files_of
from flexcage.case.sections import CAGE_MODELS as CAGE_MODELS
from flexcage.case.sections import NO_CAGE, OF_CAGE, CaseSections
from flexcage.case.static import StaticCase
from flexcage.case.tables import (
    ALIASES,
    as_table,
    refuse_name,
    with_preset,
    without_aliases,
    without_cage,
    words_of_text,
)
from flexcage.core import html
from flexcage.core.binding import (
    Binder,
    check_spec,
    chosen_names,
    flat,
)
from flexcage.core.hashing import content_hash
from flexcage.core.registry import source_of
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.system.statics.options import StaticOptions

_FEW = 8  # values of a list that a notebook shows
_NOT_PHYSICS = ("name", "description", "preset", "heat", "static", "given")
_MOUNTED = ("bearing", "load")  # which [fit] changes: what follows of it counts
#: Sections in the order of texts and pages; others follow.
_ORDER = (
    "name", "description", "preset", "bearing", "fit", "cage", "cage_model", "defects", "mesh",
    "modes", "lubricant", "contacts", "drive", "load", "mount", "constraints", "start", "solver",
    "output", "sensors", "limits", "seed", "given", "inner_ring", "outer_ring", "life",
    "heat", "static",
)  # fmt: skip


@dataclass(frozen=True, kw_only=True, repr=False)
class Case(CaseSections, StaticCase):
    """One simulation: bearing, cage and defects, and how they are meshed, driven and solved.

    Frozen: ``case.replace("cage.pocket_width", "8.25 mm")`` gives a varied copy. Every case is
    checked when it is made; an impossible one raises InputError with one sentence.
    """

    def check(self) -> None:
        """Raise InputError for the first thing in the case that cannot be."""
        check_spec(self)
        check_case(self)

    @classmethod
    def from_preset(cls, preset: str, **sections: Any) -> Case:
        """Case from a preset's bearing, cage and contacts; ``sections`` are specs or tables."""
        return cls.from_table(
            {**sections, "bearing": {"preset": preset, **as_table(sections.get("bearing", {}))}},
            si=True,
        )

    @classmethod
    def from_table(
        cls, table: Mapping[str, Any], *, folder: Path | None = None, si: bool = False
    ) -> Case:
        """Case from nested tables as TOML gives them; ``folder`` is where relative paths start."""
        merged = without_cage(with_preset(without_aliases(table)))
        merged.setdefault("given", sorted(path for path, _ in flat(without_aliases(table))))
        refuse_without_motion(merged.get("bearing"))
        merged = with_files(merged, folder or Path.cwd(), file_paths(Case))
        binder = Binder(named=NAMED, si=si)
        with words_of_text():
            return binder.bind(cls, _with_cage(merged, binder), "")

    def _prepared(self, where: str, value: Any, binder: Binder) -> Any:
        if where == "bearing":
            refuse_name(value)
            refuse_without_motion(value)
        if where == "cage" and isinstance(value, Mapping):
            with words_of_text():
                kind = type(self.cage) if self.cage else self.bearing.cage_spec
                return binder.bind(kind, value, "cage", base=self.cage)
        if where in file_paths(Case) and isinstance(value, (str, Path)):
            return absolute(value, Path.cwd(), where)
        return value

    def _agreed(self, values: dict[str, Any]) -> dict[str, Any]:
        if values["cage_model"] != NO_CAGE or values["cage"] is None:
            return values
        given = [path for path in values["given"] or () if path.partition(".")[0] not in OF_CAGE]
        return {**values, "cage": None, "given": None if values["given"] is None else (*given,)}

    def to_table(self) -> dict[str, Any]:
        """Nested tables of texts with units, complete: nothing is left to defaults, but [static],
        which no run reads."""
        table = super().to_table()
        model = table.pop("cage_model")
        table["cage"] = {"model": model, **table.get("cage", {})}
        if self.static == StaticOptions():
            del table["static"]
        return {f.name: table[f.name] for f in sections() if f.name in table}

    @cached_property
    def hash(self) -> str:
        """16 digits that name the case's physics and outputs; names and words do not count.

        Mesh and bodies of the user's own count by their bytes, wherever they lie; a law or basis
        of the user's own by the file that defines it. Attachments count where there are any: not
        with a rigid cage or round pockets.
        """
        left_out = (*_NOT_PHYSICS, "fit")
        names = [f.name for f in dataclasses.fields(self) if f.name not in left_out]
        physics = {name: getattr(self, name) for name in names}
        physics |= {name: getattr(self.mounted, name) for name in _MOUNTED}
        if not self.life.given:
            del physics["life"]
        if not self.sensors:
            del physics["sensors"]
        physics["contacts"] = dataclasses.replace(self.contacts, land=self.land)
        if self.cage is not None:
            physics |= self._cage_physics(self.cage)
        else:
            physics = {k: v for k, v in physics.items() if k not in OF_CAGE}
        contents = {path: bytes_of(value) for path, value in self.files.items()}
        for path in filter(contents.get, contents):
            room, _, name = path.partition(".")
            physics[room] = dataclasses.replace(physics[room], **{name: ""})
        mesh = contents.pop("mesh.file", b"")
        outside = sorted(filter(None, {source_of(name) for name in chosen_names(self)}))
        return content_hash(physics, mesh, *outside, *contents.items())

    def _cage_physics(self, cage: Cage) -> dict[str, Any]:
        """What of a cage and its modes counts in the hash."""
        modes = self.modes.damped_as(cage.warm_material)
        if self.cage_model == "rigid" or not cage.has_faces:
            modes = dataclasses.replace(modes, attachments="linear")
        if cage.temperature is None:
            return {"modes": modes}
        return {"cage": dataclasses.replace(cage, material=cage.warm_material), "modes": modes}

    @property
    def files(self) -> dict[str, str]:
        """Files that the case names, by path; none of those of a flexible cage if it is rigid."""
        return files_of(self)

    def difference(self, other: Case) -> dict[str, tuple[Any, Any]]:
        """Values of this case and of another that differ and count, by dotted path; None where
        a case has none."""
        mine, its = (
            {k: v for k, v in flat(case.to_table()) if v != []}  # entries speak for a list
            for case in (self, other)
        )
        left_out = (*_NOT_PHYSICS, "bearing.preset")
        keys = (k for k in {**its, **mine} if not {k, k.partition(".")[0]} & {*left_out})
        return {k: (mine.get(k), its.get(k)) for k in keys if mine.get(k) != its.get(k)}

    @property
    def assumptions(self) -> dict[str, str]:
        """Values that count in this case, that no source gives and that nobody gave: path to
        reason. Of a case that was made of objects, a value as by default is one that nobody gave.
        """
        return assumptions(self)

    def __repr__(self) -> str:
        defects = f", {len(self.defects)} defect(s)" if self.defects else ""
        designation = self.bearing.designation or "bearing"
        speed = self.drive.speed * 30.0 / pi
        cage = f"{self.cage_model} {self.cage.material.name} cage" if self.cage else "no cage"
        return (
            f"Case('{self.name}': {designation}, {self.bearing.element_count} "
            f"{self.bearing.element}s, {cage}{defects}, {speed:g} rpm, "
            f"{self.load.radial:g} N, {self.solver.duration:g} s; {self.hash})"
        )

    def _repr_html_(self) -> str:
        """For notebooks: the case in words, and the values that its user gave."""
        from flexcage.case.description import in_words

        in_text = {field: path for path, field in ALIASES.items()}
        given = {in_text.get(path, path) for path in self.given or () if path not in _NOT_PHYSICS}
        rows = [(path, _in_short(v)) for path, v in flat(self.to_table()) if path in given]
        values = html.table(rows, heads=("key", "value"))
        return html.block(
            f"Case {self.name} ({self.hash})",
            html.paragraphs(in_words(self)),
            html.folded("Values given", values) if rows else "",
        )


def _in_short(value: Any) -> str:
    """Text of a value in a file; of a long list, how long it is."""
    if isinstance(value, (list, tuple)) and len(value) > _FEW:
        return f"{len(value)} values"
    return ", ".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)


def _with_cage(table: dict[str, Any], binder: Binder) -> dict[str, Any]:
    """The tables with the cage as a spec: the bearing's type says of which class."""
    if not isinstance(table.get("cage"), Mapping) or "bearing" not in table:
        return table
    bearing = binder.bind(Bearing, table["bearing"], "bearing")
    cage = binder.bind(bearing.cage_spec, table["cage"], "cage")
    return {**table, "bearing": bearing, "cage": cage}


def load_case(
    source: str | Path | Mapping[str, Any] | Case,
    *,
    overrides: Mapping[str, Any] | None = None,
    preset: str | None = None,
) -> Case:
    """Case from a .toml file, TOML text, or nested tables.

    ``overrides`` maps dotted paths to text with units ({"cage.pocket_width": "8.25 mm"});
    ``preset`` takes the place of ``bearing.preset``, as an override of that path does. A mistake
    raises InputError.
    """
    overrides = dict(overrides or {})
    if not isinstance(source, Case):
        preset = overrides.pop("bearing.preset", preset)
    if isinstance(source, Case):
        case = source
    else:
        table, folder = read_case(source)
        if preset is not None:
            table = {**table, "bearing": {**table.get("bearing", {}), "preset": preset}}
        case = Case.from_table(table, folder=folder)
    return case.replace(si=False, **overrides) if overrides else case


def sections() -> list[dataclasses.Field]:
    """Fields of a case in the order of texts and pages."""
    fields = {field.name: field for field in dataclasses.fields(Case)}
    return [fields[name] for name in dict.fromkeys((*_ORDER, *fields))]
