"""What tables and pages say of a study, as its folder keeps it: to read it runs no code.

The base case may need a user's own file to be built; its text, its units and what it assumes are
stored in the plan, so that nothing is built to look at what was computed. The plan holds study.toml
as it was planned and the values of every case beside its hash: a later edit of study.toml changes
no label of what was computed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from flexcage.case import description
from flexcage.core.binding import unit_at
from flexcage.core.errors import InputError
from flexcage.core.hashing import content_hash, sealed
from flexcage.core.writing import check_name
from flexcage.study.axes import Axis, Point
from flexcage.study.origin import this_one
from flexcage.study.plan import Plan, Planned
from flexcage.study.spec import FORMAT, Repeat, Study, stored_axes, stored_repeat, stored_table

_NAMED = 3  # edits that a sentence names


@dataclass(frozen=True)
class About:
    """A study without its case: what varies, how often it is repeated, and what is wanted."""

    name: str
    axes: tuple[Axis, ...]
    outputs: tuple[str, ...]
    repeat: Repeat
    use: tuple[str, ...]  # extensions with which it was planned
    base: Mapping[str, Any]  # the base case as nested tables
    units: Mapping[str, str]  # of every path that varies; "" for one without
    in_words: tuple[str, ...]  # the base case
    assumptions: Mapping[str, tuple[str, str]]  # by path: value and reason
    text: str  # study.toml as it was planned
    edited: str = ""  # how study.toml was changed since


def to_store(plan: Plan) -> dict[str, Any]:
    """What plan.json keeps, as plain JSON values."""
    points = {planned.number: planned.point for planned in plan.cases}
    return sealed({
        "format": FORMAT,
        "origin": this_one().to_store(),
        "study": plan.study.to_toml(),
        "points": [{"values": plain(p.values), "labels": dict(p.labels)} for p in points.values()],
        "cases": [[c.number, c.repetition, c.hash] for c in plan.cases],
        **_base_of(plan.study),
    })  # fmt: skip


def _base_of(study: Study) -> dict[str, Any]:
    """What of the base case tables and pages want, as plain JSON values."""
    paths = (path for axis in study.axes for path in axis.paths)
    return {
        "units": {path: unit_at(study.case, path) for path in paths},
        "in_words": list(description.in_words(study.case)),
        "assumptions": {k: list(v) for k, v in description.assumed(study.case).items()},
    }


def plain(value: Any) -> Any:
    """Nested values as JSON has them: tables with texts as keys, and lists."""
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    return [plain(entry) for entry in value] if isinstance(value, (list, tuple)) else value


def key_of(cases: Sequence[Planned]) -> str:
    """16 digits that name the cases of a plan with their labels."""
    return content_hash([[c.hash, c.repetition, dict(c.point.labels)] for c in cases])


def from_store(file: Path, stored: Mapping[str, Any]) -> tuple[About, tuple[Planned, ...]]:
    """What a study's plan.json says, and its cases; ``file`` is the folder's study.toml."""
    text = stored["study"]
    table = stored_table(file, text)
    about = About(
        name=str(table.get("name", "study")),
        axes=stored_axes(table),
        outputs=tuple(map(str, table["outputs"])),
        repeat=stored_repeat(table),
        use=tuple(table["use"]),
        base=table["case"],
        units={str(path): str(unit) for path, unit in stored["units"].items()},
        in_words=tuple(map(str, stored["in_words"])),
        assumptions={path: (value, why) for path, (value, why) in stored["assumptions"].items()},
        text=text,
        edited=_edit(file, text, table),
    )
    for _, _, name in stored["cases"]:
        check_name(name, f"The hash of a case in '{file.with_name('plan.json')}'")
    points = [Point(p["values"], p["labels"]) for p in stored["points"]]
    return about, tuple(Planned(n, points[n], k, h) for n, k, h in stored["cases"])


def _edit(file: Path, text: str, planned: Mapping[str, Any]) -> str:
    """How study.toml was changed after its cases were planned, or nothing; InputError for one of
    another format."""
    found = file.read_text("utf-8", errors="replace")
    if found == text:
        return ""
    rest = (
        "this is ignored: what follows is the study as it was planned. To compute the edited one, "
        f"take 'flexcage study resume {file.parent}'."
    )
    try:
        edited = stored_table(file, found)
    except InputError as exc:
        if exc.where == "format":
            raise
        return f"'{file}' was changed and is no study any more ({str(exc).rstrip('.')}); {rest}"
    was, now = dict(_entries(planned)), dict(_entries(edited))
    keys = [key for key in {**was, **now} if was.get(key) != now.get(key)]
    if not keys:
        return ""
    changes = [f"{key} is {now.get(key, 'gone')}, was {was.get(key, 'not there')}" for key in keys]
    more = f", and {len(keys) - _NAMED} more" if len(keys) > _NAMED else ""
    return f"'{file}' was edited ({'; '.join(changes[:_NAMED])}{more}); {rest}"


def _entries(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Dotted path and value of every entry of nested tables and lists."""
    if isinstance(value, Mapping):
        for key, entry in value.items():
            yield from _entries(entry, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for k, entry in enumerate(value):
            yield from _entries(entry, f"{path}[{k}]")
    else:
        yield path, value
