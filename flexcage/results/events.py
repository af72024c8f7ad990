"""Contacts that closed or opened during a run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray


def contact_events(table: dict[str, np.ndarray], attrs: Mapping[str, Any]) -> xarray.Dataset:
    """Contacts that closed or opened, from a store's table and attributes, one entry an event."""
    import xarray

    names, element = np.array(attrs["places"]), str(attrs["element"])
    return xarray.Dataset(
        {
            "time": ("event", table["time"], {"units": "s", "long_name": "step that found it"}),
            "element": (
                "event", table["element"], {"long_name": f"{element}; -1: the cage's land"},
            ),
            "place": ("event", names[table["place"]], {"long_name": "contact place"}),
            "closed": ("event", table["closed"].astype(bool), {"long_name": "closed, not opened"}),
        }
    )  # fmt: skip
