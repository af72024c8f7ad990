"""The planar bearing in Exudyn with a flexible cage: ``ObjectFFRFreducedOrder`` in C++.

Exudyn's own ``FEMinterface`` reduces flexcage's finite elements (nodes, mass, stiffness) with
flexcage's mode shapes to every term of its floating frame; damping is flexcage's modal damping.
Contact needs a few points of the body: three stand for every pocket face, round the centre of its
circle, and all have the face's mean displacement by the modes, so that ``MarkerSuperElementRigid``
moves as flexcage's face does; the land's three do not deform. The body moves in space, its frame
turns by Tait-Bryan angles, of which contact drives the last.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.sparse as sp
from exudyn_model import ExudynBearing

IN_EXUDYN = [1, 2, 0]  # flexcage's y, z, x
TRIPLE = np.array([[1.0, 0.0], [-0.5, np.sqrt(0.75)], [-0.5, -np.sqrt(0.75)]])  # [m] off a centre


class FlexibleExudynBearing(ExudynBearing):
    """``ExudynBearing`` with the cage's modes."""

    def _cage(self, inertia: tuple[float, float], speed: np.ndarray) -> tuple[Any, Any, list[Any]]:
        planar, exu = self.planar, self.exu
        frame, layout = self._reduced(), planar.bearing.layout
        y, _ = planar.restore()
        (py, pz, turn), (vy, vz, spin) = self.start[-1], speed
        node = self.system.AddNode(
            {"nodeType": "RigidBodyRxyz", "referenceCoordinates": [py, pz, 0.0, 0.0, 0.0, turn],
             "initialVelocities": [vy, vz, 0.0, 0.0, 0.0, spin]}
        )  # fmt: skip
        n = layout.modes
        self.modal = self.system.AddNode(
            {"nodeType": "GenericODE2", "numberOfODE2Coordinates": n,
             "referenceCoordinates": [0.0] * n, "initialCoordinates": list(layout.q(y)["modes"]),
             "initialCoordinates_t": list(layout.u(y)["modes"])}
        )  # fmt: skip
        places, shapes = self._points()
        matrices = {
            "massMatrixReduced": frame.massMatrixReduced,
            "stiffnessMatrixReduced": frame.stiffnessMatrixReduced,
            "dampingMatrixReduced": planar.bearing.data.model.cage.dff,
        }
        for name, matrix in matrices.items():
            container = exu.MatrixContainer()
            container.SetWithDenseMatrix(matrix, useDenseMatrix=False)
            matrices[name] = container
        body = self.system.AddObject(
            {"objectType": "FFRFreducedOrder", "nodeNumbers": [node, self.modal], **matrices,
             "modeBasis": shapes, "referencePositions": places.reshape(-1),
             "mass": frame.totalMass, "inertia": frame.inertiaLocal, "centerOfMass": frame.chiU,
             "mPsiTildePsi": frame.mPsiTildePsi, "mPsiTildePsiTilde": frame.mPsiTildePsiTilde,
             "mPhitTPsi": frame.mPhitTPsi, "mPhitTPsiTilde": frame.mPhitTPsiTilde,
             "mXRefTildePsi": frame.mXRefTildePsi, "computeFFRFterms": True,
             "mXRefTildePsiTilde": frame.mXRefTildePsiTilde}
        )  # fmt: skip
        markers = [self._triple(body, k) for k in range(len(places) // 3)]
        self._place[markers[0]] = self.start[-1, :2]
        for marker, at in zip(markers[1:], self.walls.reshape(-1, 2), strict=True):
            self._place[marker] = self._in_space(at)
        return node, markers[0], markers[1:]

    def _triple(self, body: Any, k: int) -> Any:
        return self.system.AddMarker(
            {
                "markerType": "SuperElementRigid",
                "bodyNumber": body,
                "meshNodeNumbers": [3 * k, 3 * k + 1, 3 * k + 2],
                "weightingFactors": [1.0 / 3.0] * 3,
                "useAlternativeApproach": False,
                "rotationsExponentialMap": 0,
            }
        )  # fmt: skip  (faces do not turn, so the cheapest rotation will do)

    def _reduced(self) -> Any:
        """Exudyn's terms of the floating frame from flexcage's finite elements and mode shapes."""
        from exudyn.FEM import FEMinterface, ObjectFFRFreducedOrderInterface

        reduction = self.planar.reduction
        model, basis = reduction.model, reduction.basis
        order = (3 * np.arange(len(model.nodes))[:, None] + IN_EXUDYN).reshape(-1)
        fem = FEMinterface()
        fem.nodes = {"Position": model.nodes[:, IN_EXUDYN]}
        fem.massMatrix = sp.csr_matrix(sp.kron(model.mass_scalar, sp.eye(3)))
        fem.stiffnessMatrix = model.K[order][:, order]
        fem.modeBasis = {"matrix": basis.shapes[:, IN_EXUDYN].reshape(-1, basis.size)}
        return ObjectFFRFreducedOrderInterface(fem)

    def _points(self) -> tuple[np.ndarray, np.ndarray]:
        """Contact points (n, 3) in Exudyn's axes and their shapes (3 n, modes): the land's, then
        every pocket's front and rear."""
        data = self.planar.bearing.data.model.pocket
        centres = np.concatenate([np.zeros((1, 2)), self.walls.reshape(-1, 2)])
        places = np.zeros((len(centres), 3, 3))
        places[..., :2] = centres[:, None] + TRIPLE
        c, s = data.azimuth.T[..., None, None]
        r, psi = data.phi[:, :2, 0, 1], data.phi[:, :2, 0, 2]  # (Z, 2, modes)
        face = np.stack([c * r - s * psi, s * r + c * psi, np.zeros_like(r)], axis=2)
        shapes = np.zeros((len(centres), 3, 3, r.shape[-1]))
        shapes[1:] = face.reshape(-1, 1, 3, r.shape[-1])
        return places.reshape(-1, 3), shapes.reshape(-1, r.shape[-1])
