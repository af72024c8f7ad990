"""Names of a package, loaded from their modules when first used (PEP 562).

A package's stub (``.pyi``) says where each name comes from; type checkers read it as well.
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable
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
        lines = [node for node in stub.body if isinstance(node, ast.ImportFrom)]
        return {a.asname or a.name: (str(n.module), a.name) for n in lines for a in n.names}

    def listed() -> list[str]:
        return sorted(homes())

    def find(name: str) -> Any:
        if name == "__all__":
            return listed()
        if name.startswith("__") or name not in homes():
            raise AttributeError(f"module '{package}' has no attribute '{name}'")
        module, original = homes()[name]
        if module == package:  # a room of this package
            return importlib.import_module(f"{package}.{original}")
        value = getattr(importlib.import_module(module), original)
        setattr(sys.modules[package], name, value)
        return value

    return find, listed
