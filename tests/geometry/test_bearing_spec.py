"""What a bearing's spec says of itself, and what it says where it defines nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from flexcage.bearings.cylindrical_roller import FAMILY
from flexcage.case import load_case
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.film import Oil


@pytest.mark.parametrize(
    "name", ["check", "equivalent_load", "contact_patch", "static_rating", "dynamic_rating"]
)
def test_what_a_type_lacks_names_itself(name):
    values = {"equivalent_load": (1.0, 0.0), "contact_patch": (1.0, 1e9, 0)}.get(name, ())
    with pytest.raises(NotImplementedError, match=f"Bearing does not define {name}"):
        getattr(Bearing(), name)(*values)


def test_plain_answers_of_a_type_that_does_not_say():
    plain, two = Bearing(), np.ones((3, 2))
    film = plain.race_film(two, two, Oil(0.01, 2e-8))
    unknown = (film.central, film.least, plain.rolling_entrainment(two, two[:, 0], 1.0))
    assert all(values.shape == (3, 2) and np.isnan(values).all() for values in unknown)
    assert plain.greatest_tilt == plain.greatest_shift == np.inf
    assert (plain.beyond_edges(two, two) == -np.inf).all()


def test_an_ellipse_reaches_a_groove_s_edge_from_its_contact_angle():
    """Half of it, over the groove's radius, is added to the angle of its middle."""
    bearing = load_preset("7010C-PI").bearing
    beyond = bearing.beyond_edges(np.array([[200.0, 250.0]]), np.array([[0.3, -0.2]]))
    radii = (bearing.inner_groove_radius, bearing.outer_groove_radius)
    for k, (force, angle) in enumerate(((200.0, 0.3), (250.0, 0.2))):
        half = bearing.contacts[k].semi_axes(force)[0] / radii[k]
        assert beyond[0, k] == pytest.approx(angle + half - bearing.groove_edges[k])


def test_a_family_says_what_there_is_instead_of_a_design(monkeypatch):
    """A user's family does as well as the cylindrical rollers'."""
    told = {r"taper.*": "tapered rollers are without a picture"}
    own = replace(FAMILY, name="own", types=(), other_designs=told)
    monkeypatch.setitem(FAMILIES._all(), own.name, own)
    for name, words in (("tapered", "without a picture"), ("nj 205", "give bearing.design")):
        for case in ({"preset": name}, {"type": name}):
            with pytest.raises(InputError, match=words):
                load_case({"bearing": case})
