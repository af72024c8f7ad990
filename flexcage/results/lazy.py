"""Arrays of a run on disk, read when they are asked for, with a sentence where they are damaged."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

from flexcage.core.errors import RunFailed
from flexcage.results.layout import StoreLayout
from flexcage.results.registry import Variable
from flexcage.results.shards import decoded


@dataclass(frozen=True)
class Blocks:
    """The blocks of one variable on disk: ``read`` gives their chunks, ``refuse`` the error of one
    that cannot be read."""

    layout: StoreLayout
    variable: Variable
    read: Callable[[Sequence[int]], list[bytes | None]]
    refuse: Callable[[], Exception]

    def values(self, blocks: Sequence[int]) -> np.ndarray:
        """Whole blocks, one after the other (samples, ...), NaN where there are none."""
        shape, v = self.layout.chunk(self.variable), self.variable
        order, stored = self.layout.order(v), np.dtype(v.stored)
        found = np.full((len(blocks), *shape), np.nan, v.dtype)
        try:
            for into, chunk in zip(found, self.read(blocks)):
                if chunk is not None:
                    into[...] = decoded(chunk, shape, stored, order)
        except (OSError, MemoryError, RunFailed):
            raise
        except Exception as error:  # of whichever library unpacks it
            raise self.refuse() from error
        return found.reshape(-1, *shape[1:])


class _StoredArray(BackendArray):
    """The blocks of a variable as xarray indexes them."""

    def __init__(self, blocks: Blocks) -> None:
        self._blocks = blocks
        self.shape = blocks.layout.shape(blocks.variable)
        self.dtype = np.dtype(blocks.variable.dtype)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        support = indexing.IndexingSupport.OUTER
        return indexing.explicit_indexing_adapter(key, self.shape, support, self._read)

    def _read(self, key: tuple[Any, ...]) -> np.ndarray:
        """Values by a slice, a number or an array of numbers for each dimension."""
        if 0 in self.shape:
            return np.empty(self.shape, self.dtype)[key]
        length = self._blocks.layout.chunk(self._blocks.variable)[0]
        wanted = np.arange(self.shape[0])[key[0]]
        blocks = np.unique(wanted // length)
        values = self._blocks.values(blocks.tolist())
        rows: Any = np.searchsorted(blocks, wanted // length) * length + wanted % length
        if isinstance(key[0], slice) and key[0].step in (None, 1) and len(rows):
            rows = slice(rows[0], rows[-1] + 1)  # no copy
        for axis in range(len(self.shape) - 1, 0, -1):
            values = values[(slice(None),) * axis + (key[axis],)]
        return values[rows]


def lazy_variable(blocks: Blocks) -> xarray.Variable:
    """A variable that reads its blocks once, when its values are wanted."""
    data: Any = indexing.LazilyIndexedArray(_StoredArray(blocks))
    for kept in (indexing.CopyOnWriteArray, indexing.MemoryCachedArray):
        data = kept(data)
    return xarray.Variable(
        blocks.variable.dims, data, dict[str, Any](blocks.variable.attrs), fastpath=True
    )
