"""The case that a command line names, with the values that its options change."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from flexcage.core.errors import InputError


def case_from(args: argparse.Namespace) -> Any:
    """Case named on the command line, with --set and --cage applied."""
    from flexcage.case import load_case

    overrides = settings_of(args)
    if getattr(args, "cage", None):
        overrides["cage.model"] = args.cage
    return load_case(Path(args.case), overrides=overrides)


def settings_of(args: argparse.Namespace) -> dict[str, Any]:
    """Values of --set by path."""
    return dict(parse_setting(text) for text in args.set or ())


def parse_setting(text: str) -> tuple[str, Any]:
    """Path and value of "cage.pocket_width=8.25 mm"; a bare number or flag is read as TOML."""
    path, sign, value = text.partition("=")
    path, value = path.strip(), value.strip()
    if not sign or not path:
        raise InputError(f"--set {text!r} should read path=value, such as 'load.radial=500 N'.")
    import tomllib

    try:
        return path, tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError:
        return path, value
