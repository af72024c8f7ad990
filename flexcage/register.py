"""Add what is yours: laws, constraints, mode bases, integrators, variables, pictures, materials."""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
