"""Names of a package, loaded from their modules when first used (PEP 562).

A package's stub (``.pyi``) says where each name comes from; type checkers read it as well.
Modules of which it imports ``*`` are loaded once a name of the package is asked for.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any


def lazy(package: str, file: str) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """``__getattr__`` and ``__dir__`` of a package (or module) whose stub lies beside ``file``."""

    @cache
    def homes() -> dict[str, tuple[str, str]]:
        """Module of every name of the stub, and what the name is called there."""
        import ast
        from pathlib import Path

        stub = ast.parse(Path(file).with_suffix(".pyi").read_text("utf-8"))
        found: dict[str, tuple[str, str]] = {}
        for line in stub.body:
            if not isinstance(line, ast.ImportFrom):
                continue
            module = str(line.module)
            for name in line.names:
                if name.name == "*":
                    found |= {each: (module, each) for each in _public(module)}
                else:
                    found[name.asname or name.name] = module, name.name
        return found

    def listed() -> list[str]:
        return sorted(homes())

    def find(name: str) -> Any:
        if name == "__all__":
            return listed()
        if name.startswith("__") or name not in homes():
            raise unknown(package, name, {each: package for each in listed()})
        module, original = homes()[name]
        if module == package:  # a room of this package
            return importlib.import_module(f"{package}.{original}")
        value = getattr(importlib.import_module(module), original)
        setattr(sys.modules[package], name, value)
        return value

    return find, listed


def _public(module: str) -> list[str]:
    """Names that ``from module import *`` takes."""
    there = vars(importlib.import_module(module))
    return [name for name in there if not name.startswith("_")]


def unknown(package: str, name: str, homes: Mapping[str, str]) -> AttributeError:
    """The error for a name that a package has not; ``homes`` maps the names that there are to
    where they stand."""
    import difflib

    close = [] if name.startswith("_") else difflib.get_close_matches(name, homes, n=1, cutoff=0.7)
    hint = f"; did you mean {homes[close[0]]}.{close[0]}?" if close else ""
    return AttributeError(f"module '{package}' has no attribute '{name}'{hint}")
