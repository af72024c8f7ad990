"""Powers and exponentials that a compiler can turn into vector instructions.

The C library's pow and exp keep a loop over slices scalar. These are polynomials between powers of
two, good to a few units in the last place.
"""

from __future__ import annotations

from math import factorial, floor

from flexcage.core.jit import bits_of, part, real_of

_ROOT_HALF = 0x3FE6A09E667F3BCD  # bits of sqrt(1/2)
_LOG2_E, _LN_2 = 1.4426950408889634, 0.6931471805599453
_ATANH = tuple(1.0 / k for k in range(19, 2, -2))  # of z^19 to z^3
_EXP = tuple(1.0 / factorial(k) for k in range(12, -1, -1))


@part(fastmath={"contract"})
def _log2(x):
    """log2 of a normal positive x = 2^e m with m within a factor sqrt 2 of one.

    ln m = 2 atanh z with z = (m-1)/(m+1), by its series.
    """
    bits = bits_of(x)
    e = (bits - _ROOT_HALF) >> 52
    m = real_of(bits - (e << 52))
    z = (m - 1.0) / (m + 1.0)
    q = z * z
    s = 0.0
    for c in _ATANH:
        s = s * q + c
    return 2.0 * _LOG2_E * (z + z * q * s) + e


@part(fastmath={"contract"})
def _exp2(y):
    """2^y for y within the exponents of normal numbers."""
    y = min(max(y, -1020.0), 1020.0)
    k = floor(y + 0.5)
    r = (y - k) * _LN_2
    s = 0.0
    for c in _EXP:
        s = s * r + c
    return real_of(bits_of(s) + (int(k) << 52))


@part
def product_of_powers(x, a, y, b):
    """x^a y^b of positive x and y."""
    return _exp2(a * _log2(x) + b * _log2(y))


@part
def powers(n, x, a, out):
    """out = x^a where x > 0, else 0, for the first n entries."""
    for k in range(n):
        power = _exp2(a * _log2(max(x[k], 1e-300)))
        out[k] = power if x[k] > 0.0 else 0.0


@part
def exponentials(n, x, c, out):
    """out = exp(c x) for the first n entries."""
    for k in range(n):
        out[k] = _exp2(c * _LOG2_E * x[k])
