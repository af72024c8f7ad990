"""Tables to specs and back, by field metadata alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from flexcage.core.binding import Binder, check_spec, set_path, to_table, with_their_choice
from flexcage.core.errors import InputError
from flexcage.core.spec import option, quantity


@dataclass(frozen=True, kw_only=True)
class Stuff:
    name: str = option(doc="name")
    density: float = quantity("g/cm^3", above=0.0)


PARTS: dict[str, type] = {}


@dataclass(frozen=True, kw_only=True)
class Part:
    type: str = option(doc="kind of part", choices=PARTS)


@dataclass(frozen=True, kw_only=True)
class Ball(Part):
    type: str = option("ball", doc="kind of part", choices=PARTS)
    radius: float = quantity("mm", above=0.0)


@dataclass(frozen=True, kw_only=True)
class FlatBox(Part):
    type: str = option("flat_box", doc="kind of part", choices=PARTS)
    side: float = quantity("mm", above=0.0)


PARTS.update(ball=Ball, flat_box=FlatBox)


@dataclass(frozen=True, kw_only=True)
class Law:
    kind: str = option("soft", choices=("soft", "hard"))
    factor: float = option(1.0, minimum=0.5, maximum=2.0)


@dataclass(frozen=True, kw_only=True)
class Thing:
    length: float = quantity("mm", doc="the length", above=0.0)
    count: int = option(3, minimum=1)
    on: bool = option(True)
    limit: float | None = quantity("MPa", None)
    stuff: Stuff = option(Stuff(name="iron", density=7870.0))
    law: Law = option(Law(factor=1.5))
    parts: tuple[Part, ...] = option(())
    times: tuple[float, ...] = quantity("ms", ())
    pair: tuple[int, int] = option((1, 2))


NAMED = {Stuff: {"iron": Stuff(name="iron", density=7870.0)}}
BINDER = Binder(named=NAMED)
TABLE = {
    "length": "2 cm",
    "limit": "5 MPa",
    "law": {"kind": "hard"},
    "stuff": {"name": "iron", "density": "7.5 g/cm^3"},
    "parts": [{"type": "ball", "radius": "1 mm"}, {"type": "flat_box", "side": "2 mm"}],
    "times": ["0 s", "1 ms"],
    "pair": [3, 4],
}


def test_a_table_becomes_a_spec():
    thing = BINDER.bind(Thing, TABLE, "thing")
    assert thing.length == 0.02 and thing.limit == 5e6 and thing.times == (0.0, 1e-3)
    assert thing.parts == (Ball(radius=1e-3), FlatBox(side=2e-3))
    assert thing.stuff == Stuff(name="iron", density=7500.0)
    assert thing.pair == (3, 4)


def test_what_a_table_leaves_out_comes_from_its_own_place():
    """Law alone would default to a factor of 1; in Thing the default is 1.5."""
    assert BINDER.bind(Thing, TABLE, "").law == Law(kind="hard", factor=1.5)


def test_round_trip():
    thing = BINDER.bind(Thing, TABLE, "")
    assert BINDER.bind(Thing, to_table(thing, named=NAMED), "") == thing
    plain = Thing(length=1.0)
    assert to_table(plain, named=NAMED)["stuff"] == "iron"
    assert BINDER.bind(Thing, to_table(plain, named=NAMED), "") == plain


@pytest.mark.parametrize(
    ("change", "where", "words"),
    [
        ({"lenght": "1 mm"}, "lenght", ["Unknown key 'lenght'", "'length'"]),
        ({"zzz": 1}, "zzz", ["known keys are length, count"]),
        ({"length": 3}, "length", ["'3 mm'"]),
        ({"length": "-1 mm"}, "length", ["-1 mm", "greater than 0 mm"]),
        ({"count": 0}, "count", ["is 0", "1 or more"]),
        ({"count": 1.5}, "count", ["a whole number"]),
        ({"count": True}, "count", ["a whole number"]),
        ({"on": 1}, "on", ["true or false"]),
        ({"law": {"kind": "sotf"}}, "law.kind", ["'sotf' is not known", "'soft'"]),
        ({"law": {"factor": 3}}, "law.factor", ["is 3", "2 or less"]),
        ({"law": {"factor": "3"}}, "law.factor", ["a number"]),
        ({"law": 5}, "law", ["a table"]),
        ({"stuff": "irno"}, "stuff", ["'irno' is not known", "'iron'"]),
        ({"stuff": {"name": "wood"}}, "stuff.density", ["lacks 'density'", "g/cm^3"]),
        ({"parts": [{"radius": "1 mm"}]}, "parts.0.type", ["lacks 'type'", "ball, flat_box"]),
        ({"parts": [{"type": "bal"}]}, "parts.0.type", ["'bal' is not known", "'ball'"]),
        (
            {"parts": [{"radius": "1 mm", "type": "bal"}]},  # its keys are not those to blame
            "parts.0.type",
            ["'bal' is not known"],
        ),
        ({"parts": [{"type": "ball", "side": "1 mm"}]}, "parts.0.side", ["Unknown key 'side'"]),
        ({"parts": "x"}, "parts", ["a list"]),
        ({"times": [1]}, "times.0", ["'1 ms'"]),
        ({"pair": [1]}, "pair", ["1 values, but needs 2"]),
    ],
)
def test_mistakes_are_one_sentence(change, where, words):
    with pytest.raises(InputError) as caught:
        BINDER.bind(Thing, {**TABLE, **change}, "")
    sentence = str(caught.value)
    assert caught.value.where == where
    assert sentence.endswith(".") and "\n" not in sentence
    assert all(word in sentence for word in words), sentence


def test_a_missing_value_is_named_with_its_unit():
    with pytest.raises(InputError, match=r"lacks 'length' \(the length, in mm\); give it"):
        BINDER.bind(Thing, {}, "thing")


def test_set_path():
    thing = BINDER.bind(Thing, TABLE, "")
    assert set_path(thing, "parts.1.side", "3 mm", BINDER).parts[1].side == 3e-3
    assert set_path(thing, "stuff", "iron", BINDER).stuff.density == 7870.0
    assert set_path(thing, "stuff.density", 1.0, Binder(si=True)).stuff.density == 1.0
    assert set_path(thing, "limit", "none", BINDER).limit is None
    assert set_path(thing, "law.factor", 2, BINDER).law == Law(kind="hard", factor=2.0)
    assert thing == BINDER.bind(Thing, TABLE, "")


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [
        ("parts.2.side", "3 mm", "no entry '2'; there are 0 to 1"),
        ("parts.x", "3 mm", "no entry 'x'"),
        ("law.kidn", "hard", "nearest known one is 'kind'"),
        ("length.x", "1 mm", "leads nowhere"),
        ("length", 1.0, "without a unit"),
        ("law.factor", 9.0, "2 or less"),
    ],
)
def test_set_path_mistakes(path, value, words):
    with pytest.raises(InputError, match=words):
        set_path(BINDER.bind(Thing, TABLE, ""), path, value, BINDER)


def test_bounds_hold_for_specs_made_of_objects():
    with pytest.raises(InputError, match=r"thing.parts.0.radius is -1 mm"):
        check_spec(Thing(length=1.0, parts=(Ball(radius=-1e-3),)), "thing")
    with pytest.raises(InputError, match="must be a number"):
        check_spec(Thing(length=float("nan")), "thing")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"length": "5 mm"}, "thing.length is '5 mm', but should be a number in SI; text with"),
        ({"length": True}, "thing.length is True, but should be a number"),
        ({"count": 2.0}, "thing.count is 2.0, but should be a whole number"),
        ({"on": 1}, "thing.on is 1, but should be true or false"),
        ({"limit": [1.0]}, r"thing.limit is \[1.0\], but should be a number"),
        ({"law": Law(kind=-1)}, "thing.law.kind is -1, but should be one of soft, hard"),  # type: ignore[arg-type]
        ({"law": Ball(radius=1.0)}, "thing.law is Ball.*, but should be a Law"),
        ({"parts": (Stuff(name="tin", density=1.0),)}, "should be a Part"),
        ({"times": [0.0, 1.0]}, "thing.times is .*, but should be a tuple"),
        ({"times": (0.0, "1 ms")}, "thing.times.1 is '1 ms', but should be a number in SI"),
        ({"pair": (1, 2, 3)}, "thing.pair is .*, but should be 2 values"),
    ],
)
def test_kinds_hold_for_specs_made_of_objects(change, words):
    with pytest.raises(InputError, match=words):
        check_spec(Thing(**{"length": 1.0, **change}), "thing")


def test_a_spec_and_a_value_of_it_are_changed_in_the_order_given():
    """Only loose values of one spec are joined in a table; what the caller gave stays as it was."""
    table = {"kind": "hard"}
    changes = {"law": table, "law.factor": 0.7}
    assert with_their_choice(Thing(length=1.0), changes) == changes and table == {"kind": "hard"}


def test_numbers_of_numpy_are_numbers():
    check_spec(Thing(length=np.float32(0.5), count=np.int64(4), times=(np.float64(1.0), 2)))
