"""Speed, accuracy and memory, as README.md beside this file says. Measures, asserts nothing."""

from __future__ import annotations

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import argparse
import json
import logging
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
sys.path[:0] = [str(Path(__file__).parent)]
WHAT = (
    "solver", "fe", "peer", "exudyn", "scale", "study", "ball", "methods", "start", "own", "whole",
    "machine", "dataset", "shards", "rollers",
)  # fmt: skip
# of the case, with --quick
QUICK = {"mesh.fineness": "coarse", "mesh.order": 1, "cage.model": "rigid"}


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=WHAT)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--case", type=Path, help="default: n1013, or c7010 for ball and methods")
    parser.add_argument("--fineness", default="medium", help="fe: fineness of the mesh")
    parser.add_argument("--solver", default="auto", help="fe: linear solver")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="peer, scale: draw curves")
    text = "study, dataset, shards: number of cases (1000 trivial; 2 a bearing; 2000)"
    parser.add_argument("--cases", type=int, help=text)
    parser.add_argument("--only", metavar="A,B", help="dataset: these alone, as '6205 rigid'")
    parser.add_argument("--seconds", type=float, default=1.0, help="dataset: of a signal")
    parser.add_argument("--quick", action="store_true", help="only see whether it runs")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    args = parser.parse_args(argv)
    import flexcage
    from flexcage.cli.settings import parse_setting

    logging.basicConfig(level=logging.WARNING)
    small = QUICK if args.quick else {}
    file = args.case or EXAMPLES / ("c7010" if args.what in ("ball", "methods") else "n1013")
    case = flexcage.load_case(
        file.with_suffix(".toml"),
        overrides={**small, **dict(parse_setting(text) for text in args.set)},
    )
    benchmark = import_module(f"{args.what}_benchmark")
    options: dict[str, Any] = dict(benchmark.QUICK) if args.quick else {}
    if args.what == "ball":
        options["rollers"] = flexcage.load_case(EXAMPLES / "n1013.toml", overrides=small)
    elif args.what == "whole":
        options["balls"] = flexcage.load_case(EXAMPLES / "c7010.toml", overrides=small)
    elif args.what in ("peer", "scale"):
        options["plot"] = args.plot
    elif args.what == "study":
        options.setdefault("trivial_cases", args.cases or 1000)
    elif args.what in ("dataset", "shards"):
        options |= {"cases": args.cases} if args.cases else {}
        if args.what == "dataset":
            options.setdefault("seconds", args.seconds)
        if args.only:
            options["subjects"] = tuple(part.strip() for part in args.only.split(","))
    elif args.what in ("fe", "own"):
        case = case if args.quick else case.replace("mesh.fineness", args.fineness)
        if args.what == "fe":
            options["solver_kind"] = args.solver
    cases = () if args.what == "exudyn" else (case,)  # it has planar ones of its own
    figures = benchmark.measure(*cases, **options)
    if args.json:
        sys.stdout.write(json.dumps(figures) + "\n")
    else:
        width = max(map(len, figures))
        sys.stdout.writelines(f"{key:<{width}}  {value}\n" for key, value in figures.items())
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
