"""Can the parts of a machine be together? One sentence each, and what would be right."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from math import sin
from typing import Protocol

from flexcage.core.errors import InputError
from flexcage.core.units import describe, mm
from flexcage.core.writing import unusable
from flexcage.machine.seated import SeatedBearing
from flexcage.machine.spec import Gravity, Shaft

Finding = tuple[str, str]  # where, sentence


class Machine(Protocol):
    """What is looked at of a machine (``machine.Machine``)."""

    @property
    def name(self) -> str: ...
    @property
    def shaft(self) -> Shaft: ...
    @property
    def gravity(self) -> Gravity: ...
    @property
    def bearings(self) -> tuple[SeatedBearing, ...]: ...


_SAME = 1e-6  # m, by which diameters may differ
_BEYOND = 1e-9  # m, of rounding


def check_machine(machine: Machine) -> None:
    """Raise InputError for the first thing that cannot be."""
    for find in (
        _find_in_names, _find_in_shaft, _find_in_places, _find_in_discs, _find_in_bearings,
        _find_without_play, _find_too_few,
    ):  # fmt: skip
        for where, sentence in find(machine):
            raise InputError(sentence, where=where)


def _find_in_names(machine: Machine) -> Iterator[Finding]:
    if wrong := unusable(machine.name):
        yield "name", f"name is {wrong}."
    seen: set[str] = set()
    for bearing in machine.bearings:
        name = bearing.place.name
        where = f"bearings.{name}.name"
        if wrong := unusable(name):
            yield where, f"{where} is {wrong}."
        if name.casefold() in seen:
            yield where, f"Two of [[bearings]] are called '{name}'; give each a name of its own."
        seen.add(name.casefold())


def _find_in_shaft(machine: Machine) -> Iterator[Finding]:
    shaft = machine.shaft
    if shaft.body and shaft.sections:
        yield (
            "shaft.body",
            "shaft.body and [[shaft.sections]] both describe the shaft; leave one of them out.",
        )
    if shaft.body and shaft.length is None:
        yield (
            "shaft.length",
            "A shaft from a file (shaft.body) needs its length as well; give shaft.length.",
        )
    if shaft.kind == "elastic" and not (shaft.sections or shaft.body):
        yield (
            "shaft.sections",
            "An elastic shaft needs [[shaft.sections]], each with length and diameter, or a body; "
            'or take kind = "rigid" with a length.',
        )
    if not shaft.whole_length:
        yield "shaft.length", "A rigid shaft needs its length, or [[shaft.sections]]."
    if shaft.sections and shaft.length is not None:
        yield (
            "shaft.length",
            f"shaft.length is {mm(shaft.length)}, but [[shaft.sections]] have lengths of their own "
            f"({mm(shaft.whole_length)} in all); leave it out.",
        )
    for k, section in enumerate(shaft.sections):
        if section.bore >= section.diameter:
            where = f"shaft.sections.{k}.bore"
            yield (
                where,
                f"{where} is {mm(section.bore)}, but the section's diameter is "
                f"{mm(section.diameter)}; a bore is smaller.",
            )


def _find_in_places(machine: Machine) -> Iterator[Finding]:
    length = machine.shaft.whole_length
    placed = [(f"bearings.{b.place.name}", b.place.position) for b in machine.bearings]
    placed += [(f"shaft.discs.{k}", d.position) for k, d in enumerate(machine.shaft.discs)]
    placed += [(f"shaft.loads.{k}", p.position) for k, p in enumerate(machine.shaft.loads)]
    for where, position in placed:
        if position > length + _BEYOND:
            yield (
                f"{where}.position",
                f"{where}.position is {mm(position)}, off the end of the shaft, which is "
                f"{mm(length)} long; positions count from its left end.",
            )
    at: dict[float, str] = {}
    for bearing in machine.bearings:
        place = bearing.place
        if other := at.get(round(place.position, 9)):
            yield (
                f"bearings.{place.name}.position",
                f"Bearings {other} and {place.name} both stand at {mm(place.position)}; no shaft "
                "has two at one place.",
            )
        at[round(place.position, 9)] = place.name


def _find_in_discs(machine: Machine) -> Iterator[Finding]:
    for k, disc in enumerate(machine.shaft.discs):
        where = f"shaft.discs.{k}"
        sized = disc.diameter is not None and disc.width is not None
        if (disc.mass is not None) == (disc.diameter is not None or disc.width is not None):
            yield where, f"{where} should have either a mass, or a diameter and a width."
        elif disc.mass is None and not sized:
            yield where, f"{where} has a diameter or a width alone; give both."
        elif disc.diameter is not None and disc.bore >= disc.diameter:
            yield (
                f"{where}.bore",
                f"{where}.bore is {mm(disc.bore)}, but its diameter is {mm(disc.diameter)}.",
            )


def _find_in_bearings(machine: Machine) -> Iterator[Finding]:
    for seated in machine.bearings:
        place, case = seated.place, seated.case
        where = f"bearings.{place.name}"
        if case.rings_bend:
            yield (
                f"{where}.outer_ring.ring",
                f"{where} has rings that bend, which a machine's bearings do not yet; leave out "
                "inner_ring.ring and outer_ring.ring.",
            )
        if case.mount.kind == "contact":
            yield (
                f"{where}.mount.kind",
                f"{where}.mount.kind is 'contact', but a machine's bearings know 'fixed' and "
                "'bushing' seats, and a body.",
            )
        if case.life.spectrum:
            yield (
                f"{where}.life.spectrum",
                f"{where}.life has a load spectrum of its own, but its loads are the machine's; "
                "leave it out.",
            )
        yield from _find_in_preload(seated, where)


def _find_in_preload(seated: SeatedBearing, where: str) -> Iterator[Finding]:
    place, bearing = seated.place, seated.case.bearing
    offset, sprung = place.axial_offset != 0.0, place.spring_force > 0.0
    if place.preload_force is not None and offset:
        yield (
            f"{where}.preload_force",
            f"{where} has both preload_force and axial_offset, which say the same; keep one.",
        )
    floats = place.floats
    if sprung and not floats:
        yield (
            f"{where}.spring_force",
            f"{where}.spring_force presses an outer ring that slides, but axial_seat is 'fixed'; "
            'take axial_seat = "floating", or axial_offset.',
        )
    if floats and not sprung and (offset or place.preload_force):
        yield (
            f"{where}.axial_offset",
            f"{where} has a preload, but its outer ring is floating and nothing presses it; give "
            'spring_force, or take axial_seat = "fixed".',
        )
    if floats and not sprung and getattr(bearing, "one_sided", False):
        yield (
            f"{where}.spring_force",
            f"{where} is an {bearing.kind} whose outer ring is floating: without a push it falls "
            "apart; give spring_force.",
        )
    carries = bears_axially(seated)
    if not carries and (offset or place.preload_force or sprung):
        yield (
            f"{where}.axial_offset",
            f"{where} is a {bearing.kind} that bears no axial load, so it has no preload; leave "
            "it out.",
        )


def bears_axially(seated: SeatedBearing) -> bool:
    """Do its elements bear axial load?"""
    bearing = seated.case.bearing
    return bearing.carries_axial_load or any(getattr(bearing, "carried", ()))


def _both_ways(seated: SeatedBearing) -> bool:
    """Is it a fixed ball bearing that bears the shaft's push both ways?"""
    bearing = seated.case.bearing
    one = getattr(bearing, "one_sided", True)
    return bears_axially(seated) and not one and seated.place.axial_seat == "fixed"


def _find_without_play(machine: Machine) -> Iterator[Finding]:
    """Two fixed bearings that hold the shaft both ways and leave it no axial play."""
    fixed = [b for b in machine.bearings if _both_ways(b)]
    for one, other in combinations(fixed, 2):
        given = any(b.place.axial_offset or b.place.preload_force for b in (one, other))
        if given or max(_half_play(one), _half_play(other)) > 0.0:
            continue
        a, b = one.place.name, other.place.name
        clearance = describe(one.case.mounted.bearing.clearance, "um")
        yield (
            f"bearings.{b}.axial_seat",
            f"Bearings {a} and {b} both hold the shaft along x and leave it no play (radial "
            f"clearance {clearance} in {a}): the least warmth would jam them; let one float, "
            'axial_seat = "floating", give a clearance, or if preload is meant, axial_offset.',
        )


def _half_play(seated: SeatedBearing) -> float:
    """By how much [m] the shaft may move either way in a fixed bearing before it is held."""
    bearing = seated.case.mounted.bearing
    angle = getattr(bearing, "free_contact_angle", 0.0)
    return float(getattr(bearing, "groove_distance", 0.0) * sin(angle))


def _find_too_few(machine: Machine) -> Iterator[Finding]:
    """Axial loads that no bearing can bear."""
    axial = sum(load.force[0] for load in machine.shaft.loads)
    if machine.gravity.along != "across" and machine.gravity.acceleration:
        axial = axial or 1.0
    holds = any(
        bears_axially(b) and (b.place.axial_seat == "fixed" or b.place.spring_force)
        for b in machine.bearings
    )
    if axial and not holds:
        yield (
            "bearings",
            "The shaft has an axial load, but no bearing holds it along x; give one that bears "
            'axial load axial_seat = "fixed".',
        )
