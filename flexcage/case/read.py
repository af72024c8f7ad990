"""Nested tables of a case: from a file, from TOML text, or from tables."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.missing import no_file
from flexcage.core.texts import text_of
from flexcage.core.toml import read_toml


def read_case(source: str | Path | Mapping[str, Any]) -> tuple[dict[str, Any], Path | None]:
    """Nested tables of a file, a text or tables, and the folder where relative paths start."""
    table, path = _tables(source)
    if is_machine(table):
        called = f"'{path}'" if path else "This"
        has = "[[bearings]]" if "bearings" in table else "[shaft]"
        raise InputError(
            f"{called} is a machine, for it has {has}, not the case of one bearing: 'flexcage run "
            f"{path or 'MACHINE'}' and 'flexcage static' take machines, and flexcage.load_machine "
            "in Python.",
            where="case",
            value=str(path or ""),
        )
    if path is None:
        return table, None
    if "case" in table and "bearing" not in table:
        what, command = study_or_map(table)
        raise InputError(
            f"'{path}' is a {what}, not a case; take '{command} {path}'.",
            where="case",
            value=str(path),
        )
    return table, path.resolve().parent


def is_machine(table: Mapping[str, Any]) -> bool:
    """Do tables describe a machine, with a shaft or several bearings, not the case of one?"""
    several = isinstance(table.get("bearings"), list)
    return several or ("shaft" in table and "bearing" not in table and "preset" not in table)


def names_machine(path: Path) -> bool:
    """Is a file that of a machine? Raises InputError for one that cannot be read."""
    return is_machine(_tables(path)[0])


def read_machine(source: str | Path | Mapping[str, Any]) -> tuple[dict[str, Any], Path | None]:
    """The same of a machine. Raises InputError for a case of one bearing."""
    table, path = _tables(source)
    if not is_machine(table) and "bearing" in table:
        called = f"'{path}'" if path else "This"
        raise InputError(
            f"{called} is the case of one bearing, not a machine, which has [shaft] and "
            "[[bearings]]; flexcage.load_static reads it.",
            where="case",
            value=str(path or ""),
        )
    return table, None if path is None else path.resolve().parent


def _tables(source: str | Path | Mapping[str, Any]) -> tuple[dict[str, Any], Path | None]:
    """Nested tables, and the file that they are from."""
    if isinstance(source, Mapping):
        return dict(source), None
    if isinstance(source, str) and ("\n" in source or "=" in source):
        return read_toml(source, "The text", where="case"), None
    path = path_of(source, "case")
    return read_toml(_text(path), str(path), where="case"), path


def study_or_map(table: Mapping[str, Any]) -> tuple[str, str]:
    """Which of both the tables of a file that is no case are, and the command that computes it."""
    return ("map", "flexcage study map") if "unknowns" in table else ("study", "flexcage study run")


def _text(path: Path) -> str:
    try:
        return text_of(path, "a case is TOML", where="case")
    except InputError:
        raise
    except FileNotFoundError:
        sentence = f"{no_file('case file', path, ('.toml',))}."
    except IsADirectoryError:
        sentence = f"'{path}' is a folder; name the .toml case file in it."
    except PermissionError:
        sentence = f"The case file '{path}' may not be read; check its permissions."
    except (OSError, ValueError) as exc:  # a name that no file can have
        reason = getattr(exc, "strerror", None) or exc
        sentence = f"The case file '{path}' cannot be read: {reason}."
    raise InputError(sentence, where="case", value=str(path))
