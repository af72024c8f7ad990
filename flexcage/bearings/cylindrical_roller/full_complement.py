"""Rollers inside a catalogue's bearing without a cage, from one race diameter and the ratings.

Catalogues give the race diameter of the ring that can be taken off: E of NCF (SL18), F of NJG
(SL19). Makers choose it so that a whole number of rollers fills the pitch circle, which lies about
midway between bore and outside: this tells the rollers' diameter; C0 tells their length.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from math import ceil

from flexcage.bearings.cylindrical_roller import inference
from flexcage.bearings.cylindrical_roller.needle_inference import TYPES
from flexcage.bearings.cylindrical_roller.needle_inference import candidates as needles
from flexcage.core.errors import InputError
from flexcage.core.units import describe
from flexcage.geometry.full_complement import elements_around, filling_count, reason_of_count
from flexcage.geometry.inference import Candidate, Inference, Outline

Rule = Callable[[Outline], Sequence[Candidate]]

_LONGEST = 2.0  # length over diameter of rollers
_THINNEST = 0.15  # of a ring at its race, over the roller's diameter
_SMALLEST, _LARGEST = 0.15, 0.45  # roller's diameter over half of outside diameter less bore
_SPARE = 0.05  # of a roller that the pitch circle usually has to spare
_OFF_MIDDLE = 0.02  # of the pitch diameter, from midway between bore and outside: usual
_HALF = 0.5  # how unlikely diameters of half a millimetre are, beside whole ones


def candidates(outline: Outline) -> list[Candidate]:
    """As many rollers as fit, of each diameter that leaves rings, and each length."""
    inference.check_design(outline)
    found = []
    for inner, outer in _races(outline):
        diameter, pitch = 0.5 * (outer - inner), 0.5 * (outer + inner)
        if not 0.0 < diameter < 0.5 * pitch:
            continue
        count = filling_count(diameter, pitch)
        unlikely = _unlikely(outline, diameter, pitch)
        races = replace(outline, inner_race_diameter=inner, outer_race_diameter=outer)
        for length in inference.lengths(outline, diameter, _LONGEST):
            made = inference.candidate(races, length, count)
            reasons = {**made.reasons, **_reasons(outline, made)}
            found.append(replace(made, outline=outline, reasons=reasons,
                                 unlikely=made.unlikely + unlikely))  # fmt: skip
    return found


def _races(outline: Outline) -> Iterator[tuple[float, float]]:
    """Diameters [m] of inner and outer race: those of the outline, and where it has one alone,
    the other one of every roller in steps of half a millimetre."""
    inner, outer = outline.inner_race_diameter, outline.outer_race_diameter
    if inner is not None and outer is not None:
        if outer <= inner:
            raise inference.races_the_wrong_way(inner, outer)
        yield inner, outer
        return
    if inner is None and outer is None:
        raise InputError(
            "A full complement of rollers needs the race diameter E (--outer-race) or F "
            "(--inner-race) as well.",
            where="--outer-race",
        )
    height = 0.5 * (outline.outside_diameter - outline.bore)
    for half in range(ceil(2e3 * _SMALLEST * 2.0 * height), int(2e3 * _LARGEST * 2.0 * height) + 1):
        diameter = 0.5e-3 * half
        low = outer - 2.0 * diameter if inner is None else inner  # type: ignore[operator]
        high = inner + 2.0 * diameter if outer is None else outer  # type: ignore[operator]
        thin = _THINNEST * 2.0 * diameter
        if low - outline.bore >= thin and outline.outside_diameter - high >= thin:
            yield round(low, 9), round(high, 9)


def _unlikely(outline: Outline, diameter: float, pitch: float) -> float:
    """What speaks against rollers of a diameter on a pitch circle [m]."""
    spare = elements_around(diameter, pitch) - filling_count(diameter, pitch)
    middle = 0.5 * (outline.bore + outline.outside_diameter)
    off = (pitch / middle - 1.0) / _OFF_MIDDLE
    half = 0.0 if round(1e3 * diameter, 6).is_integer() else _HALF
    return (spare / _SPARE) ** 2 + off**2 + half


def _reasons(outline: Outline, made: Candidate) -> dict[str, str]:
    bearing = made.bearing
    reasons = {"roller_count": reason_of_count(bearing)}
    for ring, letter, other in (("inner", "F", "E - 2 Dw"), ("outer", "E", "F + 2 Dw")):
        if getattr(outline, f"{ring}_race_diameter") is None:
            reasons[f"{ring}_race_diameter"] = f"inferred: {letter} = {other}"
            reasons["roller_diameter"] = (
                f"inferred: {bearing.element_count} of {describe(bearing.element_diameter, 'mm')} "
                "fill the pitch circle"
            )
    return reasons


def _by_type(cylindrical: Rule) -> Rule:
    """The rule of a type: the same one of needles, with a cage and without."""
    return lambda outline: needles(outline) if outline.type in TYPES else cylindrical(outline)


INFERENCE = Inference(
    candidates=_by_type(inference.candidates),
    cages=dict.fromkeys(("cylindrical_roller", *TYPES), "window"),
    count="roller_count",
    full=_by_type(candidates),
)
