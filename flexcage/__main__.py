"""``python -m flexcage`` is the console script."""

from flexcage.cli import entry

entry()
