"""Bases, interfaces and mode tables as named arrays and back: what the disk cache and a run's
folder keep of a reduced cage.

A folder keeps a shape in 24 bits: whole steps of 2^-23 of its largest displacement, so that the
error anywhere is what single precision has there. Stress differs by some 100 Pa
from that of shapes in full precision (``tests/simulate/test_folder_alone.py``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple, fields
from typing import Any, TypeVar

import numpy as np
import scipy.sparse as sp

from flexcage.core.arrays import SPARSE, sparse_matrix
from flexcage.core.errors import InputError
from flexcage.core.hashing import content_hash
from flexcage.modes.basis import BodyFit, ModeBasis, ResidualFlexibility
from flexcage.modes.table import ModeTable

Interface = TypeVar("Interface")
_STEPS = 2**23 - 1  # to the largest displacement of a shape


def basis_arrays(basis: ModeBasis) -> dict[str, np.ndarray]:
    """A basis, and a ``digest`` of its shapes: modes of equal frequency can come out turned when
    another release of a library makes them again, and what was made from these does not fit."""
    arrays = {
        "name": np.array(basis.name),
        "shapes": basis.shapes,
        "stiffness": basis.stiffness,
        "mass": basis.mass,
        "frequencies": basis.frequencies,
        "kind": np.array(basis.kind),
        "digest": np.array(content_hash(basis.shapes)),
    }
    if basis.geometric is not None:
        arrays["geometric"] = basis.geometric
    if basis.fit is not None:
        arrays["fit"] = np.array(astuple(basis.fit))
    if basis.residual is not None:
        r = basis.residual
        assert r.shapes is not None, "a basis is stored as it was made"
        arrays |= {
            "r_shapes": r.shapes,
            "r_stiffness": r.stiffness,
            "r_compliance": r.compliance,
            "r_far": np.array(r.far_coupling),
        }
    return arrays


def rounded(a: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Arrays of a basis as a run's folder keeps them: each shape in whole ``steps`` (int32) of its
    ``step`` [shape's unit], and no residual shapes."""
    shapes = a["shapes"]
    step = np.abs(shapes).max(axis=(0, 1), initial=0.0) / _STEPS
    step = np.where(step > 0.0, step, 1.0)
    kept = {name: value for name, value in a.items() if name not in ("shapes", "r_shapes")}
    return {**kept, "steps": np.rint(shapes / step).astype(np.int32), "step": step}


def basis_from(a: Mapping[str, np.ndarray]) -> ModeBasis:
    """The basis of which these are the arrays, as made or ``rounded``."""
    residual = None
    if "r_far" in a:
        residual = ResidualFlexibility(
            shapes=a.get("r_shapes"),
            stiffness=a["r_stiffness"],
            compliance=a["r_compliance"],
            far_coupling=float(a["r_far"]),
        )
    return ModeBasis(
        name=str(a["name"]),
        shapes=a["shapes"] if "shapes" in a else a["steps"] * a["step"],
        stiffness=a["stiffness"],
        mass=a["mass"],
        frequencies=a["frequencies"],
        kind=tuple(str(k) for k in a["kind"]),
        residual=residual,
        geometric=a.get("geometric"),
        fit=BodyFit(*map(float, a["fit"])) if "fit" in a else None,
    )


def table_arrays(table: ModeTable) -> dict[str, np.ndarray]:
    """Fields of a mode table."""
    return {field.name: np.asarray(getattr(table, field.name)) for field in fields(table)}


def table_from(a: Mapping[str, np.ndarray]) -> ModeTable:
    """The mode table of which these are the fields."""
    texts: dict[str, Any] = {n: tuple(str(x) for x in a[n]) for n in ("kind", "loaded")}
    return ModeTable(**{**a, **texts})


def interface_arrays(interface: Any) -> dict[str, np.ndarray]:
    """Fields of an interface, a sparse matrix by its parts; those that are None are left out."""
    arrays: dict[str, np.ndarray] = {}
    for field in fields(interface):
        value = getattr(interface, field.name)
        if sp.issparse(value):
            arrays |= {f"{field.name}.{part}": getattr(value, part) for part in SPARSE}
        elif value is not None:
            arrays[field.name] = value
    return arrays


def interface_from(kind: type[Interface], a: Mapping[str, np.ndarray]) -> Interface:
    """The interface of a ``kind`` of which these are the arrays; a number is a float."""
    values: dict[str, Any] = {
        n: x if np.ndim(x) else float(x) for n, x in a.items() if "." not in n
    }
    for name in {n.split(".")[0] for n in a if "." in n}:
        parts = {part: a[f"{name}.{part}"] for part in SPARSE if f"{name}.{part}" in a}
        try:
            values[name] = sparse_matrix(parts, name)
        except ValueError as error:
            raise InputError(
                f"What was kept of the cage's contacts is damaged ({error}); run the case again, "
                "or remove what the cache holds: flexcage cache --clear.",
                where="cage",
            ) from error
    return kind(**values)
