"""The integrators that a case can name."""

from __future__ import annotations

from flexcage.core.registry import add
from flexcage.solve.bdf import BDF
from flexcage.solve.contract import Integrator
from flexcage.solve.options import METHODS
from flexcage.solve.runge_kutta import EXPLICIT_METHOD

INTEGRATORS: dict[str, Integrator] = {m.name: m for m in (EXPLICIT_METHOD, BDF)}


def register_integrator(integrator: Integrator) -> Integrator:
    """Let cases name an integrator of your own as ``solver.method``.

    Its ``advance`` is compiled with its module's ``helpers``; ``functions`` may name any of those
    that ``system.problem`` offers. Raises InputError if the name is taken.
    """
    add(METHODS, integrator.name, None, what="integrator", source=integrator.advance)
    INTEGRATORS[integrator.name] = integrator
    return integrator
