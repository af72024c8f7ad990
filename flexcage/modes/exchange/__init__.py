"""Reduced bodies from elsewhere, and to elsewhere: one value, its formats, its checks."""

from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.formats import read_body, write_body

__all__ = ["ReducedBody", "read_body", "write_body"]
