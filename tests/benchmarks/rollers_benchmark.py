"""Time of an evaluation of the equations of motion, over the contacts with races that bear: of
cylinders, cones and barrels, with as many slices and without a cage."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import Any

import numba
import numpy as np

import flexcage
from flexcage.core.threads import on_one_core
from flexcage.stages import assembled_start, bearing_in_motion
from flexcage.system.data import POWERS

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
REPEATS, CALLS = 15, 2000
QUICK: dict[str, Any] = {"repeats": 2, "calls": 20}
PRESSED = {  # so that most rollers bear
    "cylinder": {"bearing.radial_clearance": 0.0},
    "cone": {"load.radial": 0.0, "load.axial": 3e3},
    "barrel": {"load.radial": 0.0, "load.axial": 2e3},
}
UNCAGED = '\n[cage]\nmodel = "none"\n'


@on_one_core
def measure(case: flexcage.Case, *, repeats: int = REPEATS, calls: int = CALLS) -> dict[str, Any]:
    """Microseconds a contact, the least of ``repeats``, and how many bear: of the case's cylinders
    without its cage, and of the examples' cones and barrels."""
    cylinders = case.replace({"cage": None, "cage.model": "none"})
    found: dict[str, Any] = {}
    cases = {"cylinder": cylinders, "cone": _example("30205"), "barrel": _example("22208")}
    cases = {name: one.replace(PRESSED[name]) for name, one in cases.items()}
    for name, one in cases.items():
        seconds, contacts = _of(one, repeats, calls)
        found |= {f"{name}_us": round(1e6 * seconds / contacts, 3), f"{name}_contacts": contacts}
    return found


def _example(name: str) -> flexcage.Case:
    text = (EXAMPLES / f"{name}.toml").read_text("utf-8")
    return flexcage.load_case(text + UNCAGED)


def _of(case: flexcage.Case, repeats: int, calls: int) -> tuple[float, int]:
    """Seconds of an evaluation at the start of a run, and contacts with races that bear then."""
    bearing = bearing_in_motion(case, None, None)
    start = assembled_start(case, bearing)
    bearing.residual(0.0, start.y, start.yd, mode=2)
    contacts = int((bearing.data.work.report.race[:, :, 0] > 0.0).sum())
    rates, taken = bearing.function("rates"), []
    arguments = start.y.copy(), start.yd.copy(), bearing.args, np.zeros(len(POWERS))
    _often(rates, 1, *arguments)
    for _ in range(repeats):
        began = perf_counter()
        _often(rates, calls, *arguments)
        taken.append(perf_counter() - began)
    return min(taken) / calls, contacts


@numba.njit
def _often(rates, calls, y, yd, args, power):
    for _ in range(calls):
        rates(0.0, y, yd, args, power)
