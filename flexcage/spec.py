"""The parts of a case: bearings, cages and their defects, contacts, drive and load, options; and
curves and laws of materials, and how lasers measure."""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
