"""Time until the first step: with kernels to be compiled, and with everything on disk.

Each figure comes from processes of their own, which run this file and keep their files in a folder
that is new.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

REPEATS = 3  # of what takes a second
QUICK: dict[str, Any] = {"cold": False, "repeats": 1}  # whether it runs


def measure(case: Any, *, cold: bool = True, repeats: int = REPEATS) -> dict[str, Any]:
    """All figures that README.md lists; without ``cold``, with whatever is on disk already."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "case.toml"
        file.write_text(case.to_toml(), encoding="utf-8")
        ball, roller, both = (Path(folder) / k if cold else None for k in ("ball", "roller", "all"))
        of_balls, of_rollers = (
            measured("kernels", ball, "7010C-PI"),
            measured("kernels", roller, "N1013"),
        )
        first = measured("first_step", both, str(file))
        warm = [measured("first_step", both, str(file)) for _ in range(repeats)]
    typical = sorted(warm, key=lambda w: w["first_step_s"])[repeats // 2]
    return {
        "cold_kernels_s": of_rollers["kernels_s"],
        "cold_kernels_cpu_s": of_rollers["kernels_cpu_s"],
        "ball_cold_kernels_s": of_balls["kernels_s"],
        "ball_cold_kernels_cpu_s": of_balls["kernels_cpu_s"],
        "import_s": median(w["import_s"] for w in warm),
        "warm_first_step_s": typical["first_step_s"],
        "warm_stages_s": typical["stages_s"],
        "cold_first_step_s": first["first_step_s"],
    }


def measured(what: str, cache: Path | None, argument: str) -> dict[str, Any]:
    """What a new process measures, with its files in ``cache``, or where they always are."""
    env = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    if cache is not None:
        env["FLEXCAGE_CACHE_DIR"] = str(cache)
    begin = time.time()
    done = subprocess.run(
        [sys.executable, __file__, what, argument, str(begin)],
        env=env,
        stdout=subprocess.PIPE,
        check=True,
    )
    return json.loads(done.stdout)


def kernels(preset: str, _begin: float) -> dict[str, Any]:
    """From starting to compile until all kernels are on disk; imports and a mesh come before."""
    from flexcage.case import Case
    from flexcage.compiling import build_bearing
    from flexcage.mesh.options import MeshOptions
    from flexcage.stages import cage_mesh

    case = Case.from_preset(preset, mesh=MeshOptions(fineness="coarse"))
    mesh = cage_mesh(case)
    wall, cpu = time.perf_counter(), _cpu()
    build_bearing(case, mesh, None)
    return {
        "kernels_s": round(time.perf_counter() - wall, 2),
        "kernels_cpu_s": round(_cpu() - cpu, 2),
    }


def first_step(file: str, begin: float) -> dict[str, Any]:
    """From starting the process until the integrator's first step is done."""
    stages, last = {}, begin

    def done(stage: str, value: Any = None) -> Any:
        nonlocal last
        now = time.time()
        stages[stage], last = round(now - last, 3), now
        return value

    done("python")
    import numpy as np

    import flexcage
    from flexcage.compiling import begin_compiling, build_bearing
    from flexcage.solve.integrators import INTEGRATORS
    from flexcage.stages import assembled_start, cage_mesh, cage_reduction
    from flexcage.system.data import POWERS

    done("import")
    case = done("case", flexcage.load_case(file))
    compiling = begin_compiling(case)
    mesh = done("mesh", cage_mesh(case))
    cage = done("modes", cage_reduction(case, mesh))
    bearing = done("kernels", build_bearing(case, mesh, cage, compiling))
    start = done("start", assembled_start(case, bearing))
    method, until = INTEGRATORS["explicit"], 1e-7
    weight = bearing.error_weights(case.solver.tolerance)
    state = method.new_state(
        0.0,
        start.y,
        start.yd,
        weight=weight,
        h0=until,
        quad_weight=np.zeros(len(POWERS)),
        modes=bearing.modes,
    )
    rows = np.zeros((2, len(start.y)))
    bearing.advance(
        method, state, method.options(case.solver), until, np.array([until]), rows[:1],
        rows[1:], 0, np.zeros((100, 5)), np.zeros((1, len(POWERS))),
    )  # fmt: skip
    done("step")
    return {
        "first_step_s": round(last - begin, 2),
        "import_s": round(stages["python"] + stages["import"], 2),
        "stages_s": stages,
    }


def _cpu() -> float:
    """Processor time of this process and of those that it started and waited for [s]."""
    return sum(os.times()[:4])


if __name__ == "__main__":
    measures: dict[str, Callable[[str, float], dict[str, Any]]] = {
        "kernels": kernels,
        "first_step": first_step,
    }
    sys.stdout.write(json.dumps(measures[sys.argv[1]](sys.argv[2], float(sys.argv[3]))))
