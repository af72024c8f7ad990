"""Commands that take the folders of runs: render, compare."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from flexcage.cli.files import existing_run, prepare_out
from flexcage.cli.parser import command, say
from flexcage.cli.settings import case_from
from flexcage.core.errors import InputError


def add_commands(commands: Any) -> None:
    """Add this module's commands to the parser."""
    render = command(commands, "render", render_command, "draw the pictures of a stored run")
    render.add_argument("run", metavar="RUN", help="run folder")
    render.add_argument("-o", "--out", metavar="DIR", help="folder for the pictures")
    render.add_argument("--animate", action="store_true", help="make an animation as well")
    compare = command(
        commands, "compare", compare_command, "one case rigid and flexible, or two runs"
    )
    compare.add_argument("what", nargs="+", metavar="CASE|RUN", help="a case, or two run folders")
    compare.add_argument("--set", action="append", metavar="PATH=VALUE", help="change a value")
    compare.add_argument("-o", "--out", metavar="DIR", help="folder for table, plot and runs")
    compare.add_argument("--force", action="store_true", help="write an existing folder anew")


def render_command(args: argparse.Namespace) -> int:
    """flexcage render RUN: draw the pictures of a stored run again."""
    from flexcage.simulate import load_run

    run = load_run(existing_run(args.run))
    out = Path(args.out) if args.out else Path(args.run) / "images"
    run.draw(out, animate=args.animate)
    say(f"The pictures are in {out}")
    return 0


def compare_command(args: argparse.Namespace) -> int:
    """flexcage compare CASE (rigid against flexible), or RUN RUN."""
    from flexcage.core.progress import Progress
    from flexcage.study.compare import compare, compare_case

    if len(args.what) == 2:
        first, second = (existing_run(path) for path in args.what)
        out = Path(args.out) if args.out else Path("compare")
        prepare_out(out, resume=False, force=args.force, resumable=False)
        say(compare(first, second, out=out))
        return 0
    if len(args.what) != 1:
        raise InputError("compare wants one case, or two run folders.", where="compare")
    args.case = args.what[0]
    case = case_from(args)
    out = Path(args.out) if args.out else Path("runs") / f"{case.name}-compare"
    prepare_out(out, resume=False, force=args.force, resumable=False)
    say(compare_case(case, out=out, progress=Progress))
    return 0
