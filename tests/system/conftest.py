"""Bearings compiled for the tests of this room."""

from __future__ import annotations

import pytest

from flexcage.contacts.spec import Contacts


@pytest.fixture(scope="session")
def bearing_of(build_parts):
    """bearing_of(flexible={...}, contacts=..., constraints=..., ...) -> a Bearing of the N1013."""

    from bearing_runs import assembled  # of rollers, which tests of balls can do without
    from flexible_parts import flexible_cage

    def make(*, contacts=None, flexible=None, constraints=(), **specs):
        contacts = contacts or Contacts()
        if flexible is not None:
            specs["body"], specs["interface"] = flexible_cage(**flexible)
        return assembled(build_parts(contacts=contacts, **specs), contacts, constraints)

    return make
