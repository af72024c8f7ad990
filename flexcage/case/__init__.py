"""The case: what is asked, from TOML or from objects, checked and hashed."""

from flexcage.case.case import Case, load_case
from flexcage.case.extensions import load_extension
from flexcage.case.static import StaticCase, load_static

__all__ = ["Case", "StaticCase", "load_case", "load_extension", "load_static"]
