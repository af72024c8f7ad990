"""A basis as named arrays, for the disk cache, and back."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from flexcage.modes.basis import ModeBasis, ResidualFlexibility

MODEL_VERSION = 1  # raise when the same spec would give another basis

_RESIDUAL = "residual_"


def basis_arrays(basis: ModeBasis) -> dict[str, np.ndarray]:
    """Arrays that hold all of a basis; ``basis_from_arrays`` is the inverse."""
    arrays = {
        "name": np.array(basis.name),
        "kind": np.array(basis.kind),
        "shapes": basis.shapes,
        "stiffness": basis.stiffness,
        "mass": basis.mass,
        "frequencies": basis.frequencies,
    }
    if basis.residual is not None:
        fields = vars(basis.residual).items()
        arrays.update({_RESIDUAL + key: np.asarray(value) for key, value in fields})
    return arrays


def basis_from_arrays(arrays: Mapping[str, np.ndarray]) -> ModeBasis:
    """The basis that ``basis_arrays`` took apart."""
    residual = None
    if _RESIDUAL + "shapes" in arrays:
        residual = ResidualFlexibility(
            shapes=arrays[_RESIDUAL + "shapes"],
            stiffness=arrays[_RESIDUAL + "stiffness"],
            compliance=arrays[_RESIDUAL + "compliance"],
            far_coupling=float(arrays[_RESIDUAL + "far_coupling"]),
        )
    return ModeBasis(
        name=str(arrays["name"]),
        shapes=arrays["shapes"],
        stiffness=arrays["stiffness"],
        mass=arrays["mass"],
        frequencies=arrays["frequencies"],
        kind=tuple(str(kind) for kind in arrays["kind"]),
        residual=residual,
    )
