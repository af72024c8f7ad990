"""What catalogues say of common bearings: boundary dimensions of ISO 15, ratings, races F and E.

The data are in the folder ``catalogues``: dimensions by diameter series and bore code, which all
types share, and ratings by designation, each with the catalogue that they are from.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from flexcage.case.catalogues import further, rows
from flexcage.case.designation import Designation, plain, read, series, unknown_part
from flexcage.case.marks import applied, rated_by_user
from flexcage.core.binding import near_names, replacement_of
from flexcage.core.errors import InputError
from flexcage.core.units import parse
from flexcage.geometry.bearing import OTHER_DESIGNS
from flexcage.geometry.full_complement import CAGED, FULL
from flexcage.geometry.inference import Outline
from flexcage.geometry.other_kinds import inferred_kind, kind_of

# columns of ratings that only some types of bearing have: the key, and the option of "flexcage new"
_OPTIONS = {
    "contact_angle_deg": ("contact_angle", "--contact-angle"),
    "inner_race_mm": ("inner_race_diameter", "--inner-race"),
    "outer_race_mm": ("outer_race_diameter", "--outer-race"),
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
    found = _read(text)
    if found and (other := next((u for u in found.unknown if _is_known(u)), "")):
        raise _refused(text, f"names two bearings; give one, as in: flexcage new {other}")
    if not found or found.bare not in _ratings():
        raise _not_found(text, found)
    if "needle" in series()[found.series]["type"] and any("RS" in mark for mark in found.marks):
        raise _refused(
            text, "has seals, which take their place from the needles and lower the ratings; give "
            f'your maker\'s: flexcage new {found.bare} --dynamic "..." --static "..."',
        )  # fmt: skip
    entry = _entry(found)
    source = entry.source
    if plain(found.bare) not in plain(text):
        source = f"{source}; {text} means {found.bare}"
    return Entry(outline=applied(entry.outline, found), source=source)


def known(text: str) -> dict[str, Any] | None:
    """What is known of a bearing without ratings, keys of its outline: boundary dimensions (ISO 15)
    and what its designation says; None of one with ratings, and of an unknown one."""
    found = _read(text)
    row = found and _boundary().get(_place(found))
    if not found or not row or found.bare in _ratings():
        return None
    made, own = series()[found.series], _all_rows().get(found.number, {})
    sizes = zip(("bore", "outside_diameter", "width"), row)
    dimensions = {key: parse(size, "mm") for key, size in sizes}
    races = {
        key: parse(f"{own[column]} mm", "mm")
        for column, (key, _) in _OPTIONS.items()
        if own.get(column) and column != "contact_angle_deg"
    }
    angle = {"contact_angle": parse(f"{found.degrees} deg", "deg")} if found.degrees else {}
    return {
        "type": made["type"], "design": made["design"] or None, "complement": made["complement"],
        **dimensions, **races, **angle,
    }  # fmt: skip


def with_marks(outline: Outline) -> Outline:
    """An outline that a user gives, with what the marks of its designation say."""
    found = read(outline.designation)
    if not found or series()[found.series]["type"] != outline.type:
        return outline
    marked = applied(outline, found)
    return rated_by_user(replace(marked, designation=outline.designation))


def _is_known(text: str) -> bool:
    """Is a text the designation of a bearing of known dimensions?"""
    found = read(text)
    return found is not None and _place(found) in _boundary()


def _read(text: str) -> Designation | None:
    """A designation in parts; the suffix that numbers of its series may leave out is there, the A
    of a contact angle of 30 degrees (NTN, Ball and Roller Bearings, CAT. No. 2203/E)."""
    if declined := kind_of(text):
        raise InputError(f"'{text}' {declined}.", where="designation", value=text)
    found = read(text)
    if found and not found.angle:
        full = replace(found, angle=series()[found.series]["omitted"])
        return full if full.bare in _ratings() else found
    return found


def _not_found(text: str, found: Designation | None) -> InputError:
    """The sentence on a designation without an entry."""
    name = plain(text)
    uncaged = _UNCAGED.fullmatch(name)
    if not found:
        if own := inferred_kind(text):
            return _of_another_series(text, *own)
        if design := _of_a_design(name):
            return _refused(
                text,
                f"is a cylindrical roller bearing of the design {design}, which flexcage has, "
                f"but the catalogue has only the series {', '.join(_series_of(design))} of it; "
                f"describe it by flexcage new {name} --type cylindrical_roller --design {design} "
                '--bore "..." --outside "..." --width "..." --dynamic "..." --static "..."',
            )
        if uncaged:
            return _refused(
                text,
                "is a full complement cylindrical roller bearing; the catalogue has those of the "
                f"series {', '.join(_uncaged_series())} with bores of 20 to 60 mm, and any other "
                f"one is described by {_uncaged_way(uncaged[1])}",
            )
        if told := replacement_of(name, OTHER_DESIGNS):
            return InputError(f"'{text}': {told}{_same_rollers(name)}.", where="designation",
                              value=text)  # fmt: skip
        if parts := unknown_part(text):
            number, rest = parts
            return _refused(
                text, f"has '{rest}' beside '{number}', which flexcage does not know; set it apart "
                f'to leave it out, as in: flexcage new "{number} {rest}"',
            )  # fmt: skip
    elif _place(found) in _boundary():
        return _without_ratings(text, found)
    way = _uncaged_way(uncaged[1]) if uncaged else WAY
    return _refused(
        text, f"is not in the catalogue; {_nearest(found.bare if found else name)}, and any other "
        f"bearing is described by {way}",
    )  # fmt: skip


def _of_another_series(text: str, kind: str, own: str) -> InputError:
    """The sentence on a bearing of a kind and a type of which the catalogue has other series."""
    here = {name: row for name, row in series().items() if row["type"] == own}
    more = _wanted(next(iter(here.values())))
    options = " ".join(
        f'--{name} "..."' for name in ("bore", "outside", "width", "dynamic", "static")
    )
    further = "".join(f' {option} "..."' for _, option in more)
    return _refused(
        text, f"is {kind}, of which the catalogue has the series {', '.join(here)}; describe it by "
        f"flexcage new {plain(text)} --type {own} {options}{further}",
    )  # fmt: skip


def _refused(text: str, why: str) -> InputError:
    return InputError(f"'{text}' {why}.", where="designation", value=text)


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
    full = {name: row for name, row in series().items() if row["complement"] == FULL}
    return [f"{name} ({', '.join(row['makers_series'].split())})" for name, row in full.items()]


WAY = (
    'its dimensions and ratings, as in: flexcage new --type deep_groove_ball --bore "25 mm" '
    '--outside "52 mm" --width "15 mm" --dynamic "14 kN" --static "7.85 kN"'
)


def _nearest(name: str) -> str:
    """The known designations that are nearest to a name, or what the catalogue has at all."""
    close = near_names(name, _ratings())
    if not close:
        return f"it has ratings of the series {', '.join(_rated_series())}"
    return f"the nearest known {'one is' if len(close) == 1 else 'ones are'} {', '.join(close)}"


def _rated_series() -> list[str]:
    """Series of which there are ratings."""
    rated = {found.series for name in _ratings() if (found := read(name))}
    return [name for name in series() if name in rated]


def _same_rollers(name: str) -> str:
    """What there is in the place of another design, which has its rolling elements and races."""
    for first, row in series().items():
        for other in row["other_designs"].split():
            own = f"{first}{name.removeprefix(other)[:2]}"
            if re.match(rf"{other}\d\d(\D|$)", name) and own in _ratings():
                return f"; '{own}' has the same races and ratings"
    return ""


def _of_a_design(name: str) -> str:
    """The design of a cylindrical roller bearing that the catalogue has some series of; or ""."""
    match = re.fullmatch(r"([A-Z]+)\d{3,}[A-Z0-9]*", name)
    return match[1] if match and _series_of(match[1]) else ""


def _series_of(design: str) -> list[str]:
    """Its series with a cage."""
    caged = {name: row for name, row in series().items() if row["complement"] == CAGED}
    return [name for name, row in caged.items() if design and row["design"] == design]


def _without_ratings(text: str, found: Designation) -> InputError:
    """The sentence on a designation whose dimensions alone are known."""
    has = known(text) or {}
    row, (bore, outside, width) = series()[found.series], _boundary()[_place(found)]
    wanted = ["--dynamic", "--static"]
    wanted += [option for key, option in _wanted(row) if key not in has]
    others = [n for n in _ratings() if re.fullmatch(rf"{found.number}\D*", n)]
    listed = f"; it has {', '.join(others)}" if others else ""
    size = f"{bore.removesuffix(' mm')} x {outside.removesuffix(' mm')} x {width}"
    name = str(found) if plain(found.number) in plain(text) else found.bare
    options = " ".join(f'{option} "..."' for option in wanted)
    return InputError(
        f"The catalogue has no ratings of '{text}' ({size} by ISO 15{listed})"
        f"{_same_rollers(found.bare)}; give your maker's: flexcage new {name} {options}.",
        where="designation",
        value=text,
    )


def _wanted(row: dict[str, str]) -> list[tuple[str, str]]:
    """Keys and options of what bearings of a series need beside dimensions and ratings."""
    alike = [
        own for name, own in _all_rows().items()
        if (made := read(name)) and (other := series()[made.series])["type"] == row["type"]
        and other["complement"] == row["complement"]
        and (row["complement"] == CAGED or other["design"] == row["design"])
    ]  # fmt: skip
    return [pair for column, pair in _OPTIONS.items() if alike[0][column]]


def _place(found: Designation) -> tuple[str, str]:
    """Its diameter series, with that of widths where it has several, and bore code."""
    return series()[found.series]["diameter_series"], found.code


def _entry(found: Designation) -> Entry:
    row, made = _ratings()[found.bare], series()[found.series]
    bore, outside, width = (parse(text, "mm") for text in _boundary()[_place(found)])
    return Entry(
        outline=Outline(
            type=made["type"], designation=found.bare, bore=bore, outside_diameter=outside,
            width=width,
            static_rating=parse(f"{row['static_kN']} kN", "kN"),
            dynamic_rating=parse(f"{row['dynamic_kN']} kN", "kN"),
            contact_angle=_optional(row["contact_angle_deg"], "deg"),
            inner_race_diameter=_optional(row["inner_race_mm"], "mm"),
            outer_race_diameter=_optional(row["outer_race_mm"], "mm"),
            design=made["design"] or None,
            inner_rib_diameter=_optional(row["inner_rib_mm"], "mm"),
            outer_rib_diameter=_optional(row["outer_rib_mm"], "mm"),
            complement=made["complement"],
            left_out=(made["left_out"],) if made["left_out"] else (),
            further={k: parse(f"{v} mm", "mm") for k, v in further("ratings", row).items()},
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
