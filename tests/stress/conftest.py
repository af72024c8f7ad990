"""Stress recoveries of the small cage of ``stress_cage``."""

from __future__ import annotations

import pytest
from stress_cage import DEFECTS, make_recovery

from flexcage.modes.spec import ModesSpec


@pytest.fixture(scope="session")
def recovery():
    return make_recovery((), ModesSpec())


@pytest.fixture(scope="session")
def damaged():
    return make_recovery(DEFECTS, ModesSpec(count=12))


@pytest.fixture(scope="session")
def free_only():
    return make_recovery((), ModesSpec(kind="free_free", count=6))
