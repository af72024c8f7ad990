"""One case over tolerance, slices, samples, modes and mesh: which of its outputs have converged."""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from math import hypot, nan
from pathlib import Path
from typing import Any

from flexcage.case import Case
from flexcage.contacts.spec import FEWEST_SLICES, MOST_SLICES
from flexcage.core.binding import expect, path_of
from flexcage.core.errors import FlexcageError, InputError
from flexcage.core.reading import read_json
from flexcage.core.warning import RunWarning
from flexcage.core.writing import replace
from flexcage.mesh.options import FINENESS
from flexcage.results.figures.figure import CONVERGENCE, STATISTIC
from flexcage.results.figures.table import FIGURES, marked
from flexcage.results.files import load, save
from flexcage.results.row import SummaryRow
from flexcage.results.statistics import spread
from flexcage.results.summary import Summary
from flexcage.run.folder import write_case
from flexcage.run.foreseen import reported_at_once
from flexcage.study.convergence import Convergence, Finding
from flexcage.study.origin import Origin, check_origins, stored_origin, this_one
from flexcage.study.work import run_in

log = logging.getLogger(__name__)

_ORIGIN = "origin.json"  # beside a run: the flexcage that computed it


@dataclass(frozen=True)
class Level:
    """One setting of one axis: its name, and the case with it."""

    axis: str
    name: str
    case: Case


def _tolerances(case: Case) -> dict[str, dict[str, Any]]:
    return {f"x{f:g}": {"solver.tolerance": f * case.solver.tolerance} for f in (1.0, 0.3, 0.1)}


def _samples(case: Case) -> dict[str, dict[str, Any]]:
    """How often it is looked at: as it is, twice and four times as often."""
    found, own = {}, case.output
    for factor in (1, 2, 4):
        rate = factor * own.rate
        fine = rate * max(round(own.vibration_rate / rate), 1)
        found[f"{rate / 1e3:g} kHz"] = {
            "output.rate": rate, "output.vibration_rate": fine, "output.block": factor * own.block,
        }  # fmt: skip
    return found


def _slices(case: Case) -> dict[str, dict[str, Any]]:
    own = {place: getattr(case.contacts, place).slices for place in ("race", "pocket")}
    found = {}
    for factor in (0.5, 1.0, 2.0):
        cut = {place: _sliced(count, factor) for place, count in own.items()}
        name = ", ".join(f"{place} {count}" for place, count in cut.items())
        found[name] = {f"contacts.{place}.slices": count for place, count in cut.items()}
    return found


def _sliced(own: int, factor: float) -> int:
    return min(max(round(factor * own), FEWEST_SLICES), MOST_SLICES)


def _modes(case: Case) -> dict[str, dict[str, Any]]:
    return {str(k * case.modes.count): {"modes.count": k * case.modes.count} for k in (1, 2, 4)}


def _meshes(case: Case) -> dict[str, dict[str, Any]]:
    return {name: {"mesh.fineness": name} for name in FINENESS[:3]}


AXES: dict[str, Callable[[Case], dict[str, dict[str, Any]]]] = {
    "tolerance": _tolerances,
    "slices": _slices,
    "samples": _samples,
    "modes": _modes,
    "mesh": _meshes,
}


def levels(case: Case, axes: Sequence[str] = ()) -> list[Level]:
    """Levels of the axes named (default: all that fit the case), coarse to fine.

    Raises InputError for an axis that does not exist, or one that this case cannot vary.
    """
    for axis in axes:
        if axis not in AXES:
            raise InputError(
                f"Axis {axis!r} is not known; there are {', '.join(AXES)}.",
                where="axes",
                value=axis,
            )
        if why := _unfit(case, axis):
            raise InputError(f"{why}, so axis {axis!r} does not apply; leave it out.", where="axes")
    return [
        Level(axis, name, case.replace(**changes))
        for axis in dict.fromkeys(axes or [a for a in AXES if not _unfit(case, a)])
        for name, changes in AXES[axis](case).items()
    ]


def _unfit(case: Case, axis: str) -> str:
    """Why a case cannot vary along an axis; nothing if it can."""
    if axis in ("modes", "mesh") and case.cage is None:
        return "The bearing has no cage"
    if axis in ("modes", "mesh") and case.cage_model == "rigid":
        return "The cage is rigid"
    if axis in ("modes", "mesh") and case.modes.body:
        return "The cage's modes are those of modes.body"
    mesh = case.mesh
    if axis == "mesh" and (mesh.file or mesh.size is not None or mesh.fillet_size is not None):
        return "The mesh has a file or sizes of its own"
    return ""


def converge(
    case: Case,
    *,
    out: str | Path,
    axes: Sequence[str] = (),
    duration: float | str | None = None,
    other_version: bool = False,
    progress: Any = None,
) -> Convergence:
    """Repeat a case along each axis, the others left as they are, and compare its outputs.

    Every run lies in ``out/cases/<hash>``; one that is complete there is not repeated, and one
    that stopped goes on. ``duration`` replaces the case's own; ``other_version`` allows to compare
    with runs that a flexcage of other physics computed. A run that fails is reported with its
    reason. The table is written to ``out`` as text, .csv and .json, with a picture.
    """
    from flexcage.render import convergence_picture

    expect(case, Case, "case", "flexcage.load_case reads one from a file")
    axes = (axes,) if isinstance(axes, str) else axes
    if duration is not None:
        case = case.replace("solver.duration", duration)
    steps = levels(case, axes)
    out = path_of(out, "out")
    write_case(out, case)
    wanted = {level.case.hash: level for level in (*steps, Level("case", "as is", case))}
    _check_physics(wanted, out / "cases", allowed=other_version)
    with reported_at_once(level.case for level in wanted.values()):
        figures = _run_all(wanted, out / "cases", progress)
    found = _compare(case, steps, figures, out / "cases")
    found.write(out)
    convergence_picture([f.record() for f in found.findings], out / "converge.png", name=case.name)
    return found


def _check_physics(wanted: Collection[str], cases: Path, *, allowed: bool) -> None:
    """Refuse, or say, that runs would be compared with those of other physics."""
    done = [cases / name for name in wanted if _is_done(cases / name)]
    new = len(wanted) - len(done)
    mixed = check_origins(map(_origin_of, done), new=new, folder=cases.parent, allowed=allowed)
    if mixed:
        log.warning(mixed)


def _run_all(wanted: dict[str, Level], folder: Path, progress: Any) -> dict[str, Summary | str]:
    """Summary of every case by its hash, or the sentence of the error that stopped it."""
    figures: dict[str, Summary | str] = {}
    new = [name for name in wanted if not _is_done(folder / name)]
    begin, ran = time.perf_counter(), 0
    for name, level in wanted.items():
        if name in new:
            spent = time.perf_counter() - begin
            left = f", about {spent / ran * (len(new) - ran):.0f} s left" if ran else ""
            ran += 1
            log.info("run %d of %d: %s %s%s", ran, len(new), level.axis, level.name, left)
        try:
            figures[name] = _figures_of(level.case, folder / name, progress)
        except FlexcageError as error:
            figures[name] = str(error)
    return figures


def _figures_of(case: Case, folder: Path, progress: Any) -> Summary:
    """Summary of a case with the windows of its statistics; simulated if it is not there. What
    another flexcage computed has a warning that says so."""
    kept = folder / "windows.npz"
    if _is_done(folder):
        return Summary.read(folder / "summary.json", windows=load(kept))
    summary = run_in(folder, case, progress=progress).summary
    save(kept, {row.key: row.record.sums for row in summary if row.record is not None})
    replace(folder / _ORIGIN, json.dumps(this_one().to_store()).encode())
    return summary


def _compare(
    case: Case, steps: Sequence[Level], figures: dict[str, Summary | str], cases: Path
) -> Convergence:
    findings: list[Finding] = []
    compared: dict[str, tuple[str, str]] = {}
    for axis in dict.fromkeys(level.axis for level in steps):
        *coarser, finest = (level for level in steps if level.axis == axis)
        base = next((s for s in coarser if s.case.hash == case.hash), coarser[-1])
        compared[axis] = base.name, finest.name
        for level in coarser:
            findings += _findings(level, finest, figures)
    own = figures[case.hash]
    names = {case.hash: "as is"}
    for step in steps:
        names.setdefault(step.case.hash, f"{step.axis} {step.name}")
    return Convergence(
        name=case.name,
        own=() if isinstance(own, str) else tuple(own.row(k) for k in _compared() if k in own),
        findings=tuple(findings),
        compared=compared,
        failures={
            f"{s.axis} {s.name}": sentence
            for s in steps
            if isinstance(sentence := figures[s.case.hash], str)
        },
        warnings={
            name: (*(run.warnings or ()), *_by_another(cases / key))
            for key, name in names.items()
            if isinstance(run := figures[key], Summary)
        },
    )


def _is_done(folder: Path) -> bool:
    """Is a run complete, with the windows of its statistics? Its origin is written last."""
    return (folder / _ORIGIN).exists()


def _origin_of(folder: Path) -> Origin:
    """Which flexcage computed the run in a folder; InputError where its file does not say."""
    path = folder / _ORIGIN
    try:
        return stored_origin(read_json(path))
    except (OSError, ValueError, KeyError, TypeError) as exc:
        raise InputError(
            f"'{path}' does not say which flexcage computed the run beside it; remove it to "
            "compute the run anew.",
            where="origin",
            value=str(path),
        ) from exc


def _by_another(folder: Path) -> list[RunWarning]:
    """A warning if another flexcage computed the run in a folder."""
    origin = _origin_of(folder)
    if origin == this_one():
        return []
    sentence = (
        f"Flexcage {origin} computed this run, and this is flexcage {this_one()}: results may "
        f"differ between them. Remove '{folder}' to compute it anew."
    )
    return [RunWarning("version", sentence)]


def _compared() -> tuple[str, ...]:
    """Keys of the figures compared: statistics of the motion, and plain values."""
    return marked(CONVERGENCE)


def _findings(level: Level, finest: Level, figures: dict[str, Summary | str]) -> list[Finding]:
    here, best = figures[level.case.hash], figures[finest.case.hash]
    if isinstance(here, str) or isinstance(best, str):
        return []
    pairs = [(here.row(k), best.row(k)) for k in _compared() if k in here and k in best]
    return [
        Finding(
            axis=level.axis, level=level.name, finest=finest.name, output=a.key, label=a.label,
            unit=a.unit, statistic=STATISTIC in FIGURES[a.key].marks, spread=_spread(a, b),
            value=_number(a.value), margin=a.margin,
            finest_value=_number(b.value), finest_margin=b.margin,
        )
        for a, b in pairs
    ]  # fmt: skip


def _spread(one: SummaryRow, other: SummaryRow) -> float:
    """Relative margin of a difference: from windows in pairs, or of runs taken as independent."""
    if STATISTIC not in FIGURES[one.key].marks:
        return 0.0
    if one.record is not None and other.record is not None:
        return spread(one.record, other.record)
    if one.margin is None or other.margin is None:
        return nan
    return hypot(one.margin, other.margin) / abs(_number(other.value))


def _number(value: object) -> float:
    return float(value) if isinstance(value, (int, float)) else nan
