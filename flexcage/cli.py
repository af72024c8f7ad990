"""The command line: parse, call, and say in one sentence what went wrong.

Exit codes: 0 done, 1 a run that failed or a machine that lacks something, 2 a mistake in the
input, 130 stopped by Ctrl-C. FLEXCAGE_DEBUG=1 shows tracebacks.
"""

from __future__ import annotations

import argparse
import errno
import logging
import os
import sys
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NoReturn

from flexcage._version import __version__
from flexcage.core.errors import FlexcageError, InputError

_STOPPED = 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; the exit code."""
    parser = build_parser()
    args = parser.parse_args(argv)
    if not hasattr(args, "command"):
        parser.print_help()
        return 2
    try:
        return _call(args)
    except KeyboardInterrupt:
        return _fail(_stopped_sentence(args), _STOPPED)
    except BrokenPipeError:  # the reader of our output has left, as in `flexcage presets | head`
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except Exception as exc:
        if os.environ.get("FLEXCAGE_DEBUG"):
            raise
        return _fail(*_sentence(exc))


def _call(args: argparse.Namespace) -> int:
    from flexcage.core import logs

    logs.setup(verbose=args.verbose - args.quiet)
    if args.use:
        from flexcage.case import load_extension

        for source in args.use:
            load_extension(source)
    return args.command(args) or 0


def _sentence(exc: Exception) -> tuple[str, int]:
    """One sentence and the exit code for an error."""
    if isinstance(exc, FlexcageError):
        return str(exc), exc.exit_code
    if isinstance(exc, OSError):
        place = f" at '{exc.filename}'" if exc.filename else ""
        if exc.errno in (errno.ENOSPC, errno.EDQUOT):
            return f"The disk is full{place}; what was written before is kept.", 1
        return f"A file could not be read or written{place}: {exc.strerror or exc}.", 1
    if isinstance(exc, MemoryError):
        return "This machine has too little memory; take a coarser mesh or fewer modes.", 1
    return (
        f"flexcage stopped on an error of its own, {type(exc).__name__}: {exc}; "
        "FLEXCAGE_DEBUG=1 shows where.",
        1,
    )


def _stopped_sentence(args: argparse.Namespace) -> str:
    out = getattr(args, "out", None)
    if out is not None and (Path(out) / "study.toml").exists():
        return (
            f"Stopped; what is finished is kept in '{out}', and 'flexcage study resume {out}' "
            "goes on from there."
        )
    if out is None or not (Path(out) / "results.zarr").exists():
        return "Stopped."
    return f"Stopped; what was computed is kept in '{out}', and --resume goes on from there."


def _fail(sentence: str, code: int) -> int:
    first = sentence.strip()
    sys.stderr.write(f"flexcage: {first if first.endswith(('.', '!', '?')) else first + '.'}\n")
    return code


def say(text: object = "") -> None:
    """Write to standard output: what the command was asked for."""
    sys.stdout.write(f"{text}\n")


# ---------------------------------------------------------------------------------- commands


def run_command(args: argparse.Namespace) -> int:
    """flexcage run CASE: simulate, summarise, draw."""
    case = case_from(args)
    args.out = out = Path(args.out) if args.out else Path("runs") / case.name
    prepare_out(out, resume=args.resume, force=args.force)
    from flexcage.core.progress import Progress
    from flexcage.simulate import simulate

    run = simulate(case, out=out, resume=args.resume, progress=Progress)
    say(run.summary)
    say(f"\nThe run is in {out}")
    if not args.no_images:
        draw(run, out / "images", animate=args.animate)
    return 0


def static_command(args: argparse.Namespace) -> int:
    """flexcage static CASE: equilibrium of the inner ring, contact loads, stiffness, life."""
    from flexcage.case import load_static
    from flexcage.static import solve_static, write_static

    case = load_static(Path(args.case), overrides=settings_of(args))
    if args.out:
        prepare_out(Path(args.out), resume=False, force=args.force, resumable=False)
    solution = solve_static(case)
    say(solution.table())
    if args.out:
        write_static(case, solution, Path(args.out))
        say(f"\nThe table, its numbers and a picture are in {args.out}")
    return 0


def mesh_command(args: argparse.Namespace) -> int:
    """flexcage mesh CASE: build, check and write the cage's mesh."""
    case = case_from(args)
    out = Path(args.out) if args.out else Path(f"{case.name}.msh")
    prepare_file(out, (".msh", ".vtu"), force=args.force)
    from flexcage.mesh.build import build_cage_mesh
    from flexcage.mesh.io import write_mesh
    from flexcage.mesh.quality import report_mesh

    mesh = build_cage_mesh(**case.cage_shape)
    say(report_mesh(mesh, density=case.cage.material.density))
    for path in dict.fromkeys((out, out.with_suffix(".vtu"))):
        say(f"written: {write_mesh(mesh, path)}")
    return 0


def modes_command(args: argparse.Namespace) -> int:
    """flexcage modes CASE: the modal basis of the cage, as a table."""
    case = case_from(args)
    from flexcage.stages import cage_modes

    basis = cage_modes(case)
    say(f"{'mode':>5}  {'kind':<12}  {'frequency':>12}")
    for i, (frequency, kind) in enumerate(zip(basis.frequencies, basis.kind)):
        say(f"{i:>5}  {kind:<12}  {frequency:>9.1f} Hz")
    return 0


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


def converge_command(args: argparse.Namespace) -> int:
    """flexcage converge CASE: how far its outputs move with tolerance, slices, modes and mesh."""
    from flexcage.core.progress import Progress
    from flexcage.study.converge import converge, levels

    case = case_from(args)
    if args.duration:
        case = case.replace("solver.duration", args.duration)
    axes = [name.strip() for name in args.axes.split(",") if name.strip()]
    levels(case, axes)
    out = Path(args.out) if args.out else Path("runs") / f"{case.name}-converge"
    goes_on = (out / "cases").is_dir() and not args.force
    if not goes_on:
        prepare_out(out, resume=False, force=args.force, resumable=False)
    say(converge(case, out=out, axes=axes, progress=Progress))
    say(f"\nThe table, its picture and the runs are in {out}")
    return 0


def study_run_command(args: argparse.Namespace) -> int:
    """flexcage study run STUDY: compute what the study's folder lacks, and print its table."""
    from flexcage.study.spec import load_study

    study = load_study(args.study, overrides=settings_of(args))
    args.out = Path(args.out) if args.out else Path("runs") / study.name
    return compute_study(study, args)


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
        progress=Progress,
    )  # fmt: skip
    say(results.report())
    say(f"\nThe study is in {args.out}")
    return 1 if results.count("failed") else 0


def study_status_command(args: argparse.Namespace) -> int:
    """flexcage study status DIR: how many cases are done, failed and open."""
    from flexcage.study.results import StudyResults

    say(StudyResults(args.dir).status())
    return 0


def study_report_command(args: argparse.Namespace) -> int:
    """flexcage study report DIR: the table, printed and written anew from the cases."""
    from flexcage.study.results import StudyResults

    results = StudyResults(args.dir)
    say(results.report())
    for path in results.write():
        say(f"written: {path}")
    return 0


def presets_command(args: argparse.Namespace) -> int:
    """flexcage presets [NAME]: the list, or one preset with its assumptions."""
    from flexcage.geometry.presets import load_preset, preset_names

    if args.name is None:
        for name in preset_names():
            say(f"{name:<12} {load_preset(name).title}")
        return 0
    preset = load_preset(args.name)
    say(preset.title)
    for path, value in flat(preset.tables):
        reason = preset.assumptions.get(path)
        say(f"  {path:<30} {value!s:<12} {f'assumption: {reason}' if reason else ''}".rstrip())
    say()
    for name, stated, computed in preset.ratings():
        say(f"  {name}: catalogue {stated / 1e3:.1f} kN, from this inside {computed / 1e3:.2f} kN")
    for name, text in preset.sources.items():
        say(f"  {name}: {text}")
    return 0


def verify_command(args: argparse.Namespace) -> int:
    """flexcage verify [NAMES]: known answers against what flexcage computes; 1 if one is missed."""
    from flexcage.verification import chosen, report, run_case

    cases = chosen(args.names, quick=args.quick)
    if args.list:
        for case in cases:
            say(f"{case.name:<24} {'quick' if case.quick else 'long':<6} {case.title}")
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
        say(f"{finding.name:<14} {word:<16} {finding.detail}")
        if not finding.ok:
            say(f"{'':<14} remedy: {finding.remedy}")
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


# ----------------------------------------------------------------------------------- helpers


def draw(run: Any, folder: Path, *, animate: bool) -> None:
    """Draw a run's pictures; a machine that cannot draw costs the pictures, not the run."""
    from flexcage.core.errors import EnvironmentLacks

    try:
        run.draw(folder, animate=animate)
    except EnvironmentLacks as exc:
        logging.getLogger(__name__).warning("no pictures: %s", exc)


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


def prepare_out(out: Path, *, resume: bool, force: bool, resumable: bool = True) -> None:
    """Refuse an output folder that would be overwritten by accident or cannot be written."""
    if out.exists() and not out.is_dir():
        raise InputError(f"'{out}' is a file; name a folder for the output.", where="out")
    if resume:
        existing_run(out)
    elif out.is_dir() and any(out.iterdir()):
        if not force:
            raise InputError(
                f"The output folder '{out}' exists already; "
                f"{'--resume goes on with it, ' if resumable else ''}--force writes it anew, "
                "-o names another.",
                where="out",
                value=str(out),
            )
        empty_run(out)
    try:
        out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=out):
            pass
    except OSError as exc:
        reason = (exc.strerror or str(exc)).lower()
        raise InputError(
            f"The output folder '{out}' cannot be written ({reason}); name another with -o.",
            where="out",
            value=str(out),
        ) from exc


def empty_run(out: Path) -> None:
    """Remove a former output of flexcage; anything else in that folder is not ours to remove."""
    import shutil

    ours = ("case.toml", "results.zarr", "compare.json")
    if not any((out / name).exists() for name in ours):
        raise InputError(
            f"'{out}' holds files that flexcage did not write, so --force leaves it alone; name "
            "another folder with -o.",
            where="out",
            value=str(out),
        )
    shutil.rmtree(out)


def prepare_file(path: Path, endings: Iterable[str], *, force: bool) -> None:
    """Refuse an output file of another ending, or one that exists or cannot be written."""
    endings = tuple(endings)
    if path.suffix not in endings:
        raise InputError(
            f"'{path}' should end in {' or '.join(endings)}.", where="out", value=str(path)
        )
    if path.exists() and not force:
        raise InputError(f"'{path}' exists already; --force writes it anew.", where="out")
    if not path.parent.is_dir() or not os.access(path.parent, os.W_OK):
        raise InputError(f"'{path.parent}' is not a folder that can be written.", where="out")


def existing_run(path: str | Path) -> Path:
    """Folder of a stored run, or InputError."""
    path = Path(path)
    if not (path / "results.zarr").exists():
        raise InputError(f"'{path}' is not the folder of a run: it has no results.zarr.")
    return path


def flat(table: Any, where: str = "") -> list[tuple[str, Any]]:
    """Dotted path and value of every entry of nested tables."""
    rows: list[tuple[str, Any]] = []
    for key, value in table.items():
        path = f"{where}.{key}" if where else key
        rows += flat(value, path) if hasattr(value, "items") else [(path, value)]
    return rows


# ------------------------------------------------------------------------------------ parser


class _Parser(argparse.ArgumentParser):
    """Options that are wrong get one sentence, as any other mistake."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"flexcage: {message}; '{self.prog} --help' lists the options.\n")


def build_parser() -> argparse.ArgumentParser:
    """All commands and their options."""
    parser = _Parser(
        prog="flexcage", description="Rolling bearings with an elastic, deformed cage."
    )
    parser.add_argument("--version", action="version", version=f"flexcage {__version__}")
    parser.add_argument("-v", "--verbose", action="count", default=0, help="say more")
    parser.add_argument("-q", "--quiet", action="store_true", help="warnings only")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    _add_run(commands)
    _add_static(commands)
    _add_case_commands(commands)
    _add_run_commands(commands)
    _add_converge(commands)
    _add_verify(commands)
    _add_study(commands)
    _add_small_commands(commands)
    return parser


def _add_run(commands: Any) -> None:
    run = _command(commands, "run", run_command, "simulate a case: results, summary, pictures")
    _case_options(run)
    run.add_argument("-o", "--out", metavar="DIR", help="run folder (default: runs/NAME)")
    again = run.add_mutually_exclusive_group()
    again.add_argument("--resume", action="store_true", help="go on with a run that stopped")
    again.add_argument("--force", action="store_true", help="write an existing run anew")
    run.add_argument("--animate", action="store_true", help="make an animation as well")
    run.add_argument("--no-images", action="store_true", help="results only")


def _add_static(commands: Any) -> None:
    text = "equilibrium under load: displacements, contact loads, stiffness, life"
    static = _command(commands, "static", static_command, text)
    static.add_argument("case", metavar="CASE", help="case file (.toml)")
    static.add_argument(
        "--set", action="append", metavar="PATH=VALUE", help="change a value of the case"
    )
    static.add_argument("-o", "--out", metavar="DIR", help="folder for table, JSON and picture")
    static.add_argument("--force", action="store_true", help="write an existing folder anew")


def _add_case_commands(commands: Any) -> None:
    mesh = _command(commands, "mesh", mesh_command, "build and check the cage's mesh")
    _case_options(mesh)
    mesh.add_argument("-o", "--out", metavar="FILE", help="mesh file (default: NAME.msh)")
    mesh.add_argument("--force", action="store_true", help="write over an existing file")
    modes = _command(commands, "modes", modes_command, "compute the cage's modes")
    _case_options(modes)


def _add_run_commands(commands: Any) -> None:
    render = _command(commands, "render", render_command, "draw the pictures of a stored run")
    render.add_argument("run", metavar="RUN", help="run folder")
    render.add_argument("-o", "--out", metavar="DIR", help="folder for the pictures")
    render.add_argument("--animate", action="store_true", help="make an animation as well")
    compare = _command(
        commands, "compare", compare_command, "one case rigid and flexible, or two runs"
    )
    compare.add_argument("what", nargs="+", metavar="CASE|RUN", help="a case, or two run folders")
    compare.add_argument("--set", action="append", metavar="PATH=VALUE", help="change a value")
    compare.add_argument("-o", "--out", metavar="DIR", help="folder for table, plot and runs")
    compare.add_argument("--force", action="store_true", help="write an existing folder anew")


def _add_converge(commands: Any) -> None:
    text = "repeat a case finer and finer: which outputs have converged"
    study = _command(commands, "converge", converge_command, text)
    _case_options(study)
    study.add_argument(
        "--axes", default="", metavar="A,B", help="of tolerance,slices,modes,mesh (default: all)"
    )
    study.add_argument("--duration", metavar="TIME", help="bearing time of each run, as '40 ms'")
    study.add_argument("-o", "--out", metavar="DIR", help="folder (default: runs/NAME-converge)")
    study.add_argument("--force", action="store_true", help="repeat runs that are there already")


def _add_verify(commands: Any) -> None:
    text = "compute cases with known answers, and compare"
    verify = _command(commands, "verify", verify_command, text)
    verify.add_argument("names", nargs="*", metavar="NAME", help="cases (default: all)")
    extent = verify.add_mutually_exclusive_group()
    extent.add_argument(
        "--quick", action="store_true", help="only those that need no compiled bearing"
    )
    extent.add_argument("--all", action="store_true", help="the long ones as well (the default)")
    verify.add_argument("--list", action="store_true", help="name the cases, compute nothing")
    verify.add_argument("-o", "--out", metavar="FILE", help="write a chapter (.md), or .json")
    verify.add_argument("--force", action="store_true", help="write over an existing file")


def _add_study(commands: Any) -> None:
    study = commands.add_parser("study", help="many cases on all cores or a cluster, and one table")
    actions = study.add_subparsers(title="actions", metavar="ACTION", required=True)
    run = _command(actions, "run", study_run_command, "compute what a study's folder lacks")
    run.add_argument("study", metavar="STUDY", help="study file (.toml)")
    run.add_argument("-o", "--out", metavar="DIR", help="study folder (default: runs/NAME)")
    run.add_argument(
        "--set", action="append", metavar="PATH=VALUE", help="change a value of the base case"
    )
    resume = _command(actions, "resume", study_resume_command, "go on with a study that stopped")
    resume.add_argument("dir", metavar="DIR", help="study folder")
    for parser in (run, resume):
        where = parser.add_mutually_exclusive_group()
        where.add_argument("--workers", type=_count, metavar="N", help="processes (default: cores)")
        where.add_argument("--scheduler", metavar="ADDRESS", help="a running Dask scheduler")
        parser.add_argument("--retry", action="store_true", help="try failed cases again")
    for name, function, text in (
        ("status", study_status_command, "count what is done, failed and open"),
        ("report", study_report_command, "print and write the table"),
    ):
        _command(actions, name, function, text).add_argument("dir", metavar="DIR", help="folder")


def _count(text: str) -> int:
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' should be a whole number, 1 or more")
    return int(text)


def _add_small_commands(commands: Any) -> None:
    presets = _command(commands, "presets", presets_command, "list presets, or show one")
    presets.add_argument("name", nargs="?", metavar="NAME")
    _command(commands, "doctor", doctor_command, "what this machine lacks, and the remedy")
    cache = _command(commands, "cache", cache_command, "what the cache on disk holds")
    cache.add_argument("--clear", action="store_true", help="remove all of it")


def _command(commands: Any, name: str, function: Any, text: str) -> argparse.ArgumentParser:
    parser = commands.add_parser(name, help=text, description=text)
    parser.set_defaults(command=function)
    parser.add_argument(
        "--use", action="append", metavar="FILE", help="a .py of your own laws ..., or a preset"
    )
    return parser


def _case_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("case", metavar="CASE", help="case file (.toml)")
    parser.add_argument("--cage", choices=("rigid", "flexible"), help="how the cage is modelled")
    parser.add_argument(
        "--set", action="append", metavar="PATH=VALUE", help="change a value of the case"
    )


if __name__ == "__main__":
    sys.exit(main())
