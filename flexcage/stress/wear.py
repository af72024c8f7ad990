"""Wear of a cage's pockets and land by Archard's law, from recorded forces and sliding.

Worn volume = k * integral of normal force times sliding speed. Depth is that volume over the area
of the track that an element leaves: on a crossbeam face, slice by slice, the slice's length times
the height over which the line of contact wanders; on a round pocket's wall, the same by sectors; on
side beams the band that a roller's end covers; on a land all of it. The height is that of a uniform
spread with the same standard deviation, sqrt(12) times it, plus the width of the Hertz contact.
That is the depth at first. An element works itself in and its track grows wider: ``Wear.depth``
takes the groove to have the element's radius. Neither changes the pocket in the model: forces and
speeds are those of the unworn cage.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, isfinite, isnan, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.contacts.spec import LandSpec
from flexcage.core.binding import wrong_type
from flexcage.core.digits import number_text, texts_with_margin
from flexcage.core.errors import InputError
from flexcage.core.listing import aligned, wrapped
from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.results.bootstrap import NO_INTERVAL
from flexcage.results.each_cage import ONE_OF, cage_count, one_cage
from flexcage.results.statistics import Windows
from flexcage.stress.rubbing import Rub, Rubbing, joined
from flexcage.stress.sn_curves import of_other
from flexcage.stress.wear_laws import WearLaw

if TYPE_CHECKING:
    import xarray

_SHALLOW = 0.1  # of a groove's radius: beyond it a groove is no shallow segment, nor the cage whole
_HOUR = 3600.0
_ITERATIONS = 40  # of Newton's method for a depth; each near its end doubles the digits


@dataclass(frozen=True, eq=False)
class Wear:
    """Rates of wear over ``duration`` [s] of settled motion.

    ``dataset`` holds, by pocket and face, ``volume_rate`` [m^3/s] with its ``margin`` (half the
    width of the 95 % interval; NaN for too few windows), ``depth_rate`` [m/s] at first of the
    deepest slice or sector and ``track_area`` [m^2]; by cell ``cell_volume_rate`` [m^3/s],
    ``cell_length`` and ``cell_height`` [m]; by face ``groove_radius`` [m]; and
    ``land_volume_rate`` and ``land_depth_rate``, zero without a land, NaN where a film carries it,
    for which Archard's law says nothing.
    ``friction_check`` is the work of pocket friction at the speeds used over the recorded one.
    """

    law: WearLaw
    duration: float
    dataset: xarray.Dataset
    friction_check: float
    cage: str = ""  # name of the cage's material, if it is known
    elements: str = ""  # name of the elements' material, where it is not the rings'

    @property
    def depth_rate(self) -> float:
        """Largest rate of depth on any pocket face [m/s]."""
        return float(self.dataset["depth_rate"].max())

    @property
    def volume_rate(self) -> float:
        """Volume worn from all pockets [m^3/s]."""
        return float(self.dataset["volume_rate"].sum())

    def depth(self, hours: float) -> xarray.DataArray:
        """Depth [m] of the deepest cell by pocket and face after ``hours`` of such operation.

        A groove of radius R and depth d that is ``h`` high at first has the cross-section
        h d + (4/3) sqrt(2 R) d^(3/2): a circular segment, as long as d is small beside R.
        """
        number = np.asarray(hours)
        if number.ndim or number.dtype.kind not in "iuf" or not 0.0 <= number < inf:
            raise wrong_type(hours, "a number that is at least 0, and finite", "hours")
        ds = self.dataset
        section = ds["cell_volume_rate"] / ds["cell_length"] * (hours * _HOUR)
        bend = 4.0 / 3.0 * np.sqrt(2.0 * ds["groove_radius"])
        root: Any = np.sqrt(section / ds["cell_height"])  # of the depth; Newton's method from above
        for _ in range(_ITERATIONS):
            over = ds["cell_height"] * root**2 + bend * root**3 - section
            slope = 2.0 * ds["cell_height"] * root + 3.0 * bend * root**2
            root = root - (over / slope).where(slope > 0.0, 0.0)
        depth: xarray.DataArray = (root**2).max("cell").assign_attrs(units="m")
        return depth

    def table(self, hours: float = 1.0) -> str:
        """An aligned table of the pocket faces that wear and of the land, with depths at first and
        after ``hours``, and what stands behind."""
        ds, after = self.dataset, self.depth(hours)
        lines: list[tuple[str, ...]] = [
            ("pocket", "face", "mm^3/h", "±", "um/h, first", f"um in {hours:g} h")
        ]
        known = True
        for k, face in ((k, f) for k in ds["pocket"].values for f in ds["face"].values):
            at = {"pocket": k, "face": face}
            if float(ds["volume_rate"].sel(at)) > 0.0:
                volume, margin, depth = (
                    float(ds[name].sel(at)) * _HOUR
                    for name in ("volume_rate", "margin", "depth_rate")
                )
                rate, half = texts_with_margin(volume * 1e9, margin * 1e9)
                known = known and isfinite(margin)
                depths = (f"{d * 1e6:.4g}" for d in (depth, float(after.sel(at))))
                lines.append((str(k), str(face), rate, half or "-", *depths))
        said = [] if known else [NO_INTERVAL]
        volume, depth = (float(ds[f"land_{what}_rate"]) * _HOUR for what in ("volume", "depth"))
        if isnan(volume):
            said.append("land: a film carries it, and Archard's law says nothing of its wear.")
        elif volume > 0.0:
            depths = (f"{d * 1e6:.4g}" for d in (depth, depth * hours))
            lines.append(("land", "", number_text(volume * 1e9), "", *depths))
        radius = ds["groove_radius"]  # none on flat ends
        if bool(((after > _SHALLOW * radius) & (radius > 0.0)).any()):
            said.append(
                f"depths beyond {_SHALLOW * float(radius.max()) * 1e6:.3g} um, a tenth of the "
                "element's radius, no cage has: take fewer hours, or a coefficient of the "
                "lubricated cage"
            )
        table = aligned(lines, sides="rlr", heads=True)
        return "\n".join([table, *map(wrapped, (*said, self.grounds()))])

    def grounds(self) -> str:
        """The coefficient with its source and what it assumes."""
        law = self.law
        words = [
            f"{law.material}: k = {law.coefficient * 1e9:.3g} mm^3/(N m) (Archard)",
            f"source: {law.source or 'the user'}",
            *of_other(law.material, self.cage),
            *self._against(),
        ]
        return "\n".join([*words, *([f"assumption: {law.assumption}"] if law.assumption else [])])

    def _against(self) -> list[str]:
        """A line on elements that are not of steel."""
        if not self.elements:
            return []
        return [f"the coefficient is against steel, and the elements are of {self.elements}"]

    __str__ = table


def wear(
    ds: xarray.Dataset, bearing: Bearing, cage: Cage, land: LandSpec, law: WearLaw, windows: Windows
) -> Wear:
    """Wear by the (settled) dataset of a run, which ``windows`` cut."""
    slot: Callable[[], Rub] | None = FAMILIES[bearing.family].rubbing
    if slot is None:
        raise InputError(
            f"Wear of pockets is not known for bearings of the family '{bearing.family}'; it needs "
            "a rubbing of its own.",
            where="bearing.type",
        )
    parts = [one_cage(ds, k) for k in range(cage_count(ds))]
    rubbing = joined([slot()(part, bearing, cage) for part in parts])
    t, recorded = ds["time"].values, ds["work"].sel(channel="pocket_friction").values
    lost, found = float(recorded[0] - recorded[-1]), float(np.trapezoid(rubbing.friction, t))
    lands = [land_rubbing(part, cage, land.on(bearing.land(cage))) for part in parts]
    slid = max(lands, key=lambda each: each[0])
    table = _tabled(rubbing, ds, law.coefficient, windows, slid)
    check = found / lost if lost and ONE_OF not in ds.attrs else float("nan")
    elements = bearing.rolling_material.name if bearing.is_hybrid else ""
    return Wear(law, float(t[-1] - t[0]), table, check, cage.material.name, elements)


def _tabled(
    rubbing: Rubbing, ds: xarray.Dataset, k: float, windows: Windows, land: tuple[float, float]
) -> xarray.Dataset:
    """The rates as a dataset, with the coefficient k [m^3/(N m)]."""
    import xarray as xr

    series = rubbing.power.reshape(len(rubbing.power), -1).T
    margins = np.reshape([windows.mean(one).margin for one in series], rubbing.power.shape[1:])
    area = np.where(rubbing.cells > 0.0, rubbing.length * rubbing.height, 0.0)
    depth = np.divide(rubbing.cells, area, out=np.zeros_like(area), where=area > 0.0)
    face, cell = ("pocket", "face"), ("pocket", "face", "cell")
    slid, land_area = land
    rows = {
        "volume_rate": (face, k * rubbing.power.mean(axis=0), "m^3/s", "worn volume by time"),
        "margin": (face, k * margins, "m^3/s", "half of the 95 % interval of volume_rate"),
        "depth_rate": (face, k * depth.max(axis=-1), "m/s", "worn depth by time, at first"),
        "track_area": (face, area.sum(axis=-1), "m^2", "area of the wear track"),
        "cell_volume_rate": (cell, k * rubbing.cells, "m^3/s", "worn volume by time"),
        "cell_length": (cell, rubbing.length, "m", "length of a cell of the track"),
        "cell_height": (cell, rubbing.height, "m", "height of the track at first"),
        "groove_radius": (("face",), rubbing.groove, "m", "radius that a groove takes"),
        "land_volume_rate": ((), k * slid, "m^3/s", "worn volume of the land by time"),
        "land_depth_rate": ((), k * slid / land_area, "m/s", "worn depth of the land by time"),
    }
    return xr.Dataset(
        {n: (d, v, {"units": unit, "long_name": words}) for n, (d, v, unit, words) in rows.items()},
        coords={"pocket": ds["pocket"].values, "face": ds["face"].values},
    )


def land_rubbing(ds: xarray.Dataset, cage: Cage, land: LandSpec) -> tuple[float, float]:
    """Mean of normal force times sliding speed on the land [W], NaN under a film, and its area
    [m^2], two lands of ``land``'s width all round. The force's part along the line of centres is
    taken as normal."""
    outer, radius = cage.land_ring == "outer", cage.land_radius
    assert land.width is not None
    area = 4.0 * pi * radius * land.width
    force = ds["land_force"].values[:, 1:]
    if not np.any(force):
        return 0.0, area
    if land.kind == "film":
        return float("nan"), area
    ring = "outer" if outer else "inner"
    eccentricity = (ds["cage_position"] - ds[f"{ring}_position"]).values[:, 1:]
    drift = (ds["cage_velocity"] - ds[f"{ring}_velocity"]).values[:, 1:]
    reach = np.linalg.norm(eccentricity, axis=1)
    line = eccentricity / np.where(reach > 0.0, reach, 1.0)[:, None]
    normal = np.abs((force * line).sum(axis=1))
    turning = ds["cage_omega"].sel(axis="x").values - (0.0 if outer else ds["inner_speed"].values)
    side = 1.0 if outer else -1.0  # the land touches ahead of the centre, or behind it
    across = drift[:, 1] * line[:, 0] - drift[:, 0] * line[:, 1]
    return float((normal * np.abs(side * radius * turning + across)).mean()), area
