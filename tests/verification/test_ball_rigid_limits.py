"""A ball bearing's flexible cage becomes the rigid one: stiffened, and frozen."""

from dataclasses import replace

import numpy as np
import pytest
from verification_bearing import log, relative_error, with_modes

from flexcage.bearings.ball.motion import MOTION
from flexcage.bodies.cage import flexible_from_basis, rigid_from_tets
from flexcage.cages.build import rigid_interface_of
from flexcage.simulate import simulate
from flexcage.stages import cage_mesh, cage_reduction
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.problem import BearingSystem
from flexcage.verification.runs import c7010

THROWN = {  # against balls of different load; trajectories part soon after
    "load.radial": "40 N",
    "load.tilt": "free",
    "drive.speed": "4000 rpm",
    "start.push": "300 mm/s",
    "solver.duration": "1 ms",
    "solver.tolerance": "0.0003 um",
    "output.rate": "200 kHz",
    "output.vibration_rate": "200 kHz",
}


def rigid_and_flexible(factor: float):
    """Datasets of a thrown cage, rigid and flexible, with so many times its material's modulus.

    Ball and wall make the same contact law in both.
    """
    case = c7010(THROWN)
    case = case.replace("cage.material.youngs_modulus", factor * case.cage.material.youngs_modulus)
    return [simulate(case.replace("cage.model", m)).dataset for m in ("rigid", "flexible")]


def test_a_stiffened_cage_gives_the_rigid_run():
    """Four pockets are struck, with up to 120 N; the modulus alone decides what is left."""
    errors = {}
    for factor in (1e4, 1e5):
        rigid, flexible = rigid_and_flexible(factor)
        a, b = (ds["pocket_force"].values.astype(float) for ds in (rigid, flexible))
        assert np.count_nonzero(a.max(axis=0)) >= 4 and a.max() > 100.0
        errors[factor] = relative_error(b, a)
        log.info("E x %g: pocket forces differ by %.4f", factor, errors[factor])
        assert b.max() == pytest.approx(a.max(), rel=0.04)
        races = relative_error(flexible["race_force"].values, rigid["race_force"].values)
        assert races < 3e-4
        for name in ("cage_position", "inner_position"):
            moved = float(np.abs(rigid[name] - rigid[name][0]).max())
            assert float(np.abs(flexible[name] - rigid[name]).max()) < 1e-3 * moved, name
        apart = np.abs(flexible["element_position"] - rigid["element_position"]).max(
            ("time", "element")
        )
        assert float(apart.sel(cyl="r")) < 0.01e-6
        assert float(apart.sel(cyl="psi")) * 32.5e-3 < 1e-6  # they went round by 6 mm
    assert errors[1e4] < 0.05 and errors[1e5] < 0.2 * errors[1e4]


@pytest.fixture(scope="module")
def frozen_and_rigid():
    """(flexible without local compliance, rigid), with the same pocket law and two defects."""
    case = c7010({
        "load.tilt": "free",
        "defects": [
            {"type": "displaced", "pocket": 3, "circumferential": "0.1 mm", "axial": "0.1 mm"},
            {"type": "elongated", "pocket": 7, "direction": "axial", "elongation": "0.1 mm"},
        ],
    })  # fmt: skip
    mesh = cage_mesh(case)
    cage = cage_reduction(case.replace("cage.model", "flexible"), mesh)
    specs = {k: getattr(case, k) for k in ("contacts", "lubricant", "drive", "load", "mount")}

    def bearing(body, interface):
        model = MOTION.build_model(case.bearing, case.cage, body, interface, **specs)
        layout = Layout(18, bodies_of_bearing(body.modes))
        bearing = BearingSystem(MOTION, case.bearing, model, case.contacts, layout)
        for speeds in bearing.data.memory[:4]:
            speeds[...] = 0.3  # at which contacts closed
        return bearing

    ratios = np.ones(cage.basis.size)
    soft = flexible_from_basis(cage.model.nodes, cage.model.mass_scalar, cage.basis, ratios)
    hard = rigid_from_tets(mesh.points, mesh.tets, case.cage.material.density)
    still = replace(cage.interface, local=np.zeros_like(cage.interface.local))
    rigid = rigid_interface_of(case.cage, pocket_count=18, defects=case.defects)
    return bearing(soft, still), bearing(hard, rigid)


def test_frozen_modes_leave_the_rigid_equations(frozen_and_rigid):
    """In states with pocket contact and any accelerations, every rigid row is the rigid one."""
    frozen, rigid = frozen_and_rigid
    rng = np.random.default_rng(1)
    small, large = rigid.layout, frozen.layout
    for _ in range(5):
        y, yd = np.zeros(small.size), 10.0 * rng.standard_normal(small.size)
        q = small.q(y)
        balls = q["elements"]
        balls[:, 0] = 1e-4 * rng.standard_normal(18)
        balls[:, 1] = 32.5e-3 + 4e-6 * rng.standard_normal(18)
        balls[:, 2] = 2.0 * np.pi * np.arange(18) / 18 + 8e-3 * rng.standard_normal(18)
        q["cage"][:] = 1e-4 * rng.standard_normal(3)
        q["quaternion"][:] = [1.0, 1e-3, 2e-4, -1e-4]
        for values in small.u(y).values():
            values[...] = rng.standard_normal(values.shape)
        small.u(y)["omega"][0] = 180.0
        expected = small.u(rigid.residual(0.0, y, yd))
        there = [with_modes(small, large, v) for v in (y, yd)]
        ours = large.u(frozen.residual(0.0, *there))
        rigid.residual(0.0, y, yd, 2)
        assert np.count_nonzero(rigid.data.work.report.pocket_normal) >= 4
        for name, values in expected.items():
            if name != "modes" and values.size:
                scale = np.abs(values).max() + 10.0 * rigid.data.model.cage.mass
                np.testing.assert_allclose(ours[name], values, atol=1e-9 * scale, err_msg=name)
