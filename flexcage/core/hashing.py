"""Content hashes over canonical JSON: equal inputs give equal names on disk."""

from __future__ import annotations

import dataclasses
import enum
import hashlib
import json
import math
from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

import numpy as np

_DIGITS = 12  # 0.2 * 1e-3 and 200 * 1e-6 differ in the 16th digit and mean the same


def canonical(obj: Any) -> Any:
    """Plain JSON values of nested dataclasses: numbers rounded to 12 significant digits.

    Integers and floats of the same value are the same; arrays enter by shape, type and bytes;
    fields that are not ``hashed`` (``core.spec``) stay out.
    """
    if obj is None or isinstance(obj, (bool, str)):
        return obj
    if isinstance(obj, enum.Enum):
        return canonical(obj.value)
    if isinstance(obj, (int, float, np.integer, np.floating)):
        return _number(obj)
    if isinstance(obj, np.bool_):
        return bool(obj)
    if dataclasses.is_dataclass(obj) and not isinstance(obj, type):
        fields = [f for f in dataclasses.fields(obj) if f.metadata.get("hashed", True)]
        values = {f.name: getattr(obj, f.name) for f in fields}
        return {"": type(obj).__name__, **{name: canonical(v) for name, v in values.items()}}
    if isinstance(obj, Mapping):
        return {str(k): canonical(v) for k, v in obj.items()}
    if isinstance(obj, (list, tuple)):
        return [canonical(v) for v in obj]
    if isinstance(obj, np.ndarray):
        data = np.ascontiguousarray(obj)
        return [
            "array",
            list(obj.shape),
            str(obj.dtype),
            hashlib.sha256(data.tobytes()).hexdigest(),
        ]
    if isinstance(obj, bytes):
        return ["bytes", hashlib.sha256(obj).hexdigest()]
    if isinstance(obj, PurePath):
        return str(obj)
    raise TypeError(f"no canonical form for {type(obj).__name__}")


def _number(x: Any) -> Any:
    if isinstance(x, (int, np.integer)) and abs(int(x)) >= 10**_DIGITS:
        return int(x)
    value = float(x)
    if not math.isfinite(value):
        return ["number", str(value)]
    rounded = float(f"{value:.{_DIGITS}g}")
    return int(rounded) if rounded == int(rounded) and abs(rounded) < 2**53 else rounded


def canonical_json(obj: Any) -> str:
    """Canonical JSON text of nested dataclasses, mappings, sequences and arrays."""
    return json.dumps(canonical(obj), sort_keys=True, separators=(",", ":"), ensure_ascii=True)


def content_hash(obj: Any, *extra: Any) -> str:
    """16 hexadecimal digits that name ``obj`` and ``extra`` (a model version, say) by content."""
    return hashlib.sha256(canonical_json([obj, *extra]).encode()).hexdigest()[:16]


def sealed(table: Mapping[str, Any]) -> dict[str, Any]:
    """A table of plain JSON values with its ``seal``, by which ``seal_holds`` sees a change."""
    return {**table, "seal": _seal(table)}


def seal_holds(table: Mapping[str, Any]) -> bool:
    """Is a table, as read from JSON, what was sealed?"""
    rest = {key: value for key, value in table.items() if key != "seal"}
    return table.get("seal") == _seal(rest)


def _seal(table: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(table, sort_keys=True).encode()).hexdigest()[:16]
