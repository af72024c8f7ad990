"""A virtual measurement of the cage's motion by lasers, and its inversion to the cage's centre.

Two sensors look along -y and -z at the cage's outside, in a plane across the bearing axis at
``plane`` [m] from the bearing's middle; three look along -x at its end face. A tilted cage shows
the radial sensors another displacement than its centre has: by ``plane`` times the slope of its
axis. The set-up, and the equations of ``by_tilt_angles``, are those of "Measurement and Dynamic
Analysis of the Centroid Trajectories of Angular-Contact Ball Bearing Cages"; ``invert`` solves for
the cage that shows just these readings.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import cos, pi, sin
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.texts import text_of
from flexcage.core.units import mm
from flexcage.results.metrics import of_cage

if TYPE_CHECKING:
    import xarray

ITERATIONS = 20  # of the inversion; it gains five digits in each
CHANNELS = ("Y", "Z", "X1", "X2", "X3")
_FARTHEST = 10.0  # mm, that a cage moves: tens of times the clearance of large bearings' cages
_OF_TIMES = re.compile(r"time|zeit\b|sec|(?-i:t)\b", re.IGNORECASE)
TIME = "t"  # column of a rig's file that holds times in seconds


@dataclass(frozen=True, kw_only=True)
class LaserSetup:
    """Where the sensors are, and how good; lengths in metres, readings from a centred cage's.

    Raises InputError for sensors that look past the cage.
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

    def __post_init__(self) -> None:
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

    @property
    def spots(self) -> np.ndarray:
        """Places (3, 2) as (y, z) of the axial sensors."""
        return self.circle * np.array([(cos(a), sin(a)) for a in self.angles])


def readings(
    centre: np.ndarray,
    axis: np.ndarray,
    setup: LaserSetup,
    *,
    face: np.ndarray | None = None,
    seed: int | None = None,
) -> np.ndarray:
    """Readings (n, 5) [m] in the order of ``CHANNELS`` of a cage at ``centre`` (n, 3) with unit
    ``axis`` (n, 3).

    Lines of sight meet the cylinder and the plane exactly. ``face`` (n, 3) is the unit normal of
    the end face, where it is not square to the axis (``run_out``). ``seed`` adds the sensors'
    noise.
    """
    out = np.empty((len(centre), 5))
    for k, component in enumerate((1, 2)):
        start = np.zeros(3)
        start[0] = setup.plane
        direction = np.eye(3)[component]
        out[:, k] = _cylinder(start, direction, centre, axis, setup.radius) - setup.radius
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


def _cylinder(
    start: np.ndarray, direction: np.ndarray, centre: np.ndarray, axis: np.ndarray, radius: float
) -> np.ndarray:
    """Distance (n,) along a line at which it leaves each of the cylinders."""
    from_centre = start - centre
    d = direction - (axis @ direction)[:, None] * axis
    o = from_centre - np.einsum("ni,ni->n", from_centre, axis)[:, None] * axis
    a, b = (d * d).sum(axis=1), (d * o).sum(axis=1)
    root = np.sqrt(b * b - a * ((o * o).sum(axis=1) - radius**2))
    return (root - b) / a


def slopes(values: np.ndarray, setup: LaserSetup) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x0, p, q (n,) of the end face x = x0 + p y + q z that three axial readings show."""
    rows = np.column_stack([np.ones(3), setup.spots])
    face = values[:, 2:] + setup.half_width
    return tuple(np.linalg.solve(rows, face.T))  # type: ignore[return-value]


def invert(values: np.ndarray, setup: LaserSetup) -> tuple[np.ndarray, np.ndarray]:
    """Centre (n, 3) [m] and unit axis (n, 3) of the cage that shows these readings (n, 5)."""
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
    """Centre (n, 2) as (y, z) [m] by the paper's equation: each sensor in a plane of its own.

    d = Y - R (1 - cos(theta))/cos(theta) - plane tan(theta), theta the tilt that the end face
    shows in the sensor's plane: exact for a cage that tilts in that plane alone.
    """
    _, p, q = slopes(values, setup)
    theta = np.arctan(np.column_stack([-p, -q]))
    lifted = setup.radius * (1.0 - np.cos(theta)) / np.cos(theta)
    return values[:, :2] - lifted - setup.plane * np.tan(theta)


def measured(ds: xarray.Dataset, setup: LaserSetup, *, seed: int | None = None) -> np.ndarray:
    """Readings (n, 5) [m] that the set-up would take of a run's cage, at the set-up's rate."""
    return readings(*of_run(ds, rate=setup.rate), setup, seed=seed)


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


def load_readings(path: str | Path) -> np.ndarray:
    """Readings (n, 5) [m] of a test rig from a CSV file, in the order of ``CHANNELS``.

    Its first line names the columns Y, Z, X1, X2, X3 in any order; below are numbers in
    millimetres. Other columns are ignored; ``load_times`` reads one of times. Raises InputError
    for a file that has them not.
    """
    names, table = _columns(path)
    lacking = [name for name in CHANNELS if name not in names]
    if lacking:
        raise InputError(
            f"The readings '{path}' have no column '{lacking[0]}'; the first line must name "
            f"{', '.join(CHANNELS)}, then numbers in mm.",
            where=lacking[0],
        )
    found = table[:, [names.index(name) for name in CHANNELS]]
    if (farthest := float(np.abs(found).max())) > _FARTHEST:
        raise InputError(
            f"The readings '{path}' go up to {farthest:g} mm, but no cage moves farther than "
            f"{_FARTHEST:g} mm in its clearance: write mm, as 0.15 for 150 um, from the reading of "
            "a centred cage.",
            value=farthest,
        )
    return 1e-3 * found


def load_times(path: str | Path) -> np.ndarray | None:
    """Times (n,) [s] of a rig's readings: the column t of their file; None if it has none.

    Raises InputError for times of another name, and for those that do not rise.
    """
    names, table = _columns(path)
    if TIME not in names:
        if other := next((name for name in names if _OF_TIMES.match(name)), None):
            raise InputError(
                f"The readings '{path}' have a column '{other}'; name it t, and give seconds.",
                where=TIME,
                value=other,
            )
        return None
    times: np.ndarray = table[:, names.index(TIME)]
    if (late := np.flatnonzero(np.diff(times) <= 0.0)).size:
        row = int(late[0]) + 1
        raise InputError(
            f"The readings '{path}' have times that do not rise: reading {row + 1} is at "
            f"{times[row]:g} s, after {times[row - 1]:g} s; sort them, or write more digits.",
            where=TIME,
            value=float(times[row]),
        )
    return times


def _columns(path: str | Path) -> tuple[list[str], np.ndarray]:
    """Names of a CSV file's columns, and its numbers (n, columns)."""
    file = path_of(path, "readings")
    try:
        first, *rest = text_of(file, "readings are").splitlines() or [""]
    except OSError as exc:
        raise InputError(f"The readings '{path}' cannot be read: {exc.strerror}.") from exc
    names = [name.strip() for name in first.split(",")]
    if twice := next((name for name in names if name and names.count(name) > 1), None):
        raise InputError(
            f"The readings '{path}' have {names.count(twice)} columns '{twice}'; leave one of "
            "them.",
            where=twice,
        )
    lines = [(number, line) for number, line in enumerate(rest, 2) if line.strip()]
    other = next((f"'{mark}'" if mark == ";" else "tabs" for mark in ";\t" if mark in first), None)
    if other:
        raise InputError(
            f"The readings '{path}' have {other} between their columns; write commas there, and "
            "numbers with a point, as 0.15."
        )
    if not lines:
        raise InputError(
            f"The readings '{path}' hold 0 numbers below their first line, which names the columns."
        )
    try:
        table = np.loadtxt([line for _, line in lines], delimiter=",", ndmin=2)
    except ValueError:
        table = np.full((1, 1), np.nan)
    if table.shape[1] != len(names) or not np.isfinite(table).all():
        raise InputError(f"The readings '{path}' {_fault(names, lines)}.")
    return names, table


def _fault(names: list[str], lines: list[tuple[int, str]]) -> str:
    """What is wrong with the first line that is."""
    for number, line in lines:
        entries = [entry.strip() for entry in line.split(",")]
        if len(entries) != len(names):
            return (
                f"name {len(names)} columns, but their line {number} holds {len(entries)} numbers; "
                "write one number a column, with a point, as 0.15"
            )
        for name, entry in zip(names, entries):
            try:
                known = np.isfinite(float(entry))
            except ValueError:
                known = False
            if not known:
                return (
                    f"hold what is no number: '{entry}' in line {number}, column '{name}'; leave "
                    "out lines without a reading"
                )
    return "hold what is no number"
