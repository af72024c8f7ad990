"""The chapter's data files, beside the code in ``data``."""

from __future__ import annotations

from importlib import resources

import numpy as np

from flexcage.core.arrays import UNREADABLE, read_arrays
from flexcage.core.errors import EnvironmentLacks


def stored_arrays(name: str) -> dict[str, np.ndarray]:
    """All arrays of an .npz file in ``data``.

    Raises EnvironmentLacks where the file is missing or cannot be read.
    """
    source = resources.files("flexcage.verification") / "data" / name
    try:
        with source.open("rb") as stream:
            return read_arrays(stream)
    except FileNotFoundError as exc:
        raise _lacks(f"'{source}' is missing", name) from exc
    except (OSError, *UNREADABLE) as exc:
        raise _lacks(f"'{source}' cannot be read: it is cut short or damaged", name) from exc


def _lacks(trouble: str, name: str) -> EnvironmentLacks:
    return EnvironmentLacks(
        f"The reference data {trouble}. Reinstall flexcage, which brings '{name}' along."
    )
