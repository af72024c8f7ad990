"""Errors that a user can act on. Their text is one sentence: what, where, value, what is right."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager
from errno import EDQUOT, ENOSPC
from traceback import extract_tb
from typing import Any

_WHOLE = 80  # characters of a value of another kind that are told
_LONG, _LONGEST = 240, 1200  # characters of a value, and of a sentence, that are told whole
_VALUE = re.compile(rf"(?<!\w)'[^']*'|\S{{{_LONG},}}")  # in quotes, or without a space
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")


def in_one_line(text: str) -> str:
    """A sentence that can be read, whatever values it tells: long ones lose their middle, and
    control characters are written as escapes."""

    def shortened(long: str, whole: int, most: int) -> str:
        if len(long) <= whole:
            return long
        return f"{long[: most // 2]}... ({len(long)} characters) ...{long[-(most // 4) :]}"

    text = _CONTROL.sub(lambda match: repr(match[0])[1:-1], text)
    text = _VALUE.sub(lambda match: shortened(match[0], _LONG, _LONG // 3), text)
    return shortened(text, _LONGEST, _LONGEST)


def shown(value: Any) -> str:
    """A value as a sentence tells it: as Python writes it, or what it is if that is long."""
    text = repr(value)
    return f"a {type(value).__name__}" if len(text) > _WHOLE or "\n" in text else text


class FlexcageError(Exception):
    """Base of all errors that flexcage raises on purpose."""

    exit_code = 1


class InputError(FlexcageError, ValueError):
    """A mistake in the input: case, geometry, mesh, option. ``where`` and ``value`` name it."""

    exit_code = 2

    def __init__(self, message: str, *, where: str = "", value: object = None) -> None:
        super().__init__(in_one_line(message))
        self.where = where
        self.value = value


class EnvironmentLacks(FlexcageError, RuntimeError):
    """This machine lacks something (a system library, a package); the text names the remedy."""

    exit_code = 1


@contextmanager
def pictures_alone(log: logging.Logger) -> Iterator[None]:
    """Where this machine cannot draw, it costs the pictures alone: a warning says why."""
    try:
        yield
    except EnvironmentLacks as exc:
        log.warning("no pictures: %s", exc)


def install(extra: str) -> str:
    """How one installs an extra: from a clone, for no index of packages has flexcage."""
    return f"in the folder of flexcage's sources:  pip install '.[{extra}]'"


def package_lacks(
    work: str, package: str, *, extra: str, pip: str = "", instead: str = ""
) -> EnvironmentLacks:
    """The error to raise where an optional package is not installed.

    ``work`` is what it does ("Fatigue is counted"), ``extra`` the one of flexcage that has it,
    ``pip`` its name for pip if that is another, ``instead`` what else to do.
    """
    return EnvironmentLacks(
        f"{work} by {package}, which is not installed here; install it "
        f"{install(extra)}  (or anywhere:  pip install {pip or package}){instead}."
    )


class RunFailed(FlexcageError, RuntimeError):
    """A computation that could not go on; what was computed before is kept."""

    exit_code = 1


def mistake_in(function: Any, error: Exception) -> str:
    """An error that a user's function raised, and the line of its file."""
    file = getattr(getattr(function, "__code__", None), "co_filename", "")
    lines = [frame.lineno for frame in extract_tb(error.__traceback__) if frame.filename == file]
    where = f" ({file}, line {lines[-1]})" if lines else ""
    return f"{type(error).__name__}: {error}{where}"


def is_full(error: OSError) -> bool:
    """Whether an error of the disk says that it is full, or one's share of it."""
    return error.errno in (ENOSPC, EDQUOT)


def unwritable(
    what: str, error: OSError, *, remedy: str = "", path: object = None
) -> FlexcageError:
    """The error to raise where ``what`` could not be written: RunFailed for a full disk, which is
    no mistake in the input, else InputError with the ``remedy``, about the output ``path``."""
    if is_full(error):
        return RunFailed(f"{what} cannot be written: the disk is full; make room and try again.")
    reason = (error.strerror or str(error)).lower()
    text = f"{what} cannot be written ({reason}){f'; {remedy}' if remedy else ''}."
    return InputError(text, where="out", value=None if path is None else str(path))
