"""What a study costs beside its cases: rates of one and two workers, memory of the client."""

from __future__ import annotations

import os
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from flexcage.case import Case
from flexcage.simulate import simulate
from flexcage.study.axes import LatinHypercube
from flexcage.study.folder import Folder
from flexcage.study.plan import make_plan
from flexcage.study.run import run_study
from flexcage.study.spec import Study
from flexcage.study.work import do_case, order_of

CASES = 32
WARM = 4  # cases that return before rates are taken: by then every worker has begun
OUTPUTS = ("cage_speed", "pocket_force.max")
DURATION = 1e-3
QUICK: dict[str, Any] = {"cases": 6, "trivial_cases": 6}  # whether it runs
MB = 1e6


def measure(case: Case, *, cases: int = CASES, trivial_cases: int = 1000) -> dict[str, Any]:
    """Figures by name, as README.md describes them."""
    case = case.replace("cage.model", "rigid").replace("mesh.fineness", "coarse")
    with tempfile.TemporaryDirectory() as folder:
        top = Path(folder)
        study = _study(case.replace("solver.duration", DURATION), cases)
        plain, longer = _loop_seconds(study, top / "loop")
        one, two = (_timed(study, top / f"{n}", workers=n) for n in (1, 2))
        handling = 1.0 / one["rate"] - one["seconds"]
        load = os.getloadavg()[0]
        trivial = case.replace("solver.duration", 2.0 / case.output.rate)
        many = _timed(_study(trivial, trivial_cases, keep="figures"), top / "many", workers=2)
        return {
            "speedup_2_workers": round(two["rate"] / one["rate"], 2),
            "overhead_s_per_case": round(longer + handling, 3),
            "handling_s_per_case": round(handling, 3),
            "plain_s_per_case": round(plain, 3),
            "start_s": round(two["start_s"], 1),
            "client_growth_mb": round(many["growth_mb"], 1),
            "trivial_cases": trivial_cases,
            "scheduler_ms_per_case": round(many["scheduler_ms"], 1),
            "client_ms_per_case": round(many["client_ms"], 1),
            "plan_ms_per_case": round(_plan_ms(study), 1),
            "bytes_per_run": one["bytes"],
            "files_per_run": one["files"],
            "bytes_per_figures": many["bytes"],
            "load_average": round(load, 1),
        }


class Watch:
    """A progress context that notes, as every case comes back, the time and this process."""

    def __init__(self, total: float, label: str) -> None:
        self.times: list[float] = []
        self.memory: list[int] = []
        self.process = psutil.Process()

    def __call__(self, total: float, label: str) -> Watch:
        return self

    def __enter__(self) -> Watch:
        self.begin = time.perf_counter()
        return self

    def __exit__(self, *error: object) -> None:
        """Nothing to close."""

    def begin_at(self, done: float) -> None:
        self.cpu = sum(self.process.cpu_times()[:2])

    def to(self, done: float) -> None:
        while len(self.times) < int(done + 1e-9):
            self.times.append(time.perf_counter())
            self.memory.append(self.process.memory_info().rss)
            self.scheduler = _scheduler_seconds()


def _study(case: Case, count: int, *, keep: str = "runs") -> Study:
    ranges = {"load.radial": ("500 N", "1500 N"), "drive.speed": ("4000 rpm", "8000 rpm")}
    axis = LatinHypercube(ranges, count)
    return Study(case=case, axes=(axis,), outputs=OUTPUTS, keep=keep)


def _loop_seconds(study: Study, folder: Path) -> tuple[float, float]:
    """Median seconds of a case by ``simulate``, and how much longer a worker's way takes.

    Both in this process, in turns, so that other load on the machine meets both alike.
    """
    plan = make_plan(study)
    home = Folder(folder / "study")
    home.prepare(plan)
    plain, longer = [], []
    for planned in plan.cases[: 2 * WARM]:
        case = plan.case(planned)
        order = order_of(plan, planned, home.path)
        begin = time.perf_counter()
        simulate(case, out=folder / planned.hash)
        middle = time.perf_counter()
        do_case(order)
        plain.append(middle - begin)
        longer.append(time.perf_counter() - middle - plain[-1])
    return float(np.median(plain[1:])), float(np.median(longer[1:]))


def _timed(study: Study, folder: Path, *, workers: int) -> dict[str, Any]:
    watch = Watch(0.0, "")
    results = run_study(study, out=folder, workers=workers, progress=watch)
    n, first = len(watch.times), results.folder.case(results.rows[0].planned.hash)
    sizes = [p.stat().st_size for p in first.rglob("*") if p.is_file()]
    cpu = sum(watch.process.cpu_times()[:2]) - watch.cpu
    return {
        "rate": (n - WARM) / (watch.times[-1] - watch.times[WARM - 1]),
        "seconds": float(np.mean([row.seconds for row in results.rows[WARM:]])),
        "start_s": watch.times[0] - watch.begin,
        "growth_mb": (watch.memory[-1] - watch.memory[n // 10]) / MB,
        "scheduler_ms": 1e3 * watch.scheduler / n,
        "client_ms": 1e3 * cpu / n,
        "bytes": sum(sizes),
        "files": len(sizes),
    }


def _scheduler_seconds() -> float:
    """Processor time of the local cluster's scheduler so far."""
    for child in psutil.Process().children():
        words = " ".join(child.cmdline())
        if "dask_process" in words and "://" not in words:  # workers have its address
            return sum(child.cpu_times()[:2])
    return float("nan")


def _plan_ms(study: Study) -> float:
    begin = time.perf_counter()
    plan = make_plan(study)
    return 1e3 * (time.perf_counter() - begin) / len(plan.cases)
