"""Which coordinates are modal, where a file does not say: by the usual order, and by stiffness.

Fixed-interface modes have no stiffness in common with the coordinates of nodes: these move the
body as it answers statically, which does no work on what leaves the nodes in place (Craig and
Bampton, AIAA Journal 6 (1968) 1313).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.mesh.files.raw import listed
from flexcage.modes.exchange.body import MODAL

# Shares of the diagonal's entries: what rounding leaves between modes and nodes, and what a row
# among nodes has at least with others of its own node or of other nodes.
_COUPLED, _TOGETHER = 1e-3, 1e-6


def usual_dofs(stiffness: Any, nodes: int, *, reduced: bool) -> np.ndarray:
    """Coordinates (n, 2) of a file that does not name them: all modal if it has shapes
    (``reduced``); else node by node, six of each if there are so many and stiffness says nothing
    against it, or three, and modal ones after them; modal alone if there are fewer than three a
    node."""
    size = stiffness.shape[0]
    fit = [] if reduced else [each for each in (6, 3) if size >= each * nodes]
    every = [_by_node(each, nodes, size) for each in fit] or [_by_node(0, nodes, size)]
    right = (d for d in every if not _amiss(stiffness, d))
    return next(right, every[0])


def _by_node(each: int, nodes: int, size: int) -> np.ndarray:
    own = np.stack(np.divmod(np.arange(each * nodes), max(each, 1)), axis=1)
    modal = np.tile([MODAL, 0], (size - len(own), 1))
    return np.concatenate([own, modal]).astype(np.int64)


def _amiss(stiffness: Any, dofs: np.ndarray) -> bool:
    return bool(coupling(stiffness, dofs) > _COUPLED or len(_alone(stiffness, dofs)))


def coupling(stiffness: Any, dofs: np.ndarray) -> float:
    """The largest stiffness between a modal coordinate and one of a node, as a share of the root of
    the product of their own; 0 without either."""
    modal = dofs[:, 0] == MODAL
    if modal.all() or not modal.any():
        return 0.0
    return float(abs(_shares(stiffness)[modal][:, ~modal]).max())


def _shares(stiffness: Any) -> Any:
    """Entries (n, n) over the root of the product of those on the diagonal."""
    own = np.abs(np.asarray(stiffness.diagonal(), float))
    per = sp.diags_array(1.0 / np.sqrt(np.where(own > 0.0, own, 1.0)))
    scaled = per @ stiffness @ per
    return sp.csr_array(scaled) if sp.issparse(scaled) else scaled


def _alone(stiffness: Any, dofs: np.ndarray) -> np.ndarray:
    """Nodes (m,) of a reduced body whose coordinates have stiffness of their own and none in
    common, with each other or with other nodes, while others do: rows of modes."""
    of_nodes = dofs[:, 0] != MODAL
    if sp.issparse(stiffness) or not of_nodes.any():
        return np.zeros(0, int)
    shares = np.abs(_shares(stiffness)[of_nodes][:, of_nodes])
    own = np.diag(shares) > 0.0
    np.fill_diagonal(shares, 0.0)
    most = shares.max(axis=1)
    found, place = np.unique(dofs[of_nodes, 0], return_inverse=True)
    single = np.ones(len(found), bool)
    np.logical_and.at(single, place, own & (most < _TOGETHER))
    return np.zeros(0, int) if single.all() else found[single]


def check_usual(
    stiffness: Any, dofs: np.ndarray, numbers: np.ndarray, path: Path, where: str
) -> None:
    """InputError where ``usual_dofs`` found no order that stiffness agrees with."""
    alone, modal = _alone(stiffness, dofs), np.flatnonzero(dofs[:, 0] == MODAL)
    share = coupling(stiffness, dofs)
    if share > _COUPLED:
        said = (
            f"the {len(modal)} after those of its {len(numbers)} nodes are not modal, as they have "
            f"stiffness in common with the nodes' ({share:.1e} of their own, and modes have none)"
        )
    elif len(alone):
        said = (
            f"those that would be of node {listed(numbers[alone])} have no stiffness in common "
            "with any other, as only modes have none"
        )
    else:
        return
    raise InputError(
        f"{path} does not name its coordinates, and {said}; name the nodes of the boundary, all of "
        f"them and no others, as {where}_nodes, or write a matrix DOFS of node numbers and "
        "components.",
        where=where,
        value=share,
    )


def check_named(
    stiffness: Any, dofs: np.ndarray, labels: np.ndarray, path: Path, where: str
) -> None:
    """InputError for coordinates that name a component of a node without a place, ``labels`` (n, 2)
    from 1, and are not modal: the node is missing."""
    unplaced = (dofs[:, 0] == MODAL) & (labels[:, 1] > 0)
    if not unplaced.any():
        return
    others = (dofs[:, 0] != MODAL) | unplaced
    share = coupling(_submatrix(stiffness, others), dofs[others])
    if share > _COUPLED:
        missed = np.unique(np.abs(labels[unplaced, 0]))
        raise InputError(
            f"{path} has coordinates of nodes without a place ({listed(missed)}), and they are not "
            "modal, as they have stiffness in common with those of other nodes "
            f"({share:.1e} of their own, and modes have none); name a deck with all of its nodes "
            f"as {where}_nodes.",
            where=where,
            value=share,
        )


def _submatrix(matrix: Any, chosen: np.ndarray) -> Any:
    return (sp.csr_array(matrix) if sp.issparse(matrix) else matrix)[chosen][:, chosen]
