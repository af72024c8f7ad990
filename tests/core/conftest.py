"""Processes that tests of this room share."""

import pytest
from warm_process import warm_process


@pytest.fixture(scope="module")
def warm():
    """A process that has loaded numba (``warm_process``)."""
    with warm_process() as process:
        yield process
