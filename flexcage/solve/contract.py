"""What an integrator is: functions of a problem come in, samples and quadratures go out.

An integrator is plain Python that knows no compiler; ``system`` compiles its ``advance`` for the
functions of a bearing. ``advance(fns, data, state, options, t_end, times, ys, yds, first, log,
quads)`` integrates until ``t_end``, fills ``ys, yds, quads`` at ``times`` from index ``first`` on
and a row of ``log`` for every step, and returns (outcome, next sample, rows of the log).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

# outcomes of ``advance``
DONE, LOG_FULL, TOO_SMALL, TOO_MANY, NOT_FINITE = 0, 1, 2, 3, 4
OUTCOMES = {
    TOO_SMALL: "the step fell below solver.min_step: a contact is too stiff for the tolerance, "
    "or bodies overlap; look at the start, or loosen solver.tolerance",
    TOO_MANY: "solver.max_steps was reached; raise it or shorten solver.duration",
    NOT_FINITE: "a value became infinite or not a number; look at stiffness and damping inputs",
}
LOG_COLUMNS = ("time", "step", "order", "newton", "error")
# first entries of every state's ``real`` and ``count``
T, H = range(2)
STEPS, RESIDUALS, ERROR_FAILS, JACOBIANS, FACTORS, NEWTON_FAILS, EXPLICIT = range(7)
COUNTS = {
    "steps": STEPS,
    "explicit_steps": EXPLICIT,
    "residuals": RESIDUALS,
    "jacobians": JACOBIANS,
    "factorisations": FACTORS,
    "failed_error_tests": ERROR_FAILS,
    "failed_newton": NEWTON_FAILS,
}


class Effort(NamedTuple):
    """What an integration took: numbers of steps and more by the names in ``COUNTS``, and the least
    stability bound of explicit steps that was found [s], infinite where none was sought."""

    counts: Mapping[str, int]
    stable_step: float


@dataclass(frozen=True)
class Integrator:
    """One method: its ``advance`` and what surrounds it.

    ``functions``: names of the problem's functions in the order in which ``advance`` takes them.
    ``helpers``: names of functions beside ``advance`` that it calls, callees first.
    ``options``: from SolverOptions to the numbers of ``advance``. ``bounded``: its steps are held
    within the stability bound of explicit ones by ``h_max`` of these, as ``within`` says.
    ``new_state(t0, y0, yd0, *, weight, h0, quad_weight, modes)``: a NamedTuple of arrays with
    ``real``, ``count`` and ``quad``; ``weight`` and ``quad_weight`` are 1/(allowed local error) of
    the unknowns and of the integrals, 0 for those not tested; ``modes`` are the unknowns' linear
    oscillators (``oscillators.Oscillators``), of which a method may make use. ``kept`` names the
    arrays that a checkpoint needs. ``refresh``: forget at a block's boundary what a resumed run
    cannot know.
    ``last``: y and y' of the last accepted point.
    """

    name: str
    advance: Callable[..., tuple[int, int, int]]
    functions: tuple[str, ...]
    helpers: tuple[str, ...]
    options: Callable[[Any], Any]
    new_state: Callable[..., Any]
    kept: tuple[str, ...]
    refresh: Callable[[Any], None]
    last: Callable[[Any], tuple[np.ndarray, np.ndarray]]
    bounded: bool = False

    def within(self, options: Any, bound: float) -> Any:
        """Its options with steps of at most ``bound`` [s], if they are to be bounded."""
        return options._replace(h_max=min(options.h_max, bound)) if self.bounded else options

    def checkpoint(self, state: Any) -> Mapping[str, np.ndarray]:
        """Arrays from which the state can be restored, by name."""
        return {name: getattr(state, name) for name in self.kept}
