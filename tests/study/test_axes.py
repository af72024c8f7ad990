"""Axes: which points they hold, and what they refuse."""

import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.core.units import parse
from flexcage.study.axes import Grid, LatinHypercube, Points, Sobol, Zip

BOX = {"drive.speed": ("1000 rpm", "9000 rpm"), "load.radial": ("200 N", "5 kN")}


def shares(axis, count):
    """Sampled points (count, 2) as shares of the box."""
    values = [p.values for p in axis.expand()]
    speed = [parse(v["drive.speed"], "rpm") * 30.0 / np.pi for v in values]
    load = [parse(v["load.radial"], "N") for v in values]
    assert len(values) == count
    return np.stack([(np.array(speed) - 1000) / 8000, (np.array(load) - 200) / 4800], axis=1)


def test_grid_and_zip():
    assert [p.values for p in Grid("a.b", ["1 mm", "2 mm"]).expand()] == [
        {"a.b": "1 mm"},
        {"a.b": "2 mm"},
    ]
    both = Zip({"a": ["1 N", "2 N"], "b": ["3 N", "4 N"]})
    assert [p.values for p in both.expand()] == [{"a": "1 N", "b": "3 N"}, {"a": "2 N", "b": "4 N"}]


def test_a_label_is_no_path():
    points = Points([{"label": "sound"}, {"label": "bent", "a": "1 mm"}], name="cage")
    assert points.paths == ("a",)
    assert [p.labels for p in points.expand()] == [{"cage": "sound"}, {"cage": "bent"}]


def test_latin_hypercube_hits_every_part_once():
    part = np.floor(shares(LatinHypercube(BOX, 10, seed=3), 10) * 10)
    assert np.array_equal(np.sort(part, axis=0).T, [np.arange(10)] * 2)


def test_sobol_is_balanced_in_every_elementary_box():
    part = np.floor(shares(Sobol(BOX, 16, seed=3), 16) * 4)
    assert len({tuple(p) for p in part}) == 16  # a (0, 4, 2)-net: one point in each of 4 x 4 boxes


def test_samples_follow_the_seed():
    first, again, other = (LatinHypercube(BOX, 4, seed=s).expand() for s in (1, 1, 2))
    assert first == again != other


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Grid("load.radial", []), "'load.radial' is empty"),
        (lambda: Grid("load.radial", "1 kN"), "should be a list"),
        (lambda: Zip({}), "is empty"),
        (lambda: Zip({"a": [1, 2], "b": [1]}), "2 for 'a', 1 for 'b'"),
        (lambda: Points([]), "is empty"),
        (lambda: Sobol(BOX, 12).expand(), "take 8 or 16"),
        (lambda: LatinHypercube({"a": ["2 mm", "1 mm"]}, 4), "from 2 mm to 1 mm"),
        (lambda: LatinHypercube({"a": ["1 mm", "1 N"]}, 4), "another kind"),
        (lambda: LatinHypercube({"a": ["1 mm"]}, 4), "should be two values"),
        (lambda: LatinHypercube({"a": ["PEEK", "PA66"]}, 4), "two numbers"),
    ],
)
def test_mistakes(make, words):
    with pytest.raises(InputError, match=words):
        make()
