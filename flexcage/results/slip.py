"""Speeds of cage and elements against pure rolling: slip ratios, and what they rest on.

Slip compares like with like (both speeds in the inertial frame, or both relative to the cage), with
the theoretical speed from the instantaneous inner speed; averages are taken over whole cage
revolutions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.geometry.kinematics import Kinematics, epicyclic, rolling_shares
from flexcage.results import metrics

if TYPE_CHECKING:
    import xarray

LOADED_SHARE = 0.01  # an element is in the loaded zone above this share of the largest inner force
STANDING = 1e-9  # rad/s, what a constrained speed of zero may be by rounding, and more
# times the sliding that the curvature of contacts makes: below it, mean sliding is its doing
_BY_CURVATURE = 2.0


@dataclass(frozen=True, kw_only=True)
class BearingNumbers:
    """The few numbers of a bearing that metrics need [m].

    ``contact_angle`` [rad] is the nominal one. ``own_angles``, inner and outer race's, are mean
    values of a run (``at_own_angles``), to which kinematics then refer. ``rolling_heights`` are the
    bearing's.
    """

    pitch_diameter: float
    element_diameter: float
    element_count: int
    contact_angle: float = 0.0
    own_angles: tuple[float, float] | None = None
    rolling_heights: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def of(cls, bearing: Bearing) -> BearingNumbers:
        """Those of a bearing."""
        return cls(
            pitch_diameter=bearing.pitch_diameter,
            element_diameter=bearing.element_diameter,
            element_count=bearing.element_count,
            contact_angle=bearing.nominal_contact_angle,
            rolling_heights=bearing.rolling_heights,
        )

    @property
    def nominal(self) -> BearingNumbers:
        """The same, whose kinematics refer to the nominal contact angle."""
        return replace(self, own_angles=None)

    @property
    def angles(self) -> tuple[float, float]:
        """Contact angles [rad] of inner and outer race to which kinematics refer."""
        return self.own_angles or (self.contact_angle, self.contact_angle)

    @property
    def at_angles(self) -> str:
        """At which contact angles kinematics are taken, in words; "" for the nominal one."""
        if self.own_angles is None:
            return ""
        inner, outer = np.degrees(self.own_angles)
        return (
            f"pure rolling at the mean contact angles, {inner:.1f} deg inner, {outer:.1f} deg outer"
        )

    @property
    def at_nominal(self) -> str:
        """The nominal contact angle, in words."""
        return f"by the nominal contact angle, {np.degrees(self.contact_angle):.4g} deg"

    def kinematics(self, inner_speed: float, outer_speed: float = 0.0) -> Kinematics:
        """Speeds without slip at the given speeds of the rings [rad/s]."""
        return epicyclic(
            element_diameter=self.element_diameter,
            pitch_diameter=self.pitch_diameter,
            element_count=self.element_count,
            contact_angle=self.angles,
            inner_speed=inner_speed,
            outer_speed=outer_speed,
        )


@dataclass(frozen=True)
class MeanSpeed:
    """Mean cage speed over whole revolutions [rad/s]; ``slip_ratio`` (w_m - w_c)/w_m.

    ``epicyclic`` is the speed w_m of pure rolling at the run's own mean contact angles,
    ``nominal`` that at the nominal contact angle, and ``nominal_slip`` the slip ratio by it. Both
    are the same for rollers.
    """

    mean: float
    epicyclic: float
    slip_ratio: float
    revolutions: float
    nominal: float
    nominal_slip: float


@dataclass(frozen=True)
class BallRolling:
    """Slip ratios of cage and balls, and sliding speeds [m/s] in the middle of inner and outer
    contact, that the curvature of the grooves makes where balls roll."""

    cage_slip: float
    ball_slip: float
    sliding: tuple[float, float]


@dataclass(frozen=True)
class ElementSpeed:
    """How fast the elements of a family turn about their own axes, and what pure rolling makes.

    ``title`` heads a picture of it, ``axis`` names it at an axis. ``spin`` takes it from a run,
    (time, element) [rad/s], positive as in rolling, ``rolling`` from kinematics, and ``slip_ratio``
    is (n_th - n)/n_th, (time, element). ``inertial``: in space, not relative to the cage.
    """

    title: str
    axis: str
    spin: Callable[[xarray.Dataset], xarray.DataArray]
    rolling: Callable[[Kinematics], float]
    slip_ratio: Callable[[xarray.Dataset, BearingNumbers], xarray.DataArray]
    inertial: bool = False


def spin_in_cage(ds: xarray.Dataset) -> xarray.DataArray:
    """Speed of every element about its own axis relative to the cage, or without one to the mean
    orbit, (time, element) [rad/s], positive as in rolling: so often a defect on it turns past a
    race."""
    own = speed_of(ds)
    spin = own.spin(ds)
    return spin - rolling_sense(ds) * metrics.carrier_speeds(ds) if own.inertial else spin


def element_spin(ds: xarray.Dataset) -> xarray.DataArray:
    """Speed of every element about its own axis, (time, element) [rad/s], as its family takes it:
    of rollers in the inertial frame, of balls relative to the cage."""
    return speed_of(ds).spin(ds)


def element_slip_ratio(ds: xarray.Dataset, bearing: BearingNumbers) -> xarray.DataArray:
    """(n_th - n)/n_th of every element over time, (time, element), by the same speed."""
    return speed_of(ds).slip_ratio(ds, bearing)


def speed_of(ds: xarray.Dataset) -> ElementSpeed:
    """How the elements of a run's bearing turn."""
    found: ElementSpeed = metrics.family(ds).speed()
    return found


def cage_speed(ds: xarray.Dataset, bearing: BearingNumbers) -> MeanSpeed:
    """Mean speed of the cage, or without one of the elements' orbits, against the epicyclic speeds
    of the mean inner speed."""
    return speed_over(metrics.whole_revolutions(ds), bearing)


def speed_over(part: xarray.Dataset, bearing: BearingNumbers) -> MeanSpeed:
    """The same over all of a part of a run."""
    t, angle = part["time"].values, metrics.carrier_angle(part)
    mean = (angle[-1] - angle[0]) / (t[-1] - t[0])
    inner = _mean(t, part["inner_speed"].values)
    own, nominal = (
        b.kinematics(inner).cage_speed for b in (at_own_angles(part, bearing), bearing.nominal)
    )
    slips = [(w - mean) / w if abs(w) > STANDING else float("nan") for w in (own, nominal)]
    turns = abs(angle[-1] - angle[0]) / (2.0 * np.pi)
    return MeanSpeed(mean, own, slips[0], turns, nominal, slips[1])


def at_own_angles(ds: xarray.Dataset, bearing: BearingNumbers) -> BearingNumbers:
    """The bearing with the mean contact angles of a run's loaded balls, inner and outer race.

    Magnitudes are averaged: a tilted ring turns signs from one side of the bearing to the other.
    Rollers keep the nominal angle, as do balls where none is loaded, and a bearing that has them.
    """
    if "contact_angle" not in ds or bearing.own_angles is not None:
        return bearing
    own = _loaded_means(ds, abs(ds["contact_angle"]))
    return bearing if own is None else replace(bearing, own_angles=own)


def _loaded_means(ds: xarray.Dataset, values: xarray.DataArray) -> tuple[float, float] | None:
    """Means (inner, outer race) of values (time, element, race) over loaded elements, None
    if none is loaded."""
    zone = loaded_zone(ds).transpose("time", "element").values
    inner, outer = values.transpose("race", "time", "element").values.astype(float)
    return (float(inner[zone].mean()), float(outer[zone].mean())) if zone.any() else None


def rolling_by_curvature(ds: xarray.Dataset, bearing: BearingNumbers) -> BallRolling | None:
    """What loaded balls do if each race's traction along the rolling direction is nothing: they
    roll above the middle of curved contacts. None where no ball is loaded, or for rollers.

    A strip at x of the ellipse's half-length a lies x^2 a^2/(2 R) above the middle, for R the
    radius of curvature of the surface of contact (Harris), and bears a share of 1 - x^2 of the
    load; under a traction in proportion to sliding, the mean height is a fifth of that at x = 1.
    """
    own = at_own_angles(ds, bearing)
    size = None if own.own_angles is None else _loaded_means(ds, ds["race_force"] ** (2.0 / 3.0))
    if size is None:
        return None
    heights = own.rolling_heights[0] * size[0], own.rolling_heights[1] * size[1]
    ratio = bearing.element_diameter / bearing.pitch_diameter
    middle, above = (rolling_shares(ratio, own.angles, h) for h in ((0.0, 0.0), heights))
    rolling = above.spin * abs(float(ds["inner_speed"].mean())) * 0.5 * bearing.element_diameter
    return BallRolling(
        1.0 - above.orbit / middle.orbit, 1.0 - above.spin / middle.spin,
        (rolling * heights[0], rolling * heights[1]),
    )  # fmt: skip


def slip_of(ideal: xarray.DataArray, spin: xarray.DataArray) -> xarray.DataArray:
    """(ideal - spin)/ideal, NaN where nothing should turn."""
    return (ideal - spin) / ideal.where(abs(ideal) > STANDING)


def rolling_sense(ds: xarray.Dataset) -> float:
    """Sense about the bearing axis in which elements roll, +1 or -1: against the inner ring's."""
    return 1.0 if float(ds["inner_speed"].mean()) < 0.0 else -1.0


def touching(ds: xarray.Dataset, of: xarray.DataArray) -> xarray.DataArray:
    """Values ``of`` (time, element, race), NaN where an element does not touch the race."""
    return of.where(ds["race_force"] > 0.0)


def loaded_zone(ds: xarray.Dataset, share: float = LOADED_SHARE) -> xarray.DataArray:
    """True where the inner race carries an element, (time, element)."""
    force = ds["race_force"].sel(race="inner", drop=True)
    return force > share * float(force.max())


@dataclass(frozen=True)
class SlipRange:
    """Sliding speeds [m/s] of a friction law that say what a slip ratio rests on.

    ``creep``: under it the law only creeps, where a real contact sticks; ``rise``: up to it the
    traction curve rises from rest. None where the law has no such speed.
    """

    creep: float | None = None
    rise: float | None = None

    def note(self, slip: float, sliding: Sequence[float], rolling: Sequence[float] = ()) -> str:
        """What a slip ratio rests on where both races slide at mean speeds [m/s]; "" where the law
        sets no more than its own value, or where there is no ratio. ``rolling``: sliding speeds
        that the curvature of contacts makes of pure rolling (``rolling_by_curvature``)."""
        if not isfinite(slip):
            return ""
        fastest = max(sliding)
        if self.creep is not None and fastest < self.creep:
            return f"unresolved: sliding is under the law's creep speed {self.creep:.3g} m/s"
        curved = max(rolling, default=0.0)
        if fastest < _BY_CURVATURE * curved:
            return (
                "balls roll: the grooves' curvature alone lets the middle of a contact slide at "
                f"{curved:.2g} m/s"
            )
        if self.rise is not None and fastest < self.rise:
            return (
                "set by the traction curve's slope: sliding is on its rise, which ends at "
                f"{self.rise:.3g} m/s"
            )
        return ""


def _mean(t: np.ndarray, values: np.ndarray) -> float:
    return float(np.trapezoid(values, t) / (t[-1] - t[0]))
