"""Commands that list what flexcage knows: keys of a case, result variables, figures."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flexcage.cli.files import prepare_file
from flexcage.cli.parser import command, say
from flexcage.core.writing import write_text

if TYPE_CHECKING:
    from flexcage.core.listing import Listing


def add_commands(commands: Any) -> None:
    """Add this module's commands to the parser."""
    keys = command(commands, "keys", keys_command, "every key of a case: unit, default, meaning")
    what = "a section, or a text to look for; without one, the sections"
    keys.add_argument("wanted", nargs="*", metavar="TEXT", help=what)
    text = "every result variable: dimensions, unit, meaning"
    variables = command(commands, "variables", variables_command, text)
    text = "every figure of a summary: unit, meaning"
    figures = command(commands, "figures", figures_command, text)
    for listed in (variables, figures):
        listed.add_argument("wanted", nargs="?", default="", metavar="TEXT", help="text to find")
    for listed in (keys, variables, figures):
        listed.add_argument("-o", "--out", metavar="FILE", help="write a page (.md)")
        listed.add_argument("--force", action="store_true", help="write over an existing file")


def keys_command(args: argparse.Namespace) -> int:
    """flexcage keys [SECTION or TEXT ...]: keys of a case, or of a machine; alone, the sections."""
    from flexcage.case import keys
    from flexcage.machine.keys import groups_of_machines

    if not args.wanted:
        say(keys.contents().text())
        say(
            "\n'flexcage keys SECTION' lists its keys.\n'flexcage keys machine' lists "
            "those of a machine.\n'flexcage keys TEXT' finds keys by a text."
        )
        return 0
    more = groups_of_machines()
    listings = [group.listing() for wanted in args.wanted for group in keys.chosen(wanted, more)]
    page = keys.PAGE.format(", ".join(args.wanted), " ".join(args.wanted))
    return _show(listings, args, page)


def variables_command(args: argparse.Namespace) -> int:
    """flexcage variables [TEXT]: what a run records."""
    from flexcage.results import registry

    return _show([registry.listing(args.wanted)], args, registry.PAGE)


def figures_command(args: argparse.Namespace) -> int:
    """flexcage figures [TEXT]: what a summary holds, and a study may ask for."""
    from flexcage.results.figures import table

    return _show([table.listing(args.wanted)], args, table.PAGE)


def _show(listings: Iterable[Listing], args: argparse.Namespace, page: str) -> int:
    if not args.out:
        say("\n\n".join(listing.text() for listing in listings))
        return 0
    out = Path(args.out)
    prepare_file(out, (".md",), force=args.force)
    text = "\n".join([page, *(listing.markdown() for listing in listings)])
    write_text(out, f"{text.rstrip()}\n")
    say(f"written: {out}")
    return 0
