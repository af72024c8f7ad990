"""Stress of the cage in motion by mode acceleration.

At one instant the full mesh is solved under the contact forces less all inertia and damping
forces. Over a history the same answer is superposed (see ``history``): what the dynamic modes
carry, plus for every contact force the static field that the modes miss.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel
from flexcage.mesh.rows import rows_in
from flexcage.modes.basis import ContactInterface, ModeBasis
from flexcage.modes.pockets import pocket_frames
from flexcage.modes.rows import pocket_axes
from flexcage.stress.fillets import Arrays, Fillet
from flexcage.stress.places import StressPlaces
from flexcage.stress.rows import contact_zone_of, fillets_of, roots_of
from flexcage.stress.surface import SurfaceStress

STRESS_VERSION = 1  # of what is kept: raise it when the same cage gives other fields or joints
Keep = Callable[[str, Callable[[], Arrays]], Arrays]


def _compute(_name: str, make: Callable[[], Arrays]) -> Arrays:
    """Keeps nothing."""
    return make()


@dataclass(frozen=True, kw_only=True)
class CageLoads:
    """What acts on the cage at one instant.

    Elastic inertia and modal damping follow from the modal coordinates, with which forces, inertia
    and damping are in balance (a recorded coordinate is more precise than its second derivative),
    or are given themselves.
    Rigid accelerations and gravity need not be given: their nodal loads are M times a rigid
    motion, which inertia relief removes exactly, as it does the resultant of the forces.
    """

    station_forces: np.ndarray  # (Z, F, n_st, 3) [N], components (x, r, psi) of the pocket frames
    land_forces: np.ndarray | None = None  # (2, n_land, 3) [N], components (x, r, psi)
    angular_velocity: np.ndarray = field(default_factory=lambda: np.zeros(3))  # body frame [rad/s]
    modal_coordinates: np.ndarray | None = None  # (n,)
    modal_acceleration: np.ndarray | None = None  # (n,)
    modal_damping: np.ndarray | None = None  # (n,) generalised damping forces D qdot


class StressRecovery:
    """Displacements and stresses of one cage; costly parts are made when first needed.

    ``places`` are those of the cage's type.
    ``keep(name, make)`` gives the arrays of that name, which cost the most, from where it keeps
    them, or makes them.
    """

    def __init__(
        self,
        model: FEModel,
        basis: ModeBasis,
        interface: ContactInterface,
        *,
        places: StressPlaces,
        solver: FreeBodySolver | None = None,
        solver_kind: str = "auto",
        keep: Keep = _compute,
    ) -> None:
        if interface.weights is None or interface.land_weights is None:
            raise InputError("a rigid cage has no stress to recover", where="cage", value="rigid")
        self.model, self.basis, self.interface = model, basis, interface
        self.places = places
        self.weights: sp.csr_matrix = interface.weights
        self.land_weights: sp.csr_matrix = interface.land_weights
        self.pocket_count, self.keep = interface.modes.shape[0], keep
        self._given_solver, self._solver_kind = solver, solver_kind

    @cached_property
    def solver(self) -> FreeBodySolver:
        return self._given_solver or FreeBodySolver(self.model, kind=self._solver_kind)

    @cached_property
    def fillets(self) -> list[Fillet]:
        """Submodels of the pockets' corners, where the mesh has fillets."""
        return fillets_of(self.places, self.model, self.interface, self.pocket_count, self.keep)

    @cached_property
    def roots(self) -> dict[str, np.ndarray]:
        """Vertices of every named place."""
        return roots_of(self.places, self.model, self.pocket_count)

    @cached_property
    def contact_zone(self) -> np.ndarray:
        """Vertices that the search for a peak leaves out (``places.StressPlaces``)."""
        return contact_zone_of(self.places, self.model, self.pocket_count)

    @cached_property
    def vertex_stress(self) -> SurfaceStress:
        """Stress at all mesh vertices."""
        return self.stress_at(np.arange(len(self.model.points)))

    def stress_at(self, vertices: np.ndarray) -> SurfaceStress:
        """Stress at mesh vertices (n,), rising."""
        return SurfaceStress(self.model, vertices, self.fillets)

    @cached_property
    def frames(self) -> np.ndarray:
        """Rows x, r, psi of every pocket's frame (Z, 3, 3), x as the cage's."""
        return pocket_axes(self.model, self.pocket_count)

    @property
    def rows(self) -> int:
        """How many rows of pockets the cage has."""
        return max(len(rows_in(self.model.info)), 1)

    def nodal_forces(self, loads: CageLoads) -> np.ndarray:
        """Nodal contact forces (N, 3), cage frame: station forces spread with their weights."""
        at_stations = np.einsum("kfsa,kab->kfsb", loads.station_forces, self.frames)
        nodal = self.weights.T @ at_stations.reshape(-1, 3)
        return nodal if loads.land_forces is None else nodal + self._on_lands(loads.land_forces)

    def _on_lands(self, forces: np.ndarray) -> np.ndarray:
        if forces.size == 0:  # no station of a bearing without lands
            return np.zeros((self.land_weights.shape[1], 3))
        on_land = np.einsum("lja,jab->ljb", forces, pocket_frames(forces.shape[1]))
        return np.asarray(self.land_weights.T @ on_land.reshape(-1, 3))

    @cached_property
    def felt_by_lands(self) -> np.ndarray:
        """Modes (n,) that land forces push and that move the lands, as 1, others as 0."""
        return self.interface.land.any(axis=(0, 1, 2)).astype(float)

    def spin_forces(self, loads: CageLoads) -> np.ndarray:
        """Centrifugal forces (N, 3) on the undeformed cage."""
        model, spin = self.model, np.asarray(loads.angular_velocity, float)
        acceleration = np.cross(spin, np.cross(spin, model.nodes - model.centre))
        return -model.mass_times(acceleration)

    def modal_forces(self, loads: CageLoads, others: np.ndarray) -> np.ndarray:
        """Elastic inertia and modal damping as forces (N, 3), beside the ``others`` (N, 3).

        An eigenmode's are its own inertia, M times its shape; a static shape's act as the load does
        that makes the shape, so that both are K times shapes.
        """
        basis, modal = self.basis, np.zeros(self.basis.size)
        if loads.modal_coordinates is not None:
            push = np.einsum("aik,ai->k", basis.shapes, others)
            if loads.land_forces is not None:
                on_lands = np.einsum("aik,ai->k", basis.shapes, self._on_lands(loads.land_forces))
                push -= (1.0 - self.felt_by_lands) * on_lands
            modal = np.linalg.solve(basis.mass, push - basis.stiffness @ loads.modal_coordinates)
        if loads.modal_acceleration is not None:
            modal = modal + loads.modal_acceleration
        if loads.modal_damping is not None:
            modal = modal + np.linalg.solve(basis.mass, loads.modal_damping)
        moved = basis.shapes @ np.linalg.solve(basis.stiffness, basis.mass @ modal)
        return -np.asarray(self.model.K @ moved.ravel()).reshape(-1, 3)

    def displacement(self, loads: CageLoads) -> np.ndarray:
        """Elastic displacement (N, 3) [m] by mode acceleration on the full mesh."""
        forces = self.nodal_forces(loads) + self.spin_forces(loads)
        total = forces + self.modal_forces(loads, forces)
        return self.solver.solve(total.reshape(-1, 1)).reshape(-1, 3)

    def stress(self, displacement: np.ndarray, loads: CageLoads | None = None) -> np.ndarray:
        """Stress (n_points, 6) [Pa] at the mesh's vertices of a displacement (N, 3) under loads.

        Of the loads those count that act on pocket faces close to a fillet. At a vertex of a
        fillet it is the stress of the most stressed of the points that are nearest to it.
        """
        forces = None if loads is None else loads.station_forces[..., None]
        at_points = self.vertex_stress(displacement[..., None], forces)
        return self.vertex_stress.worst(at_points[:, 0])
