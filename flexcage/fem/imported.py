"""A model whose matrices another program assembled, on the nodes of a mesh of ours."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.fem.assembly import Matrices
from flexcage.fem.mass import scalar_mass
from flexcage.fem.model import FEModel


@dataclass(frozen=True, repr=False)
class ImportedModel(FEModel):
    """Nodes, elements and groups of a model; stiffness and mass from elsewhere.

    Stresses follow from its own elements and material. Nothing is said of sectors: matrices of
    another program need not repeat to rounding.
    """

    imported: Matrices | None = None  # (3N, 3N) stiffness, (N, N) mass of one component

    @property
    def _matrices(self) -> Matrices:  # type: ignore[override]
        assert self.imported is not None
        return self.imported

    @property
    def couples_by_elements(self) -> bool:
        return False  # another program may have ties between nodes


def with_matrices(model: FEModel, stiffness: Any, mass: Any, order: np.ndarray) -> ImportedModel:
    """The model with matrices (3N, 3N) on nodes of which ``order[i]`` is the model's node i.

    InputError for a mass that is not the same along x, y and z.
    """
    dofs = (3 * order[:, None] + np.arange(3)).ravel()
    K, M = (sp.csr_matrix(m)[dofs][:, dofs] for m in (stiffness, mass))
    fields = {f.name: getattr(model, f.name) for f in dataclasses.fields(model)}
    fields["info"] = MappingProxyType({})
    imported = 0.5 * (K + K.T).tocsr(), scalar_mass(0.5 * (M + M.T), len(order))
    return ImportedModel(**fields, imported=imported)
