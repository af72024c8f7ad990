"""What a run's motion amounts to: parts of a run, the cage's whirl and tilt, contact forces.

Without a cage its elements' mean orbit takes its place (``carrier_speed``).

Every function takes the dataset of a run and plain numbers, and returns plain numbers or labelled
arrays. Whirl is positive with the cage.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.wings import FAMILIES
from flexcage.results.each_cage import cage_count, one_cage
from flexcage.results.registry import CAGES

if TYPE_CHECKING:
    import xarray

TOUCHING = 1e-3  # N, above which a pocket face counts as in contact
FEWEST_FILTERED = 16  # samples, below which a low pass has nothing to begin from


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
    """A variable of the cage; InputError for a run without one, or with one for each row."""
    if name not in ds and not caged(ds):
        raise InputError(
            f"The run's bearing has no cage, and so no '{name}'; neighbour_force has how elements "
            "press each other.",
            where=name,
        )
    if CAGES in ds[name].dims:
        raise InputError(
            f"Each row of the run's bearing has a cage, and '{name}' is that of each; take one of "
            "them: flexcage.results.each_cage.one_cage(ds, 0), or run.row(0).",
            where=name,
        )
    return ds[name]


def following_in_row(ds: xarray.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Of every element the next one of its row, and the turn [rad] by which the first is ahead of
    the last."""
    numbers = np.arange(ds.sizes["element"])
    row = ds["row"].values if "row" in ds.coords else 0 * numbers
    last = np.append(row[1:] != row[:-1], True)
    first = np.array([numbers[row == k][0] for k in row])
    return np.where(last, first, numbers + 1), np.where(last, 2.0 * np.pi, 0.0)


def carrier(ds: xarray.Dataset) -> str:
    """What goes round with the elements, in words: "cage", "cages" where each row has one, or
    without one "balls", "rollers"."""
    if not caged(ds):
        return f"{element(ds)}s"
    return "cage" if cage_count(ds) == 1 else "cages"


def carrier_angle(ds: xarray.Dataset) -> np.ndarray:
    """Angle turned about the bearing axis [rad], continuous, (time,): by the cage, by those of all
    rows in the mean, or without one by the elements in the mean."""
    if not caged(ds):
        psi: np.ndarray = ds["element_position"].sel(cyl="psi").mean("element").values
        return psi
    if (count := cage_count(ds)) > 1:
        each = [carrier_angle(one_cage(ds, k)) for k in range(count)]
        return np.asarray(np.mean(each, axis=0))
    q = ds["cage_quaternion"].values
    return np.unwrap(2.0 * np.arctan2(q[:, 1], q[:, 0]), period=2.0 * np.pi)


def carrier_speed(ds: xarray.Dataset) -> xarray.DataArray:
    """Speed about the bearing axis, (time,) [rad/s]: of the cage, of those of all rows in the mean,
    or without one of the elements in the mean."""
    if caged(ds):
        speed = ds["cage_omega"].sel(axis="x", drop=True)
        return speed.mean(CAGES, keep_attrs=True) if CAGES in speed.dims else speed
    around = ds["element_velocity"].sel(cyl="psi", drop=True)
    found: xarray.DataArray = (around / ds["element_position"].sel(cyl="r", drop=True)).mean(
        "element"
    )
    found.attrs = {"units": "rad/s", "long_name": "mean orbital speed of the elements"}
    return found


def carrier_speeds(ds: xarray.Dataset) -> xarray.DataArray:
    """The same as it goes round with every element, (time, element), where each row has a cage;
    else ``carrier_speed``."""
    if (count := cage_count(ds)) == 1:
        return carrier_speed(ds)
    of_row = ds["cage_omega"].sel(axis="x", drop=True)
    return (
        of_row.isel({CAGES: np.arange(ds.sizes["element"]) * count // ds.sizes["element"]})
        .rename({CAGES: "element"})
        .assign_coords(element=ds["element"])
    )


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

    The figure depends on sampling and filter, so state both (20 kHz and 2 kHz, say). NaN for a
    centre that rests, and where it cannot be filtered.
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


def _about(ds: xarray.Dataset, about: str) -> np.ndarray:
    """Orbit (time, 2) about its mean or about the axis [m]."""
    yz = orbit(ds)
    if about == "mean":
        return yz - yz.mean(axis=0)
    if about != "axis":
        raise InputError(f"Whirl is taken about 'mean' or 'axis', not {about!r}.")
    return yz
