"""Add what is yours: bearing families, laws, constraints, mode bases, variables, pictures, ...

``quantity`` and ``option`` are the fields of specs, ``Variable`` describes a result.
"""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
