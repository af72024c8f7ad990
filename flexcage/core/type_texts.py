"""Types of numba as texts that say all of them: names of fields too, which numba leaves out."""

from __future__ import annotations

from functools import cache
from typing import Any

from numba import types
from numba.core.typing import Signature


class UnknownContent(TypeError):
    """A kernel takes in something of which nobody can say here when it changes."""


@cache
def described(kind: Any) -> str:
    """A numba type, signature or tuple of types as text, with all names of fields in their order.

    Raises UnknownContent for the type of one function alone, which stands for what that holds.
    """
    if isinstance(kind, Signature):
        return f"{described(kind.return_type)} of {described(kind.args)}"
    if isinstance(kind, types.BaseNamedTuple):
        return f"{class_name(kind.instance_class)}{kind.fields}{described(tuple(kind.types))}"
    if isinstance(kind, tuple | types.BaseTuple):
        return f"({', '.join(map(described, kind))})"
    if isinstance(kind, types.FunctionType):
        return f"{type(kind).__name__}[{described(kind.signature)}]"
    if isinstance(kind, types.Callable | types.ClassInstanceType):
        raise UnknownContent(f"the argument {kind}")
    if not isinstance(kind, types.Type):
        return repr(kind)
    return f"{kind}{''.join(f'[{described(part)}]' for part in parts_of(kind))}"


def parts_of(kind: Any) -> tuple[types.Type, ...]:
    """Types that a numba type, a signature or a tuple of types is made of."""
    if isinstance(kind, Signature):
        return (kind.return_type, *kind.args)
    if isinstance(kind, tuple | types.BaseTuple):
        return tuple(kind)
    if isinstance(kind, types.FunctionType):
        return parts_of(kind.signature)
    found = (
        getattr(kind, name, None) for name in ("held", "dtype", "type", "key_type", "value_type")
    )
    return tuple(part for part in found if isinstance(part, types.Type) and part is not kind)


def class_name(kind: Any) -> str:
    """Module and name of a class or function."""
    return f"{kind.__module__}:{kind.__qualname__}"
