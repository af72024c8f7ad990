"""Direct solvers for symmetric positive definite matrices, behind one face.

``linear_solver(A)`` factors A once with CHOLMOD (cvxopt), PARDISO (pypardiso), or SciPy's SuperLU,
which is always there. On an N1013 cage of 98,000 unknowns (one thread) they factor in 1.2, 1.9
and 2.0 s and solve one of many right-hand sides in 33, 34 and 18 ms; on one of 263,000
in 8, 6 and 30 s, and 118, 105 and 105 ms. Free bodies need none of them:
they are solved part by part (``condensed``) or by dense fronts (``dissected``).
"""

from __future__ import annotations

import importlib.util
import logging
import os
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError, RunFailed

log = logging.getLogger(__name__)

KINDS = ("cholmod", "pardiso", "superlu")
_SUPERLU_LIMIT = 150_000  # unknowns up to which 'auto' takes it
_TOGETHER = 16  # right-hand sides that SuperLU solves fastest: more do not stay in the cache
_MODULES = {"cholmod": "cvxopt", "pardiso": "pypardiso", "superlu": "scipy"}
SINGULAR = (
    "the matrix is not positive definite ({what}): the body has loose parts, "
    "inverted elements or too few supports"
)


class LinearSolver:
    """A factored symmetric positive definite matrix: ``solve(b)`` for (n,) or (n, m)."""

    name = "none"

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        raise NotImplementedError


class Cholmod(LinearSolver):
    """Supernodal Cholesky through cvxopt (GPL)."""

    name = "CHOLMOD (cvxopt)"

    def __init__(self, matrix: sp.csr_matrix) -> None:
        import cvxopt
        import cvxopt.cholmod as cholmod

        self._matrix, self._solve = cvxopt.matrix, cholmod.solve
        lower = sp.tril(matrix, format="coo")
        integers = [cvxopt.matrix(np.asarray(i, np.int64)) for i in (lower.row, lower.col)]
        packed = cvxopt.spmatrix(cvxopt.matrix(lower.data), *integers, lower.shape)
        cholmod.options["supernodal"] = 2
        self._factor = cholmod.symbolic(packed)
        try:
            cholmod.numeric(packed, self._factor)
        except ArithmeticError as error:
            raise RunFailed(SINGULAR.format(what=f"pivot {error}")) from error

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        columns = self._matrix(np.asfortranarray(rhs.reshape(len(rhs), -1), dtype=float))
        self._solve(self._factor, columns)
        return np.array(columns).reshape(rhs.shape)


class Pardiso(LinearSolver):
    """Intel MKL PARDISO through pypardiso, matrix type 2 (upper triangle)."""

    name = "PARDISO (pypardiso)"

    def __init__(self, matrix: sp.csr_matrix) -> None:
        from pypardiso import PyPardisoSolver
        from pypardiso.pardiso_wrapper import PyPardisoError

        self._upper = sp.triu(matrix, format="csr")
        self._upper.sort_indices()
        self._pardiso = PyPardisoSolver(mtype=2)
        try:
            self._pardiso.factorize(self._upper)
        except PyPardisoError as error:
            raise RunFailed(SINGULAR.format(what=str(error))) from error

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        columns = np.asfortranarray(rhs.reshape(len(rhs), -1), dtype=float)
        self._pardiso.set_phase(33)
        # the low-level call spares a hash of the matrix at every solution
        return self._pardiso._call_pardiso(self._upper, columns).reshape(rhs.shape)

    def __del__(self) -> None:
        if hasattr(self, "_pardiso"):
            self._pardiso.free_memory(everything=True)


class SuperLu(LinearSolver):
    """SciPy's SuperLU in its symmetric mode: no extra package, several times slower."""

    name = "SuperLU (SciPy)"

    def __init__(self, matrix: sp.csr_matrix) -> None:
        from scipy.sparse.linalg import splu

        try:
            self._factor = splu(
                matrix.tocsc(),
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:
            raise RunFailed(SINGULAR.format(what=str(error))) from error

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        rhs = np.asarray(rhs, float)
        if rhs.ndim == 1 or rhs.shape[1] == 1:
            return self._factor.solve(rhs)
        answer, threads = np.empty(rhs.shape, order="F"), _thread_count()
        together = min(_TOGETHER, -(-rhs.shape[1] // threads))
        parts = [slice(i, i + together) for i in range(0, rhs.shape[1], together)]

        def solve_part(part: slice) -> None:
            answer[:, part] = self._factor.solve(rhs[:, part])

        if threads == 1:
            for part in parts:
                solve_part(part)
        else:  # SuperLU's triangular solution releases the interpreter: columns in parallel
            with ThreadPoolExecutor(threads) as pool:
                list(pool.map(solve_part, parts))
        return answer


def _thread_count() -> int:
    """Threads that a solution may use: OMP_NUM_THREADS where set, else the cores, at most four."""
    asked = os.environ.get("OMP_NUM_THREADS", "")
    return int(asked) if asked.isdigit() and int(asked) > 0 else min(os.cpu_count() or 1, 4)


_SOLVERS = {"cholmod": Cholmod, "pardiso": Pardiso, "superlu": SuperLu}


def available_kinds() -> tuple[str, ...]:
    """Kinds whose package is installed, fastest first."""
    return tuple(k for k in KINDS if importlib.util.find_spec(_MODULES[k]) is not None)


def linear_solver(matrix: sp.csr_matrix, *, kind: str = "auto") -> LinearSolver:
    """Factor a symmetric positive definite matrix; ``kind`` is 'auto' or one of KINDS.

    'auto' takes SuperLU for small matrices, where its fast solutions outweigh its factorization,
    and the fastest factorization installed for large ones.
    """
    installed = available_kinds()
    if kind == "auto":
        kind = "superlu" if matrix.shape[0] <= _SUPERLU_LIMIT else installed[0]
    if kind not in KINDS:
        raise InputError(
            f"linear solver {kind!r} is not one of auto, {', '.join(KINDS)}",
            where="solver",
            value=kind,
        )
    if kind not in installed:
        raise InputError(
            f"linear solver {kind!r} needs the package {_MODULES[kind]}; installed here: "
            f"{', '.join(installed)}",
            where="solver",
            value=kind,
        )
    started = time.perf_counter()
    solver = _SOLVERS[kind](matrix)
    check_factor(solver.solve, matrix)
    seconds = time.perf_counter() - started
    log.debug("factored %d unknowns with %s in %.1f s", matrix.shape[0], solver.name, seconds)
    return solver


def check_factor(
    solve: Callable[[np.ndarray], np.ndarray],
    matrix: sp.csr_matrix,
    held: Sequence[int] | np.ndarray = (),
) -> None:
    """Refuse a factor that cannot give back a known solution: a singular matrix may factor.

    ``held`` unknowns are zero in the solution, and what acts on them does not matter.
    """
    known = np.random.default_rng(0).standard_normal(matrix.shape[0])
    known[np.asarray(held, int)] = 0.0
    error = np.abs(solve(matrix @ known) - known).max()
    if not error < 1e-3:
        raise RunFailed(SINGULAR.format(what=f"a known solution comes back wrong by {error:.1g}"))
