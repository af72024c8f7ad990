"""A bearing on its seats: the clearance of its class, the sections of its rings, the speed of its
drive, and what of case and bearing follows (``geometry.fits``)."""

from __future__ import annotations

import dataclasses
from typing import TypeVar

import numpy as np

from flexcage.bearings import sections_of
from flexcage.case.catalogues import clearance_limits, rows
from flexcage.core.errors import InputError
from flexcage.core.units import describe
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.fits.mounting import Mounting, Three, mount
from flexcage.geometry.fits.spec import Fit
from flexcage.system.spec import Drive, Load

B = TypeVar("B", bound=Bearing)


def mounting_of(bearing: Bearing, fit: Fit, drive: Drive) -> Mounting:
    """Clearance of a bearing from before mounting to operation. Raises InputError for a class or a
    code that there is not, and materials whose expansion is not known."""
    speed = fastest(drive) if fit.at_speed is None else abs(fit.at_speed)
    found = mount(bearing, fit, _initial(bearing, fit), _walls(bearing), speed)
    after = bearing.in_place(found.changed)
    approach = bearing.approach(after, found.changed)
    if approach is None:
        return found
    has = hasattr(bearing, "free_contact_angle")
    angles = (bearing.nominal_contact_angle, after.nominal_contact_angle) if has else None
    return dataclasses.replace(found, angles=angles, approach=approach)


def in_operation(bearing: B, load: Load, mounting: Mounting) -> tuple[B, Load]:
    """The bearing and its load as the mounting leaves them: an inner ring that meets its elements
    earlier along the axis presses the shaft's spring by as much more."""
    changed: B = bearing.in_place(mounting.changed)  # type: ignore[assignment]
    more = load.axial_stiffness * (mounting.approach or 0.0)
    if not more:
        return changed, load
    varies = load.varies == "axial"
    new: dict[str, object] = {"axial": load.axial + more}
    if varies and load.ramp_to is not None:
        new["ramp_to"] = load.ramp_to + more
    if varies:
        new["values"] = tuple(value + more for value in load.values)
    return changed, dataclasses.replace(load, **new)  # type: ignore[arg-type]


def fastest(drive: Drive) -> float:
    """The highest speed [rad/s] of a drive, in either sense."""
    speeds = drive.speeds if drive.times else (drive.speed, drive.ramp_to or 0.0)
    swing = abs(drive.wave_amplitude) if drive.wave != "none" else 0.0
    return max(map(abs, speeds), default=0.0) + swing


def class_limits(bearing: Bearing, group: str) -> tuple[float, float] | None:
    """Least and largest radial clearance [m] of a class (ISO 5753-1); None where flexcage has no
    table for such bearings or their bore."""
    return clearance_limits(bearing.type, bearing.bore, group)


def _initial(bearing: Bearing, fit: Fit) -> Three:
    if fit.clearance is None:
        return (bearing.clearance,) * 3
    limits = class_limits(bearing, fit.clearance)
    if limits is None:
        known = sorted({row["type"] for row in rows("clearance")})
        if bearing.type in known:
            why = f"flexcage has no table for a bore of {describe(bearing.bore, 'mm')}"
        else:
            why = f"ISO 5753-1 has no classes of {bearing.kind}s"
        raise InputError(
            f"fit.clearance is '{fit.clearance}', but {why}; leave it out: clearance or contact "
            "angle of [bearing] are then those before mounting.",
            where="fit.clearance",
            value=fit.clearance,
        )
    least, largest = limits
    return least, 0.5 * (least + largest), largest


def _walls(bearing: Bearing) -> tuple[float, float]:
    """Diameters [m] of cylinders with the area of the rings' sections: the inner ring's outer one
    and the outer ring's inner one; those of the races where the family has no sections."""
    sections = sections_of(bearing)
    if sections is None:
        return bearing.race_diameters
    angle, seats = bearing.nominal_contact_angle, (bearing.bore, bearing.outside_diameter)
    rings = sections(
        bearing, angle=(angle, angle), across=(0.05 * bearing.element_diameter,) * 2, seat=seats
    )
    inner, outer = (2.0 * _area(ring.outline) / bearing.width for ring in rings)
    return seats[0] + inner, seats[1] - outer


def _area(outline: tuple[tuple[float, float], ...]) -> float:
    x, r = np.array(outline).T
    return 0.5 * abs(float(x @ np.roll(r, -1) - r @ np.roll(x, -1)))
