"""Other integrators on a bearing's own residual, from its stored settled state.

All of them are told the scales of flexcage's own error test, evaluate the compiled residual, have
the contacts remember their onset after every accepted step, and give y at the sampling times by
their own dense output.

* IDA (SUNDIALS, by scikit-sundae) takes F(t, y, y') = 0 as it is, and flexcage's bordered
  factorisation for its Newton iteration. scikit-sundae has no user's linear solver, so GMRES is
  given a preconditioner and a product that is that preconditioner's inverse by definition: it ends
  after one vector, at the cost of one back-substitution. IDA decides when to factor anew; as with
  its direct solvers, the correction is scaled by 2/(1 + c_j/c_j of the factors). With the same
  matrix whole it takes LAPACK's solver.
* SciPy's BDF, Radau and LSODA take x' = f(t, x) with the tangent as their dense Jacobian.

Or they find their Jacobian themselves, by differences of the residual, as for any function that
they are given.
"""

from __future__ import annotations

from dataclasses import dataclass
from time import process_time
from typing import Any

import numpy as np
import scipy.integrate
from c_functions import CFunctions
from dense_tangent import newton_matrix
from ode_form import OdeForm
from settled import SETTLE, Settled, sample_times

from flexcage.integrate.integration import FIRST_STEP

UNTESTED = 1e6  # tolerance of unknowns that are not in the error test (spin angles, multipliers)
RELATIVE = 2.3e-14  # the smallest that SciPy accepts: all tolerances are absolute


@dataclass(frozen=True)
class Path:
    """An integration: processor time, counts, and sampled states."""

    cpu: float
    residuals: int
    jacobians: int
    steps: int
    ys: np.ndarray  # (samples, n)
    yds: np.ndarray


class Peers:
    """Integrations of one settled bearing over ``duration`` [s], sampled at ``RATE``."""

    def __init__(self, settled: Settled, duration: float) -> None:
        self.settled, self.duration = settled, duration
        self.times = sample_times(duration)
        self.c = CFunctions(settled.bearing)
        self.ode = OdeForm(self.c)

    def tolerances(self, share: float) -> np.ndarray:
        """Absolute tolerance of every unknown, ``share`` of flexcage's default."""
        s, b = self.settled, self.settled.bearing
        weight = b.error_weights(s.case.solver.tolerance * share, implicit=True)
        return np.where(weight > 0.0, 1.0 / np.where(weight > 0.0, weight, 1.0), UNTESTED)

    def ida(self, share: float, *, max_order: int, matrix: str = "bordered") -> Path:
        """SUNDIALS IDA, with a ``matrix`` that is "bordered", "dense" or its "own", dense by
        differences."""
        from sksundae.ida import IDA, IDAJacTimes, IDAPrecond

        y, yd = self.settled.restore()
        newton, n = _Newton(self.c), self.c.size
        linear: dict[str, Any] = {"linsolver": "lapackdense"}
        if matrix == "dense":
            linear["jacfn"] = newton.matrix
        elif matrix == "bordered":
            linear = {
                "linsolver": "gmres",
                "precond": IDAPrecond(newton.setup, newton.solve),
                "jactimes": IDAJacTimes(None, newton.times),
            }
        solver = IDA(
            self.c.residual, rtol=RELATIVE, atol=self.tolerances(share), max_order=max_order,
            first_step=FIRST_STEP, max_step=self.settled.case.solver.max_step,
            max_num_steps=10**8, algebraic_idx=list(range(self.ode.size, n)), **linear,
        )  # fmt: skip
        ys, yds = np.empty((2, len(self.times), len(y)))
        begin = process_time()
        self.c.accepted(SETTLE, y, yd)
        solver.init_step(SETTLE, y, yd)
        sample, steps, last = 0, 0, SETTLE
        while sample < len(self.times):
            now = solver.step(self.times[-1], method="onestep")
            if not now.success:
                raise RuntimeError(f"IDA at {now.t}: {now.message}")
            if now.t > last:  # after an output in between, IDA first returns to its own step
                self.c.accepted(now.t, now.y, now.yp)
                steps, last = steps + 1, now.t
            while sample < len(self.times) and self.times[sample] <= last:
                at = solver.step(self.times[sample], method="normal")
                ys[sample], yds[sample] = at.y, at.yp
                sample += 1
        return Path(process_time() - begin, now.nfev, newton.setups, steps, ys, yds)

    def scipy(self, share: float, *, method: str, own: bool = False) -> Path:
        """One of SciPy's integrators, with the tangent or with a Jacobian of its ``own``."""
        y, yd = self.settled.restore()
        n = self.ode.size
        begin = process_time()
        self.c.accepted(SETTLE, y, yd)
        solver: scipy.integrate.OdeSolver = getattr(scipy.integrate, method)(
            self.ode.rates, SETTLE, y[:n], self.times[-1], rtol=RELATIVE,
            atol=self.tolerances(share)[:n], first_step=FIRST_STEP,
            max_step=self.settled.case.solver.max_step, jac=None if own else self.ode.jacobian,
        )  # fmt: skip
        xs = np.empty((len(self.times), n))
        sample, steps = 0, 0
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"{method} at {solver.t}: {message}")
            steps += 1
            self.c.accepted(solver.t, self.ode.full(solver.y), yd)
            dense = solver.dense_output()
            while sample < len(self.times) and self.times[sample] <= solver.t:
                xs[sample] = dense(self.times[sample])
                sample += 1
        cpu = process_time() - begin
        return self._path(cpu, int(solver.nfev), int(solver.njev), steps, xs)

    def _path(self, cpu: float, residuals: int, jacobians: int, steps: int, xs) -> Path:
        """A path of the ODE form; forces do not depend on y'."""
        ys = np.stack([self.ode.full(x) for x in xs])
        return Path(cpu, residuals, jacobians, steps, ys, np.zeros_like(ys))


class _Newton:
    """IDA's linear system: solved by the bordered factors, or as a dense matrix."""

    def __init__(self, functions: CFunctions) -> None:
        self.c, self.setups, self._factored = functions, 0, 1.0
        self._vector, self._product = np.zeros(functions.size), False

    def setup(self, t, y, yd, residual, c_j) -> None:
        self.c.setup(t, y, yd, c_j)
        self._factored = c_j
        self.setups += 1

    def matrix(self, t, y, yd, residual, c_j, out) -> None:
        out[:] = newton_matrix(self.c, t, y, yd, c_j)
        self.setups += 1

    def times(self, t, y, yd, residual, v, out, c_j) -> None:
        """J v, known only by what the preconditioner makes of it, which is v."""
        self._vector[:] = v
        self._product = True
        out[:] = v

    def solve(self, t, y, yd, residual, r, z, c_j, delta) -> None:
        if self._product:
            z[:] = self._vector
            self._product = False
            return
        self._vector[:] = r
        self.c.solve(self._factored, y, self._vector)
        z[:] = self._vector
        z *= -2.0 / (1.0 + c_j / self._factored)
