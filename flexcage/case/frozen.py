"""Assigning to a value of a case, which is frozen: told with the call that makes a changed copy."""

from __future__ import annotations

import dataclasses
from typing import Any, NoReturn

from flexcage.core.errors import InputError

_EXPLAINED: set[type] = set()


class Frozen(InputError, dataclasses.FrozenInstanceError):
    """A value of a case was assigned; a FrozenInstanceError too, as of any frozen dataclass."""


def explain(case: Any) -> None:
    """Let the classes of a case and of what it holds say how their values are changed."""
    _explain(case, "", 0)


def _explain(spec: Any, path: str, depth: int) -> None:
    kind = type(spec)
    if kind not in _EXPLAINED and "__dataclass_params__" in kind.__dict__:
        _EXPLAINED.add(kind)
        # a section stands in one place; what it holds, as a material, may stand in several
        refuse = _refusing(path if depth < 2 else None)
        kind.__setattr__ = kind.__delattr__ = refuse
    for field in dataclasses.fields(spec):
        value = getattr(spec, field.name)
        for part in value if isinstance(value, tuple) else (value,):
            if dataclasses.is_dataclass(part) and not isinstance(part, type):
                listed = 2 if isinstance(value, tuple) else 1
                _explain(part, f"{path}{field.name}.", depth + listed)


def _refusing(path: str | None) -> Any:
    def refuse(self: Any, name: str, value: Any = None) -> NoReturn:
        where = name if path is None else f"{path}{name}"
        call = "..." if path is None else f'"{where}", value'
        named = ", with the path of this value" if path is None else ""
        raise Frozen(
            f"{name} of {_article(type(self).__name__)} was to be set, but cases and their parts "
            f"cannot be changed; make a changed copy, case = case.replace({call}){named}.",
            where=where,
            value=value,
        )

    return refuse


def _article(name: str) -> str:
    return f"{'an' if name[0] in 'AEIOU' else 'a'} {name}"
