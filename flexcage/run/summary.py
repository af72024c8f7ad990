"""The summary of a run: what its rooms say of it, section by section."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from flexcage.core.warning import RunWarning
from flexcage.mesh.quality import report_mesh
from flexcage.results import mode_file
from flexcage.results.evenly import FEWEST
from flexcage.results.figures.cage import SUPPORT, CageFacts, cage_rows
from flexcage.results.figures.effort import SOLVER, TIMES
from flexcage.results.figures.figure import rows_of
from flexcage.results.figures.film import FILM, Lubricated
from flexcage.results.figures.fits import FITS
from flexcage.results.figures.life import LIFE
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise
from flexcage.results.figures.stress import RIVETS, stress_rows
from flexcage.results.figures.table import FIGURES
from flexcage.results.row import SummaryRow, with_others
from flexcage.results.signals.figures import SENSORS, clipped, sensor_rows
from flexcage.results.slip import SlipRange
from flexcage.results.summary import Summary
from flexcage.results.warnings import from_attrs, warnings_of
from flexcage.results.warnings_at_end import AT_END, CAGELESS_AT_END, RunOutcome
from flexcage.run.elastic import elastic_shape
from flexcage.run.seams import seam_warnings
from flexcage.system.statics.lives import questioned_lives

if TYPE_CHECKING:
    from flexcage.run.record import RunRecord


def summary_of(run: RunRecord, *, stress: bool = True) -> Summary:
    """Figures of a run; without ``stress`` the cage's is left out where it surely stays below the
    proof stress."""
    case, part = run.case, part_of(run)
    summary = summarise(part)
    for rows in (
        FILM.rows(Lubricated(part, run.bearing, case.lubricant.oil)),
        [] if case.mounting is None else FITS.rows(case.mounting),
        [] if run.lives is None else LIFE.rows(run.lives),
        [FIGURES[edge.key].row(edge.found) for edge in run.groove_edges],
        SUPPORT.rows(case.held_in_words),
        _cage_rows(run),
    ):
        summary = summary.with_figures(rows)
    if run.cage is not None:
        proof = case.its_cage.material.proof_stress
        if stress or any(row.cage_stress.may_exceed(proof) for row in run.rows):
            summary = with_stress(summary, run)
    if case.sensors and run.store.n_time >= FEWEST:
        summary = summary.with_section(SENSORS, sensor_rows(run.signals, part.frequencies))
    if run.effort is not None:
        summary = summary.with_figures(SOLVER.rows(run.effort))
    return warned(timed(summary, run), run)


def part_of(run: RunRecord) -> SettledRun:
    """What figures of a run's motion and forces are taken from."""
    case, friction = run.case, run.case.contacts.race.friction
    slip_range = SlipRange(friction.creeps_below, friction.rises_below)
    return SettledRun(run.dataset, run.numbers, case.output.settle, slip_range, run.events)


def with_stress(summary: Summary, run: RunRecord) -> Summary:
    """The summary with stress behind the cage's figures."""
    found = [stress_rows(row.cage_stress.figures) for row in run.rows]
    summary = summary.with_figures(_of_rows(found), after="cage_mass")
    if not run.case.riveted:
        return summary
    riveted = [RIVETS.rows(row.rivets) for row in run.rows]
    return summary.with_figures(_of_rows(riveted), after="stress_peak")


def _of_rows(found: Sequence[Sequence[SummaryRow]]) -> list[SummaryRow]:
    """Figures of the cage, or of that of each row of elements."""
    return [with_others(rows) for rows in zip(*found, strict=False)]


def warned(summary: Summary, run: RunRecord) -> Summary:
    """The summary with its warnings."""
    case = run.case
    known = (*from_attrs(run.dataset.attrs), *seam_warnings(run.store))
    if run.lives is not None:
        rating = case.static.dynamic_rating or run.bearing.dynamic_rating
        rated = questioned_lives(run.lives, rating)
        known = (*known, *(RunWarning("life", f"{t[0].upper()}{t[1:]}") for t in rated))
    if case.sensors and run.store.n_time >= FEWEST:
        known = (*known, *clipped(run.signals))
    outcome = RunOutcome(
        summary=summary,
        dataset=run.dataset,
        bearing=run.bearing,
        cage=case.cage,
        land=case.land,
        duration=case.solver.duration,
        settle=case.output.settle,
        edges=tuple(run.groove_edges),
        shape=elastic_shape(run),
        said=frozenset(warning.key for warning in known),
    )
    looked = CAGELESS_AT_END if case.cage is None else AT_END
    return summary.with_warnings((*known, *warnings_of(looked, outcome)))


def timed(summary: Summary, run: RunRecord) -> Summary:
    """The summary with the wall times of all stages so far."""
    stages = [FIGURES[f"wall_{stage}"] for stage in (*run.stages, "total")]
    return summary.with_section(TIMES.section, rows_of(stages, run.stages))


def _cage_rows(run: RunRecord) -> tuple[SummaryRow, ...]:
    cage, start = run.case.cage, run.start
    if cage is None:
        return ()
    return cage_rows(
        CageFacts(
            cage=cage,
            mesh=report_mesh(run.mesh, density=cage.material.density),
            basis=None if run.cage is None else run.cage.shown,
            table=mode_file.FILE if run.folder else "run.mode_table",
            count=run.case.cages,
            pinched=() if start is None else start.pinched,
            pinch_force=0.0 if start is None else start.pinch_force,
        )
    )
