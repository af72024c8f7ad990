"""A machine's bearings as cases of runs, each in its own frame, and where they begin.

A bearing that faces -x has a frame of its own, turned by half a turn about y: x and z change sign,
and so do spin and tilt; its case then reads as that of any other bearing.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from math import atan2
from typing import Any

import numpy as np

from flexcage.case import Case
from flexcage.core.errors import InputError
from flexcage.machine.checks import bears_axially
from flexcage.machine.machine import Machine, SeatedBearing
from flexcage.machine.solution import BearingResult
from flexcage.machine.state import without_rounding
from flexcage.system.shaft.problem import OTHER_WAY
from flexcage.system.spec import Drive, Load
from flexcage.system.statics.elements import ElementLoads
from flexcage.system.statics.options import AT_START
from flexcage.system.statics.solution import StaticSolution

# of a vector (5,) that a mirror across x gives, as half a turn about y gives it
FROM_MIRROR = np.array([1.0, 1.0, -1.0, -1.0, 1.0])


def check_moves(machine: Machine) -> None:
    """Raise InputError for what a machine's static solution has and its run has not."""
    for where, sentence in _find_in_motion(machine):
        raise InputError(sentence, where=where)


def _find_in_motion(machine: Machine) -> Iterator[tuple[str, str]]:
    if machine.drive.kind != "prescribed":
        yield (
            "drive.kind",
            "drive.kind is 'shaft', but the speed of a machine's shaft is prescribed; leave it "
            "out.",
        )
    if machine.drive.at_start == 0.0 and machine.drive.ramp_to is None and not machine.drive.times:
        yield "drive.speed", "drive.speed is 0: a run needs a shaft that turns; give its speed."


def slides(seated: SeatedBearing) -> bool:
    """Does the outer ring of a bearing slide in its seat? That of a bearing which bears no axial
    load does not: its elements slide, and nothing pushes the ring."""
    return seated.place.floats and bears_axially(seated)


def case_in_motion(machine: Machine, seated: SeatedBearing, result: BearingResult) -> Case:
    """The case of a bearing's run: the machine's drive, solver and output, and for its load what
    the shaft presses it with in the static solution."""
    table = {k: v for k, v in seated.table.items() if k not in ("fit",)}
    own = Case.from_table({**table, "name": machine.name}, folder=seated.folder)
    way = -1.0 if seated.place.reversed else 1.0
    return dataclasses.replace(
        own,
        name=f"{machine.name}-{seated.place.name}",
        description=f"bearing {seated.place.name} of the machine '{machine.name}': the shaft moves "
        f"its inner ring{_of_seat(machine, seated)}; the load here is that of the static solution",
        bearing=seated.case.mounted.bearing,
        mount=seated.case.mount,
        contacts=seated.case.contacts, lubricant=seated.case.lubricant,
        drive=_drive(machine.drive, way),
        load=_load(machine, seated, result, way),
        solver=dataclasses.replace(machine.solver, method="explicit"),
        output=machine.output,
        given=own.given,
    )  # fmt: skip


def _of_seat(machine: Machine, seated: SeatedBearing) -> str:
    """What the case of a bearing alone does not say of its outer ring's seat."""
    mount = seated.case.mount
    if mount.body:
        return ", and its housing is turned as it is" if seated.place.reversed else ""
    if machine.housing.body and mount.kind == "fixed":
        return ", and the housing its outer ring"
    return ", and its outer ring slides" if slides(seated) else ""


def _drive(drive: Drive, way: float) -> Drive:
    ramp = None if drive.ramp_to is None else way * drive.ramp_to
    return dataclasses.replace(
        drive, speed=way * drive.speed, ramp_to=ramp, speeds=tuple(way * s for s in drive.speeds),
        wave_amplitude=way * drive.wave_amplitude,
    )  # fmt: skip


def _load(machine: Machine, seated: SeatedBearing, result: BearingResult, way: float) -> Load:
    force = -result.force * (OTHER_WAY if way < 0.0 else 1.0)
    force = without_rounding(force)
    bearing = seated.case.bearing
    tilt = "free" if bearing.carries_axial_load and not bearing.self_aligning else "held"
    if seated.case.bearing.axial_refusal(float(force[0])):
        force[0] = 0.0
    if tilt == "held":  # as a run begins
        force[3:] = 0.0
    gravity = machine.gravity
    pull = gravity.vector * [way, 1.0, way]
    across = float(np.hypot(pull[1], pull[2]))
    return Load(
        radial=float(np.hypot(force[1], force[2])), direction=atan2(force[2], force[1]),
        axial=float(force[0]), moment_y=float(force[3]), moment_z=float(force[4]), tilt=tilt,
        gravity=across, gravity_direction=atan2(pull[2], pull[1]) if across else 0.0,
    )  # fmt: skip


def starting_point(result: BearingResult) -> StaticSolution:
    """A bearing's static solution in the frame of its run."""
    own = result.solution
    if result.facing == "+x":
        return own
    other = _mirrored(own.elements.azimuth)
    turned = {
        f.name: _turned(getattr(own.elements, f.name), other)
        for f in dataclasses.fields(ElementLoads)
    }
    turned["azimuth"] = own.elements.azimuth
    turned["orbital_speed"] = -turned["orbital_speed"]
    return dataclasses.replace(
        own, displacement=own.displacement * FROM_MIRROR, outer=own.outer * FROM_MIRROR,
        elements=ElementLoads(**turned),
    )  # fmt: skip


def _mirrored(azimuth: np.ndarray) -> np.ndarray:
    """Numbers (n,) of the elements at minus the azimuths (n,) of others of their rows, in each of
    which azimuths rise."""
    row = np.cumsum(np.diff(azimuth, prepend=azimuth[0]) < 0.0)
    away = np.abs(np.angle(np.exp(1j * np.add.outer(azimuth, azimuth))))
    return np.where(row[:, None] == row, away, np.inf).argmin(axis=1)


def _turned(values: Any, order: np.ndarray) -> Any:
    if isinstance(values, dict):
        return {name: _turned(each, order) for name, each in values.items()}
    return values[order] if np.ndim(values) and len(values) == len(order) else values


def as_it_begins(machine: Machine) -> Machine:
    """The machine whose static solution is that of a run's start: no race controls balls."""
    bearings = tuple(
        dataclasses.replace(
            seated,
            case=dataclasses.replace(
                seated.case,
                static=dataclasses.replace(seated.case.static, gyroscopic=AT_START.gyroscopic),
            ),
        )
        for seated in machine.bearings
    )
    return dataclasses.replace(machine, bearings=bearings)
