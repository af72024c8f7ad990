"""The start of a roller bearing's run: quasi-static equilibrium at epicyclic speeds.

Rings, rollers and a pinched cage are brought to equilibrium without friction (``frictionless``),
with the velocities of pure rolling. Rollers stay where they are along
their orbit, where friction would hold them, and between the ribs that guide them, those of a ring
that is free along the axis or in tilt included; only where ribs of both rings bear an axial load do
they find their place along the axis. A pinched cage finds its place, and a free one is moved off a
land that the ring would press. A roller that stands on its spot would roll off its edges, and is
held. Where a defect leaves less than no clearance its size grows in steps
from the first touch, so that the run begins assembled.
"""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import replace

import numpy as np

from flexcage.bearings.cylindrical_roller.frictionless import (
    Frictionless,
    HeldMotions,
    advance_y,
    axial_load,
    equilibrate,
    free_motions,
    has_pits,
    load_of,
    stop_cage,
    without_pits,
)
from flexcage.bearings.cylindrical_roller.model import RollerModel
from flexcage.contacts.state import U_SKEW, U_TILT
from flexcage.core.errors import InputError, RunFailed
from flexcage.geometry.kinematics import epicyclic
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.data import INNER_RACE, OUTER_RACE
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem
from flexcage.system.ring import CLEARANCE
from flexcage.system.rings.modes_data import standing
from flexcage.system.rings.moving import MovingRings, held_rings
from flexcage.system.rings.neglected import neglected_at_ribs
from flexcage.system.rings.sections import lands_follow
from flexcage.system.start import clear_of_land, place_cages, turn_cages

_BALANCED = 1e-6  # of the load: what may stay unbalanced at last
# likewise on spots: a roller over the middle of one pushes along the race from either edge
_ON_SPOTS = 0.01
TOUCH = 1e-9  # [m] interference that is only a touch
STAGES = 8  # steps of a pinching defect's growth


def rolling_velocities(model: RollerModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Set the velocities of pure rolling in y, and return y' (accelerations zero)."""
    b = model.bodies
    rw = float(b.radius.mean())
    pitch = 0.5 * (model.inner.radius + model.outer.radius)
    speed = float(np.interp(0.0, *b.speed))
    k = epicyclic(
        element_diameter=2.0 * rw, pitch_diameter=2.0 * pitch, element_count=layout.elements,
        inner_speed=speed,
    )  # fmt: skip
    yd = np.zeros_like(y)
    q, u, qd = layout.q(y), layout.u(y), layout.q(yd)
    radius = q["elements"][:, 1]
    u["elements"][:] = 0.0
    u["elements"][:, 2] = radius * k.cage_speed
    u["elements"][:, 3] = k.element_spin
    skew, tilt = q["elements"][:, 3], q["elements"][:, 4]
    u["elements"][:, 4] = -k.cage_speed * np.cos(skew) * np.sin(tilt)  # they keep skew and tilt
    u["elements"][:, 5] = k.cage_speed * np.sin(skew)
    qd["elements"][:, 2] = k.cage_speed
    qd["elements"][:, 5] = k.element_spin - k.cage_speed * np.cos(skew) * np.cos(tilt)
    u["inner"][3] = qd["inner"][5] = speed
    turn_cages(layout, y, yd, k.cage_speed, model.rows.azimuth)
    return yd


def standing_cage(model: RollerModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Velocities of pure rolling, but for the cage: nothing elastic holds its unbalance."""
    return stop_cage(layout, y, rolling_velocities(model, layout, y))


def pocket_clearance(model: RollerModel, offset: np.ndarray) -> np.ndarray:
    """Least clearance (Z, 2) of each pocket for its roller, across and along [m]."""
    width = 2.0 * model.pocket.half[0] - 2.0 * model.bodies.radius[:, None]
    across = width + (offset[:, 0] + offset[:, 1])
    along = 2.0 * (model.pocket.half[1] - model.pocket.half_roller) + offset[:, 2] + offset[:, 3]
    return np.stack([across.min(axis=1), along.min(axis=1)], axis=1)


def geometric_guess(model: RollerModel, layout: Layout) -> np.ndarray:
    """Rollers on the outer race in the middle of their pockets and between the ribs, or before
    those that bear the axial load; the rest centred."""
    y = np.zeros(layout.size)
    q = layout.q(y)
    q["elements"][:, 1] = model.outer.radius - model.bodies.radius
    q["elements"][:, 2] = model.rows.azimuth
    ring, mount = model.inner_ring, model.outer_ring
    q["inner"][4] = ring.rest[U_TILT]
    if ring.free[0]:
        q["inner"][0] = _axial_place(model)
    q["elements"][:, 0] = _between_ribs(model, layout, y)
    middles = model.rows.place[:: model.rows.each] if layout.cages > 1 else 0.0
    place_cages(layout, y, middles, model.rows.azimuth)
    if layout.has_cage and ring.free[0]:
        along = q["elements"][0, 0] - model.rows.place[0]
        q["cage"][..., 0] += q["inner"][0] if _guided_by_inner(model) else along
    shift = float(mount.bore[CLEARANCE]) if mount.loose else 0.0
    q["outer"][1:3] = shift * model.bodies.load_direction  # a ring in its bore lies on the ground
    psi = q["elements"][:, 2]
    q["elements"][:, 1] += q["outer"][1:3] @ np.stack([np.cos(psi), np.sin(psi)])
    play = model.outer.radius - model.inner.radius - 2.0 * model.bodies.radius.min()
    q["inner"][1:3] = (play + shift) * model.bodies.load_direction  # just before first contact
    return y


def _bearing_ribs(model: RollerModel) -> int:
    """Direction along x in which ribs of both rings bear the axial load at the start: 1 or -1; 0 if
    they bear none."""
    inner, outer, load = model.rib, model.outer_rib, axial_load(model)
    ways = {1: inner.end == 2 and outer.first == 0, -1: inner.first == 0 and outer.end == 2}
    way = int(np.sign(load)) if model.inner_ring.free[0] else 0
    return way if ways.get(way, False) else 0


def _axial_place(model: RollerModel) -> float:
    """Where the axial load moves the inner ring, on the shaft's spring or against ribs [m]."""
    load, stiffness = axial_load(model), model.inner_ring.stiffness[0, 0]
    way = _bearing_ribs(model)
    by_spring = load / stiffness if stiffness > 0.0 else 0.0
    if not way:
        return by_spring
    play = way * (model.rib.half_gap + model.outer_rib.half_gap - 2.0 * model.rib.half_roller)
    return min(play, by_spring, key=abs) if stiffness > 0.0 else play


def _guided_by_inner(model: RollerModel) -> bool:
    """Do ribs of the inner ring guide the rollers, and take them along?"""
    return bool(model.rib.column == 0) and not _bearing_ribs(model)


def _between_ribs(model: RollerModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """Where (Z,) along the axis the rollers' centres are [m]: in the middle plane of the ring whose
    ribs guide them, in that of their row; before a rib of the outer ring if it bears the axial
    load."""
    q, way = layout.q(y), _bearing_ribs(model)
    if way:
        place = way * (model.outer_rib.half_gap - model.rib.half_roller)
        return place + model.rows.place
    if not _guided_by_inner(model):
        return model.rows.place.copy()
    r, psi, (skew, tilt) = q["elements"][:, 1], q["elements"][:, 2], q["inner"][3:5]
    up, across = np.tan(tilt) / np.cos(skew), np.tan(skew)
    along: np.ndarray = q["inner"][0] - r * np.cos(psi) * up + r * np.sin(psi) * across
    return along + model.rows.place


def _check_force(
    system: Frictionless, y: np.ndarray, yd: np.ndarray, limit: float, share: float,
    pinched: np.ndarray,
) -> None:  # fmt: skip
    """InputError for a pocket that pushes with more than ``limit`` [N]."""
    force = float(system.report(y, yd).pocket_normal.max())
    if force > limit:
        raise _not_assembled(system.bearing, force, limit, share, pinched)


def _not_assembled(
    bearing: BearingSystem, force: float, limit: float, share: float, pinched: np.ndarray
) -> InputError:
    """What is to blame for a pocket's ``force`` beyond ``limit`` [N] at a share of the defects."""
    model = bearing.data.model
    beyond = f"{force:,.0f} N, more than limits.assembly_force ({limit:,.0f} N)"
    clearance = pocket_clearance(model, 0.0 * model.pocket.offset).min(axis=1)
    if clearance.min() < -TOUCH:
        roller = int(clearance.argmin())
        return InputError(
            f"roller {roller} is {-1e3 * clearance[roller]:.3g} mm larger than its pocket, without "
            f"any defect, and is pinched with {beyond}; make bearing.roller_scatter smaller, or "
            "the pocket larger",
            where="bearing.roller_scatter",
            value=force,
        )
    if model.pocket.offset.any() and _sound_one_assembles(bearing, limit):
        name = f"a defect pinches roller {int(pinched[0])}" if len(pinched) else "a pocket pushes"
        return InputError(
            f"{name} with {beyond}, at {share:.0%} of the defects' size: the bearing cannot be "
            "assembled; make the defect smaller, the pocket larger, or raise the limit",
            where="defects",
            value=force,
        )
    return InputError(
        f"a pocket pushes with {beyond}, whatever the defects: no equilibrium to start from was "
        f"found; {_others(model)} is too large",
        where="load",
        value=force,
    )


def _others(model: RollerModel) -> str:
    """What besides defects may be too large for an equilibrium."""
    soft = np.any(model.bodies.moments) and np.any(model.inner_ring.free[[U_SKEW, U_TILT]])
    moment = "the moment for such a load.tilt_stiffness, " if soft else ""
    return f"the load, {moment}the speed, the misalignment or the clearance"


def _sound_one_assembles(bearing: BearingSystem, limit: float) -> bool:
    """Does the bearing come to equilibrium, no pocket beyond ``limit`` [N], without defects?"""
    model, layout = bearing.data.model, bearing.layout
    none = 0.0 * model.pocket.offset
    y = geometric_guess(model, layout)
    yd = standing_cage(model, layout, y)
    tight = pocket_clearance(model, none) < -TOUCH
    system = Frictionless(bearing, none)
    residual = _assemble(system, y, yd, tight)
    return residual <= _BALANCED and system.report(y, yd).pocket_normal.max() <= limit


def _held(tight: np.ndarray, spotted: np.ndarray, *, along: bool) -> HeldMotions:
    """What is held where pockets are too small across or along (Z, 2) for their rollers, and of
    those (Z,) that have a spot; ``along``: do rollers find their place along the axis?"""
    pinched = np.any(tight, axis=1)
    rollers = np.zeros((len(tight), 6), bool)
    rollers[:, 2] = True
    rollers[~pinched, 0] = not along
    rollers[~pinched, 4] = True
    rollers[spotted, 3] = True
    cage = np.full(6, bool(pinched.any()))
    cage[0] &= not tight[:, 1].any()  # side beams find their place along x
    cage[3] &= not tight[:, 0].any()  # crossbeams by turning about it
    return HeldMotions(rollers, cage)


def _equilibrate(system: Frictionless, y: np.ndarray, yd: np.ndarray, tight: np.ndarray) -> float:
    """Bring y to equilibrium in place; the residual reached, as a share of the load.

    ``tight`` (Z, 2) marks the pockets that are too small for their roller at this stage.
    """
    model, layout = system.data.model, system.bearing.layout
    held = _held(tight, model.spot.has > 0, along=_bearing_ribs(model) != 0)

    def move(y: np.ndarray, step: np.ndarray) -> None:
        ribs = _between_ribs(model, layout, y)
        advance_y(system, y, step)
        if free_motions(model).any():
            layout.q(y)["elements"][:, 0] += _between_ribs(model, layout, y) - ribs
            if layout.has_cage and _guided_by_inner(model):
                layout.q(y)["cage"][..., 0] += layout.q(step)["inner"][0]

    return equilibrate(system, y, yd, held, lambda y: standing_cage(model, layout, y), move)


def _assemble(system: Frictionless, y: np.ndarray, yd: np.ndarray, tight: np.ndarray) -> float:
    """Bring y to equilibrium, with the cage out of the way of its land's ring; the residual."""
    model, layout = system.bearing.data.model, system.bearing.layout
    residual = _equilibrate(system, y, yd, tight)
    if clear_of_land(model.land, layout, y):
        residual = _equilibrate(system, y, yd, tight)
        if not tight.any():
            squeezed = np.abs(layout.u(system.residual(y, yd))["cage"]).max()  # by its pockets
            residual = max(residual, float(squeezed) / load_of(model))
    return residual


def _stages(model: RollerModel, offset: np.ndarray) -> np.ndarray:
    """Shares of the defects' size to go through: from the first touch to all of it."""
    free = pocket_clearance(model, 0.0 * offset)
    full = pocket_clearance(model, offset)
    if not np.any(full < -TOUCH):
        return np.array([1.0])
    tight = full < -TOUCH
    lost = free[tight] - full[tight]
    touch = np.divide(free[tight], lost, out=np.zeros_like(lost), where=lost > 0.0)
    first = float(touch.min())
    return np.linspace(max(first, 0.0), 1.0, STAGES + 1)[1:]


def roller_start(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """Equilibrium at epicyclic speeds; the static solution is not asked for. Where none is found on
    spalls or on spots of rollers, the start is that of even ones."""
    model = bearing.data.model
    if has_pits(model):
        allowed = _ON_SPOTS if model.spot.has.any() else _BALANCED
        try:
            return _start(bearing, limit_force, advance, allowed=allowed)
        except RunFailed:
            bearing = copy(bearing)
            bearing.data = bearing.data._replace(model=without_pits(model))
    return _start(bearing, limit_force, advance, allowed=_BALANCED)


def _start(
    bearing: BearingSystem, limit_force: float, advance: Advance, *, allowed: float
) -> Start:
    """The start with ``allowed`` of the load unbalanced at most; RunFailed if there is none."""
    model, layout = bearing.data.model, bearing.layout
    offset = model.pocket.offset
    y = geometric_guess(model, layout)
    residual = 0.0
    placed = np.zeros((layout.elements, 2))
    shares = _stages(model, offset)
    for stage, share in enumerate(shares, start=1):
        tight = pocket_clearance(model, offset * share) < -TOUCH
        pinched = np.flatnonzero(np.any(tight, axis=1))
        system = Frictionless(bearing, offset * share)
        middle = np.stack(
            [offset[:, 0].min(axis=1) - offset[:, 1].min(axis=1),
             offset[:, 2].min(axis=1) - offset[:, 3].min(axis=1)], axis=1,
        ) * 0.5 * share  # fmt: skip
        q = layout.q(y)["elements"]
        q[:, 2] += (middle - placed)[:, 0] / q[:, 1]
        placed = middle
        yd = standing_cage(model, layout, y)
        residual = _assemble(system, y, yd, tight)
        _check_force(system, y, yd, limit_force, share, pinched)
        advance(stage / len(shares))
    if len(pinched):  # and held, whether its land is in the way or not
        system = Frictionless(bearing, offset, lands=True)
        residual = _equilibrate(system, y, yd, tight)
        _check_force(system, y, yd, limit_force, 1.0, pinched)
    if residual > allowed:
        by_defects = len(pinched) and _sound_one_assembles(bearing, limit_force)
        blamed = "a defect" if by_defects else _others(model)
        raise RunFailed(
            f"no equilibrium to start from was found: {residual:.1e} of the load stays "
            f"unbalanced ({allowed:g} is allowed); is {blamed} too large?"
        )
    report = system.report(y, yd)
    yd = rolling_velocities(model, layout, y)
    held = tuple(int(i) for i in pinched if report.pocket_normal[i].max() > 0.0)
    force = float(report.pocket_normal[list(held)].max()) if held else 0.0
    return Start(y, yd, held, force, residual, report.station.copy())


def roller_start_between_bent_rings(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The same between races that are bent as in the static solution, which has to be given; rings
    bear what then presses on them."""
    assert bearing.rings is not None, "rings bend as in a static solution"
    held, model = copy(bearing), bearing.data.model
    rings = held_rings(bearing.rings)
    inner, outer = (
        standing(bearing.layout.elements, made, at)
        for made, at in zip((model.inner_modes, model.outer_modes), bearing.rings.at_start)
    )
    still = lands_follow(model._replace(rings=rings, inner_modes=inner, outer_modes=outer))
    held.data = bearing.data._replace(model=still)
    start = roller_start(held, limit_force=limit_force, statics=None, advance=advance)
    Frictionless(held, model.pocket.offset).residual(start.y, start.yd)
    y = bearing.rings.begun(start.y, bearing.layout)
    bearing.layout.ring_forces(y)[:] = rings.force
    sentences = (*start.warnings, *_neglected_at_ribs(bearing.rings, model))
    return replace(start, y=y, warnings=sentences)


def _neglected_at_ribs(moving: MovingRings, model: RollerModel) -> Iterator[str]:
    """Sentences on ribs that do not follow how their ring bends."""
    for side, ribs in ((INNER_RACE, model.rib), (OUTER_RACE, model.outer_rib)):
        if ribs.first < ribs.end:
            height = float(model.bodies.radius.mean() - np.abs(ribs.points[:, 0]).min())
            play = 2.0 * (ribs.half_gap - ribs.half_roller)
            yield from neglected_at_ribs(moving, side, height, play)
