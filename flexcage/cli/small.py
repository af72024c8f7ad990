"""Commands without a case or a run: presets, verify, doctor, cache."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from flexcage.bearings import in_motion
from flexcage.cli.files import prepare_file
from flexcage.cli.parser import command, say
from flexcage.core.listing import aligned, wrapped


def add_commands(commands: Any) -> None:
    """Add this module's commands to the parser."""
    _add_verify(commands)
    _add_small(commands)


def _add_verify(commands: Any) -> None:
    text = "compute cases with known answers, and compare"
    verify = command(commands, "verify", verify_command, text)
    verify.add_argument("names", nargs="*", metavar="NAME", help="cases (default: all)")
    extent = verify.add_mutually_exclusive_group()
    extent.add_argument(
        "--quick", action="store_true", help="only those that need no compiled bearing"
    )
    extent.add_argument("--all", action="store_true", help="the long ones as well (the default)")
    verify.add_argument("--list", action="store_true", help="name the cases, compute nothing")
    verify.add_argument("-o", "--out", metavar="FILE", help="write a chapter (.md), or .json")
    verify.add_argument("--force", action="store_true", help="write over an existing file")


def _add_small(commands: Any) -> None:
    presets = command(commands, "presets", presets_command, "list presets, or show one")
    presets.add_argument("name", nargs="?", metavar="NAME")
    command(commands, "doctor", doctor_command, "what this machine lacks, and the remedy")
    cache = command(commands, "cache", cache_command, "what the cache on disk holds")
    cache.add_argument("--clear", action="store_true", help="remove all of it")


def presets_command(args: argparse.Namespace) -> int:
    """flexcage presets [NAME]: the list, or one preset with its assumptions."""
    from flexcage.case.presets import load_preset, preset_names
    from flexcage.core.binding import flat

    if args.name is None:
        say(aligned([(name, load_preset(name).title) for name in preset_names()]))
        return 0
    preset = load_preset(args.name)
    reasons = preset.assumptions
    say(wrapped(preset.title))
    rows = [(path, str(v), _assumed(reasons.get(path))) for path, v in flat(preset.tables)]
    say(aligned(rows, indent=2))
    if assumed := _default_assumptions(preset):
        say("\n  and in a case that says no more:")
        rows = [(path, value, _assumed(reason)) for path, (value, reason) in assumed.items()]
        say(aligned(rows, indent=2))
    say()
    for name, stated, computed in preset.ratings():
        say(f"  {name}: catalogue {stated / 1e3:.1f} kN, from this inside {computed / 1e3:.2f} kN")
    for name, text in preset.sources.items():
        say(wrapped(f"{name}: {text}", first="  ", rest="    "))
    return 0


def _assumed(reason: str | None) -> str:
    return f"assumption: {reason}" if reason else ""


def _default_assumptions(preset: Any) -> dict[str, tuple[str, str]]:
    """Assumptions of a case that names the preset and no more, beside the preset's own."""
    if not in_motion(type(preset.bearing)):
        return {}
    from flexcage.case import Case, description

    assumed = description.assumed(Case.from_preset(preset.name))
    return {path: found for path, found in assumed.items() if path not in preset.assumptions}


def verify_command(args: argparse.Namespace) -> int:
    """flexcage verify [NAMES]: known answers against what flexcage computes; 1 if one is missed."""
    from flexcage.verification import chosen, report, run_case

    cases = chosen(args.names, quick=args.quick)
    if args.list:
        say(aligned([(c.name, "quick" if c.quick else "long", c.title) for c in cases]))
        return 0
    out = Path(args.out) if args.out else None
    if out is not None:
        prepare_file(out, report.FORMATS, force=args.force)
    outcomes = [run_case(case) for case in cases]
    say(report.table(outcomes))
    if out is not None:
        report.write(outcomes, out)
        say(f"written: {out}")
    return 0 if all(outcome.passed for outcome in outcomes) else 1


def doctor_command(args: argparse.Namespace) -> int:
    """flexcage doctor: what this machine lacks, and the remedy."""
    from flexcage.core.environment import probe

    lacking = 0
    for finding in probe():
        word = "ok" if finding.ok else ("LACKS" if finding.needed else "could be better")
        say(wrapped(finding.detail, first=f"{finding.name:<14} {word:<16} "))
        if not finding.ok:
            say(wrapped(f"remedy: {finding.remedy}", first=" " * 15))
            lacking += finding.needed
    return 1 if lacking else 0


def cache_command(args: argparse.Namespace) -> int:
    """flexcage cache [--clear]: what the cache holds."""
    from flexcage.core.cache import cache_info, clear_cache

    if args.clear:
        say(f"freed {clear_cache() / 1e6:.1f} MB")
    else:
        say(cache_info())
    return 0
