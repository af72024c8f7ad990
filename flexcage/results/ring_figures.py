"""Figures of the inner ring: what drives it, where the load puts it, what holds it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.statistics import Windows
from flexcage.results.summary import Row, Section

if TYPE_CHECKING:
    import xarray

_LEAST = 1e-3  # N, N m: less is rounding, or what a sound bearing makes by chance
_REACTIONS = {
    "axial_force": ("Axial reaction", "N"),
    "moment_y": ("Moment about y", "N mm"),
    "moment_z": ("Moment about z", "N mm"),
}


def ring_section(ds: xarray.Dataset, windows: Windows) -> Section:
    """Means of power and torque of the drive, of displacement and tilt, and of reactions.

    Displacement along the axis, tilt, and reactions over a thousandth of N or N m.
    """
    return Section(
        "Inner ring",
        (*_drive_rows(ds, windows), *_place_rows(ds, windows), *_reaction_rows(ds, windows)),
    )


def _drive_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    if "work" not in ds:
        return ()
    power = np.gradient(ds["work"].sel(channel="drive").values, ds["time"].values)
    speed = ds["inner_speed"].values
    rows = [Row.of("drive_power", "Power of the drive", windows.mean(power), "W")]
    if speed.any():
        torque = windows.ratio(power, speed)
        rows.append(Row.of("drive_torque", "Drive torque", torque, "N mm", "power over speed"))
    return tuple(rows)


def _place_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    x, y, z = ds["inner_position"].transpose("axis", "time").values
    across, azimuth = np.hypot(y.mean(), z.mean()), np.degrees(np.arctan2(z.mean(), y.mean()))
    rows = [
        Row("inner_displacement", "Displacement across the axis", float(across), "um",
            f"of the mean place, towards {azimuth:.1f} deg from y to z")
    ]  # fmt: skip
    if x.any():
        rows.append(Row.of("inner_axial", "Displacement along the axis", windows.mean(x), "um"))
    lean = metrics.tilt(ds, body="inner")
    if lean.values.any():
        total, *parts = (lean.sel(component=c).values for c in lean["component"].values)
        y, z = (f"{1e3 * float(part.mean()):.4g}" for part in parts)
        rows.append(
            Row.of("inner_tilt", "Tilt", windows.mean(total), "mrad",
                   f"of the axis, {y} mrad towards y and {z} towards z")
        )  # fmt: skip
    return tuple(rows)


def _reaction_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    held = {key: ds["multiplier"].sel(constraint=key).values for key in _REACTIONS}
    return tuple(
        Row.of(f"reaction_{key}", _REACTIONS[key][0], windows.mean(force), _REACTIONS[key][1],
               "what holds the ring")
        for key, force in held.items() if np.abs(force).max() > _LEAST
    )  # fmt: skip
