"""``python -m flexcage.cli`` is the console script."""

from flexcage.cli import entry

entry()
