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
    assert built.basis.geometric is None and stored.basis.geometric is None
    for name in ("shapes", "stiffness", "mass", "frequencies"):
        np.testing.assert_array_equal(getattr(stored.basis, name), getattr(built.basis, name))
    ours, theirs = stored.basis.residual, built.basis.residual
    assert ours.far_coupling == theirs.far_coupling
    for name in ("shapes", "stiffness", "compliance"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))


def test_geometric_stiffening_comes_with_the_basis_and_with_the_cached_one(monkeypatch, tmp_path):
    """A ring of brass at 1 rad/s: the ovals gain (n^2-1)^2/(n^2+1) = 9/5 (rad/s)^2, a cage nearly
    so; no mode loses."""
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    mesh, spec = cage_mesh(), ModesSpec(count=4, crossbeams=False, geometric_stiffening=True)
    built = reduction.reduce_cage(mesh, cage=CAGE, defects=(), spec=spec).basis
    stored = reduction.reduce_cage(mesh, cage=CAGE, defects=(), spec=spec).basis
    assert built.geometric is not None and built.geometric.shape == (5, 5)
    np.testing.assert_array_equal(stored.geometric, built.geometric)
    gain = np.linalg.eigvalsh(built.geometric)
    assert gain[0] > 0.0
    in_plane = np.einsum("nai,nai->i", built.shapes[:, 1:], built.shapes[:, 1:]) / np.einsum(
        "nai,nai->i", built.shapes, built.shapes
    )
    oval = np.diag(built.geometric)[:4][in_plane[:4] > 0.8]
    assert len(oval) == 2
    np.testing.assert_allclose(oval, 1.8, rtol=0.1)
