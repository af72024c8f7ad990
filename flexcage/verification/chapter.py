"""The chapter: its cases by name, in reading order, and how they are run."""

from __future__ import annotations

import difflib
import logging
import time
from collections.abc import Sequence

from flexcage.core.errors import FlexcageError, InputError
from flexcage.core.registry import add
from flexcage.core.threads import one_blas_thread
from flexcage.verification import cases
from flexcage.verification.known_answer import KnownAnswer, Outcome, Row

log = logging.getLogger(__name__)

CHAPTER: dict[str, KnownAnswer] = {}


def register_case(case: KnownAnswer) -> KnownAnswer:
    """Add a case: ``flexcage verify`` then runs it with the others; returns it.

    Raises InputError for a name that is taken, and for a case without a source.
    """
    if not case.source:
        raise InputError(
            f"Verification case '{case.name}' has no source; say where its numbers come from.",
            where="source",
        )
    return add(CHAPTER, case.name, case, what="verification case")


for _case in cases.IN_ORDER:
    register_case(_case)


def chosen(names: Sequence[str] = (), *, quick: bool = False) -> list[KnownAnswer]:
    """Cases by name, or all of them; ``quick`` leaves out those that take long.

    Raises InputError for an unknown name, with the nearest known one.
    """
    for name in names:
        if name not in CHAPTER:
            near = difflib.get_close_matches(name, CHAPTER, n=1, cutoff=0.6)
            hint = f"the nearest known one is '{near[0]}'" if near else "--list shows all"
            raise InputError(
                f"Verification case '{name}' is not known; {hint}.", where="verify", value=name
            )
    picked = [CHAPTER[name] for name in dict.fromkeys(names)] or list(CHAPTER.values())
    picked = [case for case in picked if case.quick or not quick]
    if not picked:
        raise InputError(
            "None of the cases named is quick; leave out --quick.", where="verify", value=names
        )
    return picked


@one_blas_thread
def run_case(case: KnownAnswer) -> Outcome:
    """Compute a case's rows; an error becomes part of the outcome, so that others still run."""
    log.info("verifying %s: %s", case.name, case.title)
    rows: list[Row] = []
    start, error = time.perf_counter(), ""
    try:
        rows.extend(case.rows())
    except Exception as exc:
        log.debug("case %s stopped", case.name, exc_info=True)
        error = " ".join(str(exc).split())
        if not isinstance(exc, FlexcageError):  # its sentence does not say what it is
            error = f"{type(exc).__name__}: {error}"
    return Outcome(case, tuple(rows), time.perf_counter() - start, error)
