"""Cheap studies: the N1013 with a rigid cage on the coarse mesh, for 0.2 ms."""

from __future__ import annotations

from pathlib import Path

from flexcage.case import Case, load_case
from flexcage.study.about import plain
from flexcage.study.case_row import CaseRow
from flexcage.study.origin import this_one
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import Planned
from flexcage.study.spec import Study

SHORT = {
    "bearing": {"preset": "N1013"},
    "cage": {"model": "rigid"},
    "mesh": {"fineness": "coarse"},
    "load": {"radial": "1000 N"},
    "output": {"block": 50},
    "solver": {"duration": "0.2 ms"},
}


def short_case(**changes: object) -> Case:
    return load_case(SHORT, overrides=changes)


def short_study(*axes: object, outputs=("cage_speed",), duration="0.2 ms", **rest) -> Study:
    case = short_case(**{"solver.duration": duration})
    return Study(case=case, axes=axes, outputs=outputs, **rest)


def row_of(planned: Planned, figures: dict[str, StudyFigure], warnings=()) -> CaseRow:
    """The row of a finished case as this flexcage writes it."""
    values = plain(planned.point.values)
    return CaseRow(planned.hash, 1.0, figures, warnings, values, this_one())


def study_file(
    folder: Path, *tables: str, duration: str = "0.2 ms", outputs=("cage_speed",)
) -> Path:
    """A study.toml with its case beside it; ``tables`` are its axes and what else it says."""
    (folder / "short.toml").write_text(short_case(**{"solver.duration": duration}).to_toml())
    lines = ['name = "small"', 'case = "short.toml"', f"outputs = {list(outputs)}", *tables]
    path = folder / "study.toml"
    path.write_text("\n".join(lines))
    return path
