"""Commands that take a case: run, static, warm, mesh, modes, converge."""

from __future__ import annotations

import argparse
import logging
from pathlib import Path
from typing import Any

from flexcage.cli.files import prepare_file, prepare_out, run_folder
from flexcage.cli.parser import case_options, command, picture_options, say
from flexcage.cli.settings import (
    case_from,
    case_or_static,
    checked_case_from,
    look_of,
    settings_of,
)
from flexcage.core.errors import InputError
from flexcage.core.garbage import while_loading

_WARM = ("warm.json",)


def add_commands(commands: Any) -> None:
    """Add this module's commands to the parser."""
    _add_run(commands)
    _add_static(commands)
    _add_warm(commands)
    _add_mesh_and_modes(commands)
    _add_converge(commands)


def _add_run(commands: Any) -> None:
    run = command(commands, "run", run_command, "simulate a case: results, summary, pictures")
    case_options(run, machines=True)
    run.add_argument("-o", "--out", metavar="DIR", help="run folder (default: runs/NAME)")
    again = run.add_mutually_exclusive_group()
    again.add_argument("--resume", action="store_true", help="go on with a run that stopped")
    again.add_argument("--force", action="store_true", help="write an existing run anew")
    run.add_argument(
        "--other-version", action="store_true",
        help="with --resume: go on although a flexcage of other physics began the run",
    )  # fmt: skip
    picture_options(run)
    run.add_argument("--no-images", action="store_true", help="results only")


def _add_static(commands: Any) -> None:
    text = "equilibrium under load: displacements, contact loads, stiffness, life"
    static = command(commands, "static", static_command, text)
    static.add_argument("case", metavar="CASE", help="file of a case or a machine (.toml)")
    static.add_argument(
        "--set", action="append", metavar="PATH=VALUE", help="change a value of the case"
    )
    static.add_argument("-o", "--out", metavar="DIR", help="folder for table, JSON and picture")
    static.add_argument("--force", action="store_true", help="write an existing folder anew")


def _add_warm(commands: Any) -> None:
    text = "temperatures at which losses and heat that leaves agree; viscosity, clearance"
    warm = command(commands, "warm", warm_command, text)
    warm.add_argument("case", metavar="CASE", help="case file (.toml)")
    warm.add_argument(
        "--set", action="append", metavar="PATH=VALUE", help="change a value of the case"
    )
    warm.add_argument(
        "-o", "--out", metavar="DIR", help="folder for record, picture and settled case"
    )
    warm.add_argument("--force", action="store_true", help="write an existing folder anew")


def _add_mesh_and_modes(commands: Any) -> None:
    mesh = command(commands, "mesh", mesh_command, "build and check the cage's mesh")
    case_options(mesh)
    mesh.add_argument("-o", "--out", metavar="FILE", help="mesh file (default: NAME.msh)")
    mesh.add_argument(
        "--force", action="store_true", help="write over a file that flexcage did not write"
    )
    modes = command(commands, "modes", modes_command, "compute the cage's modes: their table")
    case_options(modes)
    modes.add_argument("-o", "--out", metavar="FILE", help="table (default: NAME_modes.csv)")
    modes.add_argument("--force", action="store_true", help="write over an existing file")


def _add_converge(commands: Any) -> None:
    text = "repeat a case finer and finer: which outputs have converged"
    study = command(commands, "converge", converge_command, text)
    case_options(study)
    study.add_argument(
        "--axes",
        default="",
        metavar="A,B",
        help="of tolerance,slices,samples,modes,mesh (default: all)",
    )
    study.add_argument("--duration", metavar="TIME", help="bearing time of each run, as '40 ms'")
    study.add_argument("-o", "--out", metavar="DIR", help="folder (default: runs/NAME-converge)")
    again = study.add_mutually_exclusive_group()
    again.add_argument("--force", action="store_true", help="repeat runs that are there already")
    again.add_argument(
        "--other-version", action="store_true",
        help="compare with runs that a flexcage of other physics computed",
    )  # fmt: skip


def run_command(args: argparse.Namespace) -> int:
    """flexcage run CASE: simulate, summarise, draw; a machine with all of its bearings."""
    from flexcage.case.read import names_machine

    if args.other_version and not args.resume:
        raise InputError("--other-version belongs to --resume.", where="other-version")
    if names_machine(Path(args.case)):
        return _run_machine(args)
    case, look = case_from(args), look_of(args)
    args.out = out = Path(args.out) if args.out else Path("runs") / case.name
    with run_folder(out, resume=args.resume, force=args.force):
        with while_loading():
            from flexcage.core.progress import Progress
            from flexcage.simulate import simulate

        say(f"Inner ring: {case.held_in_words}")
        run = simulate(
            case, out=out, resume=args.resume, other_version=args.other_version, progress=Progress
        )
        run.stages.begun = args.begun
        run.report_times()
        say(run.summary.brief())
        say(f"\nThe run is in {out}; its summary.txt has all figures")
        if not args.no_images:
            draw(run, out / "images", animate=args.animate, **look)
            drawing = run.stages.get("pictures", 0.0)
            say(f"Pictures took {drawing:.1f} s, all of it {run.stages.total:.1f} s")
    return 0


def _run_machine(args: argparse.Namespace) -> int:
    from flexcage.case.read import read_machine
    from flexcage.machine import load_machine
    from flexcage.machine.motion import check_moves
    from flexcage.machine.writing import MACHINE, OURS

    look, overrides = look_of(args), settings_of(args)
    if args.cage:
        count = len(read_machine(Path(args.case))[0].get("bearings", []))
        overrides |= {f"bearings.{k}.cage.model": args.cage for k in range(count)}
    machine = load_machine(Path(args.case), overrides=overrides)
    check_moves(machine)
    args.out = out = Path(args.out) if args.out else Path("runs") / machine.name
    ours = (*OURS, "case.toml")
    with run_folder(out, resume=args.resume, force=args.force, ours=ours, first=MACHINE):
        with while_loading():
            from flexcage.core.progress import Progress
            from flexcage.machine_run import simulate_machine

        run = simulate_machine(
            machine, out=out, resume=args.resume, other_version=args.other_version,
            progress=Progress,
        )  # fmt: skip
        say(run.summary.text())
        say(
            f"\nThe run is in {out}: shaft.nc and machine_summary.txt, and a run of each bearing "
            "in a folder there"
        )
        if not args.no_images:
            draw(run, out / "images", animate=args.animate, **look)
    return 0


def static_command(args: argparse.Namespace) -> int:
    """flexcage static CASE: equilibrium of the inner ring, contact loads, stiffness, life; of a
    machine, of its shaft and all bearings."""
    from flexcage.case import load_static
    from flexcage.case.read import names_machine
    from flexcage.static import solve_static, write_static

    if names_machine(Path(args.case)):
        return _static_machine(args)
    case = load_static(Path(args.case), overrides=settings_of(args))
    if args.out:
        prepare_out(Path(args.out), resume=False, force=args.force, resumable=False)
    solution = solve_static(case)
    say(solution.table())
    if args.out:
        write_static(case, solution, Path(args.out))
        say(f"\nThe table, its numbers and a picture are in {args.out}")
    return 0


def _static_machine(args: argparse.Namespace) -> int:
    from flexcage.machine import load_machine
    from flexcage.machine.solve import solve_machine
    from flexcage.machine.writing import OURS, write_machine

    machine = load_machine(Path(args.case), overrides=settings_of(args))
    if args.out:
        ours = (*OURS, "case.toml")
        prepare_out(Path(args.out), resume=False, force=args.force, resumable=False, ours=ours)
    solution = solve_machine(machine)
    say(solution.table())
    if args.out:
        write_machine(machine, solution, Path(args.out))
        say(f"\nTable, numbers and pictures are in {args.out}, of each bearing in a folder there")
    return 0


def warm_command(args: argparse.Namespace) -> int:
    """flexcage warm CASE: temperatures that settle, or a runaway, which is a result (code 0)."""
    from flexcage.core.progress import Progress
    from flexcage.warming import warm, write_warmth

    case = case_or_static(args)
    if args.out:
        prepare_out(Path(args.out), resume=False, force=args.force, resumable=False, ours=_WARM)
    warmth = warm(case, progress=Progress)
    say(warmth.table())
    if args.out:
        write_warmth(warmth, Path(args.out))
        settled = ", and case.toml is the case at these temperatures" if warmth.settled else ""
        say(f"\nThe table, its numbers and a picture are in {args.out}{settled}")
    return 1 if warmth.verdict == "not settled" else 0


def mesh_command(args: argparse.Namespace) -> int:
    """flexcage mesh CASE: build, check and write the cage's mesh."""
    case = checked_case_from(args)
    out = Path(args.out) if args.out else Path(f"{case.name}.msh")
    from flexcage.cages.build import build_cage_mesh
    from flexcage.core.progress import Progress
    from flexcage.core.timing import Stages
    from flexcage.mesh.io import is_written_by_us, write_mesh
    from flexcage.mesh.quality import report_mesh

    paths = dict.fromkeys((out, out.with_suffix(".vtu")))
    for path in paths:  # a mesh of ours is written anew: it costs seconds
        prepare_file(path, (".msh", ".vtu"), force=args.force or is_written_by_us(path))
    mesh = Stages(Progress).named("mesh", build_cage_mesh, **case.cage_shape)
    say(report_mesh(mesh, density=case.its_cage.material.density))
    for path in paths:
        say(f"written: {write_mesh(mesh, path)}")
    return 0


def modes_command(args: argparse.Namespace) -> int:
    """flexcage modes CASE: the modal basis of the cage, as a table printed and stored."""
    case = checked_case_from(args)
    out = Path(args.out) if args.out else Path(f"{case.name}_modes.csv")
    prepare_file(out, (".csv",), force=args.force)
    from flexcage.core.progress import Progress
    from flexcage.core.timing import Stages
    from flexcage.modes.exchange.table import body_table
    from flexcage.results.mode_file import write_modes
    from flexcage.stages import flexible_cage

    cage = flexible_cage(case)
    if cage.body is not None:
        say(body_table(cage.body))
        say("\nAs the cage of this case:\n")
    table = Stages(Progress).named("mesh and modes", lambda: cage.table)
    say(table)
    say(f"written: {write_modes(table, out)}")
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
    say(converge(case, out=out, axes=axes, other_version=args.other_version, progress=Progress))
    say(f"\nThe table, its picture and the runs are in {out}")
    return 0


def draw(run: Any, folder: Path, *, animate: bool, **look: float) -> None:
    """Draw a run's pictures; a machine that cannot draw costs the pictures, not the run."""
    from flexcage.core.errors import pictures_alone

    with pictures_alone(logging.getLogger(__name__)):
        run.draw(folder, animate=animate, **look)
