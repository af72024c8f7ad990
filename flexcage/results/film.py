"""The lubricant's film in a run: from recorded forces, and from the motion that entrains it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.geometry.film import Oil

if TYPE_CHECKING:
    import xarray

_RACES = ("inner", "outer")


@dataclass(frozen=True)
class _Motion:
    """Elements' motion, all (time, element) or (time, element, 2) for both races."""

    force: np.ndarray  # N
    angle: np.ndarray  # contact angle, rad
    radius: np.ndarray  # of their centres about the bearing's axis, m
    orbit: np.ndarray  # rad/s
    spin: np.ndarray  # (time, element, 2) about x and e_r in space, rad/s


def _motion(ds: xarray.Dataset) -> _Motion:
    def of(name: str) -> np.ndarray:
        return np.asarray(ds[name].transpose("time", "element", ...).values)

    radius = of("element_position")[..., 1]
    force = of("race_force")
    return _Motion(
        force=force,
        angle=of("contact_angle") if "contact_angle" in ds else np.zeros_like(force),
        radius=radius,
        orbit=of("element_velocity")[..., 2] / radius,
        spin=of("element_omega")[..., :2],
    )


def entrainment_speed(ds: xarray.Dataset, bearing: Bearing) -> np.ndarray:
    """Mean speed (time, element, race) [m/s] of both surfaces past their contact, along the race.

    It goes round with the element: the rings' surfaces pass with their speed less its orbit's.
    """
    return _entrained(_motion(ds), ds, bearing)


def _entrained(m: _Motion, ds: xarray.Dataset, bearing: Bearing) -> np.ndarray:
    size = 0.5 * bearing.element_diameter
    ring = np.stack([ds["inner_speed"].values, np.zeros(ds.sizes["time"])], axis=1)[:, None, :]
    side = np.array([-1.0, 1.0])
    reach = m.radius[..., None] + side * size * np.cos(m.angle)
    passing = (ring - m.orbit[..., None]) * reach
    about_axis = (m.spin[..., :1] - m.orbit[..., None]) * np.cos(m.angle)
    own = side * size * (about_axis - m.spin[..., 1:] * np.sin(m.angle))
    return np.asarray(0.5 * np.abs(passing + own))


def film_thickness(ds: xarray.Dataset, bearing: Bearing, oil: Oil) -> xarray.DataArray:
    """Film thickness (time, element, race, film) [m], "central" and "least", of a run's dataset.

    Isothermal and fully flooded; NaN where an element does not touch (``geometry.film``).
    """
    import xarray as xr

    motion = _motion(ds)
    film = bearing.race_film(motion.force, _entrained(motion, ds, bearing), oil)
    return xr.DataArray(
        np.stack([film.central, film.least], axis=-1),
        dims=("time", "element", "race", "film"),
        coords={
            "time": ds["time"], "element": ds["element"], "race": list(_RACES),
            "film": ["central", "least"],
        },
        attrs={"units": "m", "long_name": "thickness of the lubricant's film"},
        name="film_thickness",
    )  # fmt: skip
