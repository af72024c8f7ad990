"""A small cage of twelve pockets and its defects, on the coarse mesh."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import scipy.sparse as sp

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.mesh.options import MeshOptions

POCKETS = 12
CAGE = WindowCage(
    bore=40e-3, outside_diameter=47e-3, width=16e-3, pocket_width=7e-3, pocket_length=8.25e-3
)
DEFECTS = (
    CrossbeamDefect(crossbeam=3, displacement=0.2e-3),
    SideBeamDefect(pocket=5, side="-x", displacement=-0.3e-3),
)


def cage_mesh(defects=(), fineness="coarse"):
    return build_cage_mesh(
        CAGE,
        pocket_count=POCKETS,
        pitch_diameter=43.5e-3,
        defects=defects,
        options=MeshOptions(fineness=fineness),
    )


def assert_same_fields(ours, theirs):
    """Two interfaces are the same, number by number."""
    assert type(ours) is type(theirs)
    for field in fields(ours):
        a, b = getattr(ours, field.name), getattr(theirs, field.name)
        assert type(a) is type(b), field.name
        if sp.issparse(a):
            assert a.shape == b.shape and (a != b).nnz == 0, field.name
        else:
            np.testing.assert_array_equal(a, b, err_msg=field.name)
