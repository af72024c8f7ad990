"""What pictures, summaries and messages say of ribs, by design."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray
from bearing_runs import BETWEEN_RIBS, NUP, rolling_start
from roller_designs import DESIGNS, GAP, INNER, NJ, OUTER, N

from flexcage.bearings.cylindrical_roller.figures import FORCES
from flexcage.bearings.cylindrical_roller.recording import overlaps
from flexcage.render.shapes import shapes_of
from flexcage.results.statistics import Windows

RACES = {"inner": 0.5 * N.inner_race_diameter, "outer": 0.5 * N.outer_race_diameter}
RIBS = {"inner": 0.5 * INNER, "outer": 0.5 * OUTER}


@pytest.mark.parametrize(
    ("name", "ribbed"),
    [("N", {"inner"}), ("NU", {"outer"}), ("NJ", {"inner", "outer"}),
     ("NUP", {"inner", "outer"}), ("NF", {"inner"})],
)  # fmt: skip
def test_pictures_show_the_ribs_of_the_half_that_is_drawn(name, ribbed):
    """That with x < 0: the single rib of an NJ stands there, that of an NF does not."""
    shapes = shapes_of(DESIGNS[name])
    for ring in ("inner", "outer"):
        profile = getattr(shapes, ring)
        x, r = np.array(profile).T
        area = 0.5 * (x * np.roll(r, -1) - np.roll(x, -1) * r).sum()
        wide = abs(RACES[ring] - (0.5 * N.bore if ring == "inner" else 0.5 * N.outside_diameter))
        rib = abs(RIBS[ring] - RACES[ring]) * (0.5 * N.width - 0.5 * GAP)
        assert area == pytest.approx(0.5 * N.width * wide + rib * (ring in ribbed), rel=1e-9)
        assert (-0.5 * GAP, RIBS[ring]) in profile or ring not in ribbed


def test_the_other_half_is_drawn_without_the_rib_that_stands_there_not():
    shapes = shapes_of(replace(NJ, thrust="-x"))
    assert max(r for _, r in shapes.inner) == RACES["inner"]


def test_places_and_depths_go_by_the_ring_that_guides(bearing_of):
    """Ribs of the guiding ring come first; a rib that is not there is met nowhere."""
    plain = bearing_of()
    assert plain.places[6:8] == ("rib +x", "rib -x") and len(plain.places) == 10
    bearing = bearing_of(bearing={**NUP, "design": "NJ"}, load=BETWEEN_RIBS)
    assert bearing.places[6:10] == ("rib +x", "rib -x", "counter rib +x", "counter rib -x")
    y, _ = rolling_start(bearing)
    q = bearing.layout.q(y)
    q["inner"][0], q["elements"][:, 0] = 25e-6, 18e-6
    depth = overlaps(bearing.data.model, bearing.layout, y[None])[0, 0, 6:]
    play = 0.5 * (GAP - N.roller_length)
    assert depth == pytest.approx([18e-6 - play, -18e-6 - play, -np.inf, 7e-6 - play])


def test_figures_of_counter_ribs():
    """Ten rollers that ribs at -x press by 20 N, one by 30 N, one by its rib at +x by 5 N."""
    force = np.zeros((50, 12, 2))
    force[:, :10, 1], force[:, 10, 1], force[:, 11, 0] = 20.0, 30.0, 5.0
    dims = ("time", "element", "rib")
    time = np.arange(50) * 1e-4
    ds = xarray.Dataset({"counter_rib_force": (dims, force)}, coords={"time": time})
    windows = Windows(50, np.array([0, 25]))

    def part_of(ds):
        return SimpleNamespace(ds=ds, windows=windows)

    axial, peak = FORCES.rows(part_of(ds))
    assert axial.value == pytest.approx(225.0) and peak.value == 30.0 and not axial.idle
    axial, peak = FORCES.rows(part_of(0.0 * ds))
    assert axial.idle and peak.idle
    assert FORCES.rows(part_of(ds.drop_vars("counter_rib_force"))) == ()


def test_words_name_the_ring_whose_ribs_guide_a_cage():
    words = {name: bearing.guides for name, bearing in DESIGNS.items()}
    assert words["N"] == {"inner": "the inner ring's ribs", "outer": "the outer ring"}
    assert words["NU"] == {"inner": "the inner ring", "outer": "the outer ring's ribs"}
    assert words["NJ"]["inner"] == "the inner ring's rib"
