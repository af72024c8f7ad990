"""Conical window cages of tapered roller bearings."""

from __future__ import annotations

from flexcage.cages.conical.cage import ConicalCage

# specs that ``flexcage.spec`` shows
__all__ = ["ConicalCage"]
