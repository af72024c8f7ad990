"""What catalogues say of common bearings: boundary dimensions of ISO 15, ratings, races F and E.

The data are in the folder ``catalogues``: dimensions by diameter series and bore code, which all
types share, and ratings by designation, each with the catalogue that they are from.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cache

from flexcage.case.catalogues import rows
from flexcage.case.marks import split
from flexcage.core.binding import near_names, replacement_of
from flexcage.core.errors import InputError
from flexcage.core.units import parse
from flexcage.geometry.bearing import OTHER_DESIGNS
from flexcage.geometry.full_complement import CAGED, FULL
from flexcage.geometry.inference import Outline
from flexcage.geometry.other_kinds import kind_of

# columns of ratings that only some types of bearing have: the option of "flexcage new" for each
_OPTIONS = {
    "contact_angle_deg": "--contact-angle",
    "inner_race_mm": "--inner-race",
    "outer_race_mm": "--outer-race",
}


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A bearing of the catalogue, and where its ratings are from."""

    outline: Outline
    source: str


def designations() -> list[str]:
    """All designations with ratings."""
    return list(_ratings())


def find(text: str) -> Entry:
    """The bearing of a designation, "N 210" or "N210", "6205-2RS C3"; InputError if it is unknown,
    or known without ratings, or of a design that flexcage has not."""
    plain = re.sub(r"[\s_/-]", "", text.upper())
    name = _of_makers_series(plain)
    entry = _found(text, name)
    if name == plain:
        return entry
    return replace(entry, source=f"{entry.source}; {text} means {name}")


def _found(text: str, name: str) -> Entry:
    """The bearing of a designation, by its ``name`` without blanks in the catalogue's series."""
    if name in _ratings():
        return _entry(name)
    if declined := kind_of(name):
        raise InputError(f"'{text}' {declined}.", where="designation", value=text)
    if marked := split(name, _ratings()):
        bare = _entry(marked.bare)
        return replace(bare, outline=marked.applied(bare.outline))
    if full := _with_suffix(name):
        entry = _entry(full)
        return replace(entry, source=f"{entry.source}; {text} means {full}")
    if not _parsed(name) and (design := _of_a_design(name)):
        raise InputError(
            f"'{text}' is a cylindrical roller bearing of the design {design}, which flexcage has, "
            f"but the catalogue has only the series {', '.join(_series_of(design))} of it; "
            f"describe it by flexcage new {name} --type cylindrical_roller --design {design} "
            '--bore "..." --outside "..." --width "..." --dynamic "..." --static "...".',
            where="designation",
            value=text,
        )
    if not _parsed(name) and (uncaged := _UNCAGED.fullmatch(name)):
        raise InputError(
            f"'{text}' is a full complement cylindrical roller bearing; the catalogue has those of "
            f"the series {', '.join(_uncaged_series())} with bores of 20 to 60 mm, and any other "
            f"one is described by {_uncaged_way(uncaged[1])}.",
            where="designation",
            value=text,
        )
    if not _parsed(name) and (instead := replacement_of(name, OTHER_DESIGNS)):
        raise InputError(
            f"'{text}': {instead}{_same_rollers(name)}.", where="designation", value=text
        )
    uncaged = _UNCAGED.fullmatch(name)
    raise _without_ratings(text, name) or InputError(
        f"'{text}' is not in the catalogue; {_nearest(name)}, and any other bearing is described "
        f"by {_uncaged_way(uncaged[1]) if uncaged else WAY}.",
        where="designation",
        value=text,
    )


_UNCAGED = re.compile(r"(NCF|NJG|SL18|SL19)\d.*")  # a test holds the series against it


def _uncaged_way(start: str) -> str:
    """How a full complement of cylindrical rollers is described; ``start`` of its designation."""
    design, race = ("NF", "outer") if start in ("NCF", "SL18") else ("NJ", "inner")
    return (
        f"flexcage new --type cylindrical_roller --design {design} --cage none --bore "
        f'"..." --outside "..." --width "..." --{race}-race "..." --dynamic "..." --static "..."'
    )


def _uncaged_series() -> list[str]:
    """The series of full complements, each with a maker's other names of it."""
    full = {name: row for name, row in _series().items() if row["complement"] == FULL}
    return [f"{name} ({', '.join(row['makers_series'].split())})" for name, row in full.items()]


def _of_makers_series(name: str) -> str:
    """A designation by the series of this catalogue, where a maker's own name of it is given, as
    SL183010 is NCF3010, and NJ2308VH NJG2308VH."""
    for series, row in _series().items():
        for other in row["makers_series"].split():
            full = "" if other.startswith("SL") else "VH"
            if match := re.fullmatch(rf"{other}(\d\d)A?({full}.*)", name):
                return f"{series}{match[1]}{match[2]}"
    return name


def _with_suffix(name: str) -> str:
    """A designation with the suffix that numbers of its series may leave out, the A of a contact
    angle of 30 degrees (NTN, Ball and Roller Bearings, CAT. No. 2203/E); empty if it has none."""
    parsed = _parsed(name)
    full = f"{name}{parsed[0]['omitted']}" if parsed and not parsed[2] else ""
    return full if full in _ratings() else ""


WAY = (
    'its dimensions and ratings, as in: flexcage new --type deep_groove_ball --bore "25 mm" '
    '--outside "52 mm" --width "15 mm" --dynamic "14 kN" --static "7.85 kN"'
)


def _nearest(name: str) -> str:
    """The known designations that are nearest to a name, or what the catalogue has at all."""
    close = near_names(name, _ratings())
    if not close:
        return f"it has the series {', '.join(_series())}, with bores of 10 to 60 mm"
    return f"the nearest known {'one is' if len(close) == 1 else 'ones are'} {', '.join(close)}"


def _same_rollers(name: str) -> str:
    """What there is in the place of another design, which has its rolling elements and races."""
    for series, row in _series().items():
        for other in row["other_designs"].split():
            own = f"{series}{name.removeprefix(other)[:2]}"
            if re.match(rf"{other}\d\d(\D|$)", name) and own in _ratings():
                return f"; '{own}' has the same races and ratings"
    return ""


def _of_a_design(name: str) -> str:
    """The design of a cylindrical roller bearing that the catalogue has some series of; or ""."""
    match = re.fullmatch(r"([A-Z]+)\d{3,}[A-Z0-9]*", name)
    return match[1] if match and _series_of(match[1]) else ""


def _series_of(design: str) -> list[str]:
    """Its series with a cage."""
    caged = {name: row for name, row in _series().items() if row["complement"] == CAGED}
    return [name for name, row in caged.items() if design and row["design"] == design]


def _parsed(name: str) -> tuple[dict[str, str], str, str] | None:
    """Row of the series, bore code and suffix of a designation; None if it has another form."""
    pattern = rf"({'|'.join(_series())})(\d\d)((?:[A-Z][A-Z0-9]*)?)"
    match = re.fullmatch(pattern, name)
    return (_series()[match[1]], match[2], match[3]) if match else None


def _without_ratings(text: str, name: str) -> InputError | None:
    """The sentence on a designation whose dimensions alone are known."""
    parsed = _parsed(name)
    found = parsed and _boundary().get((parsed[0]["diameter_series"], parsed[1]))
    if not parsed or not found:
        return None
    series, code, suffix = parsed
    bore, outside, width = found
    wanted, angle = _wanted(series), ""
    if "--contact-angle" in wanted and suffix in _suffixes():
        wanted.remove("--contact-angle")
        angle = f' --contact-angle "{_suffixes()[suffix]} deg"'
    design = f" --design {series['design']}" if series["design"] else ""
    if series["complement"] == FULL:
        design += " --cage none"
    if own := _all_rows().get(f"{series['series']}{code}"):  # with races, without ratings
        races = [column for column in _OPTIONS if own[column]]
        wanted = []
        angle = "".join(f' {_OPTIONS[column]} "{own[column]} mm"' for column in races)
    others = [n for n in _ratings() if re.fullmatch(rf"{series['series']}{code}\D*", n)]
    has = f" (it has {', '.join(others)})" if others else ""
    return InputError(
        f"The catalogue has no ratings of '{text}'{has}{_same_rollers(name)}. Give them: add "
        f"{', '.join(['--dynamic', '--static', *wanted])} to flexcage new {name} --type "
        f'{series["type"]}{design} --bore "{bore}" --outside "{outside}" --width "{width}"{angle}.',
        where="designation",
        value=text,
    )


def _wanted(series: dict[str, str]) -> list[str]:
    """Options of what bearings of a series need beside dimensions and ratings."""
    alike = next(row for n, row in _all_rows().items() if n.startswith(series["series"]))
    return [option for column, option in _OPTIONS.items() if alike[column]]


def _entry(name: str) -> Entry:
    row = _ratings()[name]
    parsed = _parsed(name)
    assert parsed is not None  # a test holds all designations of the file against the pattern
    series, code, _ = parsed
    place = series["diameter_series"], code
    bore, outside, width = (parse(text, "mm") for text in _boundary()[place])
    return Entry(
        outline=Outline(
            type=series["type"], designation=name, bore=bore, outside_diameter=outside, width=width,
            static_rating=parse(f"{row['static_kN']} kN", "kN"),
            dynamic_rating=parse(f"{row['dynamic_kN']} kN", "kN"),
            contact_angle=_optional(row["contact_angle_deg"], "deg"),
            inner_race_diameter=_optional(row["inner_race_mm"], "mm"),
            outer_race_diameter=_optional(row["outer_race_mm"], "mm"),
            design=series["design"] or None,
            inner_rib_diameter=_optional(row["inner_rib_mm"], "mm"),
            outer_rib_diameter=_optional(row["outer_rib_mm"], "mm"),
            complement=series["complement"],
            left_out=(series["left_out"],) if series["left_out"] else (),
        ),
        source=_sources()[row["source"]],
    )  # fmt: skip


def _optional(text: str, unit: str) -> float | None:
    return parse(f"{text} {unit}", unit) if text else None


@cache
def _all_rows() -> dict[str, dict[str, str]]:
    return {row["designation"]: row for row in rows("ratings")}


@cache
def _ratings() -> dict[str, dict[str, str]]:
    return {name: row for name, row in _all_rows().items() if row["static_kN"]}


@cache
def _series() -> dict[str, dict[str, str]]:
    """By series: type and design of bearing, diameter series of ISO 15, series of other designs
    that have its rolling elements and races, the suffix that numbers may leave out, whether they
    are full complements, makers' own names of the series, and what of them is left out."""
    return {row["series"]: row for row in rows("series")}


@cache
def _suffixes() -> dict[str, str]:
    """Contact angles [deg] by suffix: those that all makers mean ("A" is 25 or 30 degrees)."""
    return {row["suffix"]: row["contact_angle_deg"] for row in rows("suffixes")}


@cache
def _sources() -> dict[str, str]:
    return {row["source"]: row["catalogue"] for row in rows("sources")}


@cache
def _boundary() -> dict[tuple[str, str], tuple[str, str, str]]:
    """Bore, outside diameter and width as texts, by diameter series and bore code."""
    return {
        (row["diameter_series"], row["bore_code"]): (
            f"{row['bore_mm']} mm", f"{row['outside_diameter_mm']} mm", f"{row['width_mm']} mm",
        )
        for row in rows("boundary")
    }  # fmt: skip
