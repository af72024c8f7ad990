"""The largest elastic deformation of the cage in a run, from its modal coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.modes.lands import LANDS
from flexcage.modes.rotation import sector_rotations
from flexcage.results.elastic import ElasticShape

if TYPE_CHECKING:
    from flexcage.run.record import RunRecord

_HARDLY = 0.01  # of the cage's width: stations that moved less far turned by no more


def elastic_shape(run: RunRecord) -> ElasticShape:
    """Of all samples; nothing where a cage is rigid or hardly deforms."""
    cage, stiffened = run.cage, run.case.modes.geometric_stiffening
    if cage is None:
        return ElasticShape()
    modal = run.dataset["modal_coordinates"].values
    modal = modal.reshape(-1, modal.shape[-1])  # of one cage after the other
    stations = cage.interface.modes.reshape(-1, modal.shape[1])
    if np.abs(stations).max(axis=0) @ np.abs(modal).max(axis=0) < _HARDLY * run.case.its_cage.width:
        return ElasticShape(stiffened=stiffened)
    count, shapes = cage.mesh.pocket_count, cage.shown.shapes
    turned = cage.once("rotations", lambda: sector_rotations(cage.model, shapes, count))
    angles = np.linalg.norm(np.einsum("kcn,tn->tkc", turned, modal), axis=2).max(axis=1)
    most = modal[int(np.argmax(angles))]
    inward, outward = (
        float((sign * _radial(cage.model, shapes, name) @ most).max(initial=0.0))
        for name, sign in zip(LANDS, (-1.0, 1.0))
    )
    return ElasticShape(float(angles.max()), inward, outward, stiffened)


def _radial(model, shapes: np.ndarray, land: str) -> np.ndarray:
    """Radial displacements (n_vertices, n) of a land's vertices in the shapes."""
    nodes = np.unique(model.groups.get(land, np.empty((0, 3), np.int64)))
    out = model.nodes[nodes] * (0.0, 1.0, 1.0)
    out = out / np.linalg.norm(out, axis=1)[:, None]
    return np.einsum("vc,vcn->vn", out, shapes[nodes])
