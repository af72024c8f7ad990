"""A warning: what the reader of a run's figures must know. Any room may make one."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class RunWarning:
    """``key`` names the kind in a study's table; ``text`` is one sentence for a reader."""

    key: str
    text: str
