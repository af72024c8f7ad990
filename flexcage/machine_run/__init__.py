"""Runs of machines: a shaft that turns in several bearings, each with its elements and cage."""

from flexcage.machine_run.run import MachineRun, load_machine_run
from flexcage.machine_run.simulate import simulate_machine

__all__ = ["MachineRun", "load_machine_run", "simulate_machine"]
