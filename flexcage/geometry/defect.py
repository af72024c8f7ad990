"""What all defects of cages share: each is one class that knows what it moves, its place, its
label, its words, its check and its marks in pictures.

A cage type lists the defects that it may have (``CageType.defects``). ``register_defect`` adds a
user's own.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, NamedTuple, TypeVar

import numpy as np

from flexcage.core.binding import did_you_mean, parts_of_length
from flexcage.core.errors import InputError
from flexcage.core.registry import check_free, note_source
from flexcage.core.spec import option
from flexcage.core.wings import CAGE_TYPES, Parts
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage

Spec = type  # by another name, for inside a defect ``type`` is a field
Finding = tuple[str, str, object]  # where, sentence, value
Meaning = Literal["smaller", "larger", "moved", "crack", "sound"]

_NO_DEFECTS = {
    ".*spall.*": "[[defects]] are of the cage; a spall of a race is [bearing.outer_spall] or "
    "[bearing.inner_spall]"
}
#: Specs of defects by the name that a case gives: those of all cage types, and users' own.
DEFECTS: Parts[Spec] = Parts(
    CAGE_TYPES, lambda made: {name_of(kind): kind for kind in made.defects}, what="kind of defect"
)
_ADDED: dict[str, list[type[CageDefect]]] = {}  # by cage type: users' own


class Reading(NamedTuple):
    """One size of a defect: what it is called, what is asked of it [m], and what a mesh has of it,
    place by place (n,) [m]."""

    kind: str
    asked: float
    measured: Sequence[float]


class Mark(NamedTuple):
    """A row of a picture's legend: a "patch", "dashes" or a "line", what it means, and its text."""

    kind: Literal["patch", "dashes", "line"]
    meaning: Meaning
    text: str


class CageLine(NamedTuple):
    """A line on the cage: points (n, 3) [m], and the one that must be seen for it to be drawn."""

    points: np.ndarray
    seen_at: np.ndarray


def defect_type(name: str) -> Any:
    """The field ``type`` of a kind of defect."""
    return option(name, doc="kind of defect", choices=DEFECTS, elsewhere=_NO_DEFECTS)


@dataclass(frozen=True, kw_only=True)
class CageDefect:
    """A defect of a cage; ``type`` picks one of the kinds below.

    Crossbeam or web k lies between the pockets k-1 and k.
    """

    #: Part of the cage that it is a defect of, and the name of the value that numbers this part.
    part: ClassVar[str] = "pocket"

    type: str = option(doc="kind of defect", choices=DEFECTS, elsewhere=_NO_DEFECTS)

    @property
    def number(self) -> int:
        """Number of its part."""
        return int(getattr(self, self.part))

    @property
    def place(self) -> float:
        """Place around the cage, counted in pockets."""
        return float(self.number) if self.part == "pocket" else self.number - 0.5

    def moved_by(self, parts: int) -> CageDefect:
        """The same defect of the part that has a number greater by ``parts``."""
        moved: dict[str, Any] = {self.part: self.number + parts}
        return replace(self, **moved) if parts else self

    def extent(self, cage: Cage) -> float:
        """How large it is [m], by which data sets grade it: the largest of its lengths; 0 without
        any."""
        return max((abs(value) for value in parts_of_length(self)), default=0.0)

    def pockets(self, count: int) -> list[int]:
        """Pockets that it touches, of ``count`` in its row; the one behind a beam or web first."""
        if self.part == "pocket":
            return [self.number]
        first = self.number // count * count  # of its row
        return [first + (self.number - 1) % count, self.number]

    @property
    def label(self) -> str:
        """The defect and its size, in a few words for pictures."""
        return f"{self.part} {self.number}, {self.type.replace('_', ' ')}"

    def in_words(self, count: int) -> str:
        """What it did to a cage with ``count`` pockets: half a sentence for reports."""
        return f"{self.part} {self.number} has a defect of the kind {self.type.replace('_', ' ')}"

    def changes(self, count: int) -> Mapping[tuple[int, str], float]:
        """Change of size [m] of pockets, by pocket and what of it; 0 for a pocket's "place"."""
        return {}

    @property
    def legend(self) -> Sequence[Mark]:
        """Legend of the marks of this kind of defect; patches count where a pocket has them."""
        return ()

    def way(self, count: int) -> tuple[float, np.ndarray] | None:
        """Where wall or beam went: axial place over the cage's half width, and the unit direction;
        None where nothing went anywhere."""
        return None

    def lines(self, points: np.ndarray, count: int) -> Sequence[CageLine]:
        """Lines that mark it on a mesh with the vertices ``points`` (n, 3) [m]."""
        return ()

    def check(self, where: str, cage: Cage, count: int) -> Iterator[Finding]:
        """What is impossible in it alone, in a cage with ``count`` pockets; it stands ``where``."""
        yield from self.check_number(where, count)

    def check_number(self, where: str, count: int) -> Iterator[Finding]:
        """A part that is not there."""
        if not 0 <= self.number < count:
            yield (
                f"{where}.{self.part}",
                f"{where}.{self.part} is {self.number}, but the cage's {self.part}s are numbered "
                f"0 to {count - 1}.",
                self.number,
            )

    @classmethod
    def check_all(
        cls, defects: Sequence[Any], cage: Cage, *, pocket_count: int, pitch_diameter: float,
        element_diameter: float = 0.0,
    ) -> None:  # fmt: skip
        """Raise InputError for defects that a sound cage of these dimensions cannot have, in a
        bearing whose elements have this pitch circle [m] and diameter [m] (0: any)."""
        check_each(defects, cage, pocket_count)

    @classmethod
    def interference(
        cls, defects: Sequence[Any], cage: Cage, bearing: Bearing
    ) -> Iterator[tuple[str, str]]:
        """Where, and in a sentence, defects leave an element less room than any assembly can
        take."""
        return iter(())

    @classmethod
    def by_chance(cls, cage: Cage, pocket_count: int, seed: int) -> tuple[CageDefect, ...]:
        """Defects that make a cage's pockets uneven, drawn at random; none if they are even."""
        return ()

    @classmethod
    def check_together(cls, own: Sequence[Any], count: int) -> Iterator[Finding]:
        """What is impossible in all defects of this kind together."""
        return iter(())

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> Sequence[Reading]:
        """What a ``mesh.cage_mesh.CageMesh`` has of it, measured from the undamaged cage."""
        return ()


def in_row(defects: Sequence[Any], row: int, count: int) -> tuple[Any, ...]:
    """Defects of a row's half of a cage with ``count`` pockets a row, by the numbers that pockets
    have in it."""
    own = [d for d in defects if d.number // count == row]
    return tuple(defect.moved_by(-row * count) for defect in own)


@contextmanager
def numbered_as(defects: Sequence[Any], row: int, count: int) -> Iterator[None]:
    """An InputError about a defect of a row (``in_row``) says which of all ``defects`` it is."""
    places = [i for i, d in enumerate(defects) if d.number // count == row]

    def whole(text: str) -> str:
        return re.sub(r"defects\.(\d+)", lambda m: f"defects.{places[int(m[1])]}", text)

    try:
        yield
    except InputError as error:
        if len(places) == len(defects):
            raise
        raise InputError(whole(str(error)), where=whole(error.where), value=error.value) from None


def check_in_rows(defects: Sequence[Any], count: int, rows: int) -> None:
    """Raise InputError for a defect of a part that none of the rows has."""
    for i, defect in enumerate(defects):
        raise_first(defect.check_number(f"defects.{i}", rows * count))


Kind = TypeVar("Kind", bound=type[CageDefect])


def name_of(kind: type[CageDefect]) -> str:
    """The name by which a case asks for a kind of defect: the default of its ``type``."""
    return str(kind.__dataclass_fields__["type"].default)


def kinds_of(cage_type: str) -> tuple[type[CageDefect], ...]:
    """Kinds of defects that cages of a type may have: those it lists, and users' own."""
    return (*CAGE_TYPES[cage_type].defects, *_ADDED.get(cage_type, ()))


def register_defect(kind: Kind, *, cages: Iterable[str]) -> Kind:
    """Add a kind of defect for cages of some types ("window", "machined", "ribbon"):
    ``[[defects]]`` with its ``type`` then asks for it.

    ``kind`` is a frozen dataclass, derived from ``window_defects.WindowDefect`` or
    ``ball_cage_defects.BallCageDefect`` (for a cage type of the user's own, from ``CageDefect``
    or what its mesh needs), whose ``type`` is ``defect_type(name)``. InputError for a name that
    is taken, a class that is no such defect or a cage type that there is not.
    """
    if not (isinstance(kind, type) and issubclass(kind, CageDefect)):
        raise InputError(f"{kind!r} is no class derived from CageDefect.", where="defect")
    for cage_type in (wanted := tuple(cages)):
        if cage_type not in CAGE_TYPES:
            raise InputError(
                f"There is no cage type '{cage_type}'; "
                f"{did_you_mean(cage_type, CAGE_TYPES, 'choose from')}.",
                where="defect",
                value=cage_type,
            )
        base = CAGE_TYPES[cage_type].defect_spec
        if not issubclass(kind, base):
            raise InputError(
                f"{kind.__name__} is no {base.__name__}, as the mesh of a cage of the type "
                f"'{cage_type}' needs it; derive it from {base.__module__}.{base.__name__}.",
                where="defect",
                value=cage_type,
            )
    DEFECTS.add(name_of(kind), kind)
    note_source(name_of(kind), kind)
    for cage_type in wanted:
        _ADDED.setdefault(cage_type, []).append(kind)
    return kind


def note_listed(kinds: Iterable[type[CageDefect]]) -> None:
    """Remember the files of those kinds, listed by a user's cage type, that are the user's own;
    InputError for one whose name is another's."""
    for kind in kinds:
        if DEFECTS.get(name := name_of(kind)) is not kind:
            check_free(DEFECTS, name, what=DEFECTS.what)
            note_source(name, kind)


def refuse_foreign(defects: Sequence[CageDefect], cage_type: str) -> None:
    """Raise InputError for a defect that cages of this type do not have."""
    kinds = kinds_of(cage_type) if defects else ()
    for i, defect in enumerate(defects):
        if type(defect) not in kinds:
            known = ", ".join(f"'{name_of(kind)}'" for kind in kinds)
            have = f"whose defects are {known}" if known else "which have no defects"
            raise InputError(
                f"defects.{i}.type is '{defect.type}', but this bearing's cage is one of the "
                f"{cage_type} cages, {have}.",
                where=f"defects.{i}.type",
                value=defect.type,
            )


def defect_spec(cage: Cage) -> type[CageDefect]:
    """What all defects of a cage are, by its type."""
    spec: type[CageDefect] = CAGE_TYPES[cage.cage_type].defect_spec
    return spec


def check_each(defects: Sequence[CageDefect], cage: Cage, count: int) -> None:
    """Raise InputError for a defect that is none of the cage's, or impossible alone or with others
    of its kind."""
    refuse_foreign(defects, cage.cage_type)
    for i, defect in enumerate(defects):
        raise_first(defect.check(f"defects.{i}", cage, count))
    for kind in dict.fromkeys(type(defect) for defect in defects):
        raise_first(kind.check_together([d for d in defects if type(d) is kind], count))
    for i, defect in enumerate(defects):
        if defect in defects[:i]:
            raise InputError(
                f"defects.{i} is the same as defects.{list(defects).index(defect)}, and both would "
                "add up; leave one out.",
                where=f"defects.{i}",
            )


def raise_first(findings: Iterable[Finding]) -> None:
    """Raise the first finding, if any, as an InputError."""
    for where, sentence, value in findings:
        raise InputError(sentence, where=where, value=value)


def around(place: float, count: int) -> np.ndarray:
    """Unit vector towards larger azimuth at a place around the cage, counted in pockets."""
    azimuth = 2.0 * np.pi * place / count
    return np.array([0.0, -np.sin(azimuth), np.cos(azimuth)])


def signed_mm(size: float) -> str:
    """A change of size with its sign, for labels."""
    return f"{size * 1e3:+.3g} mm".replace("-", "−")
