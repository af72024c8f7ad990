"""A spall names its row in bearings of two: elements of the other row do not feel it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from moving_rows import B1205, B3205, MM, NN3010, moving, reported

from flexcage.bearings.two_rows import single
from flexcage.core.errors import InputError
from flexcage.geometry.spall import Spall


@pytest.mark.parametrize("bearing", [B3205, B1205, NN3010], ids=lambda b: b.type)
@pytest.mark.parametrize("row", [0, 1])
@pytest.mark.parametrize("ring", [0, 1])
def test_a_spall_is_of_its_row_alone(bearing, row, ring):
    """Where the most loaded element of a row is over its middle, that one alone bears less."""
    load = {"radial": 2e3}
    _, sound, start = moving(bearing, **load)
    force = reported(sound, start.y).race[:, ring, 0].copy()
    own = np.arange(bearing.total_elements) // bearing.element_count == row
    over = int(np.argmax(np.where(own, force, 0.0)))
    azimuth = float(sound.layout.q(start.y)["elements"][over, 2])
    spall = Spall(length=1.5 * MM, azimuth=azimuth, row=row)
    pitted = replace(bearing, **{("inner_spall", "outer_spall")[ring]: spall})
    _, system, _ = moving(pitted, **load)
    found = reported(system, start.y).race[:, ring, 0]
    others = np.arange(len(force)) != over
    assert force[over] > 100.0 and found[over] < 0.2 * force[over]
    np.testing.assert_array_equal(found[others], force[others])
    assert f"spall{' in row 1' if row else ''} of 1.5 mm" in pitted.in_words()


def test_a_row_that_is_not_there_is_refused():
    for bearing, row, words in (
        (NN3010, 2, r"bearing.outer_spall.row is 2, but rows are 0, at -x, and 1, at \+x"),
        (B3205, 3, "bearing.outer_spall.row is 3, but rows are"),
        (NN3010.row, 1, "bearing.outer_spall.row is 1, but this bearing has one row"),
        (B3205.row, 1, "bearing.outer_spall.row is 1, but this bearing has one row"),
    ):
        with pytest.raises(InputError, match=words):
            replace(bearing, outer_spall=Spall(length=1 * MM, row=row)).check(None)
    both = replace(NN3010, outer_spall=Spall(length=1 * MM, row=1))
    both.check(None)
    assert single(both, type(NN3010.row)).outer_spall.row == 0
