"""The stages of a simulation: each turns a case and what came before into the next frozen value."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.bearings import motion_of, recording_of
from flexcage.bodies.cage import BODY_VERSION, flexible_from_reduction, rigid_from_tets
from flexcage.bodies.floating_frame import FlexibleBody
from flexcage.cages.build import build_cage_mesh, reduce_cage, reduction_of, rigid_interface_of
from flexcage.case import Case, load_case, load_extension
from flexcage.case.extensions import sources
from flexcage.core import jit
from flexcage.core.cache import cached_arrays
from flexcage.core.hashing import content_hash
from flexcage.core.progress import Silent
from flexcage.core.timing import Stages
from flexcage.core.warning import RunWarning
from flexcage.integrate.recorded import new_store
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.quality import check_mesh
from flexcage.modes.reduction import CageReduction
from flexcage.modes.table import ModeTable
from flexcage.results import room
from flexcage.results.cage_file import FORMAT as CAGE_FORMAT
from flexcage.results.cage_file import CageFile, cage_file, cage_record, check_same
from flexcage.results.store import MemoryRunStore
from flexcage.results.warnings import to_text
from flexcage.run.folder import keep_cage, kept_cage, write_case
from flexcage.static import AT_START, solve_static
from flexcage.system.constraints import names_of
from flexcage.system.layout import Layout
from flexcage.system.problem import Bearing
from flexcage.system.start import Start, constrained, find_start, pushed

log = logging.getLogger(__name__)

Cage = tuple[CageMesh, CageReduction | None]  # the second: None for a rigid cage


def run_store(
    case: Case,
    bearing: Bearing,
    cage: Cage,
    folder: Path | None,
    *,
    study: Path | None = None,
    warned: Sequence[RunWarning] = (),
) -> MemoryRunStore:
    """A new store to write to, in ``folder`` or in memory; the folder receives case and cage, or
    its ``study`` the cage."""
    attrs = {"case": case.to_toml(), "hash": case.hash, "warnings": to_text(warned)}
    if folder is not None:
        announce_room(case, bearing, folder)
        write_case(folder, case)
        file = _cage_file(case, cage)
        keep_cage(folder, file, study=study)
        attrs["cage"] = file.digest
    return new_store(
        folder and folder / "results.zarr",
        bearing,
        recording_of(case.bearing),
        duration=case.solver.duration,
        output=case.output,
        attrs=attrs,
    )


def made_cage(case: Case, stages: Stages) -> Cage:
    """The cage of a case: its mesh and, if it is flexible, its reduction."""
    mesh = stages.named("mesh", cage_mesh, case)
    return mesh, stages.named("modes", cage_reduction, case, mesh)


def stored_cage(case: Case, store: MemoryRunStore, folder: Path, stages: Stages) -> Cage:
    """The cage that a stored run's results refer to.

    A run that did not keep it (``output.keep_cage``) gets it made anew; InputError if that is
    another one.
    """
    record = stages.named("cage", kept_cage, folder, store)
    if record.mesh is None:
        mesh, made = made_cage(case, stages)
        assert made is not None, "a rigid cage keeps its mesh"
        check_same(record, made.record())
        return mesh, replace(made, stored=record.reduced)
    if case.cage_model == "rigid":
        return record.mesh, None
    cage = reduction_of(
        record.mesh,
        cage=case.cage,
        defects=case.all_defects,
        spec=case.modes,
        order=case.mesh.order,
        stored=record.reduced,
    )
    return record.mesh, cage


def _cage_file(case: Case, cage: Cage) -> CageFile:
    """What a run's folder keeps of its cage. That of a flexible cage is packed once."""
    mesh, reduction = cage
    if reduction is None:
        return cage_file(cage_record(mesh, {}))
    large = case.output.keep_cage

    def make() -> dict[str, np.ndarray]:
        body = flexible_from_reduction(reduction, case.modes).data._asdict()
        reduced = {**reduction.record(), "body": {k: np.asarray(v) for k, v in body.items()}}
        return vars(cage_file(cage_record(mesh, reduced, large=large)))

    key = content_hash(CAGE_FORMAT, reduction.content, BODY_VERSION, case.modes, large)
    kept = reduction.once(f"file {key}", lambda: cached_arrays("cage", key, make))
    return CageFile(str(kept["digest"]), kept["content"])


def announce_room(case: Case, bearing: Bearing, folder: Path) -> None:
    """Say how much room the results will take; EnvironmentLacks if there cannot be enough."""
    output = case.output
    recording = recording_of(case.bearing)
    short = new_store(None, bearing, recording, duration=0.0, output=output, attrs={})
    rate = room.expected_rate(short.layout, output.rate, output.vibration_rate)
    room.announce(folder, rate, case.solver.duration)


def cage_mesh(case: Case) -> CageMesh:
    """Mesh of the case's cage, checked."""
    mesh = build_cage_mesh(**case.cage_shape)
    check_mesh(mesh, where=case.mesh.file or "mesh")
    return mesh


def cage_reduction(case: Case, mesh: CageMesh) -> CageReduction | None:
    """Finite elements, modes and interface of a flexible cage; None for a rigid one."""
    if case.cage_model == "rigid":
        return None
    made = reduce_cage(
        mesh, cage=case.cage, defects=case.all_defects, spec=case.modes, order=case.mesh.order
    )
    return next((cage for cage in _at_hand if cage.same_as(made)), made)


_at_hand: list[CageReduction] = []  # one at most


def keep_at_hand(cage: CageReduction | None) -> None:
    """Have the next case take this cage, with all that was derived from it, if it has the same:
    the cases that a study's worker computes one after the other often do."""
    _at_hand[:] = [] if cage is None else [cage]


def cage_modes(case: Case) -> ModeTable:
    """Mode table of the case's cage, taken as flexible."""
    mesh = cage_mesh(case)
    reduction = cage_reduction(case.replace("cage.model", "flexible"), mesh)
    assert reduction is not None
    return reduction.table


@dataclass(frozen=True)
class Compiling:
    """Pieces of kernels left to be compiled, as bytes in a pipe, and a process that takes them
    too; whoever is free takes the next."""

    pieces: int  # the pipe's end to read from
    helper: subprocess.Popen | None


#: Has another process import the flexcage of this one, of which compiled kernels are found by their
#: path: one installed and one in the working folder are two.
SAME_PACKAGE = (
    f"import sys; home = {str(Path(__file__).resolve().parents[1])!r}; "
    "home in sys.path or sys.path.insert(0, home)"
)


def begin_compiling(case: Case) -> Compiling | None:
    """Begin to compile the kernels of the case's family in a process of its own, if they are not on
    disk yet.

    Meanwhile the cage is meshed and reduced. ``build_bearing`` helps, and waits for it.
    """
    if jit.kernels_cached(case.bearing.family):
        return None
    log.info("compiling the kernels for the first time: 20 to 30 seconds, once")
    pieces, end = os.pipe()
    os.write(end, bytes(range(MOST_PIECES)))
    os.close(end)
    command = f"{SAME_PACKAGE}; from flexcage.core.orphan import end_with; "
    command += f"end_with({os.getpid()}); from flexcage.stages import compile_pieces; "
    command += "compile_pieces(*sys.argv[1:])"
    try:
        helper = subprocess.Popen(
            [sys.executable, "-P", "-c", command, case.to_toml(), *sources()],
            stdin=pieces, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            env={**os.environ, **jit.cache_environment()},
        )  # fmt: skip
    except OSError:
        helper = None  # then, or if the case is too long for a command, this one does it alone
    return Compiling(pieces, helper)


MOST_PIECES = 32  # there are fewer


def compile_pieces(text: str, *use: str) -> None:
    """Compile pieces of the kernels of a case, canonical TOML: those that standard input numbers.

    ``use``: the user's files to load first. Kernels are the same for every cage: any body serves.
    """
    for source in use:
        load_extension(source)
    case = load_case(text)
    body = rigid_from_tets(np.eye(4, 3, -1), np.array([[0, 1, 2, 3]]), 1.0)
    _compile_from(sys.stdin.fileno(), _bearing_of(case, body, _rigid_interface(case)))


def _compile_from(pieces: int, bearing: Bearing) -> None:
    """Compile what can be read from ``pieces``, until nothing is left."""
    all_pieces = bearing.pieces()
    while number := os.read(pieces, 1):
        if number[0] < len(all_pieces):
            all_pieces[number[0]]()


def build_bearing(
    case: Case, mesh: CageMesh, cage: CageReduction | None, compiling: Compiling | None = None
) -> Bearing:
    """Bodies, contacts and compiled equations of motion."""
    bearing = _bearing_of(case, *_cage_in_motion(case, mesh, cage))
    compiling = compiling or begin_compiling(case)
    if compiling is not None:
        _compile_from(compiling.pieces, bearing)
        os.close(compiling.pieces)
        if compiling.helper is not None:
            compiling.helper.wait()
        for piece in bearing.pieces():  # what the helper took: read from disk, or compiled here
            piece()
    bearing.evaluate  # noqa: B018
    jit.mark_compiled(case.bearing.family)
    return bearing


def assembled_start(case: Case, bearing: Bearing, progress: Callable[..., Any] = Silent) -> Start:
    """Where a run begins: the bearing assembled and in equilibrium at the drive's first speed, its
    cage pushed off if the case says so, and all on the constraints.

    ``progress`` is a context like ``core.progress.Progress``.
    """
    limit = case.limits.assembly_force
    with progress(1.0, "start") as bar:
        start = find_start(
            bearing,
            limit_force=limit,
            statics=lambda: solve_static(case, options=AT_START),
            told=bar.to,
        )
    start = pushed(start, bearing.layout, case.start)
    return constrained(start, bearing, case.constraints, limit_force=limit)


def _cage_in_motion(
    case: Case, mesh: CageMesh, cage: CageReduction | None
) -> tuple[FlexibleBody, Any]:
    """The cage's body, and what moves in its pockets."""
    if cage is not None:
        body = flexible_from_reduction(cage, case.modes.damped_as(case.cage.material))
        return body, cage.interface
    body = rigid_from_tets(mesh.points, mesh.tets, case.cage.material.density)
    return body, _rigid_interface(case)


def _rigid_interface(case: Case) -> Any:
    count = case.bearing.element_count
    return rigid_interface_of(case.cage, pocket_count=count, defects=case.all_defects)


def _bearing_of(case: Case, body: FlexibleBody, interface: Any) -> Bearing:
    motion, Z = motion_of(case.bearing), case.bearing.element_count
    model = motion.build_model(
        case.bearing, case.cage, body, interface, contacts=case.contacts,
        lubricant=case.lubricant, drive=case.drive, load=case.load, mount=case.mount,
        seed=case.seed,
    )  # fmt: skip
    return Bearing(
        motion, case.bearing, model, case.contacts,
        Layout(Z, body.modes, names_of(case.constraints)),
        constraints=case.constraints, block=case.output.block, stride=case.output.vibration_ratio,
        interval=1.0 / case.output.rate,
    )  # fmt: skip
