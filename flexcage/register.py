"""Add what is yours: bearing families, laws, constraints, mode bases, variables, pictures, ..."""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
