"""Known answers in tests: rows as ``flexcage verify`` has them, each with its tolerance."""

from __future__ import annotations

from collections.abc import Iterable

from flexcage.verification import Row


def check(rows: Iterable[Row]) -> None:
    """Every row is met, and there is one."""
    found = list(rows)
    assert found
    missed = [
        f"{r.quantity}: {r.value:.8g} for {r.reference:.8g} ({r.difference_text}, {r.tolerance})"
        for r in found
        if not r.passed
    ]
    assert not missed, "\n".join(missed)
