"""Commands that take a study: plan, run, resume, merge, status, report, map."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from flexcage.cli.parser import command, say, say_shard, version_option, whole_number
from flexcage.cli.settings import settings_of
from flexcage.mesh.options import FINENESS


def add_commands(commands: Any) -> None:
    """Add this module's commands to the parser."""
    study = commands.add_parser("study", help="many cases on all cores or a cluster, and one table")
    actions = study.add_subparsers(title="actions", metavar="ACTION", required=True)
    run = command(actions, "run", study_run_command, "compute what a study's folder lacks")
    run.add_argument("study", metavar="STUDY", help="study file (.toml)")
    run.add_argument("-o", "--out", metavar="DIR", help="study folder (default: runs/NAME)")
    run.add_argument(
        "--shard", metavar="I/N", help="compute the I-th of N parts only; 'study merge' gathers"
    )
    plan = command(actions, "plan", study_plan_command, "check all cases and write their plan")
    plan.add_argument("study", metavar="STUDY", help="study file (.toml)")
    plan.add_argument("-o", "--out", metavar="DIR", help="study folder (default: runs/NAME)")
    for parser in (run, plan):
        _of_base_case(parser)
    resume = command(actions, "resume", study_resume_command, "go on with a study that stopped")
    resume.add_argument("dir", metavar="DIR", help="study folder")
    for parser in (run, resume):
        where = parser.add_mutually_exclusive_group()
        where.add_argument(
            "--workers", type=whole_number, metavar="N", help="processes (default: cores)"
        )
        where.add_argument("--scheduler", metavar="ADDRESS", help="a running Dask scheduler")
        parser.add_argument("--retry", action="store_true", help="try failed cases again")
        version_option(parser)
    merge = command(actions, "merge", study_merge_command, "gather the shards of a study")
    merge.add_argument("dir", metavar="DIR", help="study folder")
    version_option(merge)
    unknowns = command(actions, "map", study_map_command, "sample unknowns, and say what decides")
    unknowns.add_argument("map", metavar="MAP", help="map file (.toml)")
    unknowns.add_argument("-o", "--out", metavar="DIR", help="map folder (default: runs/NAME)")
    unknowns.add_argument(
        "--workers", type=whole_number, metavar="N", help="processes (default: cores)"
    )
    unknowns.add_argument(
        "--points", type=_numbers, metavar="N,N", help="only these points of it, from 0"
    )
    _of_base_case(unknowns)
    version_option(unknowns)
    for name, function, text in (
        ("status", study_status_command, "count what is done, failed and open"),
        ("report", study_report_command, "print and write the table"),
    ):
        command(actions, name, function, text).add_argument("dir", metavar="DIR", help="folder")
    surface = command(
        actions, "surface", study_surface_command, "lay a surface through an output, find its least"
    )
    surface.add_argument("dir", metavar="DIR", help="folder")
    surface.add_argument("output", metavar="OUTPUT", help="an output of the study")
    surface.add_argument("--axes", metavar="PATHS", help="axes, as a,b (default: all that vary)")
    surface.add_argument(
        "--where", action="append", metavar="PATH=VALUE", help="only cases that have this value"
    )
    surface.add_argument("--highest", action="store_true", help="look for the highest value")
    surface.add_argument("--model", choices=("quadratic", "kriging"), help="default: both")


def _of_base_case(parser: Any) -> None:
    parser.add_argument(
        "--set", action="append", metavar="PATH=VALUE", help="change a value of the base case"
    )
    parser.add_argument(
        "--fineness", choices=FINENESS, help="of the cage's mesh: stress wants medium or fine"
    )


def _numbers(text: str) -> list[int]:
    if not all(part.strip().isdecimal() for part in text.split(",")):
        raise argparse.ArgumentTypeError(f"'{text}' should be whole numbers, as 0,3,17")
    return [int(part) for part in text.split(",")]


def study_run_command(args: argparse.Namespace) -> int:
    """flexcage study run STUDY: compute what the study's folder lacks, and print its table."""
    from flexcage.study.spec import load_study

    study = load_study(args.study, overrides=settings_of(args))
    args.out = Path(args.out) if args.out else Path("runs") / study.name
    return _run_shard(study, args) if args.shard else compute_study(study, args)


def _run_shard(study: Any, args: argparse.Namespace) -> int:
    from flexcage.core.errors import InputError
    from flexcage.core.progress import Progress
    from flexcage.study.sharded import run_shard

    if args.scheduler:
        raise InputError(
            "A shard is computed by this machine alone; leave out --scheduler, or --shard.",
            where="shard",
        )
    state = run_shard(
        study, out=args.out, shard=args.shard, workers=args.workers, retry=args.retry,
        progress=Progress,
    )  # fmt: skip
    return say_shard(state, f"study merge {args.out}")


def study_plan_command(args: argparse.Namespace) -> int:
    """flexcage study plan STUDY: check all cases of a study and write its plan."""
    from flexcage.study.sharded import plan_study
    from flexcage.study.spec import load_study

    study = load_study(args.study, overrides=settings_of(args))
    args.out = Path(args.out) if args.out else Path("runs") / study.name
    say(f"{len(plan_study(study, out=args.out).cases)} cases are planned in {args.out}")
    return 0


def study_merge_command(args: argparse.Namespace) -> int:
    """flexcage study merge DIR: gather the shards of a study, and print its table."""
    from flexcage.study.sharded import merge_study
    from flexcage.study.shards import missing_words

    results, lacking = merge_study(args.dir, other_version=args.other_version)
    say(results.report())
    if lacking:
        say(missing_words(lacking, f"flexcage study run STUDY -o {args.dir}"))
    return 1 if lacking or results.count("failed") else 0


def study_resume_command(args: argparse.Namespace) -> int:
    """flexcage study resume DIR: go on with a study that stopped."""
    from flexcage.study.folder import Folder

    args.out = Path(args.dir)
    return compute_study(Folder(args.out).study(), args)


def compute_study(study: Any, args: argparse.Namespace) -> int:
    """Run a study in the folder ``args.out``; 1 if a case of it failed."""
    from flexcage.core.progress import Progress
    from flexcage.study.run import run_study

    results = run_study(
        study, out=args.out, workers=args.workers, scheduler=args.scheduler, retry=args.retry,
        other_version=args.other_version, progress=Progress,
    )  # fmt: skip
    say(results.report())
    say(f"\nThe study is in {args.out}")
    return 1 if results.count("failed") else 0


def study_map_command(args: argparse.Namespace) -> int:
    """flexcage study map MAP: compute what the map's folder lacks, and print what decides."""
    from flexcage.core.progress import Progress
    from flexcage.study.map_report import map_text, write_map
    from flexcage.study.maps import load_map, run_map

    spec = load_map(args.map, overrides=settings_of(args))
    out = Path(args.out) if args.out else Path("runs") / spec.name
    results = run_map(
        spec, out=out, points=args.points, workers=args.workers, other_version=args.other_version,
        progress=Progress,
    )  # fmt: skip
    say(map_text(results))
    for path in write_map(results):
        say(f"written: {path}")
    return 1 if results.study.count("failed") else 0


def study_status_command(args: argparse.Namespace) -> int:
    """flexcage study status DIR: how many cases are done, failed and open."""
    from flexcage.study.results import StudyResults
    from flexcage.study.shards import unmerged_words

    say(StudyResults(args.dir).status())
    if more := unmerged_words(Path(args.dir)):
        say(more)
    return 0


def study_report_command(args: argparse.Namespace) -> int:
    """flexcage study report DIR: the table, printed and written anew from the cases."""
    from flexcage.study.results import StudyResults

    results = StudyResults(args.dir)
    say(results.report())
    for path in results.write():
        say(f"written: {path}")
    return 0


def study_surface_command(args: argparse.Namespace) -> int:
    """flexcage study surface DIR OUTPUT: surfaces, the optimum and its region; table, picture."""
    from flexcage.core.errors import InputError
    from flexcage.study.results import StudyResults
    from flexcage.study.surface import MODELS, response_surface

    chosen = {}
    for text in args.where or ():
        name, equals, value = text.partition("=")
        if not equals:
            raise InputError(
                f"--where is '{text}', but should be PATH=VALUE, as cage.model=rigid.",
                where="where",
                value=text,
            )
        chosen[name.strip()] = value.strip()
    surface = response_surface(
        StudyResults(args.dir), args.output, where=chosen, highest=args.highest,
        axes=[path.strip() for path in args.axes.split(",")] if args.axes else (),
        models=(args.model,) if args.model else MODELS,
    )  # fmt: skip
    say(surface.report())
    for path in surface.write(args.dir):
        say(f"written: {path}")
    return 0
