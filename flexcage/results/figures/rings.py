"""Figures of the inner ring: what drives it, where the load puts it, what holds it; of what the
outer ring bears; and of further constraints."""

from __future__ import annotations

from functools import partial

import numpy as np

from flexcage.results import metrics
from flexcage.results.figures.figure import SIGNED, STATISTIC, Figure, Found, Table
from flexcage.results.figures.part import Part
from flexcage.results.row import Row
from flexcage.system.layout import CONSTRAINTS

TORQUE = "power over speed; seals, grease and elastic hysteresis of rolling are not counted"
LEAST = 1e-3  # [N, N m] reactions that never pass it are rounding

INNER = Table[Part]("Inner ring")


@INNER.figure("Drive power", "W", "mean", SIGNED, STATISTIC)
def drive_power(part: Part) -> Found | None:
    return Found(part.windows.mean(part.drive)) if "work" in part.ds else None


@INNER.figure("Drive torque", "N mm", "mean power over mean speed", SIGNED, STATISTIC)
def drive_torque(part: Part) -> Found | None:
    if "work" not in part.ds:
        return None
    speed = part.ds["inner_speed"].values
    if not speed.any():
        return Found(None, "the ring stands")
    return Found(part.windows.ratio(part.drive, speed), TORQUE)


@INNER.figure("Inner ring, displacement across the axis", "um", "of the mean place")
def inner_displacement(part: Part) -> Found:
    _, y, z = part.inner_place
    azimuth = np.degrees(np.arctan2(z.mean(), y.mean()))
    note = f"of the mean place, towards {azimuth:.1f} deg from y to z"
    return Found(float(np.hypot(y.mean(), z.mean())), note)


@INNER.figure("Inner ring, displacement along the axis", "um", "mean", SIGNED, STATISTIC)
def inner_axial(part: Part) -> Found:
    along = part.inner_place[0]
    return Found(part.windows.mean(along), idle=not along.any())


@INNER.figure("Inner ring, tilt", "mrad", "mean angle of the ring's axis", SIGNED, STATISTIC)
def inner_tilt(part: Part) -> Found:
    lean = metrics.tilt(part.ds, body="inner")
    total, *parts = (lean.sel(component=c).values for c in lean["component"].values)
    up, aside = (f"{1e3 * float(part.mean()):.4g}" for part in parts)
    note = f"of the axis, {up} mrad towards y and {aside} towards z" if total.any() else ""
    return Found(part.windows.mean(total), note, idle=not total.any())


def _reaction(key: str, part: Part) -> Found:
    force = part.ds["multiplier"].sel(constraint=key).values
    if np.abs(force).max() <= LEAST:
        force = 0.0 * force
    note = "what holds the ring" if force.any() else ""
    return Found(part.windows.mean(force), note, idle=not force.any())


for _key, _title, _unit in (
    ("axial_force", "axial reaction", "N"),
    ("moment_y", "moment about y", "N mm"),
    ("moment_z", "moment about z", "N mm"),
):
    INNER.add(
        f"reaction_{_key}", f"Inner ring, {_title}", _unit, "what holds the ring, mean",
        SIGNED, STATISTIC, take=partial(_reaction, _key),
    )  # fmt: skip

#: Of runs that record what presses the outer ring.
OUTER = Table[Part]("Outer ring")


@OUTER.figure(
    "Outer ring, force across the axis", "N", "mean size of what all contacts press it with",
    STATISTIC,
)  # fmt: skip
def outer_force_radial(part: Part) -> Found:
    _, y, z = part.pressed("outer_force")
    azimuth = np.degrees(np.arctan2(z.mean(), y.mean()))
    note = f"on average towards {azimuth:.1f} deg from y to z"
    return Found(part.windows.mean(np.hypot(y, z)), note)


@OUTER.figure("Outer ring, force along the axis", "N", "mean", SIGNED, STATISTIC)
def outer_force_axial(part: Part) -> Found:
    return Found(part.windows.mean(part.pressed("outer_force")[0]))


@OUTER.figure(
    "Outer ring, moment across the axis", "N mm", "mean size, about its centre", STATISTIC
)
def outer_moment(part: Part) -> Found:
    _, y, z = part.pressed("outer_moment")
    return Found(part.windows.mean(np.hypot(y, z)))


@OUTER.figure(
    "Outer ring, displacement across the axis", "um", "of the mean place, on a mount that yields"
)
def outer_displacement(part: Part) -> Found:
    _, y, z = part.outer_place
    return Found(float(np.hypot(y.mean(), z.mean())), idle=not (y.any() or z.any()))


@OUTER.figure("Outer ring, tilt", "mrad", "mean angle of its axis, likewise", STATISTIC)
def outer_tilt(part: Part) -> Found:
    lean = metrics.tilt(part.ds, body="outer").sel(component="total").values
    return Found(part.windows.mean(lean), idle=not lean.any())


def constraint_rows(part: Part) -> list[Row]:
    """Means of what the constraints beyond drive and load bear, which a case names."""
    rows = []
    for name in (str(name) for name in part.ds["constraint"].values if name not in CONSTRAINTS):
        borne = part.ds["multiplier"].sel(constraint=name)
        shown = {"N": "N", "N m": "N mm"}[str(borne["multiplier_unit"].values)]
        label, mean = name.replace("_", " ").capitalize(), Found(part.windows.mean(borne.values))
        figure = Figure(f"constraint_{name}", label, shown, "", "Constraints", lambda _: None)
        rows.append(figure.row_of(mean))
    return rows
