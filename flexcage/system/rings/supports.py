"""Forces of supports that hold a ring here and there, in kernels.

Supports press on the ring and are not entered, or hold it both ways: see ``modes``, whose
``RingModes`` have their compliance and space to work.
"""

from __future__ import annotations

from math import sqrt

from flexcage.core.jit import kernel, part

_TRIES = 3  # exchanges of all supports at once that need not help
_CLOSE = 1e-12  # of the largest displacement, by which a support may be entered


@kernel
def press_supports(modes):
    """Forces ``press`` of the supports that would be entered by ``free_penetration``.

    Of supports that only press this is a linear complementarity problem with a positive definite
    matrix, which has one solution: supports that pull or are entered change sides, all at once as
    long as that helps, else the last of them, which ends (J. J. Judice and F. M. Pires, Computers
    and Operations Research 21 (1994) 587; K. G. Murty, Opsearch 11 (1974) 9).
    """
    free, press, bears = modes.free_penetration, modes.press, modes.bears
    count = free.shape[0]
    largest = 0.0
    for k in range(count):
        largest = max(largest, abs(free[k]))
        bears[k] = 1 if modes.holds != 0 or free[k] > 0.0 else 0
    least, tries = count + 1, _TRIES
    for _ in range(10 * count + 10):
        solve_pressed(free, press, modes)
        if modes.holds != 0:
            return
        wrong, last = 0, 0
        for k in range(count):
            modes.step[k] = _amiss(k, _CLOSE * largest, modes)
            if modes.step[k] > 0.0:
                wrong, last = wrong + 1, k
        if wrong == 0:
            return
        at_once = wrong < least or tries > 0
        tries = _TRIES if wrong < least else tries - 1
        least = min(least, wrong)
        for k in range(count):
            if modes.step[k] > 0.0 and (at_once or k == last):
                bears[k] = 1 - bears[k]


@part
def _amiss(k, close, modes):
    """Positive if support k pulls, or is entered."""
    if modes.bears[k] != 0:
        return -modes.press[k]
    entered = modes.free_penetration[k] - close
    for l in range(modes.press.shape[0]):
        entered -= modes.between[k, l] * modes.press[l]
    return entered


@kernel
def solve_pressed(free, press, modes):
    """Forces of the supports that bear, which are not entered; those of the others are none."""
    kept, L, n = modes.kept, modes.factor, 0
    for k in range(free.shape[0]):
        press[k] = 0.0
        if modes.bears[k] != 0:
            kept[n] = k
            n += 1
    for r in range(n):
        for c in range(r + 1):
            x = modes.between[kept[r], kept[c]]
            for l in range(c):
                x -= L[r, l] * L[c, l]
            L[r, c] = sqrt(x) if r == c else x / L[c, c]
    for r in range(n):
        x = free[kept[r]]
        for l in range(r):
            x -= L[r, l] * press[kept[l]]
        press[kept[r]] = x / L[r, r]
    for back in range(n):
        r = n - 1 - back
        x = press[kept[r]]
        for l in range(r + 1, n):
            x -= L[l, r] * press[kept[l]]
        press[kept[r]] = x / L[r, r]
