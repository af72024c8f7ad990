"""A machine: a shaft in its bearings, solved statically, linearised, and set in motion."""

from flexcage.machine.machine import Machine, SeatedBearing, is_machine, load_machine

__all__ = ["Machine", "SeatedBearing", "is_machine", "load_machine"]
