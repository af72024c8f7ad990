"""Temperatures that a bearing settles at: losses, heat, viscosity and clearance, in turns."""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
