"""Spec of the static solution: what holds the ring, and what speed does to rolling elements."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.spec import option, quantity


@dataclass(frozen=True, kw_only=True)
class StaticOptions:
    """How the inner ring's equilibrium is meant.

    ``tilt``: "free" under the moments of [load], or "held" at load.misalignment, with moments as
    reactions; by default as load.tilt says, as in a run. ``gyroscopic``: which race's friction
    balances a ball's gyroscopic moment: the outer one's (race control after A. B. Jones and T. A.
    Harris), both alike, or none, for balls that spin as they like. ``cage_speed``: of all balls
    about the bearing axis, otherwise each ball's own of outer race control. ``dynamic_rating``:
    what lives follow from, otherwise ISO 281's value for the bearing's inside. ``tilt_arm``: radius
    at which a ball feels the ring's tilt and pushes back: that of the inner groove's centres, the
    pitch radius as in a published program, or, as ISO/TS 16281 is printed, one for each; only the
    first and second have an energy.
    """

    tilt: str | None = option(
        None, doc="is the inner ring free to tilt? by default, as load.tilt says",
        choices=("free", "held"),
    )  # fmt: skip
    gyroscopic: str = option(
        "outer_race",
        doc="what balances gyroscopic moments",
        choices=("outer_race", "shared", "none"),
    )
    cage_speed: float | None = quantity("rpm", None, doc="speed of the cage, if prescribed")
    dynamic_rating: float | None = quantity("kN", None, doc="catalogue's C, if known", above=0.0)
    tilt_arm: str = option("groove", doc="lever of tilts", choices=("groove", "pitch", "iso"))


#: As a run begins: no race controls balls.
AT_START = StaticOptions(gyroscopic="none")
