"""Studies: many cases planned, run on Dask and gathered; two runs put side by side."""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
