"""Maps of a claim: one base case over the unknowns of a paper or a design, and what decides.

A map is a study whose points sample the unknowns (``unknowns``), each under all ``conditions`` that
a claim compares and with several starts. Its folder is that of a study, with ``map.json`` beside
it; so runs are resumed, cases that are there are not computed again, and no kernel is compiled
twice.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.case import Case
from flexcage.core.binding import Binder, check_spec, path_of
from flexcage.core.errors import InputError
from flexcage.core.hashing import seal_holds, sealed
from flexcage.core.reading import read_json, table_of
from flexcage.core.spec import option, quantity
from flexcage.core.units import format_si
from flexcage.core.writing import check_name
from flexcage.core.writing import replace as replace_file
from flexcage.study.about import key_of
from flexcage.study.axes import Points
from flexcage.study.cluster import require_packages
from flexcage.study.desk import Crew
from flexcage.study.folder import Folder
from flexcage.study.origin import this_one
from flexcage.study.plan import Plan, make_plan
from flexcage.study.results import StudyResults
from flexcage.study.run import check_physics, run_plan
from flexcage.study.sensitivity import Index, indices
from flexcage.study.spec import KEEP, Study, base_case, check_kind, read_file, use_extensions
from flexcage.study.unknowns import DESIGNS, DUMMY, Unknown, check_unknowns, design_of
from flexcage.system.spec import MOST_PUSH

if TYPE_CHECKING:
    import pandas

FORMAT = 1
FILE = "map.json"
SAMPLE, CONDITION = "sample", "condition"  # columns of a map's tables


@dataclass(frozen=True, kw_only=True)
class Map:
    """Unknowns, conditions and outputs of a map, and how it is sampled.

    ``conditions`` are points as of a study's list, each with its ``label``. ``starts`` runs of
    every point and condition begin with pushes of their own, as strong as ``push`` unless
    "start.push" is an unknown.
    """

    called: ClassVar[str] = "The map"

    name: str = option("map", doc="name, for titles and folders")
    case: Case = option(doc="the base case")
    unknowns: tuple[Unknown, ...] = option(doc="what is not known")
    conditions: tuple[Mapping[str, Any], ...] = field(default=({"label": "base"},))
    outputs: tuple[str, ...] = option(doc="figures wanted of every run")
    design: str = option("sample", doc="how the unknowns are sampled", choices=DESIGNS)
    count: int = option(16, doc="points, trajectories or base points of the design", minimum=2)
    seed: int = option(1, doc="seed of the design and of the first start", minimum=0)
    starts: int = option(1, doc="runs of every point and condition", minimum=1)
    push: float = quantity(
        "mm/s", 1e-3, doc="speed of the cage centre at the start", above=0.0, maximum=MOST_PUSH
    )
    keep: str = option("figures", doc="what stays of a run", choices=KEEP)

    def __post_init__(self) -> None:
        check_name(self.name, "The map's name")
        object.__setattr__(self, "outputs", tuple(self.outputs))
        check_unknowns(self.unknowns)
        if not self.conditions or any("label" not in c for c in self.conditions):
            raise InputError("Every condition of a map should have a label.", where="conditions")
        check_spec(self)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the design's columns."""
        return (*(u.name for u in self.unknowns), DUMMY)

    @cached_property
    def shares(self) -> np.ndarray:
        """The design (rows, columns)."""
        return design_of(self.design, self.count, len(self.names), self.seed)

    def study(self, points: Sequence[int] | None = None) -> Study:
        """The study of its runs: all, or those of some points, counted from 0."""
        rows = range(len(self.shares)) if points is None else points
        if not set(rows) <= set(range(len(self.shares))) or not rows:
            raise InputError(
                f"The map has points 0 to {len(self.shares) - 1}, but {list(rows)} were asked for.",
                where="points",
                value=list(rows),
            )
        samples = []
        for row in rows:
            changes: dict[str, Any] = {}
            for unknown, share in zip(self.unknowns, self.shares[row]):
                changes |= unknown.changes(float(share))[1]
            for start in range(self.starts):
                seed = self.seed + row * self.starts + start
                samples.append({
                    "label": f"{row}.{start}",
                    "start.push": format_si(self.push, "mm/s"), "start.seed": seed, **changes,
                })  # fmt: skip
        return Study(
            name=self.name, case=self.case, outputs=self.outputs, keep=self.keep,
            axes=(Points(tuple(samples), SAMPLE), Points(self.conditions, CONDITION)),
        )  # fmt: skip

    def stored(self) -> dict[str, Any]:
        """What a folder keeps of it beside the study's plan, as plain JSON values."""
        return {
            "format": FORMAT, "origin": this_one().to_store(), "design": self.design,
            "count": self.count, "seed": self.seed, "starts": self.starts,
            "names": list(self.names), "shares": self.shares.tolist(),
            "reasons": [u.reason for u in self.unknowns],
            "ranges": [u.in_words() for u in self.unknowns],
            "values": [[u.changes(float(s))[0] for u, s in zip(self.unknowns, row)]
                       for row in self.shares],
            "conditions": [str(c["label"]) for c in self.conditions],
        }  # fmt: skip


def load_map(path: str | Path, *, overrides: Mapping[str, Any] | None = None) -> Map:
    """Map from a TOML file; ``overrides`` change its base case, path by path.

    Loads the extensions that the file names under ``use``. A mistake raises InputError.
    """
    path = path_of(path, "map")
    table = read_file(path)
    check_kind(table, path, "map")
    use_extensions(table, path)
    case = base_case(table.get("case"), path, overrides)
    unknowns = [_with_paths(u) for u in table.get("unknowns", [])]
    return Binder().bind(Map, {**table, "case": case, "unknowns": unknowns}, "")


def _with_paths(table: Any) -> Any:
    """An unknown of one ``path`` has it with the factor 1."""
    if not isinstance(table, Mapping) or "path" not in table:
        return table
    rest = {key: value for key, value in table.items() if key != "path"}
    return {**rest, "paths": {table["path"]: 1.0, **rest.get("paths", {})}}


def run_map(
    spec: Map,
    *,
    out: str | Path,
    points: Sequence[int] | None = None,
    workers: int | None = None,
    other_version: bool = False,
    progress: Callable[..., Any] | None = None,
) -> MapResults:
    """Compute what the folder ``out`` lacks of a map; ``workers``, ``other_version`` and
    ``progress`` are those of ``run_study``. A run that fails is a gap in the map, with its reason
    in the study's table.

    Only some ``points`` are computed where they are named: so a map is rechecked with a finer
    model, whose folder is another.
    """
    out, study = path_of(out, "out"), spec.study(points)
    require_packages()
    plan, folder = make_plan(study), Folder(out.resolve())
    check_physics(plan, folder, allowed=other_version)  # before map.json is another
    folder.prepare(plan)
    keep_map(spec, plan, folder)
    run_plan(plan, folder, Crew(workers), other_version=other_version, progress=progress)
    return MapResults(out)


def keep_map(spec: Map, plan: Plan, folder: Folder) -> None:
    """Write map.json beside the plan of the map's study."""
    stored = sealed({**spec.stored(), "plan": key_of(plan.cases)})
    replace_file(folder.path / FILE, (json.dumps(stored, indent=1) + "\n").encode())


class MapResults:
    """What a map's folder holds: outputs by point, start and condition."""

    def __init__(self, path: str | Path) -> None:
        self.study = StudyResults(path)
        file = self.study.folder.path / FILE
        if not file.is_file():
            raise InputError(
                f"'{self.study.folder.path}' does not hold a map; 'flexcage study map' makes one.",
                where="path", value=str(path),
            )  # fmt: skip
        try:
            self.about: dict[str, Any] = table_of(read_json(file))
            if self.about["format"] != FORMAT:
                raise ValueError(f"format {self.about['format']}")
            if not seal_holds(self.about):
                raise ValueError("it was edited")
            if self.about["plan"] != key_of(self.study.planned):
                raise ValueError("it belongs to other cases than plan.json")
        except (OSError, ValueError, KeyError, TypeError) as exc:
            raise InputError(
                f"'{file}' does not hold the map of this folder ({exc}); run the map anew, which "
                "computes no finished case again.",
                where="map",
            ) from exc
        self.names: list[str] = self.about["names"]
        self.conditions: list[str] = self.about["conditions"]
        self.shares = np.array(self.about["shares"], float)

    @cached_property
    def _cells(self) -> dict[tuple[str, str], Mapping[str, Any]]:
        """Figures of every run that is done, by its sample's and its condition's label."""
        return {
            (r.planned.point.labels[SAMPLE], r.planned.point.labels[CONDITION]): r.figures
            for r in self.study.rows
            if r.state == "done"
        }

    def values(self, output: str, condition: str) -> np.ndarray:
        """An output (points, starts) under one condition, SI; NaN where there is none."""
        if output not in self.study.about.outputs or condition not in self.conditions:
            raise InputError(
                f"The map has no output '{output}' under a condition '{condition}'; its outputs "
                f"are {', '.join(self.study.about.outputs)}, its conditions "
                f"{', '.join(self.conditions)}.",
                where="outputs",
                value=output,
            )
        found = np.full((len(self.shares), self.about["starts"]), np.nan)
        for row, start in np.ndindex(*found.shape):
            figures = self._cells.get((f"{row}.{start}", condition), {})
            if output in figures and figures[output].value is not None:
                found[row, start] = figures[output].value
        return found

    def means(self, output: str, condition: str) -> np.ndarray:
        """An output (points,) averaged over the starts that there are."""
        found = self.values(output, condition)
        there = np.isfinite(found)
        sums = np.where(there, found, 0.0).sum(axis=1)
        return np.where(there.any(axis=1), sums / np.maximum(there.sum(axis=1), 1), np.nan)

    def indices(self, output: str, condition: str) -> list[Index]:
        """How strongly every unknown, and the dummy, moves an output (``sensitivity.indices``)."""
        return indices(self.about["design"], self.shares, self.names,
                       self.means(output, condition), seed=self.about["seed"])  # fmt: skip

    def noise(self, output: str, condition: str) -> float:
        """Share of the variance of single runs that starts make; NaN for one start."""
        found = self.values(output, condition)
        found = found[np.isfinite(found).all(axis=1)]
        if found.shape[0] < 2 or found.shape[1] < 2 or not np.var(found, ddof=1):
            return float("nan")
        return float(np.mean(np.var(found, axis=1, ddof=1)) / np.var(found, ddof=1))

    @property
    def seconds(self) -> float:
        """Processor time of all runs that are done [s]."""
        return float(np.nansum([row.seconds for row in self.study.rows]))

    @cached_property
    def table(self) -> pandas.DataFrame:
        """One row a run: the point and its unknowns, start, condition, and outputs in SI."""
        import pandas as pd

        rows = []
        for row, values in enumerate(self.about["values"]):
            for start in range(self.about["starts"]):
                for condition in self.conditions:
                    figures = self._cells.get((f"{row}.{start}", condition), {})
                    rows.append(
                        {"point": row, "start": start, "condition": condition}
                        | dict(zip(self.names, values))
                        | {name: getattr(figures.get(name), "value", None)
                           for name in self.study.about.outputs}
                    )  # fmt: skip
        return pd.DataFrame(rows)
