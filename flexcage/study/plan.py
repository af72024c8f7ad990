"""The plan: every case of a study, built and checked before anything is computed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import reduce
from itertools import product
from operator import or_

from flexcage.bearings import family_of
from flexcage.case import Case
from flexcage.case.tables import ALIASES
from flexcage.core.errors import InputError
from flexcage.core.hashing import content_hash
from flexcage.core.units import format_si
from flexcage.modes.registry import basis_version
from flexcage.results.figures.figure import FITTED, QUOTED
from flexcage.results.registry import own_variables
from flexcage.study.axes import Axis, Point, Points
from flexcage.study.outputs import check_outputs
from flexcage.study.spec import Study
from flexcage.system.constraints import names_of
from flexcage.system.layout import CONSTRAINTS

#: What tables hold of every case or point beside labels, values that vary, and outputs.
COLUMNS = (
    "point", "repetition", "state", "reason", "warnings", "seconds", "version", "hash", "done",
)  # fmt: skip


@dataclass(frozen=True)
class Planned:
    """One case of a study: its point, which repetition of it, and the hash that names it.

    Cases of equal ``modes`` share their mesh and modes; it is empty for a rigid cage.
    """

    number: int  # of the point, from 0
    point: Point
    repetition: int
    hash: str
    modes: str = field(default="", compare=False)


@dataclass(frozen=True)
class Plan:
    """All cases of a study, in order. Holds hashes only: a case is built when it is needed."""

    study: Study
    cases: tuple[Planned, ...]

    def case(self, planned: Planned) -> Case:
        return _build(self.study, planned.point, planned.repetition)


def make_plan(study: Study) -> Plan:
    """Build and check every case; the first mistake raises InputError with its point."""
    _check_paths(study)
    _check_columns(study)
    points = points_of(study.axes)
    cases, seen = [], dict[str, int]()
    family = study.case.bearing.family
    flexible = riveted = caged = uncaged = False
    sizes = _counts(study.case)
    materials, held = dict[str, None](), set(names_of(study.case.constraints))
    rings, sections = set[str](), set[str]()
    for number, point in enumerate(points):
        for repetition in range(study.repeat.count):
            try:
                case = _build(study, point, repetition)
            except InputError as exc:
                raise InputError(
                    f"Point {number + 1} of {len(points)} ({point}): {exc}", where=exc.where
                ) from exc
            if case.hash in seen:
                first = points[seen[case.hash]]
                raise InputError(
                    f"Points {seen[case.hash] + 1} ({first}) and {number + 1} ({point}) are the "
                    "same case; leave one out.",
                    where="axes",
                )
            seen[case.hash] = number
            sizes = {dim: min(size, sizes[dim]) for dim, size in _counts(case).items()}
            flexible |= case.cage_model == "flexible"
            caged |= case.cage is not None
            uncaged |= case.cage is None
            riveted |= case.riveted
            rings |= _of_rings(case)
            sections |= {FITTED} if case.fit.given else set()
            sections |= {QUOTED} if case.life.given else set()
            if case.cage is not None:
                materials[case.cage.material.name] = None
            held = held.intersection(names_of(case.constraints))
            cases.append(Planned(number, point, repetition, case.hash, modes_key(case)))
    check_outputs(
        study.outputs, sizes=sizes, flexible=flexible, riveted=riveted, family=family,
        caged=caged, uncaged=uncaged, materials=materials,
        reactions=(*CONSTRAINTS, *sorted(held)), rings=rings, sections=sections,
    )  # fmt: skip
    return Plan(study, tuple(cases))


def _counts(case: Case) -> dict[str, int]:
    """Lengths of the dimensions of a case's results that are counted from 0."""
    count = case.bearing.total_elements
    own = own_variables(family_of(case.bearing)).sizes
    return {"element": count, "pocket": count, "slice": case.contacts.pocket.slices, **own}


def _of_rings(case: Case) -> set[str]:
    """Dimensions of ``OF_RINGS`` that a case's results have."""
    ring = case.outer_ring
    has = {"bending": case.rings_bend, "support": ring.bends and bool(ring.held_at)}
    return {dim for dim, there in has.items() if there}


def modes_key(case: Case) -> str:
    """Names what cases of one cage share; empty for a rigid cage."""
    if case.cage_model == "rigid":
        return ""
    return content_hash(
        case.cage, case.all_defects, case.mesh, case.modes, case.bearing.element_count,
        case.bearing.pitch_diameter, *basis_version(case.modes),
    )  # fmt: skip


def points_of(axes: Iterable[Axis]) -> list[Point]:
    """Every combination of the axes' points."""
    combinations = product(*(axis.expand() for axis in axes))
    return [reduce(or_, parts, Point({})) for parts in combinations]


def _build(study: Study, point: Point, repetition: int) -> Case:
    changes = dict(point.values)
    if study.repeat.count > 1:
        changes["start.push"] = format_si(study.repeat.push, "mm/s")
        changes["start.seed"] = study.repeat.seed + repetition
    return study.case.replace(si=False, **changes)


def _check_paths(study: Study) -> None:
    """Raise InputError if two axes set the same value, or one sets what another is inside of."""
    owners: dict[str, str] = {}
    if study.repeat.count > 1:
        owners = {"start.push": "repeat", "start.seed": "repeat"}
    for i, axis in enumerate(study.axes):
        for path in axis.paths:
            plain = ALIASES.get(path, path)
            for other, owner in owners.items():
                if _overlap(plain, other):
                    what = "set" if plain == other else f"overlap at '{other}' and"
                    raise InputError(
                        f"Axis {i} and {owner} both {what} '{path}'; let one of them do it.",
                        where=f"axes.{i}",
                        value=path,
                    )
            owners[plain] = f"axis {i}"


def _check_columns(study: Study) -> None:
    """Raise InputError if the labels of a list would share a column with anything else."""
    owners = dict.fromkeys((*COLUMNS, *study.outputs), "the tables have a column of that name")
    owners |= {path: "an axis sets that path" for axis in study.axes for path in axis.paths}
    for i, axis in enumerate(study.axes):
        if not isinstance(axis, Points) or not any("label" in point for point in axis.points):
            continue
        if axis.name in owners:
            raise InputError(
                f"Axis {i} shows its labels in a column '{axis.name}', but {owners[axis.name]}; "
                'give the axis another name, as in name = "variant".',
                where=f"axes.{i}.name",
                value=axis.name,
            )
        owners[axis.name] = f"axis {i} does so too"


def _overlap(a: str, b: str) -> bool:
    return a == b or a.startswith(f"{b}.") or b.startswith(f"{a}.")
