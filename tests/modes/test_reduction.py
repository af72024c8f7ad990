import numpy as np
from modes_cage import CAGE, cage_mesh

from flexcage.modes import reduction
from flexcage.modes.spec import ModesSpec


def test_a_cached_basis_is_the_one_that_was_built(monkeypatch, tmp_path):
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    mesh, spec = cage_mesh(), ModesSpec(count=4)
    built = reduction.reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)

    def never(*args, **kwargs):
        raise AssertionError("the basis was built again")

    monkeypatch.setattr(reduction, "build_basis", never)
    stored = reduction.reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    assert (stored.basis.name, stored.basis.kind) == (built.basis.name, built.basis.kind)
    for name in ("shapes", "stiffness", "mass", "frequencies"):
        np.testing.assert_array_equal(getattr(stored.basis, name), getattr(built.basis, name))
    ours, theirs = stored.basis.residual, built.basis.residual
    assert ours.far_coupling == theirs.far_coupling
    for name in ("shapes", "stiffness", "compliance"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))
