"""A new case for a bearing of a catalogue, as commented TOML that runs as it stands."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from math import ceil, floor, log10
from typing import Any

import numpy as np

from flexcage.bearings.family import in_motion, inference_of
from flexcage.cages.cage_type import proposal_of
from flexcage.cages.halves import is_one_piece, meeting
from flexcage.case.case import load_case
from flexcage.case.marked import of_mark, rolling, unmarked
from flexcage.case.presets import NAMED
from flexcage.case.sections import NO_CAGE
from flexcage.case.static import load_static
from flexcage.core.binding import default_of, did_you_mean, to_table
from flexcage.core.errors import InputError, in_one_line
from flexcage.core.units import describe
from flexcage.geometry.bearing import BEARING_TYPES, Bearing, check_type
from flexcage.geometry.cage import cages_of
from flexcage.geometry.full_complement import CAGED, FILLED, FULL, filled, reason_of_count
from flexcage.geometry.inference import (
    Candidate,
    Inference,
    MarkedCage,
    Outline,
    ProposedCage,
    in_short,
    ranked,
)
from flexcage.geometry.kinematics import rolling_shares
from flexcage.results.bootstrap import FEWEST
from flexcage.results.options import OutputOptions

SHOWN = 4  # candidates that are told
_LOAD = 0.05  # of the dynamic rating
# m/min, speed [rpm] times pitch diameter: moderate for any bearing, and without a cage, where
# surfaces of neighbours move against each other, for about half of makers' reference speeds
_SPEED, _UNCAGED_SPEED = 250.0, 125.0
_PASSES = 1.2 * FEWEST  # of elements in the settled part: enough for intervals


@dataclass(frozen=True, kw_only=True)
class NewCase:
    """A written case: its text, and what it was inferred from. ``candidates`` are those whose
    ratings fit, best first; ``chosen`` is the first of them that leaves a cage its place, with as
    many elements as fit where they shall fill the circle instead (``FILLED``)."""

    name: str
    text: str
    outline: Outline
    source: str
    chosen: Candidate
    candidates: Sequence[Candidate]

    def findings(self) -> list[str]:
        """Lines for a terminal: what was inferred, how well it fits, and what fits nearly."""
        return _findings(self.outline, self.source, self.chosen, self.candidates)


def new_case(outline: Outline, source: str, *, cage: str | None = None) -> NewCase:
    """The case of a bearing that a catalogue, named by ``source``, describes, with the type of
    cage that such bearings commonly have, with another, or with "none"; InputError if there is no
    such bearing or none of its cages is of that type."""
    check_type(outline.type)
    inference = inference_of(BEARING_TYPES[outline.type])
    if cage == NO_CAGE and outline.complement == CAGED:
        outline = replace(outline, complement=FILLED)
    if outline.complement != CAGED:
        return _without_cage(outline, source, inference, cage)
    candidates = [rolling(c) for c in ranked(inference.candidates(outline))]
    _check_cage(cage, candidates[0].bearing.element)
    usual = inference.cages[outline.type]
    if not (in_motion(BEARING_TYPES[outline.type]) and (cage or usual)):
        return _as_it_is(outline, source, candidates)
    wanted = [None, outline.cage] if outline.cage and cage in (None, outline.cage.type) else [None]
    refused = None
    while wanted:
        marked = wanted.pop()
        made, refused = _with_cage(outline, source, candidates, cage or usual, marked)
        if made:
            return made
        if marked:
            outline = unmarked(outline, marked)
    assert refused is not None  # there is a candidate, or ``ranked`` has raised
    if cage in (None, usual):
        raise refused
    raise InputError(
        f"No {cage} cage of usual proportions fits into {_called(outline)}: "
        f"{str(refused).rstrip('.')}; take --cage {usual}, the usual one of such bearings.",
        where="cage.type",
        value=cage,
    )


def _with_cage(
    outline: Outline, source: str, candidates: Sequence[Candidate], cage: str,
    marked: MarkedCage | None,
) -> tuple[NewCase | None, InputError | None]:  # fmt: skip
    """The case of the first candidate that leaves a cage of this type its place, or of that which
    a mark names; or the first reason why none does."""
    propose, refused = proposal_of(marked.type if marked else cage), None
    for candidate in candidates:
        try:
            proposed = _in_its_row(propose(candidate.bearing.one_row), candidate.bearing)
            if marked:
                proposed = of_mark(proposed, marked)
            text = _text(outline, source, candidate, candidates, proposed)
            load_case(text)
        except InputError as exc:
            refused = refused or exc
            continue
        made = NewCase(
            name=case_name(outline), text=text, outline=outline, source=source, chosen=candidate,
            candidates=candidates,
        )  # fmt: skip
        return made, None
    return None, refused


def _without_cage(outline: Outline, source: str, inference: Inference, cage: str | None) -> NewCase:
    """The case of a full complement: one with such ratings, or one that is rated with a cage."""
    if cage not in (None, NO_CAGE):
        raise InputError(
            f"{_called(outline)} has no cage: its elements fill the pitch circle; leave --cage "
            f"{cage} out.",
            where="cage.type",
            value=cage,
        )
    if outline.complement == FULL:
        if inference.full is None:
            kind = outline.type.replace("_", " ")
            raise InputError(
                f"The internal geometry of a {kind} bearing is not inferred from ratings of a "
                "full complement; give those with a cage without --cage none, then write model = "
                '"none" in [cage].',
                where="cage.type",
            )
        candidates = [rolling(c) for c in ranked(inference.full(outline))]
        chosen = candidates[0]
    else:
        candidates = [rolling(c) for c in ranked(inference.candidates(outline))]
        bearing = filled(candidates[0].bearing, inference.count)
        reasons = {**candidates[0].reasons, inference.count: reason_of_count(bearing)}
        chosen = replace(candidates[0], bearing=bearing, reasons=reasons)
    text = _text(outline, source, chosen, candidates, None)
    load_case(text)
    return NewCase(
        name=case_name(outline), text=text, outline=outline, source=source, chosen=chosen,
        candidates=candidates,
    )  # fmt: skip


def _as_it_is(outline: Outline, source: str, candidates: Sequence[Candidate]) -> NewCase:
    """The case of a bearing of which there is a static solution alone, or that no usual cage
    fits."""
    if outline.cage:
        outline = unmarked(outline, outline.cage, caged=False)
    text = _text(outline, source, candidates[0], candidates, None)
    runs = in_motion(BEARING_TYPES[outline.type])
    (load_case if runs else load_static)(text)
    return NewCase(
        name=case_name(outline), text=text, outline=outline, source=source, chosen=candidates[0],
        candidates=candidates,
    )  # fmt: skip


def _called(outline: Outline) -> str:
    return outline.designation or "this bearing"


def _check_cage(cage: str | None, element: str) -> None:
    """Refuse a type of cage that does not hold such elements."""
    known = cages_of(element)
    if cage is not None and cage not in known:
        raise InputError(
            f"There is no cage of type '{cage}' for {element}s; "
            f"{did_you_mean(cage, (*known, NO_CAGE), 'choose from')}.",
            where="cage.type",
            value=cage,
        )


def case_name(outline: Outline) -> str:
    """Name of the case, and of its file."""
    if outline.designation:
        name = re.sub(r"[^A-Za-z0-9_-]", "", outline.designation)
        if name:
            return name
    return "x".join(f"{1e3 * value:g}" for value in outline.boundary.values())


def _findings(
    outline: Outline, source: str, chosen: Candidate, candidates: Sequence[Candidate]
) -> list[str]:
    static, dynamic = chosen.bearing.rating_names
    caged = candidates[0] if outline.complement == FILLED else chosen
    others = [c for c in candidates if c is not caged][: SHOWN - 1]
    return [
        f"{chosen.bearing.name_and_size}",
        f"Ratings: {dynamic} = {_kn(outline.dynamic_rating)}, "
        f"{static} = {_kn(outline.static_rating)} ({source}).",
        *outline.left_out,
        f"Internal geometry, inferred: {_residuals(caged)}.",
        *_play(outline, chosen),
        *(
            f"{'Next best' if k == 0 else '     then'}: {_residuals(c)}."
            for k, c in enumerate(others)
        ),
    ]


def _play(outline: Outline, chosen: Candidate) -> list[str]:
    """On a full complement: how many elements, with what play, and what ratings."""
    if outline.complement == CAGED:
        return []
    bearing = chosen.bearing
    static, dynamic = bearing.rating_names
    how = reason_of_count(bearing).removeprefix("assumption: ")
    count = f"{bearing.element_count} {bearing.element}s"
    if outline.complement == FULL:
        return [f"No cage: {count}, {how}."]
    return [
        f"No cage: {count}, {how}; {static} = {_kn(bearing.static_rating)} by ISO 76, "
        f"{dynamic} = {_kn(bearing.dynamic_rating)} by ISO 281. How they are filled in is left out."
    ]


def _residuals(candidate: Candidate) -> str:
    static, dynamic = candidate.bearing.rating_names
    bearing = candidate.bearing
    return (
        f"{in_short(bearing)} on {describe(round(bearing.pitch_diameter, 6), 'mm')}; "
        f"{static} = {_kn(bearing.static_rating)} by ISO 76 ({candidate.static_error:+.1%}), "
        f"{dynamic} = {_kn(bearing.dynamic_rating)} by ISO 281 (as rated: "
        f"{candidate.makers_factor:.2f} times that)"
    )


def _kn(force: float) -> str:
    return f"{force / 1e3:.3g} kN" if force < 1e6 else f"{force / 1e3:.0f} kN"


def _text(
    outline: Outline, source: str, chosen: Candidate, candidates: Sequence[Candidate],
    proposed: ProposedCage | None,
) -> str:  # fmt: skip
    name, bearing = case_name(outline), chosen.bearing
    head = [f"# {in_one_line(line)}" for line in _findings(outline, source, chosen, candidates)]
    given = _reasons_of_outline(outline)
    load = "axial" if outline.contact_angle and not bearing.self_aligning else "radial"
    runs = in_motion(type(bearing))
    caged = proposed is not None or not runs
    speed = _speed(bearing.pitch_diameter, caged=caged)
    sections = [
        ("bearing", _entries(bearing, {"type": "", "designation": "", **given, **chosen.reasons})),
        ("cage", _cage(proposed, bearing, full=outline.complement != CAGED)),
        ("drive", [(
            "speed", f'"{speed} rpm"',
            "assumption: moderate" if caged else "assumption: moderate without a cage",
        )]),
        ("load", [(
            load, f'"{_two_digits(_LOAD * outline.dynamic_rating):g} N"',
            f"assumption: {_LOAD:.0%} of the dynamic rating",
        )]),
        ("solver", [(
            "duration", f'"{_duration(bearing, speed)} ms"',
            "assumption: long enough for means and intervals",
        )]),
    ]  # fmt: skip
    if not runs:
        sections = [pair for pair in sections if pair[0] not in ("cage", "solver")]
    lines = [
        *head,
        "# Makers do not publish internal geometry: what is inferred or assumed is marked.",
        f"# flexcage {'run' if runs else 'static'} {name}.toml",
        f'name = "{name}"',
    ]
    for section, entries in sections:
        lines += ["", f"[{section}]", *_aligned(entries)]
    return "\n".join(lines) + "\n"


def _in_its_row(proposed: ProposedCage, bearing: Bearing) -> ProposedCage:
    """The cage of a row, as wide as makes those of two rows one piece where there is room, or
    narrower where they would overlap."""
    places = bearing.row_places
    if bearing.row_count == 1 or is_one_piece(proposed.cage, places):
        return proposed
    apart = float(np.ptp([row.place for row in places]))
    whole = meeting(proposed.cage, places)
    if whole is not None and not any(whole.impossible(bearing.element_count)):
        why = "from the rows' distance: both halves meet in the middle and are one piece"
        return replace(proposed, cage=whole, reasons={**proposed.reasons, "width": why})
    if 2.0 * (proposed.cage.axial_width - proposed.cage.axial_reach) <= apart:
        return proposed
    reasons = {**proposed.reasons, "width": "assumption: the cages of both rows meet in the middle"}
    narrower: dict[str, Any] = {"width": round(apart, 6)}  # a key of all that two rows may have
    return replace(proposed, cage=replace(proposed.cage, **narrower), reasons=reasons)


def _cage(
    proposed: ProposedCage | None, bearing: Bearing, *, full: bool
) -> list[tuple[str, str, str]]:
    if proposed is None:
        why = "full complement" if full else "assumption: none of usual proportions has room"
        return [("model", f'"{NO_CAGE}"', f"{why}: elements touch the next ones")]
    model = ("model", '"flexible"', "")
    if bearing.row_count > 1:
        model = ("model", '"rigid"', "one cage for both rows, each half as follows")
        if is_one_piece(proposed.cage, bearing.row_places):
            model = ("model", '"flexible"', "one piece for both rows, each half as follows")
    return [
        model,
        *_entries(proposed.cage, {"type": "", **proposed.reasons}),
    ]


def _reasons_of_outline(outline: Outline) -> dict[str, str]:
    """Why the dimensions of the outline are as they are."""
    races = {
        f"{side}_race_diameter": f"given: race diameter {letter}"
        for side, letter in (("inner", "F"), ("outer", "E"))
        if getattr(outline, f"{side}_race_diameter") is not None
    }
    others = ("contact_angle", "design")
    given = {key: "given" for key in others if getattr(outline, key) is not None}
    return {**dict.fromkeys(outline.boundary, "given: boundary dimension"), **races, **given}


def _entries(spec: Any, reasons: Mapping[str, str]) -> list[tuple[str, str, str]]:
    """Key, value and comment of a spec's values: those with a reason, and all that are not as they
    would be anyway."""
    table = to_table(spec, named=NAMED)
    plain = {f.name for f in fields(spec) if getattr(spec, f.name) == default_of(f)}
    wanted = [key for key in table if key in reasons or key not in plain]
    return [(key, _value(table[key]), reasons.get(key, "")) for key in wanted]


def _value(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else str(value)


def _aligned(entries: Sequence[tuple[str, str, str]]) -> list[str]:
    pairs = [(f"{key} = {value}", reason) for key, value, reason in entries]
    wide = max(len(pair) for pair, _ in pairs) + 2
    return [f"{pair:<{wide}}# {reason}" if reason else pair for pair, reason in pairs]


def _speed(pitch_diameter: float, *, caged: bool) -> int:
    """Speed [rpm], to two digits."""
    return int(_two_digits((_SPEED if caged else _UNCAGED_SPEED) / pitch_diameter))


def _duration(bearing: Bearing, speed: float) -> int:
    """Duration [ms], to ten, in whose settled part the cage turns once and elements pass often
    enough; ``speed`` [rpm] is the inner ring's."""
    ratio = bearing.element_diameter / bearing.pitch_diameter
    angle = bearing.nominal_contact_angle
    turns = rolling_shares(ratio, (angle, angle)).orbit * speed / 60e3  # of the cage, in a ms
    settled = 1.0 - OutputOptions().settle
    return 10 * ceil(max(1.0, _PASSES / bearing.element_count) / (10.0 * settled * turns))


def _two_digits(value: float) -> float:
    step = 10.0 ** (floor(log10(value)) - 1)
    return round(value / step) * step
