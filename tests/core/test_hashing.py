"""Content hashes name meaning: units and last digits do not count, every value does."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from flexcage.core.hashing import canonical_json, content_hash


@dataclass(frozen=True)
class Inner:
    size: float = 2e-4
    name: str = "x"


@dataclass(frozen=True)
class Outer:
    inner: Inner = Inner()
    items: tuple = (1, 2.5)
    nothing: object = None


def test_last_digits_do_not_count():
    assert 0.2 * 1e-3 != 200 * 1e-6
    assert content_hash(Inner(0.2 * 1e-3)) == content_hash(Inner(200 * 1e-6))


def test_whole_numbers_are_the_same_as_floats():
    assert content_hash(Outer(items=(1, 2.5))) == content_hash(Outer(items=[1.0, 2.5]))
    assert content_hash(-0.0) == content_hash(0)


@pytest.mark.parametrize(
    "other",
    [
        Outer(inner=Inner(size=2.0000001e-4)),
        Outer(inner=Inner(name="y")),
        Outer(items=(2.5, 1)),
        Outer(items=(1,)),
        Outer(items=(True, 2.5)),
        Outer(nothing=0),
        Outer(nothing="None"),
        Outer(nothing=float("inf")),
        replace(Outer(), inner=None),
    ],
)
def test_every_value_counts(other):
    assert content_hash(other) != content_hash(Outer())


def test_types_and_extras_count():
    @dataclass(frozen=True)
    class Other:
        size: float = 2e-4
        name: str = "x"

    assert content_hash(Inner()) != content_hash(Other())
    assert content_hash(Inner(), "v1") != content_hash(Inner(), "v2") != content_hash(Inner())


def test_arrays_count_by_shape_type_and_content():
    a = np.arange(6.0)
    others = (a, a.reshape(2, 3), a.astype("f4"), a[::-1], a.tolist())
    assert len({content_hash(x) for x in others}) == len(others)
    assert content_hash(a[::2]) == content_hash(a[::2].copy())


def test_order_of_a_mapping_does_not_count():
    assert canonical_json({"a": 1, "b": 2}) == canonical_json({"b": 2, "a": 1})


def test_what_has_no_canonical_form_is_refused():
    with pytest.raises(TypeError, match="object"):
        content_hash(object())
