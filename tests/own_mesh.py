"""A mesh as another program would number it."""

import dataclasses
from types import MappingProxyType

import numpy as np

from flexcage.mesh.cage_mesh import CageMesh


def renumbered(mesh: CageMesh, seed: int = 0) -> CageMesh:
    """The same mesh with points, tetrahedra, corners in another order, no word of sectors."""
    rng = np.random.default_rng(seed)
    order = rng.permutation(len(mesh.points))
    number = np.argsort(order)
    tets = number[mesh.tets][rng.permutation(len(mesh.tets))]
    turned = (np.arange(3) + rng.integers(0, 3, (len(tets), 1))) % 3  # keeps the volume's sign
    tets[:, :3] = np.take_along_axis(tets[:, :3], turned, axis=1)
    groups = {name: number[triangles] for name, triangles in mesh.groups.items()}
    return dataclasses.replace(
        mesh,
        points=mesh.points[order],
        tets=tets,
        groups=MappingProxyType(groups),
        info=MappingProxyType({}),
    )
