"""Can a bearing sit as [fit] says? One sentence each, and what would be right; and what is to be
known of a fit that can be."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from flexcage.core.errors import InputError
from flexcage.core.units import describe
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.checks import Finding
from flexcage.geometry.fits.mounting import MIDDLE, Mounting
from flexcage.geometry.fits.telling import um

if TYPE_CHECKING:
    from flexcage.case.sections import LoadedSections


def find_in_fit(case: LoadedSections) -> Iterator[Finding]:
    """What is impossible in how the bearing sits."""
    fit, bearing = case.fit, case.bearing
    if not fit.given:
        return
    if type(bearing).in_place is Bearing.in_place:
        yield (
            "fit",
            f"[fit] is given, but a {bearing.kind} does not say how its races follow (its type's "
            "in_place); leave it out.",
        )
    if refusal := bearing.fit_refusal(fit):
        yield "fit.housing", refusal
    for seat in ("shaft", "housing"):
        key, code = f"{seat}_interference", getattr(fit, seat)
        if code and getattr(fit, key) is not None:
            yield (
                f"fit.{key}",
                f"fit.{seat} is '{code}' and fit.{key} is given too, but each says the same; keep "
                "one of them.",
            )
    if fit.shaft_bore >= bearing.bore:
        yield (
            "fit.shaft_bore",
            f"fit.shaft_bore is {describe(fit.shaft_bore, 'mm')}, but the shaft itself has "
            f"{describe(bearing.bore, 'mm')}, the bearing's bore; give less, or 0 mm of a solid "
            "shaft.",
        )
    mounting = case.mounting
    assert mounting is not None
    yield from _find_closed(bearing, mounting)


def _find_closed(bearing: Bearing, mounting: Mounting) -> Iterator[Finding]:
    """A clearance that the bearing's type cannot have."""
    try:
        bearing.in_place(mounting.changed).check()
    except InputError as exc:
        left, before = um(mounting.operating), um(mounting.part("initial").values[mounting.taken])
        lost = f"[fit] leaves a radial clearance of {left} of {before} before mounting, but "
        reason = str(exc).partition(", but ")[2] if exc.where.startswith("bearing.") else str(exc)
        what = (reason or str(exc)).partition(";")[0].rstrip(".")
        yield "fit", f"{lost}{what}; take looser fits, or a larger class (fit.clearance)."


def questioned_fit(case: LoadedSections) -> Iterator[str]:
    """Sentences on fits that close the clearance, or let go of a ring."""
    mounting, fit = case.mounting, case.fit
    if mounting is None:
        return
    left = mounting.part("operating").values
    adjusted = mounting.approach is not None  # another bearing sets its clearance
    if mounting.operating < 0.0 and not (fit.preload or adjusted):
        yield (
            f"The fit closes the clearance: {um(mounting.operating)} are left in operation, a "
            "preload; take a larger class of clearance (fit.clearance) or looser fits, or say that "
            "it is meant by fit.preload = true."
        )
    elif left[0] < 0.0 and mounting.taken == MIDDLE and not (fit.preload or adjusted):
        yield (
            f"Within its tolerances the fit may close the clearance: {um(left[0])} to "
            f'{um(left[2])} are left in operation; fit.at = "least" computes the tightest.'
        )
    for name, grip in (("inner ring", mounting.inner), ("outer ring", mounting.outer)):
        k = mounting.taken
        if not grip.is_race and grip.interference[k] > 0.0 and grip.operating[k] <= 0.0:
            yield (
                f"The {name} loses its grip: of an interference of {um(grip.interference[k])} "
                f"{um(grip.operating[k])} are left in operation; warmth and speed take the rest."
            )
