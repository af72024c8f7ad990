"""flexcage: rigid-flexible dynamics of rolling bearings with an elastic, deformed cage.

``import flexcage`` loads almost nothing: names come from their modules when first used. Verbs and
what they take and return stand here; ``flexcage.spec`` holds the parts of a case,
``flexcage.study`` the axes of a study, ``flexcage.register`` adds what is yours, and
``flexcage.render`` draws.
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any

from flexcage._names import lazy, unknown
from flexcage._version import __version__ as __version__

_find, __dir__ = lazy(__name__, __file__)


def __getattr__(name: str) -> Any:
    try:
        return _find(name)
    except AttributeError:
        if name.startswith("_"):
            raise
        raise unknown(__name__, name, _all_names()) from None


def _packages() -> list[ModuleType]:
    return [importlib.import_module(name) for name in ("flexcage.spec", "flexcage.study")]


def _all_names() -> dict[str, str]:
    """Names of flexcage and of its namespaces, and where they stand."""
    packages = {name: module.__name__ for module in _packages() for name in module.__all__}
    return {**packages, **dict.fromkeys(__dir__(), __name__)}


class _Package(ModuleType):
    """``flexcage.simulate`` is the function, though a module of that name is imported as well."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "simulate" and isinstance(value, ModuleType):
            return  # the import system would put the module in the function's place
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
