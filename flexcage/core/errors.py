"""Errors that a user can act on. Their text is one sentence: what, where, value, what is right."""

from __future__ import annotations


class FlexcageError(Exception):
    """Base of all errors that flexcage raises on purpose."""

    exit_code = 1


class InputError(FlexcageError, ValueError):
    """A mistake in the input: case, geometry, mesh, option. ``where`` and ``value`` name it."""

    exit_code = 2

    def __init__(self, message: str, *, where: str = "", value: object = None) -> None:
        super().__init__(message)
        self.where = where
        self.value = value


class EnvironmentLacks(FlexcageError, RuntimeError):
    """This machine lacks something (a system library, a package); the text names the remedy."""

    exit_code = 1


class RunFailed(FlexcageError, RuntimeError):
    """A computation that could not go on; what was computed before is kept."""

    exit_code = 1
