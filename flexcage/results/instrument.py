"""A virtual measurement of the cage's motion by lasers, and its inversion to the cage's centre.

Two sensors look along -y and -z at the cage's outside, in a plane across the bearing axis at
``plane`` [m] from the bearing's middle; three look along -x at its end face. A tilted cage shows
the radial sensors another displacement than its centre has: by ``plane`` times the slope of its
axis. The set-up, and the equations of ``by_tilt_angles``, are those of "Measurement and Dynamic
Analysis of the Centroid Trajectories of Angular-Contact Ball Bearing Cages"; ``invert`` solves for
the cage that shows just these readings, if its rim is round.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.core.errors import InputError
from flexcage.core.units import mm
from flexcage.results.metrics import of_cage
from flexcage.results.rig_file import CHANNELS, FARTHEST
from flexcage.results.rim import Line, Rim

if TYPE_CHECKING:
    import xarray

ITERATIONS = 20  # of the inversion; it gains five digits in each
_LARGEST = 10.0  # m, of a cage
POINTS = 8  # of Gauss and Legendre across a spot
_LEAST_SPREAD = 0.05  # of the circle: 3 deg between lines through sensors


@dataclass(frozen=True, kw_only=True)
class LaserSetup:
    """Where the sensors are, and how good; lengths in metres, readings from a centred cage's.

    Raises InputError for sensors that look past the cage, or stand where they cannot tell its tilt,
    and for values that are no numbers in SI.
    """

    radius: float  # of the cage's outside
    half_width: float  # from the cage's centre to the end face that is looked at
    plane: float  # axial place of the radial sensors, seen from the bearing's middle
    circle: float  # radius of the circle on which the axial sensors stand
    angles: tuple[float, float, float] = (0.0, 2.0 * pi / 3.0, 4.0 * pi / 3.0)  # from y to z
    repeatability: float = 0.0  # standard deviation of a reading
    resolution: float = 0.0  # readings are whole multiples of it; 0: none
    reach: float = np.inf  # readings beyond +-reach are not a number
    rate: float | None = None  # readings a second, Hz; None: as many as the run has samples
    rim: Rim = field(default_factory=Rim)  # of the cage's outside: round, unless it is given
    spot: float = 0.0  # width of the light's spot around the cage; a reading is the mean over it

    def __post_init__(self) -> None:
        self._check_numbers()
        if abs(self.plane) > self.half_width:
            raise InputError(
                f"The radial sensors look past the cage: their plane is {mm(self.plane)} from its "
                f"middle, but it ends at {mm(self.half_width)}.",
                where="plane",
                value=self.plane,
            )
        if self.circle > self.radius:
            raise InputError(
                f"The axial sensors look past the cage: they stand on a radius of "
                f"{mm(self.circle)}, but it ends at {mm(self.radius)}.",
                where="circle",
                value=self.circle,
            )
        if self.spot > self.radius:
            raise InputError(
                f"The spot of the radial sensors is {mm(self.spot)} wide, more than the cage's "
                f"radius of {mm(self.radius)}; give a smaller one.",
                where="spot",
                value=self.spot,
            )
        if not isinstance(self.rim, Rim):
            raise _of_setup("rim", repr(self.rim), "a flexcage.spec.Rim")
        self.rim.check_on(self.radius)

    def _check_numbers(self) -> None:
        """Refuse values that are no numbers, or of other units than SI."""
        positive = ("radius", "half_width", "circle", "reach", "rate")
        for name in (*positive, "plane", "repeatability", "resolution", "spot"):
            value = getattr(self, name)
            if value is None and name == "rate":
                continue
            number = isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
            if not number or np.isnan(value) or value < 0.0 and name != "plane":
                raise _of_setup(name, value, "a number in SI that is not negative")
            if name in positive and not value > 0.0:
                raise _of_setup(name, value, "greater than 0")
            if name != "rate" and _LARGEST < abs(value) < np.inf:
                raise _of_setup(name, value, f"a length in metres; is {mm(1e-3 * value)} meant?")
        angles = np.asarray(self.angles)
        if angles.shape != (3,) or angles.dtype.kind not in "iuf" or not np.isfinite(angles).all():
            raise _of_setup("angles", self.angles, "three numbers in radians")
        if np.abs(angles).max() > 2.0 * pi:
            raise _of_setup("angles", self.angles, "in radians, up to 2 pi")
        spots = self.spots - self.spots.mean(axis=0)
        if np.linalg.svd(spots, compute_uv=False)[1] < _LEAST_SPREAD * self.circle:
            raise _of_setup("angles", self.angles, "apart, so that the sensors tell every tilt")

    @property
    def spots(self) -> np.ndarray:
        """Places (3, 2) as (y, z) of the axial sensors."""
        return self.circle * np.array([(cos(a), sin(a)) for a in self.angles])


def _of_setup(name: str, value: object, wanted: str) -> InputError:
    shown = value if isinstance(value, (int, float, tuple)) else repr(value)
    return InputError(f"{name} is {shown}, but should be {wanted}.", where=name, value=value)


def _checked(values: Any) -> np.ndarray:
    """Readings as an array (n, 5); InputError for other shapes, and for those in other units."""
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != len(CHANNELS) or array.dtype.kind not in "iuf":
        raise InputError(
            f"The readings are of shape {array.shape} ({array.dtype}), but should be numbers (n, "
            f"5), in the order {', '.join(CHANNELS)}.",
            where="values",
        )
    farthest = float(np.abs(array).max(initial=0.0, where=np.isfinite(array)))
    if farthest > 1e-3 * FARTHEST:
        raise InputError(
            f"The readings go up to {farthest:g} m, but no cage moves farther than {FARTHEST:g} "
            "mm in its clearance: give metres, from the reading of a centred cage.",
            where="values",
            value=farthest,
        )
    return array.astype(float)


def readings(
    centre: np.ndarray,
    axis: np.ndarray,
    setup: LaserSetup,
    *,
    face: np.ndarray | None = None,
    mark: np.ndarray | None = None,
    seed: int | None = None,
) -> np.ndarray:
    """Readings (n, 5) [m] in the order of ``CHANNELS`` of a cage at ``centre`` (n, 3) with unit
    ``axis`` (n, 3).

    Lines of sight meet the rim and the plane exactly; a spot takes the mean of several. ``face``
    (n, 3) is the unit normal of the end face, where it is not square to the axis (``run_out``).
    ``mark`` (n, 3) is the unit vector from the axis to pocket 0 (``mark_of_run``), without which a
    rim that is not round raises InputError. ``seed`` adds the sensors' noise.
    """
    if mark is None:
        if not setup.rim.round:
            raise InputError(
                "The rim is not round, so that readings follow the cage's turn; give mark, the "
                "direction of pocket 0 (mark_of_run).",
                where="mark",
            )
        mark = np.broadcast_to(np.eye(3)[1], np.shape(centre))
    out = np.empty((len(centre), 5))
    for k, component in enumerate((1, 2)):
        out[:, k] = radial_reading(component, centre, axis, mark, setup)
    normal = axis if face is None else face
    end = centre + setup.half_width * axis  # where the axis leaves the end face
    for k, (y, z) in enumerate(setup.spots):
        across = normal[:, 1] * (y - end[:, 1]) + normal[:, 2] * (z - end[:, 2])
        out[:, 2 + k] = end[:, 0] - across / normal[:, 0] - setup.half_width
    if seed is not None:
        out = out + setup.repeatability * np.random.default_rng(seed).standard_normal(out.shape)
    if setup.resolution > 0.0:
        out = setup.resolution * np.round(out / setup.resolution)
    return np.where(np.abs(out) <= setup.reach, out, np.nan)


def radial_reading(
    component: int, centre: np.ndarray, axis: np.ndarray, mark: np.ndarray, setup: LaserSetup
) -> np.ndarray:
    """Reading (n,) [m] of the sensor that looks along y (1) or z (2): mean over its spot, less that
    of a centred round cage."""
    places, weights = np.polynomial.legendre.leggauss(POINTS if setup.spot else 1)
    out = np.zeros(len(centre))
    for place, weight in zip(0.5 * setup.spot * places, 0.5 * weights):
        start = np.zeros(3)
        start[0], start[3 - component] = setup.plane, place
        line = Line(start, np.eye(3)[component])
        seen = setup.rim.distances(line, centre, axis, mark, setup.radius)
        out += weight * (seen - np.sqrt(setup.radius**2 - place**2))
    return out


def slopes(values: np.ndarray, setup: LaserSetup) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x0, p, q (n,) of the end face x = x0 + p y + q z that three axial readings show."""
    rows = np.column_stack([np.ones(3), setup.spots])
    face = values[:, 2:] + setup.half_width
    return tuple(np.linalg.solve(rows, face.T))  # type: ignore[return-value]


def invert(values: np.ndarray, setup: LaserSetup) -> tuple[np.ndarray, np.ndarray]:
    """Centre (n, 3) [m] and unit axis (n, 3) of the round cage that shows these readings (n, 5)
    [m]: what its rim is out by is taken for motion, as on a rig.

    InputError for readings of another shape or unit.
    """
    values = _checked(values)
    x0, p, q = slopes(values, setup)
    axis = np.column_stack([np.ones(len(p)), -p, -q])
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    centre = np.zeros((len(p), 3))
    for _ in range(ITERATIONS):
        # the end face passes through the centre moved by half a width along the axis
        end = centre[:, 1:] + setup.half_width * axis[:, 1:]
        centre[:, 0] = x0 + p * end[:, 0] + q * end[:, 1] - setup.half_width * axis[:, 0]
        missed = values[:, :2] - readings(centre, axis, _ideal(setup))[:, :2]
        centre[:, 1:] += missed
        if not np.nanmax(np.abs(missed), initial=0.0) > 1e-12:
            break
    return centre, axis


def _ideal(setup: LaserSetup) -> LaserSetup:
    return LaserSetup(
        radius=setup.radius, half_width=setup.half_width, plane=setup.plane, circle=setup.circle,
        angles=setup.angles,
    )  # fmt: skip


def by_tilt_angles(values: np.ndarray, setup: LaserSetup) -> np.ndarray:
    """Centre (n, 2) as (y, z) [m] by the published equation: each sensor in a plane of its own.

    d = Y - R (1 - cos(theta))/cos(theta) - plane tan(theta), theta the tilt that the end face
    shows in the sensor's plane: exact for a cage that tilts in that plane alone. InputError as
    ``invert``.
    """
    values = _checked(values)
    _, p, q = slopes(values, setup)
    theta = np.arctan(np.column_stack([-p, -q]))
    lifted = setup.radius * (1.0 - np.cos(theta)) / np.cos(theta)
    return values[:, :2] - lifted - setup.plane * np.tan(theta)


def measured(ds: xarray.Dataset, setup: LaserSetup, *, seed: int | None = None) -> np.ndarray:
    """Readings (n, 5) [m] that the set-up would take of a run's cage, at the set-up's rate."""
    mark = mark_of_run(ds, rate=setup.rate)
    return readings(*of_run(ds, rate=setup.rate), setup, mark=mark, seed=seed)


def of_run(ds: xarray.Dataset, *, rate: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Centre (n, 3) [m] and unit axis (n, 3) of a run's cage, seen from the outer ring.

    At the run's samples, or ``rate`` [Hz] times a second from its first sample on, by linear
    interpolation between them (``sample_times``).
    """
    turn = Rotation.from_quat(of_cage(ds, "cage_quaternion").values, scalar_first=True)
    centre = of_cage(ds, "cage_position").values - ds["outer_position"].values
    axis = turn.as_matrix()[:, :, 0]
    if rate is None:
        return centre, axis
    taken = sample_times(ds, rate=rate)
    centre, axis = (_at(taken, ds["time"].values, values) for values in (centre, axis))
    return centre, axis / np.linalg.norm(axis, axis=1, keepdims=True)


def mark_of_run(ds: xarray.Dataset, *, rate: float | None = None) -> np.ndarray:
    """Unit vector (n, 3) from the axis of a run's cage to its pocket 0, at the instants of
    ``of_run``."""
    turn = Rotation.from_quat(of_cage(ds, "cage_quaternion").values, scalar_first=True)
    mark = turn.as_matrix()[:, :, 1]
    if rate is None:
        return mark
    mark = _at(sample_times(ds, rate=rate), ds["time"].values, mark)
    _, axis = of_run(ds, rate=rate)
    mark = mark - (mark * axis).sum(axis=1)[:, None] * axis
    return mark / np.linalg.norm(mark, axis=1, keepdims=True)


def run_out(ds: xarray.Dataset, *, total: float, circle: float) -> np.ndarray:
    """Unit normal (n, 3) of an end face that is not square to a run's cage: along a circle of this
    radius [m] it runs out by ``total`` [m], lowest at pocket 0, and turns with the cage."""
    slope = 0.5 * total / circle
    normal = np.array([1.0, slope, 0.0]) / np.hypot(1.0, slope)
    turn = Rotation.from_quat(of_cage(ds, "cage_quaternion").values, scalar_first=True)
    return turn.apply(normal)


def sample_times(ds: xarray.Dataset, *, rate: float | None = None) -> np.ndarray:
    """Instants (n,) [s] of what ``of_run`` gives: the run's own, or ``rate`` [Hz] of them a second.

    Raises InputError for a rate that takes fewer than two samples of the run.
    """
    t: np.ndarray = ds["time"].values
    if rate is None:
        return t
    length = t[-1] - t[0]
    if not rate * length >= 1.0:
        raise InputError(
            f"The lasers' rate is {rate:g} Hz, which takes fewer than two samples of a run of "
            f"{length:g} s; give a higher one.",
            where="rate",
            value=rate,
        )
    return t[0] + np.arange(int(rate * length * (1.0 + 1e-12)) + 1) / rate


def _at(taken: np.ndarray, t: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (n, 3) at the times ``taken`` (n,) from those (m, 3) at ``t`` (m,)."""
    return np.column_stack([np.interp(taken, t, column) for column in values.T])
