"""Where the command line sends log records; the library itself only logs."""

from __future__ import annotations

import logging
import sys

from flexcage.core.progress import clear_line


class _Plain(logging.Formatter):
    """Plain text for information, the level's name before a warning or an error."""

    def format(self, record: logging.LogRecord) -> str:
        text = record.getMessage()
        return text if record.levelno <= logging.INFO else f"{record.levelname.lower()}: {text}"


class _BetweenProgress(logging.StreamHandler):
    """Writes where progress is drawn, once that line is empty."""

    def emit(self, record: logging.LogRecord) -> None:
        clear_line()
        super().emit(record)


def setup(*, verbose: int = 0) -> None:
    """Send flexcage's records to standard error; -1 warnings, 0 information, 1 debugging: what
    solvers and reductions say of their work."""
    level = {-1: logging.WARNING, 0: logging.INFO}.get(verbose, logging.DEBUG)
    logger = logging.getLogger("flexcage")
    for old in [h for h in logger.handlers if getattr(h, "flexcage_cli", False)]:
        logger.removeHandler(old)
    handler = _BetweenProgress(sys.stderr)
    handler.setFormatter(_Plain())
    handler.flexcage_cli = True  # type: ignore[attr-defined]
    logger.addHandler(handler)
    logger.setLevel(level)
    logger.propagate = False
