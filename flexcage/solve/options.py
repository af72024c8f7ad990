"""Options of the integrator."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.spec import OtherThan, option, quantity

# Names of integrators; ``solve.integrators`` registers further ones.
_IMPLICIT = {"method": OtherThan(("explicit",))}
METHODS: dict[str, type | None] = dict.fromkeys(("auto", "explicit", "bdf"))


@dataclass(frozen=True, kw_only=True)
class SolverOptions:
    """How the equations of motion are integrated.

    ``method``: ``explicit`` is a Runge-Kutta method of order 4 on the equations with their
    constraints eliminated, in which a cage's modes swing exactly; ``bdf`` the variable-order,
    variable-step BDF with a modified Newton-Raphson corrector on F(t, y, y') = 0; ``auto`` computes
    the stability bound of explicit steps at every block of samples and takes the explicit method
    where the bound is at least ``stable_step`` (for balls 3.5 times that), the BDF elsewhere.

    ``tolerance`` is the local error allowed in a position; angles, modal coordinates and
    velocities are held to what moves a contact as far.
    """

    duration: float = quantity("s", 0.1, doc="bearing time to simulate", above=0.0)
    method: str = option("auto", doc="integrator", choices=METHODS)
    tolerance: float = quantity("um", 1e-8, doc="local error allowed in a position", above=0.0)
    max_order: int = option(2, doc="highest BDF order", minimum=1, maximum=5, when=_IMPLICIT)
    max_step: float = quantity("us", 5e-5, doc="largest step", above=0.0)
    min_step: float = quantity("us", 1e-12, doc="smallest step", above=0.0)
    stable_step: float = quantity(
        "us",
        4e-6,
        doc="least stable explicit step that 'auto' puts up with",
        above=0.0,
        when={"method": ("auto",)},
    )
    newton_tolerance: float = option(
        0.3, doc="Newton error over the local error allowed", when=_IMPLICIT
    )
    max_steps: int = option(50_000_000, doc="steps before giving up", minimum=1)
