"""What a whole run costs beside its integration: stress, storing, imports, pictures, studies.

Each figure comes from processes of their own, which run this file: the command line or a study's
cases, with clocks round their parts.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from math import pi
from pathlib import Path
from statistics import median
from typing import Any

import start_benchmark

# [s] of bearing time of the long run; balls alone would lose their cage before a second is over
LONG = {"roller": 1.0, "ball": 0.4}
ALLOWED = 1.15  # of as many revolutions from a settled state: what a run's integration may take
PLAIN_OUTPUT = "pocket_force.max"  # one that needs no stress
QUICK: dict[str, Any] = {
    "duration": 1e-3,
    "long": {"roller": 2e-3, "ball": 2e-3},
    "repeats": 1,
    "cold": False,
}

Clock = Callable[[], float]


def measure(
    case: Any,
    *,
    balls: Any,
    duration: float | None = None,
    long: dict[str, float] = LONG,
    repeats: int = 3,
    cold: bool = True,
) -> dict[str, Any]:
    """All figures that README.md lists, of both main jobs; ``duration`` [s] cuts them short,
    without ``cold`` what is on disk is taken for the first run."""
    jobs = {"roller": case, "ball": balls}
    if duration is not None:
        jobs = {name: job.replace("solver.duration", duration) for name, job in jobs.items()}
    return {name: _job(job, long[name], repeats, cold) for name, job in jobs.items()}


def _job(case: Any, long: float, repeats: int, cold: bool) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as folder:
        top = Path(folder)
        file, longer = _written(top / "case.toml", case), top / "long.toml"
        _written(longer, case.replace("solver.duration", long))
        _run(file, top / "fills_caches")
        runs = [_run(file, top / f"run{k}") for k in range(repeats)]
        drawn = _run(file, top / "drawn", images=True)
        endless = _run(longer, top / "long")
        first, kernels = _first(file, top, case, cold)
        stress = "stress_root" if case.cage_model == "flexible" else PLAIN_OUTPUT
        outputs = {"study_case": stress, "study_case_plain": PLAIN_OUTPUT}
        studies = {name: _study(file, top / name, out, repeats) for name, out in outputs.items()}
        settled = _settled_turns(case) if cold else None
        store = [p for p in (top / "long" / "results.zarr").rglob("*") if p.is_file()]
        typical = sorted(runs, key=lambda run: run["run_cpu_s"])[len(runs) // 2]
        advance = typical["integrator_cpu_s"]
        figures: dict[str, Any] = {
            **{key: typical[key] for key in _OF_A_RUN},
            "run_over_integrator": typical["run_cpu_s"] / advance,
            "long_run_over_integrator": endless["run_cpu_s"] / endless["integrator_cpu_s"],
            "pictures_cpu_s": drawn["pictures_cpu_s"],
            "pictures_import_cpu_s": drawn["pictures_import_cpu_s"],
            "run_with_pictures_wall_s": drawn["run_wall_s"],
            **{f"{name}_cpu_s": cost for name, (cost, _) in studies.items()},
            **{f"{name}_over_integration": share for name, (_, share) in studies.items()},
            "cold_kernels_s": kernels,
            "first_run_wall_s": first["run_wall_s"],
            "bytes_per_s": sum(p.stat().st_size for p in store) / long,
            "files_per_s": len(store) / long,
        }
        rounded = {key: float(f"{value:.4g}") for key, value in figures.items()}
        return {**rounded, **_against_revolutions(advance, settled)}


_OF_A_RUN = (
    "integrator_cpu_s", "run_cpu_s", "stress_cpu_s", "store_cpu_s", "import_cpu_s", "run_wall_s",
)  # fmt: skip


def _against_revolutions(advance: float, settled: float | None) -> dict[str, Any]:
    """A run's integration beside as many revolutions from a settled state, where these were
    timed."""
    if settled is None:
        return {}
    ratio = round(advance / settled, 3)
    said = {"integrator_over_revolutions": ratio}
    if ratio > ALLOWED:
        return {
            **said,
            "note": f"the run's integration took {ratio} times that; expected {ALLOWED}",
        }
    return said


def _settled_turns(case: Any) -> float:
    """Processor time [s] of the case's revolutions, each the median of three from a settled
    state."""
    from ball_benchmark import revolution
    from settled import Settled

    turns = case.solver.duration * abs(case.drive.speed) / (2.0 * pi)
    return turns * revolution(Settled(case))[0]


def _first(file: Path, top: Path, case: Any, cold: bool) -> tuple[dict[str, Any], float]:
    """A run with pictures with nothing on disk, and the time [s] of its kernels alone."""
    caches = [top / "kernels", top / "first"] if cold else [None, None]
    made = start_benchmark.measured("kernels", caches[0], case.preset)
    return _run(file, top / "first_run", images=True, cache=caches[1]), made["kernels_s"]


def _written(file: Path, case: Any) -> Path:
    file.write_text(case.to_toml(), encoding="utf-8")
    return file


def _run(
    file: Path, out: Path, *, images: bool = False, cache: Path | None = None
) -> dict[str, Any]:
    """``flexcage run`` of the case in a process of its own, its clocks' readings included."""
    command = ["run", str(file), "-o", str(out), *([] if images else ["--no-images"])]
    before, begin = _children(), time.perf_counter()
    found = _child("command", command, cache)
    wall, cpu = time.perf_counter() - begin, _children() - before
    return {**found, "run_wall_s": wall, "run_cpu_s": cpu}


def _study(file: Path, folder: Path, output: str, cases: int) -> tuple[float, float]:
    """Processor time [s] of a study's case, the median after a first one, and its ratio to the
    case's integration."""
    rows = _child("cases", [str(file), str(folder), output, str(cases + 1)], None)["cases"][1:]
    return median(cpu for cpu, _ in rows), median(cpu / advance for cpu, advance in rows)


def _child(what: str, arguments: list[str], cache: Path | None) -> dict[str, Any]:
    env = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    if cache is not None:  # matplotlib keeps a list of fonts, which a first run makes too
        env |= {"FLEXCAGE_CACHE_DIR": str(cache), "MPLCONFIGDIR": str(cache / "matplotlib")}
    with tempfile.TemporaryDirectory() as folder:
        readings = Path(folder) / "readings.json"
        subprocess.run(
            [sys.executable, __file__, what, str(readings), *arguments],
            env=env,
            stdout=subprocess.DEVNULL,
            check=True,
        )
        return json.loads(readings.read_text("utf-8"))


def _children() -> float:
    """Processor time of processes that were started and have ended [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _with_children() -> float:
    return time.process_time() + _children()


def _timed(owner: Any, name: str, clock: Clock, spent: dict[str, float], key: str) -> None:
    """Have all calls of a method counted under ``key``."""
    method = getattr(owner, name)
    spent.setdefault(key, 0.0)

    def timed(*args: Any, **kwargs: Any) -> Any:
        begin = clock()
        try:
            return method(*args, **kwargs)
        finally:
            spent[key] += clock() - begin

    setattr(owner, name, timed)


def _clocks() -> dict[str, float]:
    """Seconds by part, counted from now on in this process."""
    from flexcage.integrate.integration import Integration
    from flexcage.run import Run
    from flexcage.stress import run_stress
    from flexcage.system.problem import BearingSystem

    spent: dict[str, float] = {}
    _timed(BearingSystem, "advance", time.thread_time, spent, "integrator")
    timed = BearingSystem.advance

    def advance(self: Any, integrator: Any, state: Any, options: Any, *rest: Any) -> Any:
        self.advance_of(integrator, state, options)  # read from disk: not the integrator's time
        return timed(self, integrator, state, options, *rest)

    BearingSystem.advance = advance  # type: ignore[method-assign]
    _timed(Integration, "march", time.process_time, spent, "march")
    _timed(run_stress, "stress_history", time.process_time, spent, "stress")
    _timed(Run, "draw", _with_children, spent, "pictures")
    march, draw = Integration.march, Run.draw

    def begun(*args: Any, **kwargs: Any) -> Any:
        spent["import"] = time.process_time()
        return march(*args, **kwargs)

    def imported(*args: Any, **kwargs: Any) -> Any:
        begin = time.process_time()
        import pyvista  # noqa: F401

        spent["pictures_import"] = time.process_time() - begin
        return draw(*args, **kwargs)

    Integration.march, Run.draw = begun, imported  # type: ignore[method-assign]
    return spent


def command(arguments: list[str]) -> dict[str, Any]:
    """A command by the command line; seconds of its parts."""
    from flexcage.cli import main

    spent = _clocks()
    if main(arguments):
        raise SystemExit("the command failed")
    return {
        "integrator_cpu_s": spent["integrator"],
        "stress_cpu_s": spent["stress"],
        "store_cpu_s": spent["march"] - spent["integrator"],
        "import_cpu_s": spent["import"],
        "pictures_cpu_s": spent["pictures"],
        "pictures_import_cpu_s": spent.get("pictures_import", 0.0),
    }


def cases(arguments: list[str]) -> dict[str, Any]:
    """Cases of a study one after the other, as a worker does them; of each its processor time and
    that of its integration [s]."""
    file, top, output, number = arguments
    import flexcage
    from flexcage.study.folder import Folder
    from flexcage.study.plan import make_plan
    from flexcage.study.spec import Repeat, Study
    from flexcage.study.work import do_case, order_of

    spent = _clocks()
    case = flexcage.load_case(file)
    plan = make_plan(Study(case=case, repeat=Repeat(count=int(number)), outputs=(output,)))
    home = Folder(Path(top))
    home.prepare(plan)
    rows = []
    for planned in plan.cases:
        cpu, advance = time.process_time(), spent["integrator"]
        if do_case(order_of(plan, planned, home.path)) != "done":
            raise SystemExit("a case of the study failed")
        rows.append((time.process_time() - cpu, spent["integrator"] - advance))
    return {"cases": rows}


if __name__ == "__main__":
    _what: dict[str, Callable[[list[str]], dict[str, Any]]] = {"command": command, "cases": cases}
    _readings = _what[sys.argv[1]](sys.argv[3:])
    Path(sys.argv[2]).write_text(json.dumps(_readings), encoding="utf-8")
