"""Figures of the inner ring: what drives it, where the load puts it, what holds it; of what the
outer ring bears; and of further constraints."""

from __future__ import annotations

from functools import partial

import numpy as np

from flexcage.results.figures.figure import Figure, FigureTable, Found
from flexcage.results.figures.part import SettledRun
from flexcage.results.metrics import tilt
from flexcage.results.row import SummaryRow
from flexcage.system.layout import CONSTRAINTS

TORQUE = "power over speed; seals, grease and elastic hysteresis of rolling are not counted"
LEAST = 1e-3  # [N, N m] reactions that never pass it are rounding


def _torque(part: SettledRun) -> Found | None:
    speed = part.ds["inner_speed"].values
    if part.drive is None or not speed.any():
        return None if part.drive is None else Found(None, "the ring stands")
    return Found(part.windows.ratio(part.drive, speed), TORQUE)


def _towards(y: np.ndarray, z: np.ndarray) -> str:
    """Whither the mean of a vector across the axis points, in words."""
    return f"towards {np.degrees(np.arctan2(z.mean(), y.mean())):.1f} deg from y to z"


def _away(part: SettledRun) -> Found:
    _, y, z = part.of_axes("inner_position")
    return Found(float(np.hypot(y.mean(), z.mean())), f"of the mean place, {_towards(y, z)}")


def _axial(part: SettledRun) -> Found:
    along = part.of_axes("inner_position")[0]
    return Found(part.windows.mean(along), idle=not along.any())


def _tilt(part: SettledRun) -> Found:
    tilted = tilt(part.ds, body="inner")
    total, *parts = (tilted.sel(component=c).values for c in tilted["component"].values)
    up, aside = (f"{1e3 * float(part.mean()):.4g}" for part in parts)
    note = f"of the axis, {up} mrad towards y and {aside} towards z" if total.any() else ""
    return Found(part.windows.mean(total), note, idle=not total.any())


def _reaction(key: str, part: SettledRun) -> Found:
    force = part.ds["multiplier"].sel(constraint=key).values
    if np.abs(force).max() <= LEAST:
        force = 0.0 * force
    note = "what holds the ring" if force.any() else ""
    return Found(part.windows.mean(force), note, idle=not force.any())


# fmt: off
INNER = FigureTable[SettledRun]("Inner ring")
INNER.add("drive_power", "Drive power", "W", "mean", "signed", "statistic",
          take=lambda part: None if part.drive is None else part.windows.mean(part.drive))
INNER.add("drive_torque", "Drive torque", "N mm", "mean power over mean speed",
          "signed", "statistic", take=_torque)
INNER.add("inner_displacement", "Inner ring, displacement across the axis", "um",
          "of the mean place", take=_away)
INNER.add("inner_axial", "Inner ring, displacement along the axis", "um", "mean",
          "signed", "statistic", take=_axial)
INNER.add("inner_tilt", "Inner ring, tilt", "mrad", "mean angle of the ring's axis",
          "signed", "statistic", take=_tilt)
for _key, _title, _unit in (("axial_force", "axial reaction", "N"),
                            ("moment_y", "moment about y", "N mm"),
                            ("moment_z", "moment about z", "N mm")):
    INNER.add(f"reaction_{_key}", f"Inner ring, {_title}", _unit, "what holds the ring, mean",
              "signed", "statistic", take=partial(_reaction, _key))
# fmt: on


def _across(part: SettledRun) -> Found:
    _, y, z = part.of_axes("outer_force")
    return Found(part.windows.mean(np.hypot(y, z)), f"on average {_towards(y, z)}")


def _outer_away(part: SettledRun) -> Found:
    _, y, z = part.of_axes("outer_position")
    return Found(float(np.hypot(y.mean(), z.mean())), idle=not (y.any() or z.any()))


def _outer_tilt(part: SettledRun) -> Found:
    tilted = tilt(part.ds, body="outer").sel(component="total").values
    return Found(part.windows.mean(tilted), idle=not tilted.any())


# fmt: off
#: Of runs that record what presses the outer ring.
OUTER = FigureTable[SettledRun]("Outer ring")
OUTER.add("outer_force_radial", "Outer ring, force across the axis", "N",
          "mean size of what all contacts press it with", "statistic", take=_across)
OUTER.add("outer_force_axial", "Outer ring, force along the axis", "N", "mean",
          "signed", "statistic",
          take=lambda part: part.windows.mean(part.of_axes("outer_force")[0]))
OUTER.add("outer_moment", "Outer ring, moment across the axis", "N mm",
          "mean size, about its centre", "statistic",
          take=lambda part: part.windows.mean(np.hypot(*part.of_axes("outer_moment")[1:])))
OUTER.add("outer_displacement", "Outer ring, displacement across the axis", "um",
          "of the mean place, on a mount that yields", take=_outer_away)
OUTER.add("outer_tilt", "Outer ring, tilt", "mrad", "mean angle of its axis, likewise",
          "statistic", take=_outer_tilt)
# fmt: on


def constraint_rows(part: SettledRun) -> list[SummaryRow]:
    """Means of what the constraints beyond drive and load bear, which a case names."""
    rows = []
    for name in (str(name) for name in part.ds["constraint"].values if name not in CONSTRAINTS):
        borne = part.ds["multiplier"].sel(constraint=name)
        shown = {"N": "N", "N m": "N mm"}[str(borne["multiplier_unit"].values)]
        label, mean = name.replace("_", " ").capitalize(), part.windows.mean(borne.values)
        figure = Figure(f"constraint_{name}", label, shown, "", "Constraints", lambda _: None)
        rows.append(figure.row(mean))
    return rows
