"""Unknowns, designs and sensitivity: known indices, ranges, and what is refused."""

import numpy as np
import pytest

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.study import sensitivity, unknowns
from flexcage.study.unknowns import Unknown, check_unknowns, design_of

FRICTION = Unknown(
    name="friction", reason="a test", paths={"a.static": 1.0, "a.speed": 10.0},
    range=("1 mm/s", "100 mm/s"), scale="log",
)  # fmt: skip
SHAPE = Unknown(
    name="shape", reason="a test", choices=({"label": "round", "c": 1}, {"label": "flat", "c": 2})
)


def test_values_along_a_range_and_among_choices():
    assert FRICTION.changes(0.0) == ("1 mm/s", {"a.static": "1 mm/s", "a.speed": "10 mm/s"})
    assert FRICTION.changes(0.5)[0] == "10 mm/s"
    assert FRICTION.changes(1.0)[1]["a.speed"] in ("1000 mm/s", "1 m/s")
    assert SHAPE.changes(0.49) == ("round", {"c": 1}) and SHAPE.changes(1.0)[0] == "flat"
    plain = Unknown(name="x", reason="r", paths={"p": 1.0}, range=(1.0, 3.0))
    assert plain.changes(0.25) == (1.5, {"p": 1.5})


def test_choices_may_have_weights():
    """A choice of weight two is what two equal ones were, and says its share."""
    gravity = Unknown(
        name="gravity", reason="a test",
        choices=({"label": "across", "weight": 2, "g": 9.8}, {"label": "none", "g": 0.0}),
    )  # fmt: skip
    assert [gravity.changes(x)[0] for x in (0.0, 0.66, 0.67, 1.0)] == ["across"] * 2 + ["none"] * 2
    assert gravity.changes(0.5)[1] == {"g": 9.8} and gravity.all_paths == ("g",)
    assert gravity.in_words() == "across (67 %), none (33 %)"
    assert SHAPE.in_words() == "round, flat"


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (
            lambda: Unknown(name="x", reason="r", choices=({"label": "a", "weight": 0, "p": 1},)),
            "numbers above zero",
        ),
        (lambda: Unknown(name="x", reason="r"), "either paths and a range, or choices"),
        (lambda: Unknown(name="x", reason=" ", paths={"p": 1.0}, range=(0, 1)), "no reason"),
        (lambda: Unknown(name="x", reason="r", choices=({"p": 1},)), "no label"),
        (
            lambda: Unknown(name="x", reason="r", paths={"p": 1.0}, range=(0, 1), scale="log"),
            "begins above zero",
        ),
        (lambda: check_unknowns([]), "no unknowns"),
        (lambda: check_unknowns([SHAPE, SHAPE]), "Two unknowns are called 'shape'"),
        (
            lambda: check_unknowns([
                SHAPE, Unknown(name="y", reason="r", paths={"c": 1.0}, range=(0, 1))
            ]),
            "both change 'c'",
        ),
        (lambda: design_of("sample", 12, 3, 1), "take 8 or 16"),
        (lambda: design_of("grid", 8, 3, 1), "one of sample, morris, saltelli"),
    ],
)  # fmt: skip
def test_what_is_refused(make, words):
    with pytest.raises(InputError, match=words):
        make()


def test_a_larger_sample_begins_with_the_smaller_one():
    small, large = (design_of("sample", n, 5, 7) for n in (8, 32))
    np.testing.assert_array_equal(large[:8], small)
    assert (small >= 0.0).all() and (small < 1.0).all()


def test_without_salib_one_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(EnvironmentLacks, match=r"not installed here; .*'\.\[sensitivity\]'"):
        design_of("morris", 4, 3, 1)
    with pytest.raises(EnvironmentLacks, match="SALib"):
        sensitivity.indices("sample", np.zeros((16, 2)), "ab", np.zeros(16))


def ishigami(u):
    """I. Homma and A. Saltelli's test function, a = 7, b = 0.1, of the first three columns."""
    x = np.pi * (2.0 * u - 1.0)
    return np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def test_total_indices_of_a_function_with_known_ones():
    """0.5576, 0.4424 and 0.2437 (Saltelli and others, Global Sensitivity Analysis, 2008)."""
    pytest.importorskip("SALib")
    u = design_of("saltelli", 1024, 4, 3)
    assert u.shape == (1024 * 6, 4)
    found = sensitivity.indices("saltelli", u, ["x1", "x2", "x3", "(start)"], ishigami(u))
    values = [index.value for index in found]
    np.testing.assert_allclose(values, [0.5576, 0.4424, 0.2437, 0.0], atol=0.03)
    assert [index.matters for index in found] == [True, True, True, False]


def test_morris_and_a_plain_sample_see_what_moves_an_output_above_noise():
    pytest.importorskip("SALib")
    rng = np.random.default_rng(1)
    for kind, count in (("morris", 20), ("sample", 256)):
        u = design_of(kind, count, 4, 3)
        y = 3.0 * u[:, 0] + 0.3 * rng.standard_normal(len(u))
        found = sensitivity.indices(kind, u, ["a", "b", "c", "(start)"], y)
        assert [index.matters for index in found] == [True, False, False, False], kind
        y[rng.integers(len(y), size=3)] = np.nan  # runs that failed
        assert sensitivity.indices(kind, u, ["a", "b", "c", "(start)"], y)[0].matters
    with pytest.raises(InputError, match="wants 16 or more"):
        sensitivity.indices("sample", u[:8], ["a", "b", "c", "(start)"], y[:8])
    assert not any(i.value for i in sensitivity.indices("sample", u, "abcd", np.ones(len(u))))


def test_the_dummy_changes_nothing():
    assert unknowns.DUMMY not in {path for u in (FRICTION, SHAPE) for path in u.all_paths}
