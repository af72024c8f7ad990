"""Bodies in Nastran OUTPUT4 files (.op4), ASCII or binary, through pyYeti.

A matrix file has no nodes: Nastran's own need the GRID entries beside them (``nodes``). Those that
flexcage writes have nodes, dofs and shapes as further matrices.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.contents import (
    Contents,
    from_matrices,
    kind_codes,
    refuse_twice,
    to_matrices,
    unreadable,
)
from flexcage.modes.exchange.nastran import nastran

_DIGITS = 16  # after the first, of a number as text


def read(path: Path, *, where: str) -> Contents:
    """The matrices of the file, whatever their format."""
    module = _module()
    try:
        names, matrices, *_ = module.load(str(path), into="list", sparse=None)
    except Exception as error:  # of all kinds on broken files
        raise unreadable(path, error, where=where) from error
    refuse_twice(names, path, where=where)
    return from_matrices(dict(zip(names, matrices)), path, where=where)


def write(body: ReducedBody, path: Path, *, binary: bool = True) -> None:
    """Write a body's matrices in double precision; as text if not ``binary``."""
    found = to_matrices(body)
    if body.kind:
        found["KIND"] = kind_codes(body.kind)
    plain = {n: v if hasattr(v, "tocsr") else _two(v) for n, v in found.items()}
    _module().write(str(path), plain, binary=binary, digits=_DIGITS)


def _two(values: Any) -> np.ndarray:
    array = np.asarray(values, float)
    return array if array.ndim == 2 else array.reshape(-1, 1)


def _module() -> Any:
    return nastran("op4")
