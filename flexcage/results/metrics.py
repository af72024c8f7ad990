"""What a run's motion amounts to: cage speed and slip, whirl, tilt, roller slip, contact forces.

Without a cage its elements' mean orbit takes its place (``carrier_speed``).

Every function takes the dataset of a run and plain numbers, and returns plain numbers or labelled
arrays. Definitions: slip compares like with like (both speeds in the inertial frame, or both
relative to the cage), with the theoretical speed from the instantaneous inner speed; averages are
taken over whole cage revolutions after the start was left out. Whirl is positive with the cage.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.kinematics import Kinematics, epicyclic, rolling_shares

if TYPE_CHECKING:
    import xarray

TOUCHING = 1e-3  # N, above which a pocket face counts as in contact
LOADED_SHARE = 0.01  # an element is in the loaded zone above this share of the largest inner force
STANDING = 1e-9  # rad/s, what a constrained speed of zero may be by rounding, and more
# times the sliding that the curvature of contacts makes: below it, mean sliding is its doing
_BY_CURVATURE = 2.0
FEWEST_FILTERED = 16  # samples, below which a low pass has nothing to begin from


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
class CageSpeed:
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
class Whirl:
    """Orbit of the cage centre [m]: radius about the centre named (time,), ratio (max - min)/mean,
    and whirl speed over cage speed (+1 synchronous, negative: backward).
    """

    about: str
    radius: np.ndarray = field(repr=False, compare=False)
    mean: float
    smallest: float
    largest: float
    ratio: float
    speed_ratio: float


@dataclass(frozen=True)
class PocketForces:
    """Normal forces of rollers on the cage [N]; ``mean`` is taken while in contact only."""

    mean: float
    peak: float
    peak_pocket: int
    peak_face: str
    peak_time: float
    contact_share: float

    @property
    def ratio(self) -> float:
        """Largest over mean force; NaN where nothing touched."""
        return self.peak / self.mean if self.mean else float("nan")


@dataclass(frozen=True)
class ElementSpeed:
    """How fast the elements of a family turn about their own axes, and what pure rolling makes.

    ``title`` heads a picture of it, ``axis`` names it at an axis. ``spin`` takes it from a run,
    (time, element) [rad/s], positive as in rolling, ``rolling`` from kinematics, and ``slip_ratio``
    is (n_th - n)/n_th, (time, element).
    """

    title: str
    axis: str
    spin: Callable[[xarray.Dataset], xarray.DataArray]
    rolling: Callable[[Kinematics], float]
    slip_ratio: Callable[[xarray.Dataset, BearingNumbers], xarray.DataArray]


def element(ds: xarray.Dataset) -> str:
    """Rolling elements of a run's bearing, in words: "roller", "ball"."""
    return str(ds.attrs["element"])


def family(ds: xarray.Dataset) -> Any:
    """Family of a run's bearing (``flexcage.bearings``); InputError if no module has added it."""
    name = str(ds.attrs["family"])
    if name not in FAMILIES:
        raise InputError(
            f"The run is of bearing family '{name}', which is not known; load the module that adds "
            "it first.",
            where="family", value=name,
        )  # fmt: skip
    return FAMILIES[name]


def element_spin(ds: xarray.Dataset) -> xarray.DataArray:
    """Speed of every element about its own axis, (time, element) [rad/s], as its family takes it:
    of rollers in the inertial frame, of balls relative to the cage."""
    return speed_of(ds).spin(ds)


def element_slip_ratio(ds: xarray.Dataset, bearing: BearingNumbers) -> xarray.DataArray:
    """(n_th - n)/n_th of every element over time, (time, element), by the same speed."""
    return speed_of(ds).slip_ratio(ds, bearing)


def speed_of(ds: xarray.Dataset) -> ElementSpeed:
    """How the elements of a run's bearing turn."""
    found: ElementSpeed = family(ds).speed()
    return found


def settled(ds: xarray.Dataset, settle: float = 0.3) -> xarray.Dataset:
    """The run without its first part; ``settle`` is the share of its duration left out."""
    t = ds["time"].values
    if len(t) < 2:
        raise InputError("The run holds fewer than two samples: no statistics can be taken.")
    first = int(np.searchsorted(t, t[0] + settle * (t[-1] - t[0])))
    out = ds.isel(time=slice(min(first, len(t) - 2), None))
    if "time_hf" in ds.dims:
        fine = ds["time_hf"].values
        out = out.isel(time_hf=slice(int(np.searchsorted(fine, t[first])), None))
    return out


def caged(ds: xarray.Dataset) -> bool:
    """Has the run's bearing a cage?"""
    return "cage_position" in ds


def of_cage(ds: xarray.Dataset, name: str) -> xarray.DataArray:
    """A variable of the cage; InputError for a run without one."""
    if name not in ds and not caged(ds):
        raise InputError(
            f"The run's bearing has no cage, and so no '{name}'; neighbour_force has how elements "
            "press each other.",
            where=name,
        )
    return ds[name]


def carrier(ds: xarray.Dataset) -> str:
    """What goes round with the elements, in words: "cage", or without one "balls", "rollers"."""
    return "cage" if caged(ds) else f"{element(ds)}s"


def carrier_angle(ds: xarray.Dataset) -> np.ndarray:
    """Angle turned about the bearing axis [rad], continuous, (time,): by the cage, or without one
    by the elements in the mean."""
    if not caged(ds):
        psi: np.ndarray = ds["element_position"].sel(cyl="psi").mean("element").values
        return psi
    q = ds["cage_quaternion"].values
    return np.unwrap(2.0 * np.arctan2(q[:, 1], q[:, 0]), period=2.0 * np.pi)


def carrier_speed(ds: xarray.Dataset) -> xarray.DataArray:
    """Speed about the bearing axis, (time,) [rad/s]: of the cage, or without one of the elements in
    the mean."""
    if caged(ds):
        return ds["cage_omega"].sel(axis="x", drop=True)
    around = ds["element_velocity"].sel(cyl="psi", drop=True)
    found: xarray.DataArray = (around / ds["element_position"].sel(cyl="r", drop=True)).mean(
        "element"
    )
    found.attrs = {"units": "rad/s", "long_name": "mean orbital speed of the elements"}
    return found


def whole_revolutions(ds: xarray.Dataset) -> xarray.Dataset:
    """The longest leading part with a whole number of revolutions of the cage, or without one of
    the elements (all, if under one)."""
    turned = np.abs(carrier_angle(ds) - carrier_angle(ds)[0]) / (2.0 * np.pi)
    full = np.floor(turned[-1] + 1e-9)
    if full < 1.0:
        return ds
    stop = int(np.argmin(np.abs(turned - full)))
    return ds.isel(time=slice(stop + 1))


def varies(values: np.ndarray, share: float = 0.01) -> bool:
    """Whether ``values`` (n,) range over more than a share of the largest of them."""
    return bool(np.ptp(values) > share * np.abs(values).max())


def cage_speed(ds: xarray.Dataset, bearing: BearingNumbers) -> CageSpeed:
    """Mean speed of the cage, or without one of the elements' orbits, against the epicyclic speeds
    of the mean inner speed."""
    return speed_over(whole_revolutions(ds), bearing)


def speed_over(part: xarray.Dataset, bearing: BearingNumbers) -> CageSpeed:
    """The same over all of a part of a run."""
    t, angle = part["time"].values, carrier_angle(part)
    mean = (angle[-1] - angle[0]) / (t[-1] - t[0])
    inner = _mean(t, part["inner_speed"].values)
    own, nominal = (
        b.kinematics(inner).cage_speed for b in (at_own_angles(part, bearing), bearing.nominal)
    )
    slips = [(w - mean) / w if abs(w) > STANDING else float("nan") for w in (own, nominal)]
    turns = abs(angle[-1] - angle[0]) / (2.0 * np.pi)
    return CageSpeed(mean, own, slips[0], turns, nominal, slips[1])


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


def whirl_radius(ds: xarray.Dataset, *, about: str = "mean") -> np.ndarray:
    """Distance of the cage centre from its orbit's ``mean`` or the ``axis``, (time,) [m]."""
    yz = _about(ds, about)
    return np.hypot(yz[:, 0], yz[:, 1])


def whirl(ds: xarray.Dataset, *, about: str = "mean") -> Whirl:
    """Whirl of the cage centre about the orbit's ``mean`` or the outer ring's ``axis``."""
    yz = _about(ds, about)
    r = np.hypot(yz[:, 0], yz[:, 1])
    mean = float(r.mean())
    phase = np.unwrap(np.arctan2(yz[:, 1], yz[:, 0]))
    turned = carrier_angle(ds)
    cage = turned[-1] - turned[0]
    return Whirl(
        about,
        r,
        mean,
        float(r.min()),
        float(r.max()),
        float(np.ptp(r) / mean) if mean else 0.0,
        float((phase[-1] - phase[0]) / cage) if cage and mean else float("nan"),
    )


def orbit(ds: xarray.Dataset) -> np.ndarray:
    """Cage centre relative to the outer ring's, (time, 2): y and z [m]."""
    return centre_of(ds, "cage")


def centre_of(ds: xarray.Dataset, body: str) -> np.ndarray:
    """Centre of a body ("cage", "inner") relative to the outer ring's, (time, 2): y and z [m]."""
    place = of_cage(ds, "cage_position") if body == "cage" else ds[f"{body}_position"]
    yz = place.sel(axis=["y", "z"]).values
    if "outer_position" in ds:
        yz = yz - ds["outer_position"].sel(axis=["y", "z"]).values
    return yz


def centre_speed(ds: xarray.Dataset, *, low_pass: float | None = None) -> np.ndarray:
    """Speed of the cage's centre [m/s], (time,); ``low_pass`` [Hz] filters its velocity first.

    The filter is a Butterworth of order 4, run forwards and backwards over the components. NaN
    where the samples are too slow or too few to filter.
    """
    v = of_cage(ds, "cage_velocity").values
    if low_pass is not None:
        from flexcage.results.lowpass import butterworth, low_passed_both_ways

        rate = sampling_rate(ds)
        if rate <= 2.2 * low_pass or len(v) < FEWEST_FILTERED:
            return np.full(len(v), np.nan)
        v = low_passed_both_ways(butterworth(2.0 * low_pass / rate), v)
    return np.linalg.norm(v, axis=1)


def velocity_deviation(ds: xarray.Dataset, *, low_pass: float | None = None) -> float:
    """Standard deviation over mean of the cage centre's speed, of ``centre_speed``.

    The figure depends on sampling and filter, so state both (paper 004: 20 kHz and 2 kHz). NaN for
    a centre that rests, and where it cannot be filtered.
    """
    speed = centre_speed(ds, low_pass=low_pass)
    mean = float(speed.mean())
    return float(speed.std(ddof=1)) / mean if mean else float("nan")


def sampling_rate(ds: xarray.Dataset) -> float:
    """Samples a second of the main grid [Hz]."""
    return 1.0 / float(np.median(np.diff(ds["time"].values)))


def tilt(ds: xarray.Dataset, *, body: str = "cage") -> xarray.DataArray:
    """Tilt of the axis a of the cage, or of the "inner" or "outer" ring, against the bearing's
    [rad].

    (time, component): total acos(a.x), and the signed atan2(a_y, a_x) and atan2(a_z, a_x).
    """
    import xarray as xr

    name = f"{body}_quaternion"
    w, x, y, z = (of_cage(ds, name) if body == "cage" else ds[name]).values.T
    a = np.stack([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)])
    total = np.arctan2(np.hypot(a[1], a[2]), a[0])
    parts = np.stack([total, np.arctan2(a[1], a[0]), np.arctan2(a[2], a[0])], axis=1)
    return xr.DataArray(
        parts,
        dims=("time", "component"),
        coords={"time": ds["time"], "component": ["total", "towards y", "towards z"]},
        attrs={"units": "rad", "long_name": f"tilt of the {body} axis"},
        name=f"{body}_tilt",
    )


def pocket_forces(ds: xarray.Dataset, *, threshold: float = TOUCHING) -> PocketForces:
    """Mean (while above ``threshold`` [N]) and peak of the normal forces on pocket faces."""
    force = of_cage(ds, "pocket_force").transpose("time", "pocket", "face")
    values, peaks = force.values, pocket_peaks(ds).values
    touching = values > threshold
    at = np.unravel_index(int(np.argmax(peaks)), peaks.shape)
    return PocketForces(
        float(values[touching].mean(dtype=float)) if touching.any() else 0.0,
        float(peaks[at]),
        int(force["pocket"].values[at[1]]),
        str(force["face"].values[at[2]]),
        float(force["time"].values[at[0]]),
        float(touching.mean()),
    )


def pocket_peaks(ds: xarray.Dataset) -> xarray.DataArray:
    """Largest normal force on every pocket face since the sample before, (time, pocket, face) [N].

    A contact lasts a few samples, whose largest is some 15 % less than that of the solver's steps.
    Of runs that lack it, the samples themselves.
    """
    peaks = ds["pocket_peak"] if "pocket_peak" in ds else of_cage(ds, "pocket_force")
    return peaks.transpose("time", "pocket", "face")


def pocket_force_series(
    ds: xarray.Dataset, *, threshold: float = TOUCHING
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Over time: sum of normal forces on pocket faces in contact [N], number of such faces, and
    the largest force [N] since the sample before, each (time,)."""
    force = of_cage(ds, "pocket_force").transpose("time", "pocket", "face").values.astype(float)
    touching = force > threshold
    total = np.where(touching, force, 0.0).sum(axis=(1, 2))
    return total, touching.sum(axis=(1, 2)), pocket_peaks(ds).max(("pocket", "face")).values


def gaps(ds: xarray.Dataset, bearing: BearingNumbers) -> np.ndarray:
    """How far (time, element) [m] the next element is from every one, along the pitch circle; below
    zero by what two are pressed together."""
    psi = ds["element_position"].sel(cyl="psi").transpose("time", "element").values
    ahead = np.diff(psi, axis=1, append=psi[:, :1] + 2.0 * np.pi)
    half = 0.5 * bearing.pitch_diameter
    return np.asarray(half * (ahead - 2.0 * np.arcsin(0.5 * bearing.element_diameter / half)))


def _about(ds: xarray.Dataset, about: str) -> np.ndarray:
    """Orbit (time, 2) about its mean or about the axis [m]."""
    yz = orbit(ds)
    if about == "mean":
        return yz - yz.mean(axis=0)
    if about != "axis":
        raise InputError(f"Whirl is taken about 'mean' or 'axis', not {about!r}.")
    return yz


def _mean(t: np.ndarray, values: np.ndarray) -> float:
    return float(np.trapezoid(values, t) / (t[-1] - t[0]))
