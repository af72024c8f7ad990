"""The stages before a run: each turns specs and what came before into the next frozen value.

cage -> mesh -> modes -> bodies -> contacts and system -> start. A stage names the group of sections
(``case.sections``) that it reads. A case is all groups, so that a script with a case writes
``cage_mesh(case)``. One without a case makes the group, of the few values that it has:
``cage_mesh(MeshSections(bearing=..., cage=...))``. Groups check nothing: a case does, when it is
made.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from flexcage.bearings import bending_of, motion_of, sections_of, statics_of
from flexcage.bodies.cage import flexible_from_reduction, rigid_from_tets
from flexcage.bodies.floating_frame import FlexibleBody
from flexcage.cages.build import build_cage_mesh, reduce_cage, rigid_interface_of
from flexcage.cages.halves import find_apart
from flexcage.case.sections import (
    CageSections,
    LoadedSections,
    MeshSections,
    ModesSections,
    MotionSections,
    PocketSections,
    RingSections,
    StartSections,
)
from flexcage.core.hashing import content_hash
from flexcage.core.progress import Silent
from flexcage.core.timing import Stages
from flexcage.geometry.checks import raise_first
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.quality import check_mesh
from flexcage.modes.reduction import CageReduction
from flexcage.modes.table import ModeTable
from flexcage.system.begun import Start
from flexcage.system.bodies import heaviest_load, in_housing
from flexcage.system.constraints import names_of
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.problem import BearingSystem
from flexcage.system.rings.low_modes import DAMPED
from flexcage.system.rings.modes_data import no_modes
from flexcage.system.rings.moving import MovingRings, moving_rings
from flexcage.system.rings.neglected import neglected_at_lands
from flexcage.system.rings.races import rigid_rings
from flexcage.system.rings.sections import lands_follow
from flexcage.system.start import constrained, find_start, with_push
from flexcage.system.statics.options import AT_START
from flexcage.system.statics.rings import BentRing, Rings
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.solve import solve_bearing
from flexcage.system.statics.yielding import compliance_of, questioned

# mesh and reduction: the second is None for a rigid cage, both are where there is none
Cage = tuple[CageMesh | None, CageReduction | None]


def made_cage(specs: CageSections, stages: Stages) -> Cage:
    """A cage, if the bearing has one: its mesh and, if it is flexible, its reduction."""
    if specs.cage is None:
        return None, None
    mesh = stages.named("mesh", cage_mesh, specs)
    return mesh, stages.named("modes", cage_reduction, specs, mesh)


def cage_mesh(specs: MeshSections) -> CageMesh:
    """Mesh of a cage, checked."""
    at_hand = _mesh_at_hand.get(_mesh_key(specs))
    if at_hand is not None:
        return at_hand
    mesh = build_cage_mesh(**specs.cage_shape)
    if specs.bearing.row_count == 1:  # halves of a common cage were checked when they were made
        check_mesh(mesh, where=specs.mesh.file or "mesh")
    return mesh


_mesh_at_hand: dict[str, CageMesh] = {}  # one at most


def _mesh_key(specs: MeshSections) -> str:
    """Names a mesh that is made of the specs alone; empty for a file's."""
    return "" if specs.mesh.file else content_hash(specs.cage_shape)


def cage_reduction(specs: CageSections, mesh: CageMesh) -> CageReduction | None:
    """Finite elements, modes and interface of a flexible cage; None for a rigid one."""
    if specs.cage_model == "rigid":
        return None
    made = _reduced(specs, mesh)
    return next((cage for cage in _at_hand if cage.same_as(made)), made)


def _reduced(specs: ModesSections, mesh: CageMesh) -> CageReduction:
    if specs.bearing.row_count > 1:
        raise_first(find_apart(specs.its_cage, specs.bearing.row_places))
    return reduce_cage(
        mesh,
        cage=specs.its_cage,
        defects=specs.all_defects,
        spec=specs.modes,
        order=specs.mesh.order,
    )


_at_hand: list[CageReduction] = []  # one at most


def keep_at_hand(cage: CageReduction | None) -> None:
    """Have the next case take this cage, with all that was derived from it, if it has the same:
    the cases that a study's worker computes one after the other often do."""
    _at_hand[:] = [] if cage is None else [cage]


def keep_mesh_at_hand(specs: MeshSections, mesh: CageMesh) -> None:
    """Have the next case take this mesh of a cage, if it has the same."""
    _mesh_at_hand.clear()
    if key := _mesh_key(specs):
        _mesh_at_hand[key] = mesh


def cage_modes(specs: ModesSections) -> ModeTable:
    """Mode table of a cage, taken as flexible."""
    return flexible_cage(specs).table


def flexible_cage(specs: ModesSections) -> CageReduction:
    """The reduction of a cage, taken as flexible."""
    return _reduced(specs, cage_mesh(specs))


def bearing_in_motion(
    specs: MotionSections, mesh: CageMesh | None, cage: CageReduction | None, *,
    seat: np.ndarray | None = None,
) -> BearingSystem:  # fmt: skip
    """Bodies, contacts and equations of motion, which are compiled when first asked for; ``seat``
    (5, 5) is the compliance of a fixed outer ring's seat, if it is not that of the mount."""
    specs = specs.mounted
    seat = compliance_of(specs.mount, specs.bearing) if seat is None else seat
    rings = _moving_rings(specs, seat)
    if cage is not None:
        body = flexible_from_reduction(cage, specs.modes.damped_as(specs.its_cage.warm_material))
        return _assembled(specs, (body, cage.interface), rings, seat)
    if mesh is None:
        return _assembled(specs, None, rings, seat)
    body = rigid_from_tets(mesh.points, mesh.tets, specs.its_cage.material.density)
    return _assembled(specs, (body, _rigid_interface(specs)), rings, seat)


def bearing_to_compile(specs: MotionSections) -> BearingSystem:
    """The same with any body for its cage, and a seat that stands: kernels are alike for all."""
    specs = specs.mounted
    if specs.cage is None:
        return _assembled(specs, None)
    body = rigid_from_tets(np.eye(4, 3, -1), np.array([[0, 1, 2, 3]]), 1.0)
    return _assembled(specs, (body, _rigid_interface(specs)))


def _rigid_interface(specs: PocketSections) -> Any:
    bearing = specs.bearing
    return rigid_interface_of(
        specs.its_cage, pocket_count=bearing.element_count, defects=specs.all_defects,
        places=bearing.row_places,
    )  # fmt: skip


def bent_rings(specs: RingSections) -> tuple[BentRing, ...]:
    """The rings that bend, as a run begins; none if both are rigid."""
    specs = specs.mounted
    rings = _moving_rings(specs, compliance_of(specs.mount, specs.bearing))
    return rings.start.rings if rings else ()


def _moving_rings(specs: RingSections, seat: np.ndarray | None) -> MovingRings | None:
    if not specs.rings_bend:
        return None
    rings = replace(_rings_of(specs), heavier=heaviest_load(specs.load))
    solution = _statics(specs, rings, seat)
    return moving_rings(rings, solution, whole=_move_on_their_seats(specs, seat))


def _move_on_their_seats(specs: RingSections, seat: np.ndarray | None) -> tuple[bool, bool]:
    """May inner and outer ring, which bend, move as a whole on their seats? So they do on those
    that stand, or are as heavy: a light one would follow the ring at once."""
    load, mount, bearing = specs.load, specs.mount, specs.bearing
    held = load.centre != "free" and not load.frees_axially(bearing)
    heavy = load.shaft_mass >= bearing.inner_ring_mass
    stands = mount.kind == "fixed" and seat is None
    inner = load.tilt == "held" and (held or heavy)
    return inner, stands or mount.mass >= bearing.outer_ring_mass


def _rings_of(specs: RingSections) -> Rings:
    return Rings(specs.inner_ring, specs.outer_ring, sections_of(specs.bearing))


def _statics(
    specs: LoadedSections, rings: Rings | None = None, seat: np.ndarray | None = None
) -> StaticSolution:
    return solve_bearing(
        specs.bearing, statics_of(specs.bearing), load=specs.load, speed=specs.speed,
        contacts=specs.contacts, lubricant=specs.lubricant, options=AT_START, rings=rings,
        seat=seat,
    )  # fmt: skip


def _assembled(
    specs: MotionSections, cage: tuple[FlexibleBody, Any] | None, rings: MovingRings | None = None,
    seat: np.ndarray | None = None,
) -> BearingSystem:  # fmt: skip
    """``cage``: its body, and what moves in its pockets; ``rings``: those that bend, any if they
    are left out; ``seat``: the outer ring's compliance, if it yields."""
    motion, output = motion_of(specs.bearing), specs.output
    body, interface = cage or (None, None)
    bends = specs.rings_bend
    model = motion.build_model(
        specs.bearing, specs.cage, body, interface, contacts=specs.contacts,
        lubricant=specs.lubricant, drive=specs.drive, load=specs.load, mount=specs.mount,
        seed=specs.seed,
    )  # fmt: skip
    if seat is not None and specs.mount.kind == "fixed":
        late = DAMPED * specs.outer_ring.relaxation
        model = model._replace(outer_ring=in_housing(model.outer_ring, seat, late))
    count = specs.bearing.total_elements
    if bends:
        bending = bending_of(specs.bearing)
        data = rigid_rings(count) if rings is None else rings.data
        modes = (no_modes(count), no_modes(count)) if rings is None else rings.modes
        motion, model = bending.motion, lands_follow(bending.model(*model, data, *modes))
        if rings:
            model = rings.with_inertia(model, specs.bearing)
    if body is None:
        motion = motion.without_cage
    layout = Layout(
        count,
        bodies_of_bearing(body.modes if body else None, rings.counts if rings else (0, 0)),
        names_of(specs.constraints), bends,
    )  # fmt: skip
    return BearingSystem(
        motion, specs.bearing, model, specs.contacts, layout, constraints=specs.constraints,
        block=output.block, stride=output.vibration_ratio, interval=1.0 / output.rate, rings=rings,
        seat=seat,
    )  # fmt: skip


def assembled_start(
    specs: StartSections, bearing: BearingSystem, progress: Callable[..., Any] = Silent
) -> Start:
    """Where a run begins: the bearing assembled and in equilibrium at the drive's first speed, its
    cage pushed off if ``start`` says so, and all on the constraints.

    ``progress`` is a context like ``core.progress.Progress``.
    """
    specs = specs.mounted

    def statics() -> StaticSolution:
        return bearing.rings.start if bearing.rings else _statics(specs, seat=bearing.seat)

    limit = specs.limits.assembly_force
    with progress(1.0, "start") as bar:
        start = find_start(bearing, limit_force=limit, statics=statics, advance=bar.to)
    if bearing.rings:
        lands = neglected_at_lands(bearing.rings, bearing.data.model.land)
        start = replace(start, warnings=(*start.warnings, *bearing.rings.warnings, *lands))
    unusual = questioned(specs.mount, specs.bearing, bearing.seat)
    start = replace(start, warnings=(*start.warnings, *unusual))
    start = with_push(start, bearing.layout, specs.start)
    return constrained(start, bearing, specs.constraints, limit_force=limit)
