"""A mounting in words and numbers, for terminals and pages."""

from __future__ import annotations

from math import degrees, pi

from flexcage.geometry.fits.mounting import MIDDLE, Grip, Mounting

_FITTED = ("least", "mean", "largest")


def clearance_note(mounting: Mounting) -> str:
    """What the table of parts shows, and how both rings sit: a line each."""
    taken = _FITTED[mounting.taken]
    turning = f" at {mounting.speed * 30.0 / pi:.6g} rpm" if mounting.speed else ""
    parts = [
        f"Radial clearance in um{turning}: least and largest are of the limits of all tolerances, "
        f"of which the bearing has the {taken} (fit.at)",
        _inner(mounting.inner, mounting.taken),
        f"Outer ring in its housing: {_grip(mounting.outer, mounting.taken)}",
    ]
    if mounting.approach is not None:
        meets = f"he inner ring meets its elements {um(mounting.approach)} earlier along the axis"
        if mounting.angles is None:
            return "\n".join([*parts, f"T{meets}"])
        before, after = (f"{degrees(angle):.4g} deg" for angle in mounting.angles)
        parts.append(f"Free contact angle {before} before mounting, {after} in operation: t{meets}")
    return "\n".join(parts)


def clearance_lines(mounting: Mounting) -> list[list[str]]:
    """Rows of the parts, the first of them heads."""
    varies = any(part.values[0] != part.values[2] for part in mounting.parts)
    kept = range(3) if varies else (MIDDLE,)
    lines = [["clearance, um", *(_FITTED[k] if varies else "" for k in kept)]]
    return lines + [
        [part.title, *(_column(part.values[k]) for k in kept)] for part in mounting.parts
    ]


def _inner(grip: Grip, k: int) -> str:
    if grip.is_race:
        return f"Shaft, which is the inner race: {um(grip.interference[k])} beyond its nominal size"
    return f"Inner ring on its shaft: {_grip(grip, k)}"


def _grip(grip: Grip, k: int) -> str:
    first, late = grip.interference[k], grip.operating[k]
    word = "interference" if first > 0.0 or late > 0.0 else "gap"
    sign = 1.0 if word == "interference" else -1.0
    if first == late == 0.0:
        return "neither gap nor interference"
    given, left = (um(sign * value) for value in (first, late))
    text = f"{word} {given} as toleranced, {left} in operation"
    return f"{text}, {grip.pressure[k] / 1e6:.3g} MPa" if grip.pressure[k] else text


def um(value: float) -> str:
    """A length [m] of a sentence on fits, in micrometres and three digits."""
    return f"{1e6 * value:.3g} um"


def _column(value: float) -> str:
    return f"{1e6 * value:.2f}" if abs(value) >= 5e-9 else "0.00"
