"""The corridor of a machine's run: machine -> static solution -> bearings -> start -> solve.

Every bearing gets a folder that is that of a run, with its own case, cage, record and pictures;
beside them stands what happened to the shaft.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from flexcage.bearings import recording_of
from flexcage.case import Case
from flexcage.compiling import begin_compiling, build_bearing
from flexcage.core.binding import expect, path_of
from flexcage.core.errors import RunFailed
from flexcage.core.locks import held
from flexcage.core.output_folders import SHAFT_STORE, check_no_file
from flexcage.core.progress import Silent
from flexcage.core.timing import Stages
from flexcage.integrate.machine import MachineIntegration, rotor_store
from flexcage.machine.machine import Machine
from flexcage.machine.motion import (
    as_it_begins,
    case_in_motion,
    check_moves,
    starting_point,
)
from flexcage.machine.moving_seats import MovingSeats
from flexcage.machine.rotor import TurningShaft
from flexcage.machine.solution import BearingResult
from flexcage.machine.solve import solve_machine
from flexcage.machine.whirl import over_speeds
from flexcage.machine.writing import MACHINE, write_numbers
from flexcage.machine_run.folder import BegunMachine, attributes, begun_machine
from flexcage.machine_run.record import ShaftRecord
from flexcage.machine_run.run import MachineRun
from flexcage.machine_run.turning import Turning, turning_of
from flexcage.results.store import MemoryRunStore
from flexcage.run import Run, warnings_at_start
from flexcage.run.folder import check_written
from flexcage.run.foreseen import report_before
from flexcage.run.storing import run_store, stored_cage
from flexcage.stages import made_cage
from flexcage.system.begun import Start
from flexcage.system.problem import BearingSystem
from flexcage.system.shaft.problem import MachineSystem, release, shaft_data
from flexcage.system.shaft.problem import begun as begun_y
from flexcage.system.start import find_start, with_push


@dataclass(frozen=True)
class _Ready:
    """A bearing of the machine before the run begins."""

    case: Case
    bearing: BearingSystem
    start: Start
    run: Run
    store: MemoryRunStore


def simulate_machine(
    machine: Machine, *, out: str | Path | None = None, resume: bool = False, stress: bool = True,
    other_version: bool = False, progress: Callable[..., Any] | None = None,
) -> MachineRun:  # fmt: skip
    """Simulate a machine from its static solution on; results are kept in memory, or in the folder
    ``out`` as the run goes, a folder in it for every bearing.

    ``resume`` goes on with a run that stopped, from its last committed block; ``other_version``
    allows that with one that a flexcage of other physics began. Without ``stress``, a cage's is
    computed only when asked for, unless it may exceed the proof stress. ``progress`` is a context
    like ``core.progress.Progress``. Raises InputError for a machine that cannot run, RunFailed for
    a run that cannot go on, with what was computed kept.
    """
    expect(machine, Machine, "machine", "flexcage.load_machine reads one from a file")
    check_moves(machine)
    if out is None:
        return _simulated(machine, None, None, stress, progress)
    folder = path_of(out, "out")
    check_no_file(folder)
    if resume:
        check_written(folder, MACHINE)
    with held(folder, inside=True):
        begun = begun_machine(folder, machine, other_version=other_version) if resume else None
        return _simulated(machine, folder, begun, stress, progress)


def _simulated(
    machine: Machine, folder: Path | None, begun: BegunMachine | None, stress: bool,
    progress: Callable[..., Any] | None,
) -> MachineRun:  # fmt: skip
    clock = Stages(progress)
    solution = clock("static", solve_machine, as_it_begins(machine))
    if folder is not None and begun is None:
        write_numbers(machine, solution, over_speeds(machine, solution), folder)
    turning = begun.turning if begun else turning_of(TurningShaft(machine, solution))
    seats = MovingSeats(machine, solution)
    ready = [
        _ready(seats, k, own, folder, begun, clock, stress=stress)
        for k, own in enumerate(solution.bearings)
    ]
    system = _system(seats, ready, turning)
    clock.named("kernels of the machine", system.prepare)
    store = begun.shaft if begun else _new_store(machine, folder, system, ready, turning)
    integration = MachineIntegration(
        system, [recording_of(each.case.bearing) for each in ready],
        [each.store for each in ready], begun_y(system, [e.start for e in ready], turning.pose),
        store=store, solver=machine.solver, output=machine.output,
    )  # fmt: skip
    try:
        clock("solve", integration.march, progress)
    except (RunFailed, KeyboardInterrupt):
        ShaftRecord.of(store).write(folder)
        raise
    record = ShaftRecord.of(store)
    record.write(folder)
    runs = {
        own.name: each.run.finish(integration.effort, stress=stress)
        for own, each in zip(solution.bearings, ready, strict=True)
    }
    return MachineRun(machine, solution, runs, record, folder, clock).finish()


def _system(seats: MovingSeats, ready: Sequence[_Ready], turning: Turning) -> MachineSystem:
    bearings = [each.bearing for each in ready]
    for bearing in bearings:
        release(bearing)
    output = seats.machine.output
    rotor = shaft_data(bearings, turning.rotor, samples=output.block * output.vibration_ratio)
    return MachineSystem(bearings, rotor, seats.housing(bearings))


def _new_store(
    machine: Machine, folder: Path | None, system: MachineSystem, ready: Sequence[_Ready],
    turning: Turning,
) -> MemoryRunStore:  # fmt: skip
    """The store of the rotor: made last, it says that the run has begun."""
    names = [b.place.name for b in machine.bearings]
    cases = {name: each.case for name, each in zip(names, ready)}
    return rotor_store(
        folder and folder / SHAFT_STORE, system, names, duration=machine.solver.duration,
        output=machine.output, attrs=attributes(machine, turning, cases),
    )  # fmt: skip


def _ready(
    seats: MovingSeats, k: int, own: BearingResult, folder: Path | None, begun: BegunMachine | None,
    clock: Stages, *, stress: bool,
) -> _Ready:  # fmt: skip
    """Mesh, modes, kernels and start of one bearing, and the folder of its run begun or opened."""
    machine = seats.machine
    case = case_in_motion(machine, machine.bearings[k], own)
    into = folder / own.name if folder else None
    foreseen = report_before(case, stress=stress)
    compiling = begin_compiling(case)
    if begun and into:
        case = begun.case(own.name, case)
        mesh, cage = stored_cage(case, begun.bearings[own.name], into, clock)
    else:
        mesh, cage = made_cage(case, clock)
    bearing = clock.named(
        "kernels", build_bearing, case, mesh, cage, compiling, seat=seats.compliance(k)
    )
    seats.begin(k, bearing)
    start = clock("start", _started, case, bearing, own, clock.progress)
    seats.release(k, bearing)
    start = seats.moved(k, bearing, start)
    warned = (*foreseen, *warnings_at_start(case, mesh, cage, start))
    store = begun.bearings[own.name] if begun else run_store(
        case, bearing, (mesh, cage), into, warned=warned, machine=machine.name
    )  # fmt: skip
    return _Ready(
        case, bearing, start, Run(case, store, into, mesh, cage, start, Stages(None)), store
    )


def _started(
    case: Case, bearing: BearingSystem, own: BearingResult, progress: Callable[..., Any] = Silent
) -> Start:
    """Where a bearing begins: at its static solution in the machine."""
    with progress(1.0, f"start of {own.name}") as bar:
        start = find_start(
            bearing, limit_force=case.limits.assembly_force, statics=lambda: starting_point(own),
            advance=bar.to,
        )  # fmt: skip
    return with_push(start, bearing.layout, case.start)
