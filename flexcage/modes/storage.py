"""Bases and interfaces as named arrays and back: what the disk cache keeps of a reduced cage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeVar

import numpy as np
import scipy.sparse as sp

from flexcage.core.hashing import content_hash
from flexcage.modes.basis import ModeBasis, ResidualFlexibility

Interface = TypeVar("Interface")
_SPARSE = ("data", "indices", "indptr", "shape")  # what a sparse matrix is stored as


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
    if basis.residual is not None:
        r = basis.residual
        arrays |= {
            "r_shapes": r.shapes,
            "r_stiffness": r.stiffness,
            "r_compliance": r.compliance,
            "r_far": np.array(r.far_coupling),
        }
    return arrays


def basis_from(a: Mapping[str, np.ndarray]) -> ModeBasis:
    """The basis of which these are the arrays."""
    residual = None
    if "r_shapes" in a:
        residual = ResidualFlexibility(
            shapes=a["r_shapes"],
            stiffness=a["r_stiffness"],
            compliance=a["r_compliance"],
            far_coupling=float(a["r_far"]),
        )
    return ModeBasis(
        name=str(a["name"]),
        shapes=a["shapes"],
        stiffness=a["stiffness"],
        mass=a["mass"],
        frequencies=a["frequencies"],
        kind=tuple(str(k) for k in a["kind"]),
        residual=residual,
        geometric=a.get("geometric"),
    )


def interface_arrays(interface: Any) -> dict[str, np.ndarray]:
    """Fields of an interface, a sparse matrix by its parts; those that are None are left out."""
    arrays: dict[str, np.ndarray] = {}
    for field in fields(interface):
        value = getattr(interface, field.name)
        if sp.issparse(value):
            arrays |= {f"{field.name}.{part}": getattr(value, part) for part in _SPARSE}
        elif value is not None:
            arrays[field.name] = value
    return arrays


def interface_from(kind: type[Interface], a: Mapping[str, np.ndarray]) -> Interface:
    """The interface of a ``kind`` of which these are the arrays; a number is a float."""
    values: dict[str, Any] = {
        n: x if np.ndim(x) else float(x) for n, x in a.items() if "." not in n
    }
    for name in {n.split(".")[0] for n in a if "." in n}:
        data, indices, indptr, shape = (a[f"{name}.{part}"] for part in _SPARSE)
        values[name] = sp.csr_matrix((data, indices, indptr), shape=tuple(shape))
    return kind(**values)
