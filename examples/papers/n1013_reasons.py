"""Why a claim holds or not: what the study's figures show, in words, by key and outcome."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from n1013_view import View

Reason = Callable[[View], str]

REASONS: Mapping[tuple[str, str], Reason] = {}


def FINDINGS(view: View) -> str:
    """The findings in plain sentences."""
    return ""
