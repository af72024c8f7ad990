"""Result variables that were registered from outside, computed from those of the program."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from flexcage.core.errors import FlexcageError, InputError, RunFailed, mistake_in
from flexcage.results.registry import COMPUTED, VARIABLES
from flexcage.results.store import MemoryRunStore
from flexcage.system.problem import BearingSystem

Computed = dict[str, Callable[..., np.ndarray]]


def computed_in(store: MemoryRunStore) -> Computed:
    """Functions of the store's variables that the program does not record itself."""
    held = [v.name for v in store.layout.variables]
    unknown = [name for name in held if name not in VARIABLES]
    if unknown:
        raise InputError(
            f"The run holds the result variable '{unknown[0]}', which nothing computes here; "
            "register it again, from the module that did so when the run began.",
            where=unknown[0],
        )
    return {name: COMPUTED[name] for name in held if name in COMPUTED}


def registered(
    computed: Computed, arrays: dict[str, np.ndarray], bearing: BearingSystem, store: MemoryRunStore
) -> dict[str, np.ndarray]:
    """Registered variables of a block by name, from the block's others."""
    samples = len(arrays["inner_angle"])
    added: dict[str, np.ndarray] = {}
    for name, compute in computed.items():
        variable = next(v for v in store.layout.variables if v.name == name)
        wanted = (samples, *store.layout.shape(variable)[1:])
        try:
            value = np.asarray(compute(dict(arrays), bearing))
        except FlexcageError:
            raise
        except Exception as exc:
            raise RunFailed(
                f"the registered variable '{name}' could not be computed: "
                f"{mistake_in(compute, exc)}"
            ) from exc
        if value.shape != wanted:
            raise InputError(
                f"Result variable '{name}' was computed with shape {value.shape}, but has "
                f"dimensions {variable.dims} and needs {wanted}.",
                where=name,
            )
        added[name] = value
    return added
