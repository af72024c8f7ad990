"""Families of bearings: what a user forgets is said in one sentence."""

from dataclasses import dataclass, replace
from typing import ClassVar

import pytest

from flexcage.bearings import family_of, motion_of, recording_of, statics_of
from flexcage.bearings.ball import FAMILY as BALLS
from flexcage.bearings.ball.deep_groove import DeepGrooveBallBearing
from flexcage.bearings.family import register_family
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.core.wings import FAMILIES


@dataclass(frozen=True, kw_only=True)
class OwnBearing(DeepGrooveBallBearing):
    kind: ClassVar[str] = "own bearing"
    family: ClassVar[str] = "own"


@pytest.fixture
def bearing():
    return OwnBearing(**vars(load_preset("15x37x10").bearing))


def test_a_spec_names_a_family_that_is_not_registered(bearing):
    with pytest.raises(InputError, match="Own bearings are of the family 'own', which is not reg"):
        family_of(bearing)


def test_a_family_without_a_part_says_which(bearing, monkeypatch):
    bare = replace(BALLS, name="own", types=(), statics=None, motion=None, recording=None)
    monkeypatch.setitem(FAMILIES._all(), "own", bare)
    with pytest.raises(InputError, match="'deep_groove_ball' has no equations of motion"):
        motion_of(bearing)
    with pytest.raises(InputError, match="has no static solution"):
        statics_of(bearing)
    with pytest.raises(InputError, match="has no record of a run"):
        recording_of(bearing)


def test_names_are_taken_once():
    with pytest.raises(InputError, match="A bearing type 'angular_contact_ball' exists already"):
        register_family(replace(BALLS, name="other"))
    with pytest.raises(InputError, match="A bearing family 'ball' exists already"):
        register_family(replace(BALLS, types=()))
