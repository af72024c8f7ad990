"""A machine: a shaft in its bearings, solved statically, and linearised about that."""

from flexcage.machine.machine import Machine, SeatedBearing, is_machine, load_machine

__all__ = ["Machine", "SeatedBearing", "is_machine", "load_machine"]
