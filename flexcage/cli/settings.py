"""The case that a command line names, with the values that its options change."""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path
from typing import Any

from flexcage.core.errors import InputError
from flexcage.core.toml import read_toml


def case_from(args: argparse.Namespace) -> Any:
    """Case named on the command line, with --set and --cage applied."""
    from flexcage.case import load_case

    overrides = settings_of(args)
    if getattr(args, "cage", None):
        overrides["cage.model"] = args.cage
    return load_case(Path(args.case), overrides=overrides)


def checked_case_from(args: argparse.Namespace) -> Any:
    """The same, for commands that simulate nothing: logs which given values nothing reads."""
    import logging

    from flexcage.case.unread import not_used

    case = case_from(args)
    for text in not_used(case):
        logging.getLogger(__name__).warning("%s", text)
    return case


def case_or_static(args: argparse.Namespace) -> Any:
    """The case named on the command line with --set applied: one that can be run or, of a file
    without a cage, that of a static solution."""
    from flexcage.case import load_case, load_static

    try:
        return load_case(Path(args.case), overrides=settings_of(args))
    except InputError as whole:
        try:
            return load_static(Path(args.case), overrides=settings_of(args))
        except InputError as alone:
            raise alone if "cage" in str(whole.where or "") else whole from None


def settings_of(args: argparse.Namespace) -> dict[str, Any]:
    """Values of --set by path, and that of --fineness."""
    found = dict(parse_setting(text) for text in args.set or ())
    if getattr(args, "fineness", None):
        found["mesh.fineness"] = args.fineness
    return found


def look_of(args: argparse.Namespace) -> dict[str, float]:
    """Values of --view, --stress-limit and --scale in SI, those that are given, checked."""
    from flexcage.core.binding import check_value
    from flexcage.core.units import parse
    from flexcage.render.look import Look

    found = {}
    for field in dataclasses.fields(Look):
        text, name = getattr(args, field.name), "--" + field.name.replace("_", "-")
        if text is not None:
            unit = field.metadata.get("unit")
            found[field.name] = parse(text, unit, where=name) if unit else _number(text, name)
            check_value(found[field.name], field.metadata, name)
    return found


def _number(text: str, name: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise InputError(
            f"{name} is '{text}', but should be a number, such as 50.", where=name, value=text
        ) from None


def parse_setting(text: str) -> tuple[str, Any]:
    """Path and value of "cage.pocket_width=8.25 mm"; a bare number or flag is read as TOML."""
    path, sign, value = text.partition("=")
    path, value = path.strip(), value.strip()
    if not sign or not path:
        raise InputError(f"--set {text!r} should read path=value, such as 'load.radial=500 N'.")
    try:
        return path, read_toml(f"value = {value}", text)["value"]
    except InputError:
        return path, value
