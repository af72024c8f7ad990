"""From a machine to its static solution."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from flexcage.case.plausibility import implausible_values
from flexcage.case.unread import not_used
from flexcage.core.binding import expect
from flexcage.core.errors import InputError
from flexcage.core.threads import one_blas_thread
from flexcage.core.units import describe, mm
from flexcage.machine.equilibrium import Standing, Together, balance, tangent_of
from flexcage.machine.housing import housing_seats
from flexcage.machine.machine import Machine
from flexcage.machine.seating import Seated, in_housing, seat
from flexcage.machine.shaft import ShaftModel, build_shaft
from flexcage.machine.solution import BearingResult, MachineSolution
from flexcage.static import lives_of
from flexcage.system.statics.equilibrium import Posture
from flexcage.system.statics.lives import questioned_lives
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.solve import solution_at
from flexcage.system.statics.yielding import questioned

_OTHER = 0.02  # of a bore, by which the shaft's diameter may differ
_NEAR = 0.15  # of a critical speed: closer, a warning


@one_blas_thread
def solve_machine(machine: Machine, *, shaft: ShaftModel | None = None) -> MachineSolution:
    """Equilibrium of shaft and bearings under their loads, at the speed at which the drive begins.

    ``shaft`` is the machine's own model, where it is there already. Raises InputError for loads
    that the bearings cannot bear, RunFailed if no equilibrium is found.
    """
    expect(machine, Machine, "machine", "flexcage.load_machine reads one from a file")
    shaft = shaft or _shaft_of(machine)
    load = shaft.load(machine.gravity)
    size = _size(machine, shaft.by_node(machine.gravity))
    seats = [seat(b, shaft.dofs(b.place.position), size) for b in machine.bearings]
    housing = housing_seats(machine)
    seats, stiffness = in_housing(housing, seats)
    together = Together(shaft, load, seats, stiffness)
    found = balance(together)
    q, rings = together.split(found.z)
    results, reactions = [], np.zeros(5 * len(shaft.places))
    for b, p, posture in zip(seats, rings, found.postures):
        slopes = b.tangent(posture)
        results.append(_result(b, p, posture, slopes, q))
        reactions[b.at] += results[-1].force
    solution = MachineSolution(
        name=machine.name, speed=machine.speed, shaft=shaft, displacement=q.reshape(-1, 5),
        coordinates=shaft.made @ found.z[: together.starts[0]],
        sections=shaft.borne(reactions, machine.gravity), bearings=tuple(results), load=load,
        tangent=_condensed(together, found), warnings=(), unbalanced=found.share_left,
        whirl=machine.whirl, gravity=machine.gravity, housing=housing,
    )  # fmt: skip
    return replace(solution, warnings=tuple(_warnings(machine, solution)))


def _shaft_of(machine: Machine) -> ShaftModel:
    """Its model, of beams or from a file."""
    positions = [b.place.position for b in machine.bearings]
    if not machine.shaft.body:
        return build_shaft(machine.shaft, positions)
    from flexcage.machine.body_shaft import read_shaft  # with readers of files, which few need

    return read_shaft(machine.shaft, positions)


def _size(machine: Machine, load: np.ndarray) -> float:
    """Magnitude of what loads the machine [N]; ``load`` (k, 5) at the shaft's nodes."""
    by_node = np.abs(load)
    pushes = sum((b.place.preload_force or 0.0) + b.place.spring_force for b in machine.bearings)
    turning = float(by_node[:, 3:].sum()) / machine.shaft.whole_length
    return max(float(by_node[:, :3].sum()) + turning + pushes, 1.0)


def _condensed(m: Together, found: Standing) -> np.ndarray:
    """Slopes of the forces on the shaft over its own motions, the outer rings following."""
    whole, count = tangent_of(m, found), m.starts[0]
    rings = whole[count:, count:]
    size = np.sqrt(np.maximum(np.abs(np.diag(rings)), 1e-300))  # of rings that nothing presses: 0
    inner = np.linalg.pinv(rings / np.outer(size, size), rcond=1e-13) / np.outer(size, size)
    following = whole[:count, count:] @ inner @ whole[count:, :count]
    return np.asarray(whole[:count, :count] - following)


def _result(
    b: Seated, p: np.ndarray, posture: Posture, slopes: np.ndarray, q: np.ndarray
) -> BearingResult:
    place, case = b.spec.place, b.spec.case
    try:
        own = solution_at(
            b.bearing, b.elements, replace(posture, outer=b.outer.ways @ p), case.static,
            load=posture.force, borne=posture.force, speed=case.speed, lubricant=case.lubricant,
            reaction=np.zeros(5), stiffness=b.in_series(slopes), held="by the machine's shaft",
        )  # fmt: skip
    except InputError as exc:
        raise InputError(
            f"Bearing {place.name} faces {place.facing} and cannot bear what the shaft does to it: "
            "elements would press where its rings have no shoulder; preload it more, turn it round "
            "(facing), or let another bearing face the load.",
            where=f"bearings.{place.name}.facing",
        ) from exc
    return BearingResult(
        name=place.name, position=place.position, facing=place.facing, offset=b.offset,
        force=-b.mirror * posture.force, displacement=q[b.at],
        stiffness=np.outer(b.mirror, b.mirror) * own.stiffness, damping=place.damping,
        solution=_told(b, own),
    )  # fmt: skip


def _told(b: Seated, own: StaticSolution) -> StaticSolution:
    """A bearing's solution with its mounting, its lives, and what is to be said of its case."""
    case = b.spec.case
    seat = None if not case.mount.body else b.outer.ways @ np.linalg.pinv(
        b.outer.stiffness) @ b.outer.ways.T  # fmt: skip
    unusual = (text for _, text in implausible_values(case))
    said = (*not_used(case), *unusual, *questioned(case.mount, b.bearing, seat))
    own = replace(own, mounting=case.mounting)
    if case.life.given:
        lives = lives_of(case, own)
        said = (*said, *questioned_lives(lives, own.ratings.dynamic))
        own = replace(own, lives=lives)
    if case.speed and not own.loaded:
        said = (*said, "none of its elements bears load: at speed they slide. Preload it.")
    return replace(own, warnings=(*said, *own.warnings))


def _warnings(machine: Machine, s: MachineSolution) -> list[str]:
    found = [f"bearing {b.name}: {text}" for b in s.bearings for text in b.solution.warnings]
    found += _of_bores(machine)
    found += _of_stress(machine, s.shaft, s)
    speed = abs(machine.speed)
    for critical in s.linearised.critical_speeds() if speed else ():
        if abs(critical / speed - 1.0) < _NEAR:
            found.append(
                f"the speed, {describe(speed, 'rpm')}, is within {_NEAR:.0%} of a critical speed, "
                f"{describe(critical, 'rpm')}."
            )
    return found


def _of_bores(machine: Machine) -> list[str]:
    """A sentence on each bearing whose bore is not the diameter of the shaft where it stands."""
    found, ends = [], np.cumsum([0.0, *(s.length for s in machine.shaft.sections)])
    for seated in machine.bearings if machine.shaft.sections else ():
        bearing, x = seated.case.bearing, seated.place.position
        half = 0.5 * bearing.width
        under = [s.diameter for s, a, b in zip(machine.shaft.sections, ends, ends[1:])
                 if a < x + half and b > x - half]  # fmt: skip
        nearest = min(under, key=lambda d: abs(d - bearing.bore))
        if abs(nearest - bearing.bore) > _OTHER * bearing.bore:
            found.append(
                f"bearing {seated.place.name} has a bore of {mm(bearing.bore)}, but at "
                f"{mm(x)} the shaft's diameter is {mm(nearest)}: is there a sleeve?"
            )
    return found


def _of_stress(machine: Machine, shaft: ShaftModel, s: MachineSolution) -> list[str]:
    """A sentence where the nominal stress of a section is above its material's proof stress."""
    if not shaft.beams:
        return []
    proof = np.repeat([b.material.proof_stress for b in shaft.beams], 2)
    k = int(np.argmax(s.sections.stress / proof))
    if s.sections.stress[k] <= proof[k]:
        return []
    return [
        f"the shaft's nominal stress at {mm(s.sections.position[k])}, "
        f"{describe(s.sections.stress[k], 'MPa')}, is above the proof stress of its material, "
        f"{describe(proof[k], 'MPa')}: it would yield."
    ]
