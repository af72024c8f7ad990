"""Trajectories of many short runs, stored by one flexcage and compared by another.

    python tests/benchmarks/trajectories.py --write before.npz      # on the commit before
    python tests/benchmarks/trajectories.py --against before.npz    # on the one after

Random plausible bearings of ``audit_trial`` (every family, design, cage, defect, spall, mount and
film), with a rigid cage by both methods; every tenth with a flexible one. Each is compared variable
by variable, over the largest value that the variable has in the run: over the first tenth of a
millisecond, where two programs that solve the same equations differ by rounding, and over the
whole, where they differ by what a chaotic cage makes of that. Explicit steps are short and equal:
their control asks for other steps where y has other unknowns, or the same in another order.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from audit_trial import plausible_case

import flexcage
from flexcage.core.errors import InputError, RunFailed

EARLY = 1e-4
DURATION = {"explicit": "0.15 ms", "bdf": "1 ms"}  # by method
STEP = 2e-7  # [s] of the explicit method
NOTHING = 1e-15  # in SI units: what is smaller in all of a run is rounding
NAMES = (
    "element_position", "element_velocity", "inner_position", "outer_position", "cage_position",
    "cage_velocity", "cage_omega", "cage_quaternion", "modal_coordinates", "pocket_force",
    "land_force", "race_force", "multiplier", "energy", "work",
)  # fmt: skip
BOUND = 1e-10


def cases(seed: int, count: int) -> Iterator[tuple[str, flexcage.Case]]:
    """Names and cases: numbers of the trial, by method, with a rigid or a flexible cage."""
    for number in range(count):
        flexible = number % 10 == 0
        for method, duration in DURATION.items():
            case = plausible_case(
                seed, number, duration=duration, method=method, flexible=float(flexible)
            )
            case = replace(case, output=replace(case.output, rate=1e5, vibration_rate=1e5))
            if method == "explicit":
                case = replace(case, solver=replace(case.solver, max_step=STEP))
            yield f"{number}/{method}/{case.name}", case


def trajectory(case: flexcage.Case) -> dict[str, np.ndarray]:
    """Variables of a run by name, its sampling times with them; nothing if it does not start."""
    try:
        ds = flexcage.simulate(case, stress=False).dataset
    except (InputError, RunFailed):
        return {}
    found = {name: ds[name].values for name in NAMES if name in ds}
    return {"time": ds["time"].values, **found}


def differences(
    before: dict[str, np.ndarray], after: dict[str, np.ndarray]
) -> dict[str, tuple[float, float]]:
    """By variable: largest difference over the largest value, early and over the whole run."""
    early = before["time"] <= EARLY
    out = {}
    for name in sorted(set(before) - {"time"}):
        one, other = before[name], after.get(name)
        if other is None or one.shape != other.shape:
            out[name] = (np.inf, np.inf)
            continue
        apart = np.abs(one - other).reshape(len(one), -1).max(axis=1, initial=0.0).astype(float)
        scale = float(np.nanmax(np.abs(one), initial=0.0))
        scale = scale if scale > NOTHING else 1.0
        out[name] = (float(apart[early].max()) / scale, float(apart.max()) / scale)
    return out


def _stored(file: str) -> dict[str, dict[str, np.ndarray]]:
    out: dict[str, dict[str, np.ndarray]] = {}
    with np.load(file) as held:
        for key in held.files:
            name, variable = key.rsplit("|", 1)
            out.setdefault(name, {})[variable] = held[key]
    return out


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=60)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--write", metavar="FILE")
    what.add_argument("--against", metavar="FILE")
    args = parser.parse_args(argv)
    before = _stored(args.against) if args.against else {}
    kept, beyond = {}, 0
    for name, case in cases(args.seed, args.cases):
        found = trajectory(case)
        if args.write:
            kept |= {f"{name}|{variable}": values for variable, values in found.items()}
            continue
        row: dict[str, object] = {"case": name}
        if bool(found) != (name in before):
            row["differs"] = "one of them does not run"
            beyond += 1
        elif found:
            apart = differences(before[name], found)
            worst = max(apart, key=lambda k: apart[k][0])
            row |= {"worst": worst, "early": apart[worst][0], "whole": apart[worst][1]}
            beyond += apart[worst][0] > BOUND
        sys.stdout.write(json.dumps(row) + "\n")
        sys.stdout.flush()
    if args.write:
        np.savez_compressed(args.write, **kept)
        return 0
    sys.stdout.write(json.dumps({"beyond": int(beyond), "bound": BOUND}) + "\n")
    return int(beyond > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
