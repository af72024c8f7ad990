"""The cage of a ball bearing as contacts see it: stations round every pocket's wall.

Next to a ball the wall gives way in three parts: with the cage's dynamic modes; by ``local``, what
these miss of the cage's bending and shear around the pocket; and by the indentation that a contact
law counts. The elements show them together under a force spread round a station. Of that answer
``local`` is what is left without the modes' part and without the mean indentation of a half-space
by the same spread force.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
import scipy.sparse as sp

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import BallCageDefect, pocket_shapes
from flexcage.cages.round_pocket.shapes import PocketShapes
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel
from flexcage.fem.symmetry import find_symmetry
from flexcage.geometry.materials import Material
from flexcage.mesh.rows import RowFrame
from flexcage.modes.basis import ModeBasis
from flexcage.modes.interface import (
    LAND_STATIONS,
    land_modes,
    land_station_weights,
    normalised,
)
from flexcage.modes.pockets import pocket_frame, vector_frames
from flexcage.modes.reduction import CageReduction, Interfaces

N_STATIONS = 16


@dataclass(frozen=True)
class BallCageInterface:
    """Where balls touch their cage, and what moves there; Z pockets, components (x, r, psi).

    Station j is where the wall's outward normal, away from the pocket's axis, is at the angle
    ``stations[j]`` from +psi towards +x: (sin, 0, cos) in the pocket's frame (azimuth 2 pi k/Z,
    cage frame). On a slot's straight wall all points belong to one such angle. A station's
    displacement is a mean over the wall's whole height, weighted with a hat function of that
    angle; a force on it is spread with the same weights, so that work is conserved. Between
    stations displacements and compliances are linear in the angle.
    """

    single: ClassVar[tuple[tuple[int, ...], ...]] = ((0, 1, 2),)
    even: ClassVar[tuple[tuple[int, ...], ...]] = ((),)
    per_pocket: ClassVar[tuple[str, ...]] = (
        "modes", "local", "centre", "radius", "slot", "weights", "offset", "open_at"
    )  # fmt: skip

    stations: np.ndarray  # (n_st,) angles [rad], 0 towards +psi, pi/2 towards +x
    modes: np.ndarray  # (Z, n_st, 3, n) dynamic modes at stations
    local: np.ndarray  # (Z, n_st) [m/N] compliance along the normal beyond the modes, see above
    centre: np.ndarray  # (Z, 2) axial and circumferential shift [m] of the axis at pitch radius
    radius: np.ndarray  # (Z,) [m]
    slot: np.ndarray  # (Z, 2) half straight lengths [m] along x and psi
    land: np.ndarray  # (2, n_land, 3, n): radial-frame modes on the inner/outer land ring stations
    weights: sp.csr_matrix | None = None  # (Z*n_st, n_nodes): station <- nodal displacement
    land_weights: sp.csr_matrix | None = None  # (2*n_land, n_nodes), the same for land stations
    # where defects moved stations (Z, n_st, 3) [m], and where they let walls end towards +x (Z,)
    # [m]; None: nowhere
    offset: np.ndarray | None = None
    open_at: np.ndarray | None = None

    @property
    def normals(self) -> np.ndarray:
        """Outward normals (n_st, 3) of the wall at the stations, in the pocket's frame."""
        return wall_normals(self.stations)

    def in_row(self, frame: RowFrame) -> BallCageInterface:
        """That of a row's pockets in the cage's frame, but for where walls end towards the row's
        own +x."""
        ways = np.array([frame.sign, 1.0, 1.0])
        angles = np.arange(len(self.stations)) * int(frame.sign)
        offset, weights = self.offset, self.weights
        if weights is not None and frame.sign < 0.0:
            pockets = np.arange(len(self.radius))[:, None] * len(angles)
            weights = weights[(pockets + angles % len(angles)).ravel()]
        return replace(
            self, modes=self.modes[:, angles] * ways[:, None], local=self.local[:, angles],
            centre=self.centre * ways[[0, 2]] + np.array([frame.place, 0.0]), weights=weights,
            offset=None if offset is None else offset[:, angles] * ways,
        )  # fmt: skip

    def plain(self, name: str) -> np.ndarray:
        """What ``offset`` or ``open_at`` is where defects moved nothing."""
        if name == "offset":
            return np.zeros(self.modes.shape[:3])
        return np.full(len(self.radius), np.inf)


WeightsOf = Callable[[FEModel, np.ndarray, PocketShapes, Any], sp.csr_matrix]


def wall_stations(n_stations: int = N_STATIONS) -> np.ndarray:
    """Angles (n_st,) [rad] of evenly spaced stations, the first towards +psi."""
    return 2.0 * np.pi * np.arange(n_stations) / n_stations


def wall_normals(angles: np.ndarray) -> np.ndarray:
    """Outward normals (n, 3) as (x, r, psi) of a wall at these angles."""
    return np.column_stack([np.sin(angles), np.zeros(len(angles)), np.cos(angles)])


def rigid_ball_interface(
    cage: BallCage,
    *,
    pocket_count: int,
    defects: Sequence[BallCageDefect] = (),
    n_stations: int = N_STATIONS,
    n_land: int = LAND_STATIONS,
) -> BallCageInterface:
    """Interface of a rigid cage: no modes, no compliance, no mesh; defects in the walls' shapes."""
    shapes = pocket_shapes(cage, defects, pocket_count=pocket_count)
    return BallCageInterface(
        stations=wall_stations(n_stations),
        modes=np.zeros((pocket_count, n_stations, 3, 0)),
        local=np.zeros((pocket_count, n_stations)),
        centre=shapes.centre,
        radius=shapes.radius,
        slot=shapes.slot,
        land=np.zeros((2, n_land, 3, 0)),
    )


def ball_cage_interface(
    model: FEModel,
    basis: ModeBasis,
    *,
    pocket_count: int,
    cage: BallCage,
    defects: Sequence[BallCageDefect] = (),
    solver: FreeBodySolver | None = None,
    n_stations: int = N_STATIONS,
    n_land: int = LAND_STATIONS,
    weights_of: WeightsOf | None = None,
) -> BallCageInterface:
    """Interface of a flexible cage.

    ``solver``: the model's factored free body, if there is one. ``n_land`` = 0 leaves the lands
    out. ``weights_of`` weighs the walls' nodes for the stations, ``wall_weights`` if not given.
    """
    stations = wall_stations(n_stations)
    shapes = pocket_shapes(cage, defects, pocket_count=pocket_count)
    weights = (weights_of or wall_weights)(model, stations, shapes, cage)
    land_weights = land_station_weights(model, n_land)
    frames = vector_frames(model, pocket_count)
    modes = _modes_at_stations(basis, weights, frames)
    static = static_compliance(solver or FreeBodySolver(model), weights, frames)
    beyond = static - carried_compliance(basis, modes, stations)
    return BallCageInterface(
        stations=stations,
        modes=modes,
        local=np.maximum(beyond - indentations(cage, shapes, stations), 0.0),
        centre=shapes.centre,
        radius=shapes.radius,
        slot=shapes.slot,
        land=land_modes(basis, land_weights, n_land),
        weights=weights,
        land_weights=land_weights,
    )


def wall_weights(
    model: FEModel, stations: np.ndarray, shapes: PocketShapes, cage: BallCage
) -> sp.csr_matrix:
    """Weights (Z*n_st, N): station value <- nodal values, rows summing to one.

    A displaced pocket's arc is laid off half-way through the wall; the pitch circle, where it is
    defined, is so near that a pocket displaced by a millimetre turns by less than a milliradian.
    """
    count, mean_radius = len(shapes.radius), 0.25 * (cage.bore + cage.outside_diameter)
    rows = []
    for pocket in range(count):
        shift, arc = shapes.centre[pocket]
        frame = pocket_frame(pocket + arc / mean_radius * count / (2.0 * np.pi), count)
        slot = shapes.slot[pocket]

        def hats(
            points: np.ndarray, frame: np.ndarray = frame, shift: float = shift, slot=slot
        ) -> np.ndarray:
            x, _, t = frame @ points.T
            x = x - shift
            from_axis = (x - np.clip(x, -slot[0], slot[0]), t - np.clip(t, -slot[1], slot[1]))
            return station_hats(np.arctan2(*from_axis), len(stations))

        rows.append(model.face_weights(model.group(f"pocket{pocket}_wall"), hats))
    return normalised(sp.vstack(rows), [f"pocket{k}_wall" for k in range(count)])


def station_hats(angles: np.ndarray, count: int) -> np.ndarray:
    """Periodic hat functions (count, n) of evenly spaced stations; they sum to one."""
    place = angles * count / (2.0 * np.pi)
    difference = (place[None] - np.arange(count)[:, None] + 0.5 * count) % count - 0.5 * count
    return np.maximum(1.0 - np.abs(difference), 0.0)


def _modes_at_stations(basis: ModeBasis, weights: sp.csr_matrix, frames: np.ndarray) -> np.ndarray:
    n_nodes, _, n = basis.shapes.shape
    means = (weights @ basis.shapes.reshape(n_nodes, 3 * n)).reshape(len(frames), -1, 3, n)
    return np.ascontiguousarray(np.einsum("kab,ksbn->ksan", frames, means))


def normal_loads(weights: sp.csr_matrix, pocket: int, frames: np.ndarray) -> np.ndarray:
    """Nodal loads (3N, n_st) of 1 N along the outward normal at each station of a pocket, which has
    one of the ``frames`` (Z, 3, 3)."""
    n_stations = weights.shape[0] // len(frames)
    rows = weights[pocket * n_stations : (pocket + 1) * n_stations].toarray()
    normals = wall_normals(wall_stations(n_stations)) @ frames[pocket]
    return np.einsum("sn,sa->nas", rows, normals).reshape(-1, n_stations)


def static_compliance(
    solver: FreeBodySolver, weights: sp.csr_matrix, frames: np.ndarray
) -> np.ndarray:
    """Displacement (Z, n_st) [m/N] of each station along its normal under its own unit force.

    Inertia-relieved, on the full mesh, all that the elements show; on a cyclic model pocket 0
    stands for all.
    """
    pocket_count, answers = len(frames), []
    symmetry = find_symmetry(solver.model, pocket_count)
    for pocket in range(1 if symmetry else pocket_count):
        loads = normal_loads(weights, pocket, frames)
        answers.append(np.einsum("ns,ns->s", loads, solver.solve(loads)))
    return np.tile(answers, (pocket_count // len(answers), 1))


def carried_compliance(basis: ModeBasis, modes: np.ndarray, stations: np.ndarray) -> np.ndarray:
    """The part (Z, n_st) [m/N] of that compliance which dynamic modes (Z, n_st, 3, n) carry."""
    along = np.einsum("ksan,sa->ksn", modes, wall_normals(stations))
    soft = np.linalg.solve(basis.stiffness, along.reshape(-1, basis.size).T).T
    return np.sum(along * soft.reshape(along.shape), axis=2)


def indentations(cage: BallCage, shapes: PocketShapes, stations: np.ndarray) -> np.ndarray:
    """Mean indentation (Z, n_st) [m/N] of a half-space by the load of each station.

    A hat of base 2 w over a strip indents on its own mean as an even pressure over sqrt(2) w does,
    within half a percent for strips one to ten times as high as w (the test integrates it).
    """
    height = 0.5 * (cage.outside_diameter - cage.bore)
    even = np.sqrt(2.0) * 2.0 * np.pi / len(stations) * shapes.radius
    sides = np.arange(4) * 0.5 * np.pi  # straight walls at +psi, +x, ...
    flats = station_hats(sides, len(stations))
    lengths = 2.0 * shapes.slot[:, [0, 1, 0, 1]]
    widths = even[:, None] + lengths @ flats.T
    material = cage.warm_material
    return np.array([[mean_indentation(material, w, height) for w in row] for row in widths])


def mean_indentation(material: Material, width: float, height: float) -> float:
    """Mean displacement [m/N] of a rectangle of a half-space under an even pressure on it.

    The double integral over the rectangle of Boussinesq's (1 - nu^2)/(pi E distance), over the
    area squared. S. P. Timoshenko and J. N. Goodier, Theory of Elasticity, 3rd ed. 1970, art. 139,
    tabulate it as m (1 - nu^2)/(E sqrt(area)), m = 0.95 for a square.
    """
    w, h = width, height
    diagonal = np.hypot(w, h)
    integral = 2.0 * w * h * (w * np.arcsinh(h / w) + h * np.arcsinh(w / h))
    integral -= 2.0 / 3.0 * (diagonal**3 - w**3 - h**3)
    soft = (1.0 - material.poisson_ratio**2) / (np.pi * material.youngs_modulus)
    return float(soft * integral / (w * h) ** 2)


def _reduced(cage: CageReduction) -> BallCageInterface:
    return ball_cage_interface(
        cage.model,
        cage.basis,
        pocket_count=cage.mesh.pocket_count,
        cage=cage.cage,
        defects=cage.defects,
        solver=cage.solver,
    )


def _depends_on(
    cage: BallCage, defects: Sequence[BallCageDefect], pocket_count: int
) -> tuple[Any, ...]:
    pockets = pocket_shapes(cage, defects, pocket_count=pocket_count)
    return pockets, cage.bore, cage.outside_diameter


ROUND_INTERFACES = Interfaces(
    kind=BallCageInterface, rigid=rigid_ball_interface, reduced=_reduced, depends_on=_depends_on
)
