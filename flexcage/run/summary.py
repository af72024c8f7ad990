"""The summary of a run: what its rooms say of it, section by section."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.units import typeset
from flexcage.mesh.quality import report_mesh
from flexcage.results import mode_file
from flexcage.results.figures import summarise
from flexcage.results.film import film_rows
from flexcage.results.known import KNOWN, RARE
from flexcage.results.metrics import SlipRange, settled
from flexcage.results.summary import Row, Summary, figure
from flexcage.results.warnings import AT_END, CAGELESS_AT_END, Outcome, from_attrs, warnings_of
from flexcage.run.elastic import elastic_shape
from flexcage.run.folder import seam_warnings
from flexcage.solve.contract import Effort
from flexcage.system.bodies import unbalance_of

if TYPE_CHECKING:
    from flexcage.geometry.cage import Cage
    from flexcage.run.record import RunRecord

# measured on pinched pockets of an N1013, in tests/verification/test_pinch.py
_FAR = (
    "of a push's deflection of its own pocket, what others would feel of it beyond the modes; "
    "changes an N1013's pinch forces by under 0.5 %"
)
_NO_TIME = 1e-3  # s: a stage that is shorter had nothing to do


def summary_of(run: RunRecord, *, stress: bool = True) -> Summary:
    """Figures of a run; without ``stress`` the cage's is left out where it surely stays below the
    proof stress."""
    case, friction = run.case, run.case.contacts.race.friction
    summary = summarise(
        run.dataset,
        run.numbers,
        settle=case.output.settle,
        slip_range=SlipRange(friction.creeps_below, friction.rises_below),
        events=run.events,
    )
    part = settled(run.dataset, case.output.settle)
    for rows in (
        film_rows(part, case.bearing, case.lubricant.oil),
        [edge.row for edge in run.groove_edges],
        [figure("inner_held", case.held_in_words)],
        _cage_rows(run),
    ):
        summary = summary.with_figures(rows)
    if run.cage is not None:
        proof = case.its_cage.material.proof_stress
        if stress or run.cage_stress.may_exceed(proof):
            summary = with_stress(summary, run)
    if run.effort is not None:
        summary = summary.with_figures(_solver_rows(run.effort))
    return warned(timed(summary, run), run)


def with_stress(summary: Summary, run: RunRecord) -> Summary:
    """The summary with stress behind the cage's figures."""
    summary = summary.with_figures(run.stress_rows(), after="cage_mass")
    if not run.case.riveted:
        return summary
    return summary.with_figures(run.rivets.rows(), after="stress_peak")


def warned(summary: Summary, run: RunRecord) -> Summary:
    """The summary with its warnings."""
    case = run.case
    known = (*from_attrs(run.dataset.attrs), *seam_warnings(run.store))
    outcome = Outcome(
        summary=summary,
        dataset=run.dataset,
        bearing=case.bearing,
        cage=case.cage,
        land=case.land,
        duration=case.solver.duration,
        settle=case.output.settle,
        edges=tuple(run.groove_edges),
        shape=elastic_shape(run),
        said=frozenset(warning.key for warning in known),
    )
    looked = CAGELESS_AT_END if case.cage is None else AT_END
    return dataclasses.replace(summary, warnings=(*known, *warnings_of(looked, outcome)))


def timed(summary: Summary, run: RunRecord) -> Summary:
    """The summary with the wall times of all stages so far."""
    rows = [figure(f"wall_{k}", v, idle=v < _NO_TIME) for k, v in run.stages.items()]
    total = figure("wall_total", run.stages.total)
    return summary.with_section(KNOWN[total.key].section, [*rows, total])


def _cage_rows(run: RunRecord) -> list[Row]:
    cage, start = run.case.cage, run.start
    if cage is None:
        return []
    report = report_mesh(run.mesh, density=cage.material.density)
    mass, centre, note = report.volume * cage.material.density, report.mass_centre, ""
    if cage.unbalance:
        added, place = unbalance_of(cage)
        centre = (mass * centre + added * place) / (mass + added)
        mass += added
        note = f"{added * 1e3:.4g} g of them make the unbalance, at the cage's mean radius"
    rows = [
        figure("cage_mass", mass, note),
        figure("cage_centre_shift", float(np.linalg.norm(centre))),
        *_warm_rows(cage),
    ]
    if run.cage is not None:
        basis = run.cage.shown
        where = mode_file.FILE if run.folder else "run.mode_table"
        rows.append(figure("mode_count", basis.size, f"table: {where}"))
        rows.append(figure("first_frequency", basis.frequencies[0]))
        if basis.residual is not None:
            rows.append(figure("far_coupling", basis.residual.far_coupling, _FAR))
    if start is not None and start.pinched:
        pockets = f"pockets {', '.join(map(str, start.pinched))}"
        rows.append(figure("pinch_force", start.pinch_force, pockets))
    return rows


def _warm_rows(cage: Cage) -> list[Row]:
    """The modulus of a cage whose temperature the case gives."""
    if cage.temperature is None:
        return []
    warm, material = cage.warm_material.youngs_modulus, cage.material
    note = (
        f"of {material.name} at {typeset(cage.temperature, 'degC')}, "
        f"{warm / material.youngs_modulus:.0%} of that at 23°C"
    )
    return [figure("cage_modulus", warm, note)]


def _solver_rows(effort: Effort) -> list[Row]:
    counts, stable_step = effort
    rows = [figure(k, n, idle=not n and RARE in KNOWN[k].marks) for k, n in counts.items()]
    if np.isfinite(stable_step):
        note = "least over the run, by the spectral radius"
        rows.append(figure("stable_step", stable_step, note))
    return rows
