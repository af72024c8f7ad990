"""Runs in which each row of elements has a cage: one of these alone, as a run of a single row."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results.registry import CAGES

if TYPE_CHECKING:
    import xarray


ONE_OF = "one_of_cages"  # attribute of a part: so many cages the run has, whose works are summed


def cage_count(ds: xarray.Dataset) -> int:
    """So many cages of a run are told apart: 1, also without any, or one for each row."""
    return int(ds.sizes.get(CAGES, 1))


def check_cage(ds: xarray.Dataset, k: int) -> None:
    """Raise InputError for a cage that a run does not have."""
    if not 0 <= k < cage_count(ds):
        raise InputError(
            f"There is no cage {k}; the run's bearing has {cage_count(ds)}, counted from 0 at -x.",
            where="cage", value=k,
        )  # fmt: skip


def one_cage(ds: xarray.Dataset, k: int) -> xarray.Dataset:
    """The run with cage k and the elements in it alone; elements and pockets count from 0. A run of
    one cage is returned as it is. Energies, works and rings are the whole bearing's."""
    check_cage(ds, k)
    if CAGES not in ds.dims:
        return ds
    own = own_elements(ds, k)
    part = ds.isel({CAGES: k, "element": own, "pocket": own}).drop_vars(CAGES, errors="ignore")
    numbers = np.arange(part.sizes["element"])
    part = part.assign_coords(element=numbers, pocket=numbers)
    return part.assign_attrs({ONE_OF: cage_count(ds)})


def own_elements(ds: xarray.Dataset, k: int) -> slice:
    """Which elements of a run are in cage k."""
    count = ds.sizes["element"] // cage_count(ds)
    return slice(k * count, (k + 1) * count)


def own_events(events: xarray.Dataset | None, ds: xarray.Dataset, k: int) -> xarray.Dataset | None:
    """Those of a run's events that are of cage k or of elements in it, as ``one_cage`` counts."""
    if events is None or CAGES not in ds.dims:
        return events
    own = own_elements(ds, k)
    number, place = events["element"].values, events["place"].values.astype(str)
    second = np.char.endswith(place, ", second cage")
    land = (number < 0) & (second == (k > 0))
    part = events.isel(event=np.flatnonzero(land | ((number >= own.start) & (number < own.stop))))
    element = part["element"]
    return part.assign(element=element.where(element < 0, element - own.start))
