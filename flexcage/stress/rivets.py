"""What the rivets of a ribbon cage bear: force and moment through the joint at every web.

The halves hold together in circles of the middle plane alone, at nodes that elements of both halves
share. With K+ and K- the stiffness of the elements at x > 0 and x < 0, the half at x < 0 pushes the
other one there by (K+ u - K- u)/2 = K+ u - K u/2, node by node: nothing else acts on these nodes
but their inertia, and by symmetry each half has one half of it. Sums over a joint's nodes are its
force and moment, linear in the displacement, so that they are superposed as stresses are
(``fields``).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.fem.condensed import dofs_of
from flexcage.fem.model import FEModel, assemble
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.halves import shared_by_halves
from flexcage.modes.pockets import pocket_frame
from flexcage.stress.between import Steps, no_steps
from flexcage.stress.fields import NamedFields
from flexcage.stress.history import Sliced, histories_at
from flexcage.stress.recovery import StressRecovery

if TYPE_CHECKING:
    import xarray

AXES = ("x", "r", "psi")  # at the rivet's azimuth
_VECTORS = {  # of the dataset: units, names
    "force": ("N", "force of the half at x < 0 on the other"),
    "moment": ("N m", "moment of the half at x < 0 on the other, about the rivet's middle"),
}
_FIGURES = {  # likewise, one number each
    "tension": ("N", "tension of the rivet; negative where the halves are pressed together"),
    "shear": ("N", "shear force on the rivet"),
    "bending": ("N m", "bending moment about the rivet's middle"),
    "torsion": ("N m", "moment about the rivet's axis"),
    "stress": ("Pa", "nominal equivalent stress of the shank"),
}


class Joints:
    """Forces and moments through the joints of a ribbon cage whose ball centres lie at
    ``pitch_radius`` [m]; ``webs`` (n,) numbers those that there are."""

    def __init__(self, model: FEModel, pocket_count: int, pitch_radius: float) -> None:
        ahead, shared = shared_by_halves(model.points, model.tets, model.cells)
        azimuth = np.arctan2(model.nodes[shared, 2], model.nodes[shared, 1])
        web = np.round(azimuth * pocket_count / (2.0 * pi) + 0.5).astype(int) % pocket_count
        self.webs = np.unique(web)
        push = _nodal_forces(model, ahead, shared) - 0.5 * model.K[dofs_of(shared)]
        rows = [
            _resultant(model.nodes[shared], web == k, pocket_frame(k - 0.5, pocket_count),
                       pitch_radius)
            for k in self.webs
        ]  # fmt: skip
        self._rows = sp.csr_matrix(sp.vstack(rows) @ push)

    def __call__(self, fields: np.ndarray, _forces: np.ndarray | None = None) -> np.ndarray:
        """Force [N] and moment [N m] (n, m, 6) of displacements (N, 3, m) [m]: those of the half at
        x < 0 on the other, about the rivet's middle; components (x, r, psi) at its azimuth."""
        found = self._rows @ fields.reshape(-1, fields.shape[2])
        return np.ascontiguousarray(found.reshape(len(self.webs), 6, -1).swapaxes(1, 2))


def _nodal_forces(model: FEModel, half: np.ndarray, nodes: np.ndarray) -> sp.csr_matrix:
    """Rows (3 n, 3 N) of the stiffness of one half's elements at some of its nodes."""
    touching = half & np.isin(model.cells, nodes).any(axis=1)
    vertices, tets = np.unique(model.tets[touching], return_inverse=True)
    part = assemble(
        CageMesh(model.points[vertices], tets.reshape(-1, 4)), model.material, order=model.order
    )
    own = vertices
    if model.order == 2:
        own = np.concatenate([vertices, model.edge_nodes(vertices[part.edges])])
    place = np.full(len(model.nodes), -1)
    place[own] = np.arange(len(own))
    found = part.K[dofs_of(place[nodes])].tocoo()
    columns = dofs_of(own)[found.col]
    return sp.csr_matrix((found.data, (found.row, columns)), shape=(found.shape[0], model.n_dof))


def _resultant(
    nodes: np.ndarray, own: np.ndarray, frame: np.ndarray, pitch_radius: float
) -> sp.csr_matrix:
    """Force and moment (6, 3 n), in a frame's axes, of forces on those nodes (n, 3) that are a
    joint's ``own``."""
    arm = nodes - pitch_radius * frame[1]
    rows = np.zeros((6, len(nodes), 3))
    rows[:3] = frame[:, None]
    rows[3:] = np.cross(frame[:, None], arm)  # a . (arm x f) = (a x arm) . f
    rows[:, ~own] = 0.0
    return sp.csr_matrix(rows.reshape(6, -1))


class RivetFields(NamedFields):
    """Force and moment of every rivet per unit modal coordinate and unit force: six parts of one
    point each."""

    prefix = "rivets_"

    def __init__(self, recovery: StressRecovery, joints: Joints) -> None:
        super().__init__(recovery, joints)
        self.places = {str(web): np.array([i]) for i, web in enumerate(joints.webs)}


@dataclass(frozen=True, eq=False)
class Rivets:
    """Loads of the rivets over a run, ``dataset`` (an xarray.Dataset) by time and rivet.

    ``force`` [N] and ``moment`` [N m] at samples are those of the half at x < 0 on the other, about
    the rivet's middle, components (x, r, psi) at its azimuth. ``tension``, ``shear``, ``bending``,
    ``torsion`` and ``stress``, the nominal equivalent stress of a shank that bears them alone
    (tension and bending, and shear with torsion at its rim), are the largest since the sample
    before, steps of the solver included. Heads that clamp, and sheets that rub and press on each
    other beside the rivet, take part of these loads from a real shank.
    """

    dataset: xarray.Dataset
    diameter: float  # [m] of the shanks
    settled: int = 0  # first sample of the settled part

    def largest(self, figure: str = "stress") -> tuple[float, int]:
        """The largest value of a figure over the settled part, and its rivet."""
        values = self._most(figure)
        where = int(np.argmax(values))
        return float(values[where]), int(self.dataset["rivet"].values[where])

    def cycle(self) -> tuple[int, np.ndarray, np.ndarray]:
        """The rivet of the largest nominal stress in the settled part, and two loads (6,) on it:
        force [N] and moment [N m] (x, r, psi) at that instant, and at the one that is least by the
        same measure.

        That measure is the projection on the largest load, each part over what it takes to make a
        nominal stress of 1 Pa. The largest is that of the nearest sample, made as much larger as
        the nominal stress between samples was.
        """
        _, rivet = self.largest("stress")
        own = self.dataset.sel(rivet=rivet).isel(time=slice(self.settled, None))
        loads = np.concatenate([own["force"].values, own["moment"].values], axis=1)
        at_samples = np.array([nominal_stress(load, self.diameter) for load in loads])
        peak = int(np.argmax(own["stress"].values))
        near = max(peak - 1, 0) + int(np.argmax(at_samples[max(peak - 1, 0) : peak + 1]))
        largest = loads[near] * max(float(own["stress"].values[peak]) / at_samples[near], 1.0)
        weights = 1.0 / np.array([_unit_load(k, self.diameter) for k in range(6)])
        shares = (loads * weights) @ (largest * weights)
        return rivet, largest, loads[int(np.argmin(shares))]

    def _most(self, figure: str) -> np.ndarray:
        if figure not in _FIGURES:
            raise InputError(
                f"Rivets have no figure {figure!r}; choose from {', '.join(_FIGURES)}.",
                where="figure",
                value=figure,
            )
        return self.dataset[figure].values[self.settled :].max(axis=0)

    def table(self) -> str:
        """The largest loads of every rivet over the settled part."""
        lines = ["rivet  tension, N  shear, N  bending, N mm  torsion, N mm  nominal stress, MPa"]
        columns = zip(self.dataset["rivet"].values, *(self._most(name) for name in _FIGURES))
        for rivet, tension, shear, bending, torsion, stress in columns:
            lines.append(
                f"{rivet:5d}  {tension:10.3g}  {shear:8.3g}  {bending * 1e3:13.3g}  "
                f"{torsion * 1e3:13.3g}  {stress / 1e6:19.3g}"
            )
        return "\n".join(lines)

    __str__ = table


def rivet_loads(
    fields: RivetFields,
    q: Sliced,
    station_forces: Sliced,
    land_forces: Sliced | None = None,
    *,
    time: np.ndarray,
    diameter: float,
    settled: int = 0,
    between: Steps = no_steps,
) -> Rivets:
    """What rivets of this ``diameter`` [m] bear at samples of these times [s] and at the steps
    between; other arguments as in ``history.stress_history``."""
    sample, histories = histories_at(
        fields, q, station_forces, land_forces, places=fields.places, between=between
    )
    first = np.flatnonzero(np.append(True, np.diff(sample) > 0))
    last = np.append(first[1:], len(sample)) - 1  # the sample itself
    own = [_of_one(parts[:, 0].astype(float), first, last, diameter) for _, parts in histories]
    return Rivets(_labelled(own, time, np.array([int(name) for name in fields.places])),
                  diameter, settled)  # fmt: skip


def _of_one(
    parts: np.ndarray, first: np.ndarray, last: np.ndarray, diameter: float
) -> dict[str, np.ndarray]:
    """Figures of a rivet whose force and moment at all instants are ``parts`` (6, n)."""
    found = _figures(parts, diameter)
    largest = {name: np.maximum.reduceat(values, first) for name, values in found.items()}
    return {"force": parts[:3, last].T, "moment": parts[3:, last].T, **largest}


def _figures(parts: np.ndarray, diameter: float) -> dict[str, np.ndarray]:
    """Tension, shear, bending, torsion and nominal stress of force and moment (6, n)."""
    (along, *across), (twist, *bend) = parts[:3], parts[3:]
    tension, shear = -along, np.hypot(*across)
    bending, torsion = np.hypot(*bend), np.abs(twist)
    area, modulus = 0.25 * pi * diameter**2, pi * diameter**3 / 32.0
    normal = np.maximum(tension, 0.0) / area + bending / modulus
    sliding = shear / area + 0.5 * torsion / modulus
    values = (tension, shear, bending, torsion, np.sqrt(normal**2 + 3.0 * sliding**2))
    return dict(zip(_FIGURES, values))


def nominal_stress(load: np.ndarray, diameter: float) -> float:
    """Nominal equivalent stress [Pa] of a shank that bears a load or the difference of two (6,)
    alone, pressure along it like tension."""
    parts = np.asarray(load, float) * np.where(np.arange(6) == 0, -np.sign(load[0]), 1.0)
    return float(_figures(parts[:, None], diameter)["stress"][0])


def _unit_load(part: int, diameter: float) -> float:
    """Of one component of a load, what makes a nominal equivalent stress of 1 Pa."""
    return 1.0 / nominal_stress(np.eye(6)[part], diameter)


def _labelled(own: list[dict[str, np.ndarray]], time: np.ndarray, webs: np.ndarray) -> Any:
    import xarray

    variables = {}
    for name, (unit, words) in {**_VECTORS, **_FIGURES}.items():
        values = np.stack([each[name] for each in own], axis=1)
        dims = ("time", "rivet", "axis")[: values.ndim]
        variables[name] = (dims, values, {"units": unit, "long_name": words})
    return xarray.Dataset(variables, {"time": time, "rivet": webs, "axis": list(AXES)})
