import numpy as np

from flexcage.modes.storage import basis_arrays, basis_from_arrays


def test_a_basis_survives_its_arrays_on_disk(basis, tmp_path):
    path = tmp_path / "basis.npz"
    np.savez(path, **basis_arrays(basis))
    with np.load(path, allow_pickle=False) as stored:
        again = basis_from_arrays(dict(stored))
    assert (again.name, again.kind) == (basis.name, basis.kind)
    for name in ("shapes", "stiffness", "mass", "frequencies"):
        np.testing.assert_array_equal(getattr(again, name), getattr(basis, name))
    assert again.residual.far_coupling == basis.residual.far_coupling
    for name in ("shapes", "stiffness", "compliance"):
        np.testing.assert_array_equal(getattr(again.residual, name), getattr(basis.residual, name))
