"""How strongly each unknown of a design moves an output.

SALib computes the indices: Morris' mean absolute elementary effect, Sobol's total index, and, from
a plain sample, Sobol's first-order index by random balance designs (RBD-FAST). An unknown matters
where its index exceeds the dummy's, which is what starts and a finite sample make of nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.study.unknowns import LEVELS, problem, require_salib

#: What SALib's index of each design is called.
KINDS = {"morris": "mu*", "saltelli": "total index", "sample": "first-order index"}
FEWEST = 16  # points of a plain sample, below which no index is computed
_WAVES, _EACH = 10, 8  # harmonics of a plain sample's analysis, and points that each one wants


@dataclass(frozen=True)
class Index:
    """How strongly an unknown moves an output: its index and half of the index's 95 % interval;
    ``matters`` says that it exceeds the dummy's beyond both."""

    name: str
    value: float
    margin: float
    matters: bool


def indices(
    design: str, shares: np.ndarray, names: Sequence[str], values: np.ndarray, *, seed: int = 1
) -> list[Index]:
    """Index of every column of a design, the dummy's last, for an output (points,).

    Trajectories or base points of which a value is missing are left out. Raises InputError where
    too few remain, and EnvironmentLacks without SALib.
    """
    require_salib()
    values = np.asarray(values, float)
    block = {"morris": len(names) + 1, "saltelli": len(names) + 2}.get(design, 1)
    whole = np.isfinite(values).reshape(-1, block).all(axis=1)
    kept = np.repeat(whole, block)
    fewest = FEWEST if block == 1 else 2
    if whole.sum() < fewest:
        raise InputError(
            f"{int(whole.sum())} of {len(whole)} parts of the design are complete, but an index "
            f"wants {fewest} or more.",
            where="outputs",
        )
    found = np.column_stack(_analysed(design, shares[kept], values[kept], seed))
    least, floor = found[-1]
    return [
        Index(name, float(v), float(m), bool(v - m > least + floor and k < len(names) - 1))
        for k, (name, (v, m)) in enumerate(zip(names, found))
    ]


def _analysed(
    design: str, shares: np.ndarray, values: np.ndarray, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Index and margin of every column."""
    columns = shares.shape[1]
    if not np.ptp(values) > 0.0:
        return np.zeros(columns), np.zeros(columns)
    inputs: dict[str, Any] = problem(columns)
    if design == "morris":
        from SALib.analyze import morris

        result = morris.analyze(inputs, shares, values, num_levels=LEVELS, seed=seed)
        return np.asarray(result["mu_star"]), np.asarray(result["mu_star_conf"])
    if design == "saltelli":
        from SALib.analyze import sobol

        result = sobol.analyze(inputs, values, calc_second_order=False, seed=seed)
        return np.asarray(result["ST"]), np.asarray(result["ST_conf"])
    from SALib.analyze import rbd_fast

    waves = min(_WAVES, len(values) // _EACH)
    result = rbd_fast.analyze(inputs, shares, values, M=waves, seed=seed)
    return np.asarray(result["S1"]), np.asarray(result["S1_conf"])
