"""The command that makes data sets of signals, and checks them."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from flexcage.cli.parser import command, say, say_shard, version_option, whole_number
from flexcage.cli.settings import settings_of
from flexcage.core.errors import InputError

CHECK, MERGE, PLAN = "check", "merge", "plan"


def add_commands(commands: Any) -> None:
    """Add this module's command to the parser."""
    text = "make a data set of signals with known truth of a study or a map, or check one"
    dataset = command(commands, "dataset", dataset_command, text)
    dataset.add_argument(
        "what",
        nargs="+",
        metavar="STUDY|plan|check|merge",
        help="file of a study or a map (.toml), or: plan STUDY, check DIR, merge DIR",
    )
    dataset.add_argument(
        "-o", "--out", metavar="DIR", help="its folder (default: runs/NAME-dataset)"
    )
    dataset.add_argument("--workers", type=whole_number, metavar="N", help="processes")
    dataset.add_argument(
        "--shard", metavar="I/N", help="make the I-th of N parts only; merge DIR gathers them"
    )
    dataset.add_argument("--set", action="append", metavar="PATH=VALUE", help="of the base case")
    dataset.add_argument(
        "--severity",
        metavar="SIZES",
        help="edges of severities by the fault's size, as '0.6 mm, 1.2 mm'",
    )
    dataset.add_argument("--title", default="", metavar="TEXT", help="of its cards")
    dataset.add_argument("--license", metavar="NAME", help="of its cards (default: CC-BY-4.0)")
    version_option(dataset)


def dataset_command(args: argparse.Namespace) -> int:
    """flexcage dataset STUDY: make a data set, or go on with it; flexcage dataset check DIR, or
    merge DIR."""
    if args.what[0] in _OF_FOLDERS:
        return _OF_FOLDERS[args.what[0]](_folder(args.what), args)
    planning = args.what[0] == PLAN
    if len(args.what) != 1 + planning:
        raise InputError(
            f"dataset takes one study, and was given {' '.join(args.what)}; 'flexcage dataset "
            "check DIR' checks a data set.",
            where="dataset",
        )
    from flexcage.core.progress import Progress
    from flexcage.study.dataset.build import build_dataset
    from flexcage.study.dataset.folder import Settings
    from flexcage.study.dataset.sharded import build_shard, plan_dataset

    source = Path(args.what[-1])
    out = Path(args.out) if args.out else Path("runs") / f"{source.stem}-dataset"
    given: dict[str, Any] = {"license": args.license} if args.license else {}
    settings = Settings(edges=_edges(args.severity), title=args.title, **given)
    how: dict[str, Any] = {"settings": settings, "overrides": settings_of(args)}
    if planning:
        say(f"{len(plan_dataset(source, out, **how).cases)} cases are planned in {out}")
        return 0
    how |= {"workers": args.workers, "progress": Progress}
    if args.shard:
        return say_shard(build_shard(source, out, args.shard, **how), f"dataset merge {out}")
    return _say_all(build_dataset(source, out, other_version=args.other_version, **how))


def _say_all(folder: Any, missing: str = "") -> int:
    """Say what a data set holds, and what it lacks."""
    from flexcage.study.dataset.check import check_dataset

    say(check_dataset(folder.path).text())
    say(f"The data set is in {folder.path}; its README.md says what is in it")
    if missing:
        say(missing)
    return 1 if missing else 0


def _folder(what: list[str]) -> str:
    if len(what) != 2:
        raise InputError(
            f"{what[0]} takes the folder of one data set, as: {what[0]} DIR.", where="dataset"
        )
    return what[1]


def _check(folder: str, _args: argparse.Namespace) -> int:
    from flexcage.study.dataset.check import check_dataset

    verdict = check_dataset(folder)
    say(verdict.text())
    return 1 if verdict.faults else 0


def _merge(folder: str, args: argparse.Namespace) -> int:
    from flexcage.study.dataset.sharded import merge_dataset
    from flexcage.study.shards import missing_words

    merged, lacking = merge_dataset(folder, other_version=args.other_version)
    return _say_all(merged, missing_words(lacking, f"flexcage dataset STUDY -o {folder}"))


_OF_FOLDERS = {CHECK: _check, MERGE: _merge}


def _edges(text: str | None) -> tuple[float, ...]:
    """Sizes [m] of "0.6 mm, 1.2 mm"."""
    from flexcage.core.units import parse

    parts = [part.strip() for part in (text or "").split(",") if part.strip()]
    return tuple(parse(part, "mm", where="--severity") for part in parts)
