"""What a machine costs over its bearings, each alone under the load that it bears in the machine.

A pair 7010C back to back with rigid cages on a shaft that is rigid, or elastic with its modes. Each
is integrated in turn, and repeated; figures are processor times of the integration, by medians.
"""

from __future__ import annotations

from statistics import median
from time import process_time
from typing import Any

import flexcage
from flexcage.integrate.integration import Integration
from flexcage.machine.motion import as_it_begins, case_in_motion
from flexcage.machine.rotor import TurningShaft

QUICK: dict[str, Any] = {"duration": "0.4 ms", "repeats": 1}
PAIR = """
name = "pair"
[drive]
speed = "8000 rpm"
[shaft]
kind = "{kind}"
[[shaft.sections]]
length = "{length} mm"
diameter = "50 mm"
[[shaft.loads]]
position = "0 mm"
force = ["0 N", "200 N", "0 N"]
[[bearings]]
name = "left"
preset = "7010C-PI"
position = "60 mm"
facing = "-x"
axial_offset = "4 um"
cage.model = "rigid"
[[bearings]]
name = "right"
preset = "7010C-PI"
position = "180 mm"
axial_offset = "4 um"
cage.model = "rigid"
[solver]
method = "explicit"
duration = "{duration}"
"""
LENGTHS = {"rigid": 240, "elastic": 240, "long": 1200}  # [mm]; the longest has most modes


def measure(case: Any, *, duration: str = "10 ms", repeats: int = 3) -> dict[str, Any]:
    """Figures that README.md lists; ``case`` is not read."""
    spent: dict[str, list[float]] = {}
    steps: dict[str, int] = {}
    modes: dict[str, int] = {}
    for _ in range(repeats):
        for name, length in LENGTHS.items():
            kind = "rigid" if name == "rigid" else "elastic"
            text = PAIR.format(kind=kind, length=length, duration=duration)
            machine = flexcage.load_machine(text)
            solution = flexcage.solve_machine(as_it_begins(machine))
            modes[name] = len(TurningShaft(machine, solution).frequency)
            if name == "rigid":
                alone = [
                    _timed(flexcage.simulate, case_in_motion(machine, seated, own))
                    for seated, own in zip(machine.bearings, solution.bearings, strict=True)
                ]
                spent.setdefault("bearings", []).append(sum(seconds for seconds, _ in alone))
                steps["bearings"] = sum(count for _, count in alone)
            seconds, steps[name] = _timed(flexcage.simulate_machine, machine)
            spent.setdefault(name, []).append(seconds)
    each = {name: median(found) for name, found in spent.items()}
    return {
        "bearings_s": each["bearings"], "bearings_steps": steps["bearings"],
        **{f"{name}_shaft_over_bearings": each[name] / each["bearings"] for name in LENGTHS},
        **{f"{name}_shaft_steps": 2 * steps[name] for name in LENGTHS},
        **{f"{name}_shaft_modes": modes[name] for name in LENGTHS},
    }  # fmt: skip


def _timed(simulate: Any, what: Any) -> tuple[float, int]:
    """Processor seconds of the integration, and its steps."""
    seconds, count = 0.0, 0
    march = Integration.march

    def clocked(self: Integration, progress: Any = None) -> None:
        nonlocal seconds, count
        self._choose()  # what is compiled or read from disk for it is not counted
        begin = process_time()
        march(self, progress)
        seconds, count = process_time() - begin, self.effort.counts["steps"]

    Integration.march = clocked  # type: ignore[method-assign]
    try:
        simulate(what, stress=False)
    finally:
        Integration.march = march  # type: ignore[method-assign]
    return seconds, count
