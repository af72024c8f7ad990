"""Speed, accuracy and memory, as README.md beside this file says. Measures, asserts nothing."""

from __future__ import annotations

import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

import argparse
import json
import logging
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(Path(__file__).parent)]
WHAT = ("solver", "fe", "peer", "exudyn", "scale", "study", "ball", "start")


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=WHAT)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--case", type=Path, help="default: n1013, or c7010 for ball")
    parser.add_argument("--fineness", default="medium", help="fe: fineness of the mesh")
    parser.add_argument("--solver", default="auto", help="fe: linear solver")
    parser.add_argument("--plot", type=Path, metavar="FILE", help="peer, scale: draw curves")
    parser.add_argument("--cases", type=int, default=1000, help="study: number of trivial cases")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE")
    args = parser.parse_args(argv)
    import flexcage
    from flexcage.cli.settings import parse_setting

    logging.basicConfig(level=logging.WARNING)
    file = args.case or ROOT / "examples" / ("c7010" if args.what == "ball" else "n1013")
    case = flexcage.load_case(
        file.with_suffix(".toml"), overrides=dict(parse_setting(text) for text in args.set)
    )
    if args.what == "solver":
        import solver_benchmark

        figures = solver_benchmark.measure(case)
    elif args.what == "peer":
        import peer_benchmark

        figures = peer_benchmark.measure(case, plot=args.plot)
    elif args.what == "exudyn":
        import exudyn_benchmark

        figures = exudyn_benchmark.measure()
    elif args.what == "scale":
        import scale_benchmark

        figures = scale_benchmark.measure(case, plot=args.plot)
    elif args.what == "ball":
        import ball_benchmark

        figures = ball_benchmark.measure(case)
    elif args.what == "start":
        import start_benchmark

        figures = start_benchmark.measure(case)
    elif args.what == "study":
        import study_benchmark

        figures = study_benchmark.measure(case, trivial_cases=args.cases)
    else:
        import fe_benchmark

        figures = fe_benchmark.measure(
            case.replace("mesh.fineness", args.fineness), solver_kind=args.solver
        )
    if args.json:
        sys.stdout.write(json.dumps(figures) + "\n")
    else:
        width = max(map(len, figures))
        sys.stdout.writelines(f"{key:<{width}}  {value}\n" for key, value in figures.items())
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
