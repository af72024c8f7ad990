"""What can be said of a run from its case alone, before anything is computed."""

from __future__ import annotations

import logging
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from math import ceil, floor, log10, pi

import numpy as np

from flexcage.case import Case
from flexcage.case.checks import land_clearance_mismatch, not_reached
from flexcage.case.plausibility import implausible_values
from flexcage.case.unread import not_used
from flexcage.core.units import describe
from flexcage.core.warning import RunWarning
from flexcage.geometry.temperature import beyond_service
from flexcage.results.bootstrap import FEWEST
from flexcage.results.slip import BearingNumbers
from flexcage.results.warnings_at_end import LEAST_TURNS
from flexcage.system.bodies import speeds_over

log = logging.getLogger(__name__)

#: Bore [mm] times speed [rpm] up to which test bearings have run on a rig, of 120 mm at 25,000 rpm
#: (E. N. Bamberger, E. V. Zaretsky and H. Signer, NASA TN D-7870, 1975): a limit that is
#: demonstrated, not derived.
MOST_DN = 3e6
_SLIP = 1.05  # longer than by the epicyclic speed, for cages slip
_INSTANTS = 2001  # at which the drive's speed is looked at
_LONGEST = 1e6  # times the duration that is looked for

_reported: ContextVar[bool] = ContextVar("reported", default=False)


def foreseen(case: Case, *, stress: bool = True) -> tuple[RunWarning, ...]:
    """What a case alone tells of its run's figures; ``stress``: is the cage's to be computed?"""
    said = [("not_reached", text) for text in not_reached(case)]
    said += [("not_used", text) for text in not_used(case)]
    said += implausible_values(case)
    if case.cage is not None:
        said += [("land_clearance", text) for text in land_clearance_mismatch(case)]
        if text := beyond_service(case.cage.material, case.cage.temperature):
            said.append(("cage_temperature", text))
    found = [*(RunWarning(*each) for each in said), *_short(case), *_fast(case)]
    return (*found, *(_coarse(case) if stress else ()))


def already_reported() -> bool:
    """Is this run one of several that were told of at once?"""
    return _reported.get()


def report_before(case: Case, *, stress: bool) -> tuple[RunWarning, ...]:
    """What is foreseen of a run; logs it unless ``reported_at_once`` has done so."""
    found = foreseen(case, stress=stress)
    if not _reported.get():
        for warning in found:
            log.warning(warning.text)
    return found


@contextmanager
def reported_at_once(cases: Iterable[Case], *, stress: bool = True) -> Iterator[None]:
    """Log what is foreseen of several runs, once a kind, with the number of cases; those that are
    simulated within do not log it again."""
    report_foreseen(cases, stress=stress)
    token = _reported.set(True)
    try:
        yield
    finally:
        _reported.reset(token)


def report_foreseen(cases: Iterable[Case], *, stress: bool = True) -> None:
    """Log what is foreseen of several runs, once a kind, with the number of cases."""
    first: dict[str, list[str]] = {}  # by kind, what the first case that has it is told
    count: dict[str, int] = {}
    total = 0
    for case in cases:
        total += 1
        kinds: dict[str, list[str]] = {}
        for warning in foreseen(case, stress=stress):
            kinds.setdefault(warning.key, []).append(warning.text)
        for key, texts in kinds.items():
            first.setdefault(key, texts)
            count[key] = count.get(key, 0) + 1
    for key, texts in first.items():
        whose = f" ({count[key]} of {total} cases; this is the first of them)" if total > 1 else ""
        for text in texts:
            log.warning("%s%s", text, whose)


def _short(case: Case) -> Iterator[RunWarning]:
    """Too few turns of the cage, or passes of its elements, by the epicyclic speed."""
    carrier = "cage" if case.cage else f"{case.bearing.element}s"
    count, settle = case.bearing.element_count, case.output.settle
    wanted = max(LEAST_TURNS, FEWEST / count)
    duration = case.solver.duration
    turns = _turns(case, duration)
    if turns >= wanted or not _turns(case, _LONGEST * duration):
        return
    few = []
    if turns < LEAST_TURNS:
        few.append(f"{turns:.2g} turns of the {carrier} (means need {LEAST_TURNS:g})")
    if turns * count < FEWEST:
        passes = round(turns * count)
        word = f"{case.bearing.element} pass{'' if passes == 1 else 'es'}"
        few.append(f"{passes} {word} (intervals need {FEWEST})")
    enough = duration
    while _turns(case, enough) < _SLIP * wanted and enough < _LONGEST * duration:
        enough *= 1.02
    yield RunWarning(
        "short_run",
        f"The run is short: without the first {100.0 * settle:g} % (output.settle) it has "
        f"{' and '.join(few)}; solver.duration = {describe(_rounded_up(enough), 'ms')} is enough.",
    )


def _turns(case: Case, duration: float) -> float:
    """Turns of a cage without slip in the settled part of a run so long."""
    t = np.linspace(case.output.settle * duration, duration, _INSTANTS)
    inner = float(np.trapezoid(np.abs(speeds_over(case.drive, t)), t))
    ratio = BearingNumbers.of(case.mounted.bearing).nominal.kinematics(1.0).cage_speed
    return inner * abs(ratio) / (2.0 * pi)


def _rounded_up(value: float) -> float:
    """The next number of two digits."""
    step = 10.0 ** (floor(log10(value)) - 1)
    return ceil(value / step * (1.0 - 1e-9)) * step


def _fast(case: Case) -> Iterator[RunWarning]:
    """A speed beyond what lubrication has been shown to bear."""
    bearing = case.bearing
    t = np.linspace(0.0, case.solver.duration, _INSTANTS)
    rpm = float(np.abs(speeds_over(case.drive, t)).max()) * 30.0 / pi
    factor = 1e3 * bearing.bore * rpm
    if factor > MOST_DN:
        within = floor(MOST_DN / (1e3 * bearing.bore) / 100.0) * 100
        yield RunWarning(
            "speed_factor",
            f"The inner ring reaches {rpm:,.0f} rpm, a speed factor (bore in mm times rpm) of "
            f"{factor / 1e6:.3g} million. Test bearings have run at {MOST_DN / 1e6:g} million "
            "(NASA TN D-7870); no known lubrication is shown to bear more: "
            f"{within:,} rpm are within it.",
        )


def _coarse(case: Case) -> Iterator[RunWarning]:
    """A mesh for motion whose stress is read; how wrong it is: tests/README.md, an N1013's."""
    mesh = case.mesh
    if case.cage_model != "flexible" or case.modes.body or mesh.file:
        return
    if mesh.fineness == "coarse" and mesh.size is None and mesh.fillet_size is None:
        yield RunWarning(
            "coarse_mesh",
            "The mesh is coarse: good for motion, but stress at pocket corners reads 25 to 40 % "
            "low (measured on an N1013's cage); mesh.fineness = 'medium' is enough for stress, "
            "within 2 to 6 %.",
        )
    elif mesh.order == 1:
        yield RunWarning(
            "coarse_mesh",
            "The elements are linear (mesh.order = 1): they are too stiff, and stress at pocket "
            "corners reads about a third low (measured on an N1013's cage); mesh.order = 2 is "
            "enough for stress.",
        )
