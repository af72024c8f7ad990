"""Commands that take the folders of runs: render, export, report, fatigue, wear, compare."""

from __future__ import annotations

import argparse
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from flexcage.cli.files import existing_run, prepare_file, prepare_out
from flexcage.cli.parser import command, number, picture_options, say, whole_number
from flexcage.cli.settings import case_from, checked_case_from, look_of
from flexcage.core.errors import InputError
from flexcage.core.output_folders import check_either, holds_machine_run


def add_commands(commands: Any) -> None:
    """Add this module's commands to the parser."""
    render = command(commands, "render", render_command, "draw the pictures of a stored run")
    render.add_argument("run", metavar="RUN", help="run folder")
    render.add_argument("-o", "--out", metavar="DIR", help="folder for the pictures")
    picture_options(render)
    render.add_argument("--only", nargs="+", metavar="NAME", help="only these pictures, as orbit")
    render.add_argument(
        "--format", choices=("png", "svg", "pdf"),
        help="of curves (default: png); scenes are always .png",
    )  # fmt: skip
    _add_export(commands)
    text = "write a run or a study as one HTML page that needs no other file"
    report = command(commands, "report", report_command, text)
    report.add_argument("folder", metavar="RUN_OR_STUDY", help="folder of a run or a study")
    report.add_argument("-o", "--out", metavar="FILE", help="page (default: report.html in it)")
    report.add_argument(
        "--force", action="store_true", help="write over a file that is no page of flexcage"
    )
    report.add_argument(
        "--points", metavar="N,N", help="of a study: points whose stress is shown (default: six)"
    )
    text = "damage and life of a stored run's cage at its pocket corners"
    fatigue = command(commands, "fatigue", fatigue_command, text)
    fatigue.add_argument("run", metavar="RUN", help="run folder")
    fatigue.add_argument("--place", metavar="NAME", help="one place, such as pocket5_root_rear+x")
    fatigue.add_argument("--rows", type=whole_number, metavar="N", help="the worst N places alone")
    text = "wear of a stored run's pockets and land by Archard's law"
    wear = command(commands, "wear", wear_command, text)
    wear.add_argument("run", metavar="RUN", help="run folder")
    wear.add_argument("--coefficient", metavar="K", help='of wear, such as "1e-8 mm^3/(N*m)"')
    wear.add_argument("--hours", type=number, default=1.0, metavar="H", help="depths after H hours")
    compare = command(
        commands, "compare", compare_command, "one case rigid and flexible, or two runs"
    )
    compare.add_argument("what", nargs="+", metavar="CASE|RUN", help="a case, or two run folders")
    compare.add_argument("--set", action="append", metavar="PATH=VALUE", help="change a value")
    compare.add_argument("--all", action="store_true", help="print every figure, not ten")
    compare.add_argument(
        "-o", "--out", metavar="DIR",
        help="folder for table, picture, page and runs (default: runs/NAME-compare)",
    )  # fmt: skip
    compare.add_argument("--force", action="store_true", help="write an existing folder anew")


def _add_export(commands: Any) -> None:
    text = (
        "write a run's variables as a table, or its cage, deformed and stressed, as a .vtu series "
        "for ParaView; or a case's reduced cage as matrices for other programs"
    )
    export = command(commands, "export", export_command, text)
    export.add_argument("run", metavar="RUN|CASE", help="run folder, or case file (.toml)")
    export.add_argument(
        "-o", "--out", metavar="DIR|FILE", help="folder (default: vtu in the run's), or a "
        "case's .npz, .op4, .mtx or .pch (default: NAME_cage.npz)",
    )  # fmt: skip
    export.add_argument("--force", action="store_true", help="write an existing series anew")
    export.add_argument("--set", action="append", metavar="PATH=VALUE", help="of a case")
    export.add_argument(
        "--full", action="store_true", help="of a case: matrices of all nodes, not reduced"
    )
    export.add_argument("--text", action="store_true", help="of a case: an .op4 as text")
    export.add_argument(
        "--table", nargs="+", metavar=("FILE", "VARIABLE"), help="of a run: these variables "
        "('flexcage variables' lists them; also stress, stress_peak, film_thickness, events and "
        "steps) as .csv, .parquet or .mat",
    )  # fmt: skip
    export.add_argument(
        "--signals", metavar="FILE", help="of a run: what its [[sensors]] show, as .csv, .parquet, "
        ".mat, .wav or .uff",
    )  # fmt: skip
    export.add_argument(
        "--sensors", metavar="CASE", help="with --signals: the [[sensors]] of this file instead"
    )
    export.add_argument(
        "--from", dest="begin", metavar="TIME", help="first instant, as '3 ms' (default without "
        "--to and --count: 0.4 ms about the largest stress)",
    )  # fmt: skip
    export.add_argument("--to", dest="end", metavar="TIME", help="last instant")
    export.add_argument(
        "--count", type=whole_number, metavar="N", help="so many, evenly (default: every sample)"
    )


def render_command(args: argparse.Namespace) -> int:
    """flexcage render RUN: draw the pictures of a stored run again."""
    from flexcage.core.progress import Progress
    from flexcage.simulate import load_run

    look = look_of(args)
    run = load_run(existing_run(args.run), progress=Progress)
    out = Path(args.out) if args.out else Path(args.run) / "images"
    if look and not args.only and any(out.glob("*.png")):
        args.only = _changed(run, look, animate=args.animate)
    given: dict[str, Any] = dict(look)
    given |= {name: value for name in ("only", "format") if (value := getattr(args, name))}
    run.draw(out, animate=args.animate, **given)
    drawn = f"Drawn anew: {', '.join(args.only)}. " if args.only else ""
    say(f"{drawn}The pictures are in {out}")
    return 0


def _changed(run: Any, look: Mapping[str, float], *, animate: bool) -> list[str]:
    """Names of the run's pictures that change with --view, --stress-limit or --scale."""
    from flexcage.render.album import changed_by

    found = changed_by(look, [*run.picture_names, *(["stress"] if animate else [])])
    if not found:
        options = ", ".join(f"--{name.replace('_', '-')}" for name in look)
        raise InputError(
            f"No picture of this run changes with {options}: its cage is rigid.", where="render"
        )
    return found


def export_command(args: argparse.Namespace) -> int:
    """flexcage export RUN: displacement and stress of the cage over time, for ParaView, or with
    --table its variables; or flexcage export CASE: its reduced cage."""
    if Path(args.run).suffix == ".toml":
        return _export_body(args)
    if args.table:
        return _export_table(args)
    if args.signals:
        return _export_signals(args)
    if args.sensors:
        raise InputError("--sensors goes with --signals FILE.", where="sensors")
    for name in ("set", "full", "text"):
        if getattr(args, name):
            raise InputError(f"--{name} belongs to a case, and '{args.run}' is a run.", where=name)
    from flexcage.core.progress import Progress
    from flexcage.simulate import load_run

    run = load_run(existing_run(args.run), progress=Progress)
    run.recovery  # noqa: B018  (refuses a rigid cage before a folder is made)
    out = Path(args.out) if args.out else Path(args.run) / "vtu"
    times = _instants(args, run)
    prepare_out(out, resume=False, force=args.force, resumable=False, ours=("cage.pvd",))
    say(f"written: {run.write_vtu(out, times=times)}")
    return 0


def _refuse_others(args: argparse.Namespace, wanted: str, others: tuple[str, ...] = ()) -> None:
    """InputError for an option that does not go with the one that is wanted."""
    for name, option in (
        ("out", "-o"), ("begin", "--from"), ("end", "--to"), ("count", "--count"),
        ("set", "--set"), ("full", "--full"), ("text", "--text"), *((o, f"--{o}") for o in others),
    ):  # fmt: skip
        if getattr(args, name):
            raise InputError(f"{option} does not go with {wanted}.", where=option)


def _export_signals(args: argparse.Namespace) -> int:
    """Write signals of a run's sensors, or of those of another file."""
    _refuse_others(args, "--signals")
    from flexcage.case.sensor_checks import load_sensors
    from flexcage.core.progress import Progress
    from flexcage.simulate import load_run

    sensors = load_sensors(args.sensors) if args.sensors else None
    run = load_run(existing_run(args.run), progress=Progress)
    for path in run.write_signals(args.signals, sensors, force=args.force):
        say(f"written: {path}")
    return 0


def _export_table(args: argparse.Namespace) -> int:
    """Write variables of a run."""
    _refuse_others(args, "--table", ("signals", "sensors"))
    file, *variables = args.table
    from flexcage.core.progress import Progress
    from flexcage.simulate import load_run

    run = load_run(existing_run(args.run), progress=Progress)
    for path in run.write_table(file, variables or None, force=args.force):
        say(f"written: {path}")
    return 0


def _export_body(args: argparse.Namespace) -> int:
    """Write the reduced cage of a case, or its full matrices."""
    for name in ("table", "signals"):
        if getattr(args, name):
            raise InputError(f"--{name} belongs to a run, and '{args.run}' is a case.", where=name)
    args.case = args.run
    case = checked_case_from(args)
    for name, option in (("begin", "from"), ("end", "to"), ("count", "count")):
        if getattr(args, name) is not None:
            raise InputError(f"--{option} belongs to a run, and '{args.run}' is a case.")
    out = Path(args.out) if args.out else Path(f"{case.name}_cage.npz")
    from flexcage.core.progress import Progress
    from flexcage.core.timing import Stages
    from flexcage.modes.exchange.formats import FORMATS, write_body
    from flexcage.stages import flexible_cage

    prepare_file(out, FORMATS, force=args.force)
    if args.text and out.suffix != ".op4":
        raise InputError(f"--text is for an .op4, and '{out}' is another file.", where="text")
    cage = flexible_cage(case)
    make = cage.as_full_body if args.full else cage.as_body
    body = Stages(Progress).named("mesh and modes", make)
    say(f"written: {write_body(body, out, **({'binary': False} if args.text else {}))}")
    return 0


def _instants(args: argparse.Namespace, run: Any) -> Any:
    """Times [s] that --from, --to and --count ask for; None for those about the largest stress."""
    import numpy as np

    from flexcage.core.units import parse

    if args.count is not None and args.count < 1:
        raise InputError(f"--count is {args.count}, but must be 1 or more.", where="count")
    if args.begin is None and args.end is None and args.count is None:
        return None
    t = run.dataset["time"].values
    begin = t[0] if args.begin is None else parse(args.begin, "ms", where="--from")
    end = t[-1] if args.end is None else parse(args.end, "ms", where="--to")
    if args.count is None:
        chosen = t[(t >= begin) & (t <= end)]
        if not len(chosen):
            raise InputError(
                f"There is no sample from {begin * 1e3:g} to {end * 1e3:g} ms; the run has "
                f"{t[0] * 1e3:g} to {t[-1] * 1e3:g} ms.",
                where="from",
            )
        return chosen
    return np.linspace(begin, end, args.count)


def report_command(args: argparse.Namespace) -> int:
    """flexcage report RUN_OR_STUDY: one HTML page of what was computed."""
    folder = Path(args.folder)
    is_study = (folder / "study.toml").is_file() and (folder / "plan.json").is_file()
    is_machine = holds_machine_run(folder)
    points = _numbers(args.points) if args.points else None
    if not is_study:
        if not is_machine:
            check_either(folder)
        if points is not None:
            raise InputError(f"--points belongs to a study, and '{folder}' is a run.")
    out = Path(args.out) if args.out else folder / "report.html"
    from flexcage.core.progress import Progress
    from flexcage.report.page import is_page

    # a page of ours is written anew, and a link is replaced: what it points to stays as it is
    prepare_file(out, (".html",), force=args.force or out.is_symlink() or is_page(out))

    if is_study:
        from flexcage.study.results import StudyResults

        StudyResults(folder).page(out, points=points, progress=Progress)
    elif is_machine:
        from flexcage.machine_run import load_machine_run
        from flexcage.machine_run.page import write_machine_page

        write_machine_page(load_machine_run(folder), out)
    else:
        from flexcage.simulate import load_run

        load_run(folder).report(out, progress=Progress)
    say(f"written: {out} ({out.stat().st_size / 1e6:.1f} MB)")
    return 0


def fatigue_command(args: argparse.Namespace) -> int:
    """flexcage fatigue RUN: damage and life at the named places of the cage."""
    from flexcage.simulate import load_run

    say(load_run(existing_run(args.run)).fatigue(args.place).table(args.rows))
    return 0


def wear_command(args: argparse.Namespace) -> int:
    """flexcage wear RUN: rates of wear, with the material's coefficient or another."""
    from flexcage.core.units import parse
    from flexcage.simulate import load_run
    from flexcage.stress.wear_laws import WearLaw

    run, law = load_run(existing_run(args.run)), None
    if args.coefficient:
        k = parse(args.coefficient, "mm^3/(N*m)", where="--coefficient")
        law = WearLaw(material=run.case.its_cage.material.name, coefficient=k)
    say(run.wear(law).table(args.hours))
    return 0


def _numbers(text: str) -> list[int]:
    """Whole numbers of "0,3,5"."""
    parts = [part.strip() for part in text.split(",") if part.strip()]
    if not parts or not all(part.isdigit() for part in parts):
        raise InputError(f"--points {text!r} should be numbers of points, such as '0,3'.")
    return list(dict.fromkeys(int(part) for part in parts))


def compare_command(args: argparse.Namespace) -> int:
    """flexcage compare CASE (rigid against flexible), or RUN RUN."""
    from flexcage.core.progress import Progress
    from flexcage.study.compare import compare, compare_case, short_names

    if len(args.what) == 2:
        if len({Path(path).resolve() for path in args.what}) == 1:
            raise InputError(
                f"compare was given '{args.what[0]}' twice; name two runs.", where="compare"
            )
        first, second = (existing_run(path) for path in args.what)
        if args.set:
            raise InputError("--set belongs to a case, and two runs were given.", where="set")
        both = "-".join(re.sub(r"[^\w.-]+", "-", n) for n in short_names(first, second))
        out = _comparison_folder(args, f"{both}-compare")
        found = compare(first, second, out=out)
    else:
        if len(args.what) != 1 or Path(args.what[0]).is_dir():
            raise InputError(
                "compare needs one case (a .toml file), or two run folders; it was given "
                f"{' '.join(args.what)}.",
                where="compare",
            )
        args.case = args.what[0]
        case = case_from(args)
        out = _comparison_folder(args, f"{case.name}-compare")
        found = compare_case(case, out=out, progress=Progress)
    say(found.text(every=args.all))
    more = "" if args.all else "; its compare.txt has all figures"
    say(f"\nThe page (report.html) is in {out}{more}")
    return 0


def _comparison_folder(args: argparse.Namespace, name: str) -> Path:
    """The folder for a comparison, prepared; one of ours that holds no runs is written anew."""
    from flexcage.study.compare import MODELS

    out = Path(args.out) if args.out else Path("runs") / name
    ours = (out / "compare.json").is_file() and not any((out / m).exists() for m in MODELS)
    if ours and len(args.what) == 2:
        return out
    prepare_out(out, resume=False, force=args.force, resumable=False)
    return out
