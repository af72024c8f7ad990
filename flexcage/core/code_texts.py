"""Python functions as texts: what their bytecode says, and what it reads of their module."""

from __future__ import annotations

import dis
from functools import cache
from types import CodeType


def exact(value: object) -> str:
    """A constant to its last bit."""
    if isinstance(value, float):
        text = value.hex()
    elif isinstance(value, complex):
        text = f"{value.real.hex()} {value.imag.hex()}"
    elif isinstance(value, tuple):
        text = ", ".join(map(exact, value))
    elif isinstance(value, frozenset):
        text = ", ".join(sorted(map(exact, value)))
    else:
        text = repr(value)
    return f"{type(value).__name__}({text})"


class Facts:
    """What a function's code says by itself, and what it reads of its module."""

    def __init__(self, code: CodeType, doc: str | None) -> None:
        texts: list[str] = []
        reads: dict[str, set[str]] = {}
        for part in _with_inner(code):
            steps = list(dis.get_instructions(part))
            first_read = any("CONST" in s.opname and s.arg == 0 for s in steps)
            texts.append(_code_text(part, None if first_read or part is not code else doc))
            for step in steps:
                if step.opname in _READS:
                    reads.setdefault(_READS[step.opname], set()).add(step.argval)
        self.text = "\n".join(texts)
        self.globals, self.attributes = (sorted(reads.get(k, ())) for k in ("global", "attribute"))


_READS = {
    "LOAD_GLOBAL": "global", "LOAD_NAME": "global",
    "LOAD_ATTR": "attribute", "LOAD_METHOD": "attribute",
}  # fmt: skip


@cache
def facts_of(code: CodeType, doc: str | None) -> Facts:
    """Facts of a function with this code and docstring."""
    return Facts(code, doc)


def _with_inner(code: CodeType) -> list[CodeType]:
    """A function's code and that of functions inside it."""
    inner = (c for c in code.co_consts if isinstance(c, CodeType))
    return [code, *(part for c in inner for part in _with_inner(c))]


def _code_text(code: CodeType, doc: str | None) -> str:
    """Bytecode, constants but for the docstring, names, arguments."""
    constants = [c for c in code.co_consts if not isinstance(c, CodeType)]
    if doc is not None and constants[:1] == [doc]:
        constants[0] = None
    return repr((
        code.co_code, [*map(exact, constants)], code.co_names, code.co_varnames,
        code.co_freevars, code.co_cellvars, code.co_argcount, code.co_posonlyargcount,
        code.co_kwonlyargcount, code.co_flags & ~_HAS_DOCSTRING,
        getattr(code, "co_exceptiontable", b""),
    ))  # fmt: skip


_HAS_DOCSTRING = 0x4000000  # from Python 3.13 on
