"""Where a run begins: as the bearing's family finds it, then pushed, and moved onto constraints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from flexcage.bodies.floating_frame import BodyData
from flexcage.contacts.evaluation import REPORT
from flexcage.contacts.land import DRY, FILM, NONE, LandData
from flexcage.core.errors import InputError, RunFailed
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.constraints import POSITION, check_independent
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem
from flexcage.system.scales import ERROR_RATE
from flexcage.system.spec import Constraint, StartOptions

# of a land's clearance, by which the cage may lean at the start; a film grows stiff beyond
_CLEAR = {DRY: 0.9, FILM: 0.5}
_ONTO, _NEAR = 40, 1e-12  # steps onto constraints; [m, rad] how near they must come


def find_start(
    bearing: BearingSystem,
    *,
    limit_force: float,
    statics: StaticStart | None = None,
    advance: Advance = lambda share: None,
) -> Start:
    """Assemble the bearing and bring it to equilibrium at the drive's first speed.

    ``statics`` computes the static solution, for bearings whose run begins with it; ``advance`` is
    called with the share of the work that is done.
    """
    return bearing.motion.start(bearing, limit_force=limit_force, statics=statics, advance=advance)


def with_push(start: Start, layout: Layout, options: StartOptions) -> Start:
    """The start with the cage centre moving off at ``options.push``, at a random azimuth."""
    if options.push == 0.0:
        return start
    azimuth = np.random.default_rng(options.seed).uniform(0.0, 2.0 * np.pi)
    velocity = options.push * np.array([0.0, np.cos(azimuth), np.sin(azimuth)])
    y, yd = start.y.copy(), start.yd.copy()
    layout.u(y)["cage"][:] += velocity
    layout.q(yd)["cage"][:] += velocity
    return replace(start, y=y, yd=yd)


def constrained(
    start: Start, bearing: BearingSystem, constraints: Sequence[Constraint], *, limit_force: float
) -> Start:
    """The start with rings and cage moved onto the bearing's further constraints.

    Raises InputError for a constraint on what is held already, or that presses a rolling element
    with more than ``limit_force`` [N], RunFailed for one that the start cannot be moved onto.
    """
    if not constraints:
        return start
    layout, data = bearing.layout, bearing.data.constraints
    y, yd = start.y.copy(), np.zeros_like(start.yd)
    check_independent(constraints, data, layout, y)
    rates = bearing.function("rates")
    for _ in range(_ONTO):  # each moves y one step of Newton's nearer
        rates(0.0, y, yd, bearing.args, np.zeros(0))
        place = np.where(data.level == POSITION, data.g, 0.0) / _NEAR
        missed = np.abs([place, data.h / (_NEAR * ERROR_RATE)]).max(axis=0)
        if missed.max() < 1.0:
            break
    else:
        name = layout.held[int(missed.argmax())]
        raise RunFailed(f"the start cannot be moved onto the constraint '{name}'; can it be met?")
    bearing.residual(0.0, y, yd, REPORT)
    report = bearing.data.work.report
    for force, where in ((report.pocket_normal, "its pocket"), (report.race[:, :, 0], "a race")):
        if force.max() > limit_force:
            number = int(force.max(axis=1).argmax())
            raise InputError(
                f"where the constraints put rings and cage, {bearing.spec.element} {number} and "
                f"{where} press each other with {force.max():,.0f} N, more than "
                f"limits.assembly_force ({limit_force:,.0f} N); make them smaller, or raise the "
                "limit",
                where="constraints", value=float(force.max()),
            )  # fmt: skip
    return replace(start, y=y, yd=yd)


def clear_of_land(land: LandData, layout: Layout, y: np.ndarray) -> bool:
    """Whether a cage's land was in the way of the ring that it rides on; it is moved off it,
    and rolling elements stay in the middle of their pockets."""
    if land.kind == NONE:
        return False
    q = layout.q(y)
    ring, cages = q["inner" if land.inner else "outer"][1:3], np.atleast_2d(q["cage"])
    rows = np.split(q["elements"], len(cages))
    return any([_clear(land, ring, cage, row) for cage, row in zip(cages, rows, strict=True)])


def _clear(land: LandData, ring: np.ndarray, cage: np.ndarray, elements: np.ndarray) -> bool:
    """The same of one ``cage`` (3,) and its ``elements``, by the centre (2,) of the ring."""
    offset = cage[1:3] - ring
    share = _CLEAR[land.kind] * land.clearance / max(float(np.linalg.norm(offset)), 1e-12)
    if share >= 1.0:
        return False
    moved = (share - 1.0) * offset
    cage[1:3] += moved
    radius, psi = elements[:, 1], elements[:, 2].copy()
    elements[:, 2] += (moved[1] * np.cos(psi) - moved[0] * np.sin(psi)) / radius
    return True


def place_cages(
    layout: Layout, y: np.ndarray, along: float | np.ndarray, azimuth: np.ndarray
) -> None:
    """Put the cages, if any, at places ``along`` the axis, one or (cages,) [m], turned as elements
    of which each is the first; ``azimuth`` (Z,) is that of the elements."""
    if layout.has_cage:
        q = layout.q(y)
        q["cage"][..., 0], q["quaternion"][..., :2] = along, _half_turns(layout, azimuth)


def turn_cages(
    layout: Layout, y: np.ndarray, yd: np.ndarray, speed: float | np.ndarray, azimuth: np.ndarray
) -> None:
    """Let the cages, if any, turn at ``speed``, one or (cages,) [rad/s], from where ``place_cages``
    put them."""
    if layout.has_cage:
        layout.u(y)["omega"][..., 0] = speed
        cos, sin = np.moveaxis(_half_turns(layout, azimuth), -1, 0)
        rate = layout.q(yd)["quaternion"]
        rate[..., 0], rate[..., 1] = 0.0 - 0.5 * speed * sin, 0.5 * speed * cos


def _half_turns(layout: Layout, azimuth: np.ndarray) -> np.ndarray:
    """Cosine and sine of half the turn of each cage, (2,) of one, (cages, 2) of several."""
    half = 0.5 * azimuth[:: layout.places.in_cage]
    turns = np.stack([np.cos(half), np.sin(half)], axis=-1)
    return turns if layout.cages > 1 else turns[0]


def strained_by_rotation(body: BodyData, speed: float) -> np.ndarray:
    """Modal coordinates (n,) at which a cage that only rotates about its axis at ``speed`` [rad/s]
    rests; from none it would ring.

    Its modes feel w^2 int phi.p dm across the axis, with p the deformed place.
    """
    load = (body.S[1] + body.S[2]) * speed**2
    stiffness = body.kff - (body.SS[:, 1] + body.SS[:, 2]) * speed**2
    if body.gff.size:
        stiffness = stiffness + body.gff * speed**2
    return np.linalg.solve(stiffness, load)
