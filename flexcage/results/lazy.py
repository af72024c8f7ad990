"""Arrays of a run on disk, read when they are asked for, with a sentence where they are damaged."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing


class _StoredArray(BackendArray):
    """A Zarr array as xarray indexes it; ``refuse`` gives the error of one that cannot be read."""

    def __init__(self, array: Any, refuse: Callable[[], Exception]) -> None:
        self._array, self._refuse = array, refuse
        self.shape, self.dtype = array.shape, array.dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        support = indexing.IndexingSupport.OUTER
        return indexing.explicit_indexing_adapter(key, self.shape, support, self._read)

    def _read(self, key: tuple[Any, ...]) -> np.ndarray:
        try:
            return self._array.oindex[key]
        except (OSError, MemoryError):
            raise
        except Exception as error:  # of whichever library unpacks it
            raise self._refuse() from error


def lazy_variable(array: Any, refuse: Callable[[], Exception]) -> xarray.Variable:
    """A Zarr array as a variable that reads it once, when its values are wanted."""
    data: Any = indexing.LazilyIndexedArray(_StoredArray(array, refuse))
    for kept in (indexing.CopyOnWriteArray, indexing.MemoryCachedArray):
        data = kept(data)
    return xarray.Variable(array.metadata.dimension_names, data, dict(array.attrs), fastpath=True)
