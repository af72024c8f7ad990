"""Compiling ahead: a process of its own compiles a case's kernels while its cage is meshed."""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from flexcage.case import Case, load_case, load_extension
from flexcage.case.extensions import sources
from flexcage.case.sections import MotionSections
from flexcage.core import jit, kernel_marks
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.reduction import CageReduction
from flexcage.stages import bearing_in_motion, bearing_to_compile
from flexcage.system.problem import BearingSystem

log = logging.getLogger(__name__)

MOST_PIECES = 32  # there are fewer

#: Has another process import the flexcage of this one, of which compiled kernels are found by their
#: path: one installed and one in the working folder are two.
SAME_PACKAGE = (
    f"import sys; home = {str(Path(__file__).resolve().parents[1])!r}; "
    "home in sys.path or sys.path.insert(0, home)"
)


@dataclass(frozen=True)
class Compiling:
    """Pieces of kernels left to be compiled, as bytes in a pipe, and a process that takes them
    too; whoever is free takes the next."""

    pieces: int | None = None  # the pipe's end to read from; None: nothing is left
    helper: subprocess.Popen | None = None


def kernels_of(specs: MotionSections) -> str:
    """Name of the kernels that a run needs: its family's, or those with rings that bend, or without
    a cage."""
    parts = (specs.bearing.family, "rings" * specs.rings_bend, "uncaged" * (specs.cage is None))
    return "-".join(filter(None, parts))


def begin_compiling(case: Case) -> Compiling:
    """Begin to compile the kernels of the case's family in a process of its own, if they are not on
    disk yet.

    Meanwhile the cage is meshed and reduced. ``build_bearing`` helps, and waits for it.
    """
    if kernel_marks.kernels_cached(kernels_of(case)):
        return Compiling()
    log.info(_what_is_compiled(case))
    pieces = _numbers()
    command = f"{SAME_PACKAGE}; from flexcage.core.orphan import end_with; "
    command += f"end_with({os.getpid()}); from flexcage.compiling import compile_pieces; "
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


def _numbers() -> int:
    """A pipe's end from which the number of every piece can be read, once."""
    pieces, end = os.pipe()
    os.write(end, bytes(range(MOST_PIECES)))
    os.close(end)
    return pieces


def _what_is_compiled(case: Case) -> str:
    """The message that kernels are compiled: which, and how long that takes."""
    own_family = not type(case.bearing).__module__.startswith(f"{__name__.partition('.')[0]}.")
    if own_family or not kernel_marks.own_kernels_cached(kernels_of(case)):
        return "compiling the kernels for the first time: up to half a minute, once"
    return "compiling the kernels that are new: a few seconds, once"


def compile_pieces(text: str, *use: str) -> None:
    """Compile pieces of the kernels of a case, canonical TOML: those that standard input numbers.

    ``use``: the user's files to load first.
    """
    for source in use:
        load_extension(source)
    _compile_from(sys.stdin.fileno(), bearing_to_compile(load_case(text)))


def _compile_from(pieces: int, bearing: BearingSystem) -> None:
    """Compile what can be read from ``pieces``, until nothing is left."""
    all_pieces = bearing.pieces()
    while number := os.read(pieces, 1):
        if number[0] < len(all_pieces):
            all_pieces[number[0]]()


def build_bearing(
    specs: MotionSections,
    mesh: CageMesh | None,
    cage: CageReduction | None,
    compiling: Compiling | None = None,
    *,
    seat: np.ndarray | None = None,
) -> BearingSystem:
    """Bodies, contacts and compiled equations of motion.

    ``compiling`` is what ``begin_compiling`` began; without it, this process compiles alone what is
    not on disk yet. ``seat`` as ``bearing_in_motion`` takes it.
    """
    bearing = bearing_in_motion(specs, mesh, cage, seat=seat)
    if compiling is None:
        cached = kernel_marks.kernels_cached(kernels_of(specs))
        compiling = Compiling() if cached else Compiling(_numbers())
    if compiling.pieces is not None:
        _compile_from(compiling.pieces, bearing)
        os.close(compiling.pieces)
        if compiling.helper is not None:
            compiling.helper.wait()
        for piece in bearing.pieces():  # what the helper took: read from disk, or compiled here
            piece()
    bearing.evaluate  # noqa: B018
    if compiling.pieces is not None:
        kernel_marks.mark_compiled(kernels_of(specs))
    return bearing
