"""How long the modes and the stress fields of a mesh from a file take, and how much memory the
modes of any mesh take, said before they are made.

Estimates from one core of a server: a cage of 109,000 unknowns that repeats takes 3 s for modes and
5 to 10 s for stress, one of 297,000 meshed freely 22 s and 18 s. Where nothing repeats, work grows
with the power 4/3 of the unknowns, the numbers in the factor of a nested dissection in space.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from flexcage.core.errors import InputError
from flexcage.core.memory import free_memory, in_bytes, total_memory
from flexcage.core.pace import Pace
from flexcage.core.units import describe
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel

log = logging.getLogger(__name__)

_REPEATS = 1e5  # unknowns to which these seconds belong
_REPEATS_MODES, _REPEATS_STRESS = 3.0, 7.0
_WHOLE = 3e5
_WHOLE_MODES, _WHOLE_STRESS = 22.0, 18.0
_GROWTH = 4.0 / 3.0
# bytes for each unknown beside vectors, and for each unknown to the power 4/3 in a whole factor:
# 2.7 to 2.9 kB an unknown are measured with 24 vectors, 4.1 kB with 232; 23 GB for 1.8 million
_MATRICES, _FACTOR = 2700.0, 96.0
_LOADS = 936  # to which the seconds of stress belong
# shares of the time of modes: matrices and factors, then for each solution and each of its loads
_FACTORS, _SOLUTION, _LOAD = 0.4, 0.012, 0.0004


def check_memory(model: FEModel, vectors: int) -> None:
    """Refuse a basis of so many vectors that takes more memory than this machine has; warn of one
    that takes more than is free."""
    need, memory = modes_bytes(model, vectors), total_memory()
    repeats = "" if model.sectors is not None else ", which do not repeat from pocket to pocket,"
    text = f"The modes of a cage's mesh of {len(model.nodes):,} nodes{repeats} take about "
    text += f"{in_bytes(need)} of memory"
    size = model.info.get("size")
    larger = f" than {describe(size, 'mm')}" if isinstance(size, float) else ""
    remedy = f"give a larger mesh.size{larger}, mesh.order = 1, or cage.model = 'rigid'"
    if need > memory:
        raise InputError(
            f"{text}, and this machine has {in_bytes(memory)}; {remedy}.",
            where="mesh",
            value=len(model.nodes),
        )
    if need > (free := free_memory()):
        log.warning("%s, and %s are free; %s", text, in_bytes(free), remedy)


def modes_bytes(model: FEModel, vectors: int) -> float:
    """Bytes that a modal basis of so many vectors takes at most while it is made."""
    whole = 0.0 if model.sectors is not None else _FACTOR * model.n_dof**_GROWTH
    return model.n_dof * (_MATRICES + 8.0 * vectors) + whole


@contextmanager
def modes_progress(solver: FreeBodySolver) -> Iterator[None]:
    """Say how long the modal basis of a mesh from a file takes, and how far it is."""
    done = _FACTORS

    def solved(loads: int) -> None:
        nonlocal done
        done += _SOLUTION + _LOAD * loads
        pace.to(done)

    with Pace(_described("modes", solver.model), modes_seconds(solver.model)) as pace:
        solver.solved = solved
        try:
            yield
        finally:
            solver.solved = None


@contextmanager
def stress_progress(model: FEModel, what: str, loads: int) -> Iterator[Callable[[int], None]]:
    """Say how long the stress fields of so many unit loads take; gives what is to be called with
    the number of loads done in addition."""
    done = 0

    def solved(more: int) -> None:
        nonlocal done
        done += more
        pace.to(done / loads)

    label = _described(f"stress fields of {what}", model)
    with Pace(label, stress_seconds(model, loads)) as pace:
        yield solved


def modes_seconds(model: FEModel) -> float | None:
    """Seconds that the modal basis takes; None for a mesh that flexcage built."""
    if not _file_name(model):
        return None
    if model.sectors is not None:
        return _REPEATS_MODES * model.n_dof / _REPEATS
    return _WHOLE_MODES * (model.n_dof / _WHOLE) ** _GROWTH


def stress_seconds(model: FEModel, loads: int) -> float | None:
    """Seconds that the fields of so many unit loads take; None for a mesh that flexcage built."""
    if not _file_name(model):
        return None
    share = loads / _LOADS
    if model.sectors is not None:
        return _REPEATS_STRESS * share * model.n_dof / _REPEATS
    return _WHOLE_STRESS * share * (model.n_dof / _WHOLE) ** _GROWTH


def _file_name(model: FEModel) -> str:
    """Name of the file that a mesh was read from; empty for one that flexcage built."""
    source = model.info.get("source", "built")
    return "" if source == "built" else Path(str(source)).name


def _described(what: str, model: FEModel) -> str:
    """``what`` is made of which mesh, how large, and whether it repeats: for the log."""
    repeats = "repeats from pocket to pocket" if model.sectors is not None else "does not repeat"
    return f"{what} of {_file_name(model)} ({model.n_dof:,} unknowns, {repeats})"
