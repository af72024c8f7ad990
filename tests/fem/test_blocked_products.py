"""Products strip by strip, against those at once."""

import numpy as np

from flexcage.fem.blocked_products import inner_products, subtract_product


def test_strips_make_the_same_as_whole_products():
    rng = np.random.default_rng(0)
    left = rng.normal(size=(10_001, 3)) + 1j * rng.normal(size=(10_001, 3))
    right, coefficients = rng.normal(size=(10_001, 2)), rng.normal(size=(3, 2))
    np.testing.assert_allclose(inner_products(left, right), left.conj().T @ right, atol=1e-10)
    fields = right.astype(complex)
    subtract_product(fields, left, coefficients)
    np.testing.assert_allclose(fields, right - left @ coefficients, atol=1e-12)
