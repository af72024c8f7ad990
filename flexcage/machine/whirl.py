"""The linearised machine over a range of speeds, for the Campbell diagram and unbalance."""

from __future__ import annotations

import logging
from dataclasses import replace

import numpy as np

from flexcage.core.errors import FlexcageError
from flexcage.core.units import describe
from flexcage.machine.linear import Linearised, amplitude
from flexcage.machine.machine import Machine
from flexcage.machine.shaft import ShaftModel
from flexcage.machine.solution import MachineSolution
from flexcage.machine.solve import solve_machine
from flexcage.system.spec import Drive

log = logging.getLogger(__name__)

#: Speeds (s,) [rad/s], natural frequencies [rad/s] and ways of whirl at each, and the largest
#: amplitude (s,) [m] under unbalance; none and NaN where no equilibrium was found.
Whirls = tuple[np.ndarray, list[tuple[np.ndarray, list[str]]], np.ndarray]


def over_speeds(machine: Machine, solution: MachineSolution) -> Whirls | None:
    """Natural frequencies and unbalance response over the speeds that [whirl] asks for, with the
    bearings' stiffness here or at each speed; None for a shaft without mass or speeds."""
    wanted = machine.whirl
    highest = wanted.highest or 1.5 * abs(machine.speed)
    if not solution.linearised.has_mass or not highest:
        return None
    speeds = np.linspace(0.0, highest, wanted.points)
    found, orbits = [], []
    for w in map(float, speeds):
        here = wanted.stiffness == "here"
        lines = solution.linearised if here else _linearised_at(machine, w, solution.shaft)
        if lines is None:
            found.append((np.zeros(0), list[str]()))
            orbits.append(np.nan)
            continue
        found.append(lines.frequencies(w, wanted.modes))
        orbits.append(float(amplitude(lines.response(np.array([w]))).max()))
    gaps = np.isnan(orbits)
    if gaps.any():
        log.warning(
            "no equilibrium at %d of the %d speeds of [whirl], from %s on: gaps in whirl.csv",
            gaps.sum(), len(speeds), describe(float(speeds[gaps][0]), "rpm"),
        )  # fmt: skip
    return speeds, found, np.array(orbits)


def _linearised_at(machine: Machine, speed: float, shaft: ShaftModel) -> Linearised | None:
    """The machine linearised at another speed [rad/s]; None where it has no equilibrium."""
    drive = Drive(speed=speed)
    try:
        bearings = tuple(replace(b, case=replace(b.case, drive=drive)) for b in machine.bearings)
        other = replace(machine, drive=drive, bearings=bearings)
        return solve_machine(other, shaft=shaft).linearised
    except FlexcageError:
        return None
