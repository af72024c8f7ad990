"""A maker's designation in its parts: "HCB 7010-C-T-P4S" is a prefix, a series, a bore code, a
contact angle, and marks. What the parts mean stands in the folder ``catalogues``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

from flexcage.case.catalogues import rows

SEPARATORS = r"[\s_/.,-]+"
GROUPS = ("C2", "CN", "C3", "C4", "C5")  # of radial clearance, ISO 5753-1
_BORE = re.compile(r"(\D*\d{2,3})\s*/\s*(\d{1,4})(?!\d)(.*)")  # "62/22", where it has no code
_TWO_SIZES = re.compile(r"(NKI?)\s*(\d{1,3}\s*/\s*\d\d)(.*)|(HK|BK|HN)\s*(\d{4})(.*)")
_TOGETHER = re.compile(r"(P[56])([2-5])")  # P63 is P6 and C3
_FULL = "VH"  # of a full complement
_SPINDLES = {"E": "25"}  # what Schaeffler means by a suffix of its bearings B, HCB and XCB


@dataclass(frozen=True, kw_only=True)
class Designation:
    """A designation in parts. ``angle`` is the suffix that names the contact angle, and
    ``degrees`` its value where all makers mean the same; ``unknown`` are marks that flexcage does
    not know."""

    prefix: str
    series: str
    code: str
    angle: str
    degrees: str
    marks: tuple[str, ...]
    unknown: tuple[str, ...]

    @property
    def number(self) -> str:
        """Series and bore code; of a bore without a code, that in mm behind a stroke; of needle
        roller bearings bore and width in mm."""
        return f"{self.series}{self.code}"

    @property
    def bare(self) -> str:
        """The designation without prefix and marks."""
        return f"{self.number}{self.angle}"

    @property
    def clearance_class(self) -> str | None:
        """The group of radial clearance that it names: C2, CN, C3, C4 or C5."""
        return next((mark for mark in self.marks if mark in GROUPS), None)

    def __str__(self) -> str:
        first = f"{self.prefix}-" if self.prefix else ""
        return first + "-".join((self.bare, *self.marks, *self.unknown))


def plain(text: str) -> str:
    """A designation in capitals, without blanks, dashes and strokes."""
    return re.sub(SEPARATORS, "", text.upper())


def read(text: str) -> Designation | None:
    """The parts of a designation; None for a text of another form, or with a letter or figure
    beside its number that has no meaning here."""
    parts = [part for part in re.split(SEPARATORS, text.upper()) if part]
    name = "".join(parts)
    if sizes := _TWO_SIZES.fullmatch(text.strip().upper()):
        return _of_two_sizes(*(group for group in sizes.groups() if group is not None))
    if bore := _BORE.fullmatch(text.strip().upper()):
        return _of_a_bore(*bore.groups())
    cuts = {len("".join(parts[:k])) for k in range(1, len(parts))}
    for own, match in _numbers(name, cuts):
        row, end = series()[own], match.end()
        angle, degrees = _angle(name[end:], row, match["prefix"])
        firsts = _of_series(name[end + len(angle) :], own)
        rest = end + len(angle) + len("".join(firsts))
        tokens = _tokens(name, rest, cuts)
        marks, unknown = _marks_of(tokens)
        joined = _marks_of([name[rest:]]) if unknown else ((), ())
        if unknown and not joined[1]:  # "2 RS"
            marks, unknown = joined
        trailing = bool(tokens) and rest not in cuts
        if unknown and trailing and not _marks_in(tokens[0])[0]:
            continue
        return Designation(
            prefix=match["prefix"], series=own, code=match["code"], angle=angle,
            degrees=degrees, marks=(*firsts, *marks), unknown=unknown,
        )  # fmt: skip
    return None


def _of_a_bore(before: str, size: str, after: str) -> Designation | None:
    """A designation with a bore in mm behind a stroke, as 62/22."""
    found = read(f"{before}00{after}")
    return replace(found, code=f"/{size}") if found and found.code == "00" else None


def _of_two_sizes(own: str, code: str, after: str) -> Designation:
    """A needle roller bearing's designation, with bore and width in mm in place of a code."""
    marks, unknown = _marks_of([part for part in re.split(SEPARATORS, after) if part])
    return Designation(
        prefix="", series=own, code=re.sub(r"\s", "", code), angle="", degrees="", marks=marks,
        unknown=unknown,
    )  # fmt: skip


def unknown_part(text: str) -> tuple[str, str] | None:
    """Series and bore code as a designation begins, and what stands beside them; None for a text of
    another form."""
    name = plain(text)
    found = next(iter(_numbers(name, set())), None)
    return (name[: found[1].end()], name[found[1].end() :]) if found else None


def _numbers(name: str, cuts: set[int]) -> Iterator[tuple[str, re.Match[str]]]:
    """Series, and a match of prefix, series and bore code that a name may begin with; long names
    of series come first, and separators at ``cuts`` are not within a bore code. A code of one digit
    does not follow three."""
    for code in (r"\d\d", r"(?<!\d{3})\d"):
        for first, own in _names_of_series():
            before = "|".join(p for p, row in prefixes().items() if first.startswith(row["series"]))
            pattern = rf"(?P<prefix>(?:{before})?){first}(?P<code>{code})"
            match = re.match(pattern, name)
            if match and not any(match.start("code") < cut < match.end() for cut in cuts):
                if first == own or first not in series() or name[match.end() :].startswith(_FULL):
                    yield own, match


@cache
def _names_of_series() -> list[tuple[str, str]]:
    """Names of series with the series that they mean, long ones first: SL1830 is NCF30, and NJ23 is
    NJG23 where VH follows. A maker's name of a series comes before the series itself."""
    names = [(name, own) for own, row in series().items() for name in row["makers_series"].split()]
    return sorted([*names, *((own, own) for own in series())], key=lambda pair: -len(pair[0]))


def _angle(rest: str, row: dict[str, str], prefix: str) -> tuple[str, str]:
    """The suffix of a contact angle that a text begins with, and the angle [deg]."""
    if row["type"] != "angular_contact_ball":
        return "", ""
    known = {**suffixes(), "A": ""}  # which is 25 or 30 degrees, by maker
    if "B" in prefix:
        known = {**known, **_SPINDLES}
    found = [suffix for suffix in known if rest.startswith(suffix)]
    best = max(found, key=len, default="")
    return best, known.get(best, "")


def _of_series(rest: str, own: str) -> list[str]:
    """Marks at the beginning of a text that mean something after numbers of one series alone."""
    found: list[str] = []
    known = [
        m for m, row in meanings().items() if row.get("series") and own.startswith(row["series"])
    ]
    while fitting := [mark for mark in known if rest.startswith(mark)]:
        found.append(max(fitting, key=len))
        rest = rest.removeprefix(found[-1])
    return found


def _tokens(name: str, rest: int, cuts: set[int]) -> list[str]:
    """Texts between separators after a place in a name."""
    ends = sorted(cut for cut in cuts if cut > rest)
    places = [rest, *ends, len(name)]
    return [name[a:b] for a, b in zip(places, places[1:]) if b > a]


def _marks_in(token: str) -> tuple[tuple[str, ...], str]:
    """Marks at the beginning of a text, and what is left over of it: with the mark before it, and
    further letters, which may be the beginning of another one: "C3VT143" is C3 and VT143."""
    marks, left = _split(token)
    whole = False  # what is left over begins with a whole mark, not amid letters
    while left and marks and marks[-1] not in GROUPS and not whole:
        marks, left = marks[:-1], marks[-1] + left
        whole = bool(marks) and marks[-1][-1].isdigit()
    return marks, left


def _marks_of(tokens: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Marks in texts, and what is left over of each."""
    split = [_marks_in(token) for token in tokens]
    found = tuple(mark for marks, _ in split for mark in marks)
    return found, tuple(left for _, left in split if left)


@cache
def _split(text: str) -> tuple[tuple[str, ...], str]:
    """The fewest marks that make up a text, or its beginning, and what is left over of it."""
    best: tuple[tuple[str, ...], str] = ((), text)
    if together := _TOGETHER.match(text):
        best = _better(best, (together[1], f"C{together[2]}"), text[together.end() :])
    for mark in (*(m for m, row in meanings().items() if not row.get("series")), *GROUPS):
        if text.startswith(mark):
            best = _better(best, (mark,), text[len(mark) :])
    return best


def _better(
    best: tuple[tuple[str, ...], str], first: tuple[str, ...], text: str
) -> tuple[tuple[str, ...], str]:
    """The better of two ways to read: less is left over, there are fewer marks, or the first one
    is longer."""
    more, left = _split(text) if text else ((), "")
    found = ((*first, *more), left)

    def cost(way: tuple[tuple[str, ...], str]) -> tuple[int, int, int]:
        marks, rest = way
        return len(rest), len(marks), -len(marks[0]) if marks else 0

    return min(best, found, key=cost)


@cache
def series() -> dict[str, dict[str, str]]:
    """By series: type and design of bearing, diameter series of ISO 15, series of other designs
    that have its rolling elements and races, the suffix that numbers may leave out, whether they
    are full complements, makers' own names of the series, and what of them is left out."""
    return {row["series"]: row for row in rows("series")}


@cache
def suffixes() -> dict[str, str]:
    """Contact angles [deg] by suffix: those that all makers mean ("A" is 25 or 30 degrees)."""
    return {row["suffix"]: row["contact_angle_deg"] for row in rows("suffixes")}


@cache
def meanings() -> dict[str, dict[str, str]]:
    """By mark: its meaning, what there is instead where flexcage has no such thing, the types and
    the material of cages, and the material of elements that it names; the series whose marks they
    are, of those that one family's table has."""
    return {row["mark"]: row for row in rows("marks")}


@cache
def prefixes() -> dict[str, dict[str, str]]:
    """By prefix: the series it stands before, and what it means, as with marks."""
    return {row["prefix"]: row for row in rows("prefixes")}
