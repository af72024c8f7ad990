"""Geometry that is legal, can be computed, and is hardly what anyone builds: a warning each."""

from __future__ import annotations

from collections.abc import Iterator

from flexcage.core.warning import RunWarning
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage

# assumptions, of the rolling element's diameter: a part of a cage that is thinner is hardly made,
# and a pocket with more clearance guides nothing
_THIN, _LOOSE = 0.03, 0.3
KEY = "odd_geometry"


def implausible_geometry(bearing: Bearing, cage: Cage) -> Iterator[RunWarning]:
    """Warnings of thin parts and of loose pockets."""
    diameter, element = bearing.element_diameter, bearing.element
    parts = cage.parts(bearing.pitch_diameter, bearing.element_count)
    for name, thickness in parts.items():
        if thickness < _THIN * diameter:
            yield RunWarning(
                KEY,
                f"The thickness of the cage's {name} is only {_mm(thickness)}, for {element}s of "
                f"{_mm(diameter)}: check the dimensions.",
            )
    clearance = cage.pocket_clearance(bearing)
    if clearance > _LOOSE * diameter:
        yield RunWarning(
            KEY,
            f"The cage's pockets are {_mm(cage.pocket_size)} wide, a clearance of "
            f"{_mm(clearance)} for {element}s of {_mm(diameter)}: they hardly guide them.",
        )


def _mm(value: float) -> str:
    return f"{value * 1e3:.3g} mm"
