"""Figures of the inner ring: what drives it, where the load puts it, what holds it; of what the
outer ring bears; and of further constraints."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.statistics import Windows
from flexcage.results.summary import Row, Section, figure, section_of, statistic
from flexcage.system.layout import CONSTRAINTS

if TYPE_CHECKING:
    import xarray

REACTIONS = ("axial_force", "moment_y", "moment_z")
TORQUE = "power over speed; seals, grease and elastic hysteresis of rolling are not counted"
LEAST = 1e-3  # [N, N m] reactions that never pass it are rounding


def ring_section(ds: xarray.Dataset, windows: Windows) -> Section:
    """Means of power and torque of the drive, of displacement and tilt, and of reactions."""
    return section_of(
        (*_drive_rows(ds, windows), *_place_rows(ds, windows), *_reaction_rows(ds, windows))
    )


def _drive_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    if "work" not in ds:
        return ()
    power = np.gradient(ds["work"].sel(channel="drive").values, ds["time"].values)
    speed = ds["inner_speed"].values
    torque = figure("drive_torque", None, "the ring stands")
    if speed.any():
        mean = windows.ratio(power, speed)
        torque = statistic("drive_torque", mean, TORQUE)
    return statistic("drive_power", windows.mean(power)), torque


def _place_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    x, y, z = ds["inner_position"].transpose("axis", "time").values
    across, azimuth = np.hypot(y.mean(), z.mean()), np.degrees(np.arctan2(z.mean(), y.mean()))
    lean = metrics.tilt(ds, body="inner")
    total, *parts = (lean.sel(component=c).values for c in lean["component"].values)
    up, aside = (f"{1e3 * float(part.mean()):.4g}" for part in parts)
    leaning = f"of the axis, {up} mrad towards y and {aside} towards z" if total.any() else ""
    return (
        figure(
            "inner_displacement",
            float(across),
            f"of the mean place, towards {azimuth:.1f} deg from y to z",
        ),
        statistic("inner_axial", windows.mean(x), idle=not x.any()),
        statistic("inner_tilt", windows.mean(total), leaning, idle=not total.any()),
    )


def _reaction_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    rows = []
    for key in REACTIONS:
        force = ds["multiplier"].sel(constraint=key).values
        if np.abs(force).max() <= LEAST:
            force = 0.0 * force
        note = "what holds the ring" if force.any() else ""
        rows.append(statistic(f"reaction_{key}", windows.mean(force), note, idle=not force.any()))
    return tuple(rows)


def outer_sections(ds: xarray.Dataset, windows: Windows) -> tuple[Section, ...]:
    """Means of what contacts press the outer ring with, and of how far its mount yields; none of a
    dataset without these forces."""
    if "outer_force" not in ds:
        return ()
    force, moment = (
        ds[name].transpose("axis", "time").values.astype(float)
        for name in ("outer_force", "outer_moment")
    )
    y, z = ds["outer_position"].transpose("axis", "time").values[1:]
    azimuth = np.degrees(np.arctan2(force[2].mean(), force[1].mean()))
    lean = metrics.tilt(ds, body="outer").sel(component="total").values
    rows = (
        statistic(
            "outer_force_radial", windows.mean(np.hypot(force[1], force[2])),
            f"on average towards {azimuth:.1f} deg from y to z",
        ),
        statistic("outer_force_axial", windows.mean(force[0])),
        statistic("outer_moment", windows.mean(np.hypot(moment[1], moment[2]))),
        figure(
            "outer_displacement", float(np.hypot(y.mean(), z.mean())), idle=not (y.any() or z.any())
        ),
        statistic("outer_tilt", windows.mean(lean), idle=not lean.any()),
    )  # fmt: skip
    return (section_of(rows),)


def constraint_sections(ds: xarray.Dataset, windows: Windows) -> tuple[Section, ...]:
    """Means of what the constraints beyond drive and load bear, one section, or none."""
    further = [str(name) for name in ds["constraint"].values if name not in CONSTRAINTS]
    rows = []
    for name in further:
        borne = ds["multiplier"].sel(constraint=name)
        shown = {"N": "N", "N m": "N mm"}[str(borne["multiplier_unit"].values)]
        label = name.replace("_", " ").capitalize()
        rows.append(Row.of(f"constraint_{name}", label, windows.mean(borne.values), shown))
    return (Section("Constraints", tuple(rows)),) if rows else ()
