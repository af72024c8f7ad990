"""The command new: a case for a bearing of a catalogue."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flexcage.cli.files import prepare_file
from flexcage.cli.parser import command, say
from flexcage.core.listing import wrapped
from flexcage.core.writing import write_text

if TYPE_CHECKING:
    from flexcage.geometry.inference import Outline

_DIMENSIONS = (
    ("--bore", "bore", "mm", "bore, as '25 mm'"),
    ("--outside", "outside_diameter", "mm", "outside diameter"),
    ("--width", "width", "mm", "width"),
    ("--dynamic", "dynamic_rating", "kN", "basic dynamic load rating C, as '14 kN'"),
    ("--static", "static_rating", "kN", "basic static load rating C0"),
)
_FURTHER = (
    ("--contact-angle", "contact_angle", "deg", "of an angular contact bearing, or a tapered one"),
    ("--inner-race", "inner_race_diameter", "mm", "race diameter F under the rollers"),
    ("--outer-race", "outer_race_diameter", "mm", "race diameter E over the rollers"),
)


def add_commands(commands: Any) -> None:
    """Add this module's command to the parser."""
    text = "write a case for a designation (6205, NU 210 C3, 7208B), or for dimensions and ratings"
    new = command(commands, "new", new_command, text)
    new.add_argument("designation", nargs="*", metavar="DESIGNATION", help="such as 6205")
    new.add_argument("--type", metavar="TYPE", help="type of bearing, as deep_groove_ball")
    new.add_argument("--design", metavar="DESIGN", help="of a cylindrical roller bearing, as NU")
    for option, key, _, what in (*_DIMENSIONS, *_FURTHER):
        new.add_argument(option, dest=key, metavar=key.split("_")[-1].upper(), help=what)
    new.add_argument("--cage", metavar="TYPE", help="type of cage, as crown, or none")
    new.add_argument("-o", "--out", metavar="FILE", help="case file (.toml) to write")
    new.add_argument("--force", action="store_true", help="write over an existing file")


def new_command(args: argparse.Namespace) -> int:
    """flexcage new DESIGNATION [-o FILE]: a commented case, and how its internal geometry
    was found."""
    from flexcage.case.new import case_name, new_case

    outline, source = _outline(args)
    out = Path(args.out or f"{case_name(outline)}.toml")
    prepare_file(out, (".toml",), force=args.force)
    made = new_case(outline, source, cage=args.cage)
    write_text(out, made.text)
    for line in made.findings():
        first = " " * (len(line) - len(line.lstrip()))
        say(wrapped(line.lstrip(), first=first, rest="  "))
    say(f"written: {out}")
    return 0


def _outline(args: argparse.Namespace) -> tuple[Outline, str]:
    """What is known of the bearing, and from where: a catalogue's entry, what the options say, or
    the one changed by the other."""
    from flexcage.case.catalogue import WAY, find, known, with_marks
    from flexcage.case.marks import rated_by_user
    from flexcage.case.sections import NO_CAGE
    from flexcage.core.errors import InputError
    from flexcage.geometry.bearing import check_type
    from flexcage.geometry.full_complement import CAGED, FULL
    from flexcage.geometry.inference import Outline

    name = " ".join(args.designation)
    if args.type is not None:
        check_type(args.type)
    given = _given(args)
    lacking = [option for option, key, _, _ in _DIMENSIONS if key not in given]
    lacking = lacking if args.type else ["--type", *lacking]
    if not lacking:
        complement = FULL if args.cage == NO_CAGE else CAGED
        own = Outline(
            type=args.type, design=args.design, designation=name, complement=complement, **given
        )
        return with_marks(own), "given by the user"
    if not name:
        what = f"{', '.join(lacking)} missing; " if given or args.type else ""
        raise InputError(f"{what}give a designation, such as 6205, or {WAY}.", where="designation")
    rated = {"dynamic_rating", "static_rating"} <= given.keys()
    if rated and (sizes := known(name)):
        _check_alike(args, name, sizes["type"], sizes["design"], lacking)
        _check_sizes(given, name, lacking)
        own = Outline(designation=name, **{**sizes, **given})
        return with_marks(own), "given by the user; dimensions of ISO 15"
    entry = find(name)
    _check_alike(args, name, entry.outline.type, entry.outline.design, lacking)
    _check_sizes(given, name, lacking)
    options = [option for option, key, _, _ in (*_DIMENSIONS, *_FURTHER) if key in given]
    changed = f"{entry.source}; {', '.join(options)} given by the user" if given else entry.source
    made = replace(entry.outline, **given)
    return rated_by_user(made) if rated else made, changed


def _given(args: argparse.Namespace) -> dict[str, Any]:
    """Dimensions and ratings that the options give, by keys of an outline."""
    from flexcage.core.units import parse

    return {
        key: _positive(parse(text, unit, where=option), option, text)
        for option, key, unit, _ in (*_DIMENSIONS, *_FURTHER)
        if (text := getattr(args, key)) is not None
    }


def _check_alike(
    args: argparse.Namespace, name: str, kind: str, design: str | None, lacking: list[str]
) -> None:
    """Refuse another type or design than the designation means."""
    from flexcage.core.errors import InputError

    if args.type not in (None, kind):
        raise InputError(
            f"'{name}' is a bearing of type '{kind}', not '{args.type}'; leave "
            f"--type out, or give {', '.join(lacking)} as well.",
            where="--type",
        )
    if args.design not in (None, design):
        raise InputError(
            f"'{name}' is {_of_design(design)}, not of '{args.design}'; leave "
            f"--design out, or give {', '.join(lacking)} as well.",
            where="--design",
        )


def _check_sizes(given: dict[str, Any], name: str, lacking: list[str]) -> None:
    """Refuse boundary dimensions beside a designation that has its own."""
    from flexcage.core.errors import InputError

    if given.keys() & {"bore", "outside_diameter", "width"}:
        raise InputError(
            f"The boundary dimensions of '{name}' are known; leave them out, or give "
            f"{', '.join(lacking)} as well.",
            where="designation",
        )


def _of_design(design: str | None) -> str:
    return f"of the design '{design}'" if design else "of no design"


def _positive(value: float, option: str, text: str) -> float:
    from flexcage.core.errors import InputError

    if not value > 0.0:
        raise InputError(f"{option} is '{text}', but must be greater than zero.", where=option)
    return value
