"""Do the sections of a case fit together? One sentence each, and what would be right."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from flexcage.core.errors import InputError
from flexcage.core.units import describe
from flexcage.geometry.checks import check_geometry

if TYPE_CHECKING:
    from flexcage.case.case import Case

Finding = tuple[str, str]  # where, sentence

_LAND_TOLERANCE = 5e-6  # m between a stated land clearance and the one that the dimensions leave


def check_case(case: Case) -> None:
    """Raise InputError for the first thing in the case that cannot be."""
    check_geometry(case.bearing, case.cage, case.defects)
    for find in (
        _find_in_tables, _find_in_ramps, _find_in_solver, _find_in_output, _find_in_laws,
        _find_in_land,
    ):  # fmt: skip
        for where, sentence in find(case):
            raise InputError(sentence, where=where)


def _find_in_tables(case: Case) -> Iterator[Finding]:
    for room, values, name in (
        ("drive", case.drive.speeds, "speeds"),
        ("load", case.load.values, "values"),
    ):
        times = getattr(case, room).times
        if len(times) != len(values):
            yield (
                f"{room}.times",
                f"{room}.times has {len(times)} entries and {room}.{name} {len(values)}; a table "
                "wants as many of each.",
            )
        if len(times) == 1:
            yield f"{room}.times", f"{room}.times has one entry; a table wants two or more."
        if any(late <= early for early, late in zip(times, times[1:])):
            yield f"{room}.times", f"{room}.times must rise from entry to entry."


def _find_in_ramps(case: Case) -> Iterator[Finding]:
    for room in ("drive", "load"):
        spec = getattr(case, room)
        if spec.ramp_to is not None and spec.ramp_time <= 0.0:
            yield (
                f"{room}.ramp_time",
                f"{room}.ramp_to is given, but {room}.ramp_time is 0 s; say how long the ramp "
                "takes.",
            )
        if spec.ramp_to is None and spec.ramp_time > 0.0:
            yield (
                f"{room}.ramp_to",
                f"{room}.ramp_time is given, but not where the ramp ends; give {room}.ramp_to.",
            )
        if spec.ramp_to is not None and spec.times:
            yield f"{room}.times", f"[{room}] has both a ramp and a table; keep one of them."


def _find_in_solver(case: Case) -> Iterator[Finding]:
    solver = case.solver
    if solver.min_step > solver.max_step:
        yield (
            "solver.min_step",
            f"solver.min_step is {describe(solver.min_step, 'us')}, but must not exceed "
            f"solver.max_step, {describe(solver.max_step, 'us')}.",
        )


def _find_in_output(case: Case) -> Iterator[Finding]:
    output = case.output
    ratio = output.vibration_rate / output.rate
    if abs(ratio - round(ratio)) > 1e-9 * ratio or ratio < 1.0:
        yield (
            "output.vibration_rate",
            f"output.vibration_rate ({output.vibration_rate / 1e3:g} kHz) must be a whole multiple "
            f"of output.rate ({output.rate / 1e3:g} kHz), for instance "
            f"{max(round(ratio), 1) * output.rate / 1e3:g} kHz.",
        )


def _find_in_laws(case: Case) -> Iterator[Finding]:
    places = ("race", "pocket", "side", "rib", "land")
    for place in places:
        spec = getattr(case.contacts, place)
        where, friction = f"contacts.{place}", spec.friction
        if friction.v_dynamic <= friction.v_static:
            yield (
                f"{where}.friction.v_dynamic",
                f"{where}.friction.v_dynamic is {describe(friction.v_dynamic, 'm/s')}, but must be "
                f"greater than v_static, {describe(friction.v_static, 'm/s')}.",
            )
        if friction.law == "traction" and not friction.high_speed < friction.peak:
            yield (
                f"{where}.friction.high_speed",
                f"{where}.friction.high_speed is {friction.high_speed:g}, but must be less than "
                f"the traction's peak, {friction.peak:g}.",
            )
        if spec.normal.law == "impact_step" and spec.normal.damping == 0.0:
            yield (
                f"{where}.normal.damping",
                f"{where}.normal.law is impact_step, but its damping is 0; give {where}.normal."
                "damping, or take the law 'elastic'.",
            )


def _find_in_land(case: Case) -> Iterator[Finding]:
    land = case.contacts.land
    if case.cage.guidance != "roller" and land.kind == "none":
        yield (
            "contacts.land.kind",
            f"cage.guidance is '{case.cage.guidance}', but contacts.land.kind is 'none'; take "
            "'dry' or 'film'.",
        )
    if land.kind == "none" or land.clearance is None:
        return
    outer = case.cage.guidance == "outer"
    if outer:
        there = case.bearing.outer_race_radius - 0.5 * case.cage.outside_diameter
        what = "cage.outside_diameter and the outer race"
    else:
        there = 0.5 * (case.cage.bore - case.bearing.rib_diameter)
        what = "cage.bore and bearing.rib_diameter"
    if abs(land.clearance - there) > _LAND_TOLERANCE:
        yield (
            "contacts.land.clearance",
            f"contacts.land.clearance is {describe(land.clearance, 'mm')}, but {what} leave "
            f"{describe(there, 'mm')}; give that, or change the dimensions.",
        )
