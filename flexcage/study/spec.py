"""The study: a base case, axes along which it varies, repetitions, and the outputs wanted."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

from flexcage._version import __version__
from flexcage.case import Case, load_case, load_extension
from flexcage.case.extensions import not_loaded, sources
from flexcage.case.files import file_paths
from flexcage.case.presets import NAMED
from flexcage.case.read import study_or_map
from flexcage.case.toml import write_toml
from flexcage.core.binding import Binder, check_spec, path_of, to_table, unit_at, wrong_type
from flexcage.core.errors import InputError
from flexcage.core.missing import no_file
from flexcage.core.spec import option, quantity
from flexcage.core.texts import text_of
from flexcage.core.toml import read_toml
from flexcage.core.units import format_si, parse
from flexcage.core.writing import check_name
from flexcage.study.axes import Axis
from flexcage.system.spec import MOST_PUSH

FORMAT = 1  # of a study's file and folder
KEEP = ("runs", "figures")


@dataclass(frozen=True, kw_only=True)
class Repeat:
    """Repetitions of every point, each with its cage pushed off in another random direction.

    The push is far under the speeds at which a cage meets its rollers; contacts amplify it until
    the histories have nothing in common, and their statistics are what repetitions compare.
    """

    count: int = option(1, doc="runs of every point", minimum=1)
    push: float = quantity(
        "mm/s", 1e-3, doc="speed of the cage centre at the start", above=0.0, maximum=MOST_PUSH
    )
    seed: int = option(1, doc="seed of the first repetition's push; each takes the next", minimum=0)


@dataclass(frozen=True, kw_only=True)
class Study:
    """A family of cases: every combination of the axes' points, each ``repeat.count`` times.

    ``outputs`` are figures of a run's summary ("cage_speed") or reductions of result variables
    over the settled part ("pocket_force.max", "element_omega[element=3,spin_axis=axial].mean",
    "pocket_slice_force[slice=16:48].mean" from 16 to before 48), or
    ``outputs.LATE_FIGURES`` ("fatigue_life", "wear_depth_rate").
    ``keep`` is what stays of a case: its whole run, or its figures only.
    """

    called: ClassVar[str] = "The study"

    name: str = option("study", doc="name, for titles and folders")
    case: Case = option(doc="the base case")
    axes: tuple[Axis, ...] = option((), doc="what varies")
    outputs: tuple[str, ...] = option(doc="figures wanted of every case")
    repeat: Repeat = option(Repeat(), doc="repetitions of every point")
    keep: str = option("runs", doc="what stays of a case", choices=KEEP)

    def __post_init__(self) -> None:
        check_name(self.name, "The study's name")
        outputs: Any = (self.outputs,) if isinstance(self.outputs, str) else self.outputs
        object.__setattr__(self, "outputs", tuple(outputs))  # one alone is one
        axes: Any = (self.axes,) if isinstance(self.axes, Axis) else self.axes
        written = partial(_as_text, self.case, si=True)
        object.__setattr__(self, "axes", tuple(axis.mapped(written) for axis in axes))
        check_spec(self)

    def to_toml(self) -> str:
        """The study as TOML text, complete: the base case and the extensions are in it."""
        table = {"format": FORMAT, "use": list(sources()), **to_table(self, named=NAMED)}
        return write_toml({**table, "case": self.case.to_table()})


def load_study(path: str | Path, *, overrides: Mapping[str, Any] | None = None) -> Study:
    """Study from a study.toml; ``overrides`` change its base case, path by path.

    Loads the extensions that the file names under ``use``. A mistake raises InputError.
    """
    path = path_of(path, "study")
    table = read_file(path)
    check_format(table.pop("format", FORMAT), path)
    use_extensions(table, path)
    return _bound(table, path, overrides)


def use_extensions(table: dict[str, Any], path: Path) -> None:
    """Load the extensions that the file ``path`` of a study or map names under ``use``, and take
    that entry out of its table."""
    for source in _listed(table.pop("use", []), "use"):
        load_extension(path.parent / source if source.endswith((".py", ".toml")) else source)


def stored_study(path: Path, text: str | None = None) -> Study:
    """The study of a folder, by its study.toml or another ``text`` of it, which runs no code:
    InputError if files of the user's own are wanted that this process has not loaded."""
    table = stored_table(path, text)
    lacking = not_loaded(table.pop("use"))
    if lacking:
        raise InputError(
            f"The study in '{path.parent}' was planned with {_named(lacking)}, which a study's "
            f"folder never loads by itself; name what you trust: {uses(lacking)} (in Python, "
            "flexcage.load_extension).",
            where="use",
            value=lacking[0],
        )
    return _bound(table, path, None)


def stored_table(path: Path, text: str | None = None) -> dict[str, Any]:
    """The tables of a folder's study.toml, or of another ``text`` of it, with its list ``use`` of
    extensions."""
    table = read_file(path) if text is None else read_toml(text, str(path))
    check_format(table.pop("format", FORMAT), path)
    return {**table, "use": list(map(str, _listed(table.get("use", []), "use")))}


def stored_axes(table: Mapping[str, Any]) -> tuple[Axis, ...]:
    """The axes of a folder's study, whose values are text: no case is needed to read them."""
    return Binder(named=NAMED).bind(_Axes, {"axes": table.get("axes", [])}, "").axes


def stored_repeat(table: Mapping[str, Any]) -> Repeat:
    """The repetitions of a folder's study."""
    return Binder(named=NAMED).bind(Repeat, table.get("repeat", {}), "repeat")


def uses(files: Iterable[str]) -> str:
    """Options of the command line that load extensions."""
    return " ".join(f"--use {file}" for file in files)


def _named(files: list[str]) -> str:
    return ", ".join(f"'{Path(file).name}'" for file in files)


def _bound(table: dict[str, Any], path: Path, overrides: Mapping[str, Any] | None) -> Study:
    check_kind(table, path, "study")
    case = base_case(table.get("case"), path, overrides)
    binder = Binder(named=NAMED)
    axes = [_with_type(axis) for axis in _listed(table.get("axes", []), "axes")]
    bound = binder.bind(_Axes, {"axes": axes}, "").axes
    change = partial(_from_file, case, path.resolve().parent)
    axes = [axis.mapped(change) for axis in bound]
    return binder.bind(Study, {**table, "case": case, "axes": axes}, "")


def check_kind(table: Mapping[str, Any], path: Path, wanted: str) -> None:
    """InputError for a file that is a case, or a map where a study is ``wanted``, or a study where
    a map is: with the command that takes it."""
    if "case" not in table and "bearing" in table:
        raise InputError(
            f"'{path}' is a case, not a {wanted}; take 'flexcage run {path}', or name it in a "
            f'{wanted} as case = "my_case.toml".',
            where="case",
        )
    found, command = study_or_map(table)
    if found != wanted and ("axes" in table) != ("unknowns" in table):
        raise InputError(
            f"'{path}' is a {found}, not a {wanted}; take '{command} {path}'.",
            where="study",
        )


def base_case(case: Any, path: Path, overrides: Mapping[str, Any] | None) -> Case:
    """The base case that the file ``path`` of a study or map names or holds."""
    if not isinstance(case, (str, dict)):
        raise InputError(
            f"'{path}' names no case; give case = \"my_case.toml\", or a [case] table.",
            where="case",
            value=case,
        )
    return load_case(path.parent / case if isinstance(case, str) else case, overrides=overrides)


def _listed(value: Any, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise wrong_type(value, "a list", where)
    return value


@dataclass(frozen=True)
class _Axes:
    """The axes of a study's text, before numbers in them are taken as SI."""

    axes: tuple[Axis, ...] = ()


def _with_type(axis: Any) -> Any:
    """A table that names one path is a grid."""
    plain = isinstance(axis, Mapping) and "path" in axis and "type" not in axis
    return {"type": "grid", **axis} if plain else axis


def _as_text(case: Case, path: str, value: Any, *, si: bool) -> Any:
    """A value as a case file writes it: numbers with units, specs as tables, materials by name.

    ``si`` takes numbers as SI; otherwise one without its unit raises InputError.
    """
    unit = unit_at(case, path)
    if isinstance(value, (int, float)) and not isinstance(value, bool) and unit:
        return format_si(value if si else parse(value, unit, where=path), unit)
    if isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, (list, tuple)) and unit:  # of a table, whose lists go together
        return [_as_text(case, path, each, si=si) for each in value]
    return value_at(case.replace(path, value, si=si).to_table(), path)


def _from_file(case: Case, folder: Path, path: str, value: Any) -> Any:
    """A value from a study's file, whose own paths are relative to it."""
    found = _as_text(case, path, value, si=False)
    return str(folder / found) if path in file_paths(Case) and found else found


def value_at(table: Any, path: str) -> Any:
    """Value at a dotted path of nested tables and lists; None if it is not there."""
    for key in path.split("."):
        if isinstance(table, list):
            table = table[int(key)] if key.isdigit() and int(key) < len(table) else None
        else:
            table = table.get(key) if isinstance(table, dict) else None
    return table


def check_format(found: Any, path: Path) -> None:
    """InputError unless a study's file or folder has the format of this flexcage."""
    if found != FORMAT:
        raise InputError(
            f"'{path}' is a study of format {found}, and this flexcage ({__version__}) reads "
            f"format {FORMAT}: use the flexcage that wrote it, or run the study anew.",
            where="format",
            value=found,
        )


def read_file(path: Path) -> dict[str, Any]:
    """Tables of a study's file; InputError for one that cannot be read."""
    try:
        text = text_of(path, "a study is TOML", where="study")
    except FileNotFoundError as exc:
        raise InputError(f"{no_file('study file', path, ('.toml',))}.", value=str(path)) from exc
    except OSError as exc:
        reason = (exc.strerror or str(exc)).lower()
        raise InputError(f"The study file '{path}' cannot be read ({reason}).") from exc
    return read_toml(text, str(path))
