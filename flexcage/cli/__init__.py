"""The command line: parse, call, and say in one sentence what went wrong.

Exit codes: 0 done, 1 a run that failed or a machine that lacks something, 2 a mistake in the
input, 130 stopped by Ctrl-C (a study also 143 by SIGTERM, 129 by a closed terminal).
FLEXCAGE_DEBUG=1 shows tracebacks.
"""

from __future__ import annotations

import os
import sys
import time
from contextlib import suppress
from errno import ENAMETOOLONG
from typing import TYPE_CHECKING, NoReturn

from flexcage.core import printable, stopping

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

_running: argparse.Namespace | None = None  # the command that Ctrl-C would stop


def entry() -> NoReturn:
    """The console script: ``main``, which Ctrl-C ends at any moment in one line."""
    stopping.on_interrupt(lambda: _line(_stopped_sentence(_running)))
    code = main()
    if code == stopping.code():
        stopping.leave("")
    sys.exit(code)


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; the exit code."""
    global _running
    begun = time.perf_counter()
    printable.on_any_terminal()
    parser = build_parser()
    args = parser.parse_args(argv)
    args.begun = begun
    if not hasattr(args, "command"):
        parser.print_help()
        return 2
    _running = args
    try:
        return _call(args)
    except KeyboardInterrupt:
        return _fail(_stopped_sentence(args), stopping.code())
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
    from flexcage.core.errors import FlexcageError, in_one_line, is_full

    if isinstance(exc, FlexcageError):
        return str(exc), exc.exit_code
    if isinstance(exc, OSError):
        if exc.errno == ENAMETOOLONG:
            return in_one_line(f"The path '{exc.filename}' is too long for this machine."), 2
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


def _stopped_sentence(args: argparse.Namespace | None) -> str:
    """What Ctrl-C leaves of a command. It may come at any moment: nothing is imported here."""
    out = getattr(args, "out", None)
    if getattr(args, "shard", None):
        return "Stopped; what is finished is kept, and the same command goes on from there."
    if out is not None and os.path.exists(os.path.join(out, "study.toml")):
        loaded: tuple[str, ...] = getattr(
            sys.modules.get("flexcage.case.extensions"), "sources", tuple
        )()
        use = "".join(f" --use {source}" for source in loaded)
        return (
            f"Stopped; what is finished is kept in '{out}', and 'flexcage study resume {out}{use}' "
            "goes on from there."
        )
    stores = ("results.zarr", "shaft.zarr")
    if out is None or not any(os.path.exists(os.path.join(out, store)) for store in stores):
        return "Stopped."
    return f"Stopped; what was computed is kept in '{out}', and --resume goes on from there."


def _line(sentence: str) -> str:
    text = sentence.strip()
    return f"flexcage: {text if text.endswith(('.', '!', '?')) else text + '.'}"


def _fail(sentence: str, code: int) -> int:
    with suppress(OSError):  # the terminal may be closed
        sys.stderr.write(f"{_line(sentence)}\n")
    return code


def build_parser() -> argparse.ArgumentParser:
    """All commands and their options."""
    from flexcage.cli import lists, new, on_cases, on_datasets, on_runs, on_studies, small
    from flexcage.cli.parser import new_parser

    parser = new_parser()
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    for group in (new, on_cases, on_runs, on_studies, on_datasets, lists, small):
        group.add_commands(commands)
    return parser
