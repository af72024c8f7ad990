"""An unbalance off the middle of its cage."""

from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.bodies.floating_frame import with_point_mass
from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.system.bodies import unbalance_of


def test_an_offset_unbalance_makes_a_couple():
    """0.5 g mm at 90 deg, 4 mm off the middle: the product of inertia xz is U x, no other is."""
    cage = load_case({"bearing": {"preset": "7010C-PI"}, "cage": {
        "unbalance": "0.5 g*mm", "unbalance_phase": "90 deg", "unbalance_offset": "4 mm",
    }}).cage  # fmt: skip
    mass, where = unbalance_of(cage)
    data = SimpleNamespace(mass=0.0, c0=np.zeros(3), G0=np.zeros((3, 3)))
    data._replace = lambda **new: SimpleNamespace(**{**vars(data), **new})
    body = with_point_mass(SimpleNamespace(data=data), mass, where).data
    np.testing.assert_allclose(body.c0, [4e-3 * mass, 0.0, 0.5e-6], atol=1e-18)
    assert body.G0[0, 2] == pytest.approx(0.5e-6 * 4e-3)
    assert abs(body.G0[0, 1]) < 1e-20


def test_an_unbalance_beyond_the_cage_is_refused():
    with pytest.raises(InputError, match="unbalance_offset is 11 mm, but the cage ends 10 mm"):
        load_case({"bearing": {"preset": "7010C-PI"}, "cage": {"unbalance_offset": "11 mm"}})
