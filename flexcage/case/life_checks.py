"""Can a life be rated as [life] asks? One sentence each, and what would be right."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from flexcage.core.errors import InputError
from flexcage.geometry.checks import Finding
from flexcage.geometry.life.iso281 import reliability_factor
from flexcage.geometry.life.oil import viscosity_at
from flexcage.geometry.life.spec import Life

if TYPE_CHECKING:
    from flexcage.case.sections import StaticSections

_WHOLE = 1e-3  # by which shares may miss 1, as rounded ones do


def find_in_life(case: StaticSections) -> Iterator[Finding]:
    """What is impossible in [life]."""
    life = case.life
    if not life.given:
        return
    if case.bearing.endurance is None:
        yield (
            "life",
            f"[life] is given, but a {case.bearing.kind} does not say how its life depends on oil "
            "and cleanliness (its type's endurance); leave it out.",
        )
    try:
        reliability_factor(life.reliability)
    except InputError as exc:
        yield exc.where, str(exc)
    yield from _find_in_oil(life)
    yield from _find_in_spectrum(life)
    if life.contamination is not None and case.speed == 0.0 and not life.spectrum:
        yield (
            "life.contamination",
            "life.contamination is given, but the bearing stands still at the start, without a "
            "film or a life in hours; give drive.speed.",
        )


def _find_in_oil(life: Life) -> Iterator[Finding]:
    given = [k for k in ("viscosity_40", "viscosity_100") if getattr(life, k) is not None]
    if len(given) == 1:
        other = "viscosity_100" if given[0] == "viscosity_40" else "viscosity_40"
        yield (
            f"life.{other}",
            f"life.{given[0]} is given without life.{other}, and only both say how the oil thins "
            "with warmth; give both, or neither.",
        )
    if len(given) < 2:
        for k, point in enumerate(life.spectrum):
            if point.temperature is not None:
                yield (
                    f"life.spectrum.{k}.temperature",
                    f"life.spectrum.{k}.temperature is given, but not the oil's life.viscosity_40 "
                    "and life.viscosity_100, by which it would count; give them, or leave it out.",
                )
        return
    temperatures = [life.temperature, *(p.temperature for p in life.spectrum)]
    lacking = temperatures[1:] or temperatures
    if life.temperature is None and None in lacking:
        yield (
            "life.temperature",
            "life.viscosity_40 and viscosity_100 are given, but not at which temperature the oil "
            "works; give life.temperature.",
        )
    assert life.viscosity_40 is not None and life.viscosity_100 is not None
    try:
        viscosity_at(313.15, life.viscosity_40, life.viscosity_100)
    except InputError as exc:
        yield exc.where, str(exc)


def _find_in_spectrum(life: Life) -> Iterator[Finding]:
    if not life.spectrum:
        return
    total = sum(point.share for point in life.spectrum)
    if abs(total - 1.0) > _WHOLE:
        percent = "; shares are parts of 1, not percent" if total > 1.5 else ""
        yield (
            "life.spectrum",
            f"The shares of life.spectrum add up to {total:.6g}, but should to 1{percent}; give "
            "all of the time, standing still as a point of 0 rpm.",
        )
