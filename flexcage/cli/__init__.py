"""The command line: parse, call, and say in one sentence what went wrong.

Exit codes: 0 done, 1 a run that failed or a machine that lacks something, 2 a mistake in the
input, 130 stopped by Ctrl-C. FLEXCAGE_DEBUG=1 shows tracebacks.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from flexcage.cli import on_cases, on_runs, on_studies, small
from flexcage.cli.parser import new_parser
from flexcage.core.errors import FlexcageError, is_full

_STOPPED = 130


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; the exit code."""
    parser = build_parser()
    begun = time.perf_counter()
    args = parser.parse_args(argv)
    args.begun = begun
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
        if is_full(exc):
            return f"The disk is full{place}; what was written before is kept.", 1
        return f"A file could not be read or written{place}: {exc.strerror or exc}.", 1
    if isinstance(exc, MemoryError):
        return (
            "This machine has too little memory; take a coarser mesh, fewer modes or a "
            "shorter run.",
            1,
        )
    return (
        f"flexcage stopped on an error of its own, {type(exc).__name__}: {exc}; "
        "FLEXCAGE_DEBUG=1 shows where.",
        1,
    )


def _stopped_sentence(args: argparse.Namespace) -> str:
    out = getattr(args, "out", None)
    if out is not None and (Path(out) / "study.toml").exists():
        from flexcage.case.extensions import sources

        use = "".join(f" --use {source}" for source in sources())
        return (
            f"Stopped; what is finished is kept in '{out}', and 'flexcage study resume {out}{use}' "
            "goes on from there."
        )
    if out is None or not (Path(out) / "results.zarr").exists():
        return "Stopped."
    return f"Stopped; what was computed is kept in '{out}', and --resume goes on from there."


def _fail(sentence: str, code: int) -> int:
    first = sentence.strip()
    sys.stderr.write(f"flexcage: {first if first.endswith(('.', '!', '?')) else first + '.'}\n")
    return code


def build_parser() -> argparse.ArgumentParser:
    """All commands and their options."""
    parser = new_parser()
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    for group in (on_cases, on_runs, on_studies, small):
        group.add_commands(commands)
    return parser
