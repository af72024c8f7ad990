"""What catalogues say of common bearings: boundary dimensions of ISO 15, ratings, races F and E.

The data are in the folder ``catalogues``: dimensions by diameter series and bore code, which all
types share, and ratings by designation, each with the catalogue that they are from.
"""

from __future__ import annotations

import csv
import difflib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import resources

from flexcage.core.binding import told_elsewhere
from flexcage.core.errors import InputError
from flexcage.core.units import parse
from flexcage.geometry.bearing import OTHER_DESIGNS
from flexcage.geometry.inside import Outline

#: Series of a designation: the type of bearing, and the diameter series of ISO 15.
SERIES = {
    "60": ("deep_groove_ball", "0"),
    "62": ("deep_groove_ball", "2"),
    "63": ("deep_groove_ball", "3"),
    "70": ("angular_contact_ball", "0"),
    "72": ("angular_contact_ball", "2"),
    "73": ("angular_contact_ball", "3"),
    "N10": ("cylindrical_roller", "0"),
    "N2": ("cylindrical_roller", "2"),
    "N3": ("cylindrical_roller", "3"),
}
#: Contact angles [deg] by suffix; what "A" means depends on the maker.
ANGLES = {"C": 15, "AC": 25, "A5": 25, "B": 40}
_DESIGNATION = re.compile(r"(N10|N2|N3|6[023]|7[023])(\d\d)((?:[A-Z][A-Z0-9]*)?)")
_ROLLERS = re.compile(r"(?:NU|NJ|NUP)((?:10|2|3)\d\d)(.*)")


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A bearing of the catalogue, and where its ratings are from."""

    outline: Outline
    source: str


def designations() -> list[str]:
    """All designations with ratings."""
    return list(_ratings())


def find(text: str) -> Entry:
    """The bearing of a designation, "N 210" or "N210"; InputError if it is unknown, or known
    without ratings, or of a design that flexcage has not."""
    name = re.sub(r"[\s_-]", "", text.upper())
    if name in _ratings():
        return _entry(name)
    if told := told_elsewhere(name, OTHER_DESIGNS):
        raise InputError(f"'{text}': {told}{_same_rollers(name)}.", where="designation", value=text)
    raise _without_ratings(text, name) or InputError(
        f"'{text}' is not in the catalogue; {_nearest(name)}, and any other bearing is described "
        f"by {WAY}.",
        where="designation",
        value=text,
    )


WAY = (
    'its dimensions and ratings, as in: flexcage new --type deep_groove_ball --bore "25 mm" '
    '--outside "52 mm" --width "15 mm" --dynamic "14 kN" --static "7.85 kN"'
)


def _nearest(name: str) -> str:
    """The known designations that are nearest to a name, or what the catalogue has at all."""
    close = difflib.get_close_matches(name, _ratings(), n=3)
    if not close:
        return f"it has the series {', '.join(SERIES)}, with bores of 10 to 60 mm"
    return f"the nearest known {'one is' if len(close) == 1 else 'ones are'} {', '.join(close)}"


def _same_rollers(name: str) -> str:
    """What there is in the place of a NU, NJ or NUP."""
    match = _ROLLERS.match(name)
    known = match is not None and f"N{match[1]}" in _ratings()
    return f"; 'N{match[1]}' has the same races and ratings" if match and known else ""


def _without_ratings(text: str, name: str) -> InputError | None:
    """The sentence on a designation whose dimensions alone are known."""
    match = _DESIGNATION.fullmatch(name)
    found = match and _boundary().get((SERIES[match[1]][1], match[2]))
    if not match or not found:
        return None
    kind, suffix = SERIES[match[1]][0], match[3]
    bore, outside, width = found
    wanted = ["--dynamic", "--static"]
    angle = ""
    if kind == "angular_contact_ball":
        known = suffix in ANGLES
        angle = f' --contact-angle "{ANGLES[suffix]} deg"' if known else ""
        wanted += [] if known else ["--contact-angle"]
    if kind == "cylindrical_roller":
        wanted += ["--inner-race", "--outer-race"]
    others = [n for n in _ratings() if n.startswith(match[1] + match[2])]
    has = f" (it has {', '.join(others)})" if others else ""
    return InputError(
        f"The catalogue has no ratings of '{text}'{has}; complete, with {', '.join(wanted)}: "
        f'flexcage new {name} --type {kind} --bore "{bore}" --outside "{outside}" --width '
        f'"{width}"{angle}.',
        where="designation",
        value=text,
    )


def _entry(name: str) -> Entry:
    row = _ratings()[name]
    match = _DESIGNATION.fullmatch(name)
    assert match is not None  # a test holds all designations of the file against the pattern
    kind, series = SERIES[match[1]]
    bore, outside, width = (parse(text, "mm") for text in _boundary()[series, match[2]])
    return Entry(
        outline=Outline(
            type=kind, designation=name, bore=bore, outside_diameter=outside, width=width,
            static_rating=parse(f"{row['static_kN']} kN", "kN"),
            dynamic_rating=parse(f"{row['dynamic_kN']} kN", "kN"),
            contact_angle=_optional(row["contact_angle_deg"], "deg"),
            inner_race_diameter=_optional(row["inner_race_mm"], "mm"),
            outer_race_diameter=_optional(row["outer_race_mm"], "mm"),
        ),
        source=_sources()[row["source"]],
    )  # fmt: skip


def _optional(text: str, unit: str) -> float | None:
    return parse(f"{text} {unit}", unit) if text else None


def _rows(name: str) -> Iterator[dict[str, str]]:
    file = resources.files("flexcage.case") / "catalogues" / f"{name}.csv"
    return csv.DictReader(file.read_text("utf-8").splitlines())


@cache
def _ratings() -> dict[str, dict[str, str]]:
    return {row["designation"]: row for row in _rows("ratings")}


@cache
def _sources() -> dict[str, str]:
    return {row["source"]: row["catalogue"] for row in _rows("sources")}


@cache
def _boundary() -> dict[tuple[str, str], tuple[str, str, str]]:
    """Bore, outside diameter and width as texts, by diameter series and bore code."""
    return {
        (row["diameter_series"], row["bore_code"]): (
            f"{row['bore_mm']} mm", f"{row['outside_diameter_mm']} mm", f"{row['width_mm']} mm",
        )
        for row in _rows("boundary")
    }  # fmt: skip
