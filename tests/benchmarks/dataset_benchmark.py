"""What a data set of signals costs: signals an hour, and what a case takes beside its integration.

Every case goes a worker's way: its text, mesh, start, run in memory, figures, recording, files.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from flexcage.case import Case, load_case
from flexcage.cli import main
from flexcage.study.axes import LatinHypercube
from flexcage.study.dataset.folder import DatasetFolder, Settings
from flexcage.study.dataset.keeping import RecordingKeeper
from flexcage.study.folder import Folder
from flexcage.study.plan import make_plan
from flexcage.study.spec import Study
from flexcage.study.work import do_case, order_of
from flexcage.system.integrable import Integrable

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SENSOR = {
    "type": "accelerometer", "name": "casing", "rate": "12 kHz", "resonance": "32 kHz",
    "low_pass": "5 kHz", "noise": "0.003 m/s^2/Hz^0.5",
}  # fmt: skip
SPEED, BEFORE = "1797 rpm", 0.1  # s before the signal begins
WARM = 0.01  # s of the signal of a case that makes kernels and modes
DAY, CORES, TARGET = 86_400.0, 2, 10_000  # signals a day that are wanted of two cores
SUBJECTS = ("6205 rigid", "6205 flexible", "N1013 rigid", "N1013 flexible", "NU205 rigid")
QUICK: dict[str, Any] = {"seconds": 0.02, "cases": 2, "subjects": ("6205 rigid",)}
MB = 1e6


def measure(
    case: Case, *, seconds: float = 1.0, cases: int = 2, subjects: tuple[str, ...] = SUBJECTS
) -> dict[str, Any]:
    """A row for each subject, named by ``columns``: signals of ``seconds``, ``cases`` of each after
    a short one that makes kernels and modes. ``case`` is the N1013."""
    table = {}
    for subject in subjects:
        bearing, model = subject.split()
        plain = _case_of(bearing, case)
        _measured(_signal_case(plain, model, WARM), WARM, 1)
        table[subject] = _measured(_signal_case(plain, model, seconds), seconds, cases)
    rows = {name: list(row.values()) for name, row in table.items()}
    return {
        "columns": list(next(iter(table.values()))), **rows, "seconds": seconds, "cases": cases,
        "speed": SPEED, "target_a_day": TARGET, "load_average": round(os.getloadavg()[0], 1),
    }  # fmt: skip


def _case_of(bearing: str, n1013: Case) -> Case:
    if bearing == "N1013":
        return n1013
    if bearing == "6205":
        return load_case(EXAMPLES / "6205_signals.toml")
    with tempfile.TemporaryDirectory() as top, redirect_stdout(StringIO()):
        file = Path(top) / "case.toml"
        main(["--quiet", "new", bearing, "-o", str(file)])
        return load_case(file)


def _signal_case(case: Case, model: str, seconds: float) -> Case:
    """The case with one sensor, for a signal of so many seconds."""
    whole = seconds + min(BEFORE, seconds)
    table = {**case.to_table(), "sensors": [SENSOR]}
    changes: dict[str, Any] = {
        "solver.duration": f"{whole} s", "output.settle": 1.0 - seconds / whole,
        "drive.speed": SPEED, "cage.model": model,
    }  # fmt: skip
    return load_case(table, overrides=changes)


def _measured(base: Case, seconds: float, count: int) -> dict[str, Any]:
    load = base.load.radial
    axis = LatinHypercube({"load.radial": (f"{0.8 * load} N", f"{1.2 * load} N")}, count)
    study = Study(case=base, axes=(axis,), outputs=("cage_speed",), keep="figures")
    with tempfile.TemporaryDirectory() as top, _clock() as clock:
        data = DatasetFolder(Path(top) / "data")
        data.prepare(Settings())
        plan, folder = make_plan(study), Folder(data.study)
        folder.prepare(plan)
        spent, memory, rows = [], [], []
        for planned in plan.cases:
            keeper = RecordingKeeper(str(data.path), "data", (), planned)
            clock["advance"], begin = 0.0, time.process_time()
            done = do_case(order_of(plan, planned, folder.path, keeper))
            assert done == "done", folder.failure(planned.hash)
            spent.append((time.process_time() - begin, clock["advance"]))
            memory.append(psutil.Process().memory_info().rss)
            rows.append(folder.row(planned.hash))
        size = sum(p.stat().st_size for p in data.path.rglob("*") if p.is_file())
    cpu, advance = map(float, np.median(spent, axis=0))
    shares = [abs(row.figures["energy_of_drive"].value) for row in rows]
    worst = max(filter(isfinite, shares), default=0.0)
    return {
        "cpu_s_a_signal": round(cpu, 2), "integration_s": round(advance, 2),
        "overhead": round(cpu / advance - 1.0, 2),
        "bearing_s_a_core_hour": round(3600.0 * seconds / cpu),
        "signals_an_hour": round(3600.0 / cpu), "a_day_on_2_cores": round(CORES * DAY / cpu),
        "imbalance_of_drive": float(f"{worst:.2g}"),
        "memory_mb": round(memory[-1] / MB), "growth_mb_a_case": round(_slope(memory) / MB, 2),
        "kb_a_case": round(size / len(rows) / 1e3),
    }  # fmt: skip


def _slope(values: list[int]) -> float:
    """Growth from one to the next, by least squares; 0 of one alone."""
    return float(np.polyfit(range(len(values)), values, 1)[0]) if len(values) > 1 else 0.0


@contextmanager
def _clock() -> Iterator[dict[str, float]]:
    """Within it, the processor time of the thread inside the compiled ``advance``."""
    found, plain = {"advance": 0.0}, Integrable.advance

    def timed(self: Integrable, *args: Any) -> Any:
        begin = time.thread_time()
        try:
            return plain(self, *args)
        finally:
            found["advance"] += time.thread_time() - begin

    Integrable.advance = timed  # type: ignore[method-assign, assignment]
    try:
        yield found
    finally:
        Integrable.advance = plain  # type: ignore[method-assign]
