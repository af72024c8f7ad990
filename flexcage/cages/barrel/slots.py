"""Parts of cages of barrels, each loaded when first used; the stub beside says where they are."""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
