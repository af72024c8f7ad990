"""A run: what was asked, what happened, and what can be asked of it afterwards; its folder."""

from flexcage.run.at_start import warnings_at_start
from flexcage.run.run import Run
from flexcage.stress.run_stress import StressField

__all__ = ["Run", "StressField", "warnings_at_start"]
