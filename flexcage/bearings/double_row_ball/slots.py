"""Parts of double row ball bearings, each loaded when first used; see the stub beside."""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
