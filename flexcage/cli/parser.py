"""What all commands share on the command line: the parser, common options, output."""

from __future__ import annotations

import argparse
import os
import sys
from typing import Any, NoReturn

from flexcage._version import __version__
from flexcage.core.binding import did_you_mean, near_names
from flexcage.core.errors import in_one_line


def say(text: object = "") -> None:
    """Write to standard output: what the command was asked for."""
    sys.stdout.write(f"{text}\n")


def say_shard(state: Any, merge: str) -> int:
    """Say how far a shard is and which command gathers all; 1 if a case of it failed."""
    say(state)
    say(f"It is in {state.folder}; 'flexcage {merge}' gathers the shards")
    return 1 if state.failed else 0


_BEFORE = ("-v", "--verbose", "-q", "--quiet", "--version")


class _Parser(argparse.ArgumentParser):
    """Options that are wrong get one sentence, as any other mistake."""

    def error(self, message: str) -> NoReturn:
        sentence = in_one_line(f"{message}; '{self.prog} --help' lists the options.")
        self.exit(2, f"flexcage: {sentence}\n")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """As in argparse, but each command refuses by itself what it does not know."""
        found, rest = super().parse_known_args(args, namespace)
        unknown = next((text for text in rest if text.startswith("-")), None)
        if unknown is not None:
            name = unknown.partition("=")[0]
            if name in _BEFORE:
                self.error(f"{name} stands before the command: flexcage {name} ...")
            known = [option for action in self._actions for option in action.option_strings]
            near = near_names(name, known, 1, cutoff=0.75)
            hint = f"the nearest known one is '{near[0]}'" if near else (
                f"it takes {', '.join(known)}" if "--set" not in known
                else "a value of the case is changed by --set PATH=VALUE"
            )  # fmt: skip
            self.error(f"{self.prog} has no option {name}; {hint}")
        if rest:
            torn = "--set" in map(str, args or ()) and (rest[0] == "=" or "=" not in rest[0])
            hint = '; --set takes one word, as --set "load.radial=500 N"' if torn else ""
            self.error(f"{self.prog} takes no '{rest[0]}' here{hint}")
        return found, rest

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is not None and value not in action.choices:
            what = action.metavar or "/".join(action.option_strings)
            if what == "COMMAND" and (value.endswith(".toml") or os.path.isdir(value)):
                takes = "run" if value.endswith(".toml") else "report"
                self.error(f"the command comes first, as in: {self.prog} {takes} {value}")
            known = did_you_mean(str(value), action.choices, "choose from")
            self.error(f"{what} '{value}' is not known; {known}")


def new_parser() -> argparse.ArgumentParser:
    """The parser without its commands."""
    parser = _Parser(
        prog="flexcage", description="Rolling bearings with an elastic, deformed cage."
    )
    parser.add_argument("--version", action="version", version=f"flexcage {__version__}")
    parser.add_argument("-v", "--verbose", action="count", default=0, help="say more")
    parser.add_argument("-q", "--quiet", action="store_true", help="warnings only")
    return parser


def whole_number(text: str) -> int:
    """The value of an option that counts: 1 or more."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' should be a whole number, 1 or more")
    return int(text)


def number(text: str) -> float:
    """The value of an option that is a plain number."""
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' should be a number, as 1.5") from None


def command(commands: Any, name: str, function: Any, text: str) -> argparse.ArgumentParser:
    """Add a command that calls ``function`` with the parsed arguments; its own parser."""
    parser = commands.add_parser(name, help=text, description=text)
    parser.set_defaults(command=function)
    parser.add_argument(
        "--use", action="append", metavar="FILE", help="a .py of your own laws ..., or a preset"
    )
    return parser


def version_option(parser: argparse.ArgumentParser) -> None:
    """Add what every command that goes on with the cases of a study understands."""
    parser.add_argument(
        "--other-version", action="store_true",
        help="add to cases that a flexcage of other physics computed",
    )  # fmt: skip


def picture_options(parser: argparse.ArgumentParser) -> None:
    """Add what every command that draws a run understands."""
    parser.add_argument("--animate", action="store_true", help="make an animation as well")
    parser.add_argument(
        "--view", metavar="ANGLE", help="azimuth of the cage turned to the viewer, as '120 deg'"
    )
    parser.add_argument(
        "--stress-limit", metavar="STRESS", help="stress at the end of the colours, as '25 MPa'"
    )
    parser.add_argument("--scale", metavar="N", help="factor of the deformation that is drawn")


def case_options(parser: argparse.ArgumentParser, *, machines: bool = False) -> None:
    """Add what every command that takes a case understands; ``machines``: it takes them, too."""
    what = "file of a case or a machine (.toml)" if machines else "case file (.toml)"
    parser.add_argument("case", metavar="CASE", help=what)
    parser.add_argument("--cage", choices=("rigid", "flexible"), help="how the cage is modelled")
    parser.add_argument(
        "--set", action="append", metavar="PATH=VALUE", help="change a value of the case"
    )
